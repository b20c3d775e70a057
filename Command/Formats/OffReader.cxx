// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// The Object File Format of Geomview: [ST][C][N][4]OFF, ASCII. Values that other programs append
// to the lines of an OFF file (colors of vertices) are read, too.
#include "MeshReaders.h"

#include "MeshArrays.h"
#include "Processes/CommandError.h"
#include "TextFile.h"
#include "TextScanner.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkDoubleArray.h"
#include "vtkFloatArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <vector>

namespace penumbra
{

namespace
{

/// A color; its range is 0 to 1 if a component has a decimal point, otherwise 0 to 255.
class ColorColumn
{
public:
  void Read(const std::vector<std::string_view>& words)
  {
    std::array<double, 4> color = { 0.0, 0.0, 0.0, -1.0 };
    bool fractional = false;
    for (std::size_t i = 0; i < words.size() && i < 4; ++i)
    {
      ParseNumber(words[i], color[i]);
      fractional = fractional || words[i].find_first_of(".eE") != words[i].npos;
    }
    const double scale = fractional ? 255.0 : 1.0;
    const bool hasAlpha = words.size() == 4;
    this->HasAlpha = this->HasAlpha || hasAlpha;
    this->Found = this->Found || words.size() >= 3;
    const bool isColor = words.size() >= 3;
    for (int i = 0; i < 3; ++i)
    {
      this->Values.push_back(isColor ? scale * color[i] : Unspecified);
    }
    this->Values.push_back(hasAlpha ? scale * color[3] : 255.0);
  }

  void AddTo(vtkDataSetAttributes* attributes) const
  {
    if (!this->Found)
    {
      return;
    }
    vtkNew<vtkFloatArray> colors;
    colors->SetNumberOfComponents(this->HasAlpha ? 4 : 3);
    colors->SetNumberOfTuples(static_cast<vtkIdType>(this->Values.size() / 4));
    for (vtkIdType i = 0; i < colors->GetNumberOfTuples(); ++i)
    {
      for (int k = 0; k < colors->GetNumberOfComponents(); ++k)
      {
        colors->SetTypedComponent(i, k, static_cast<float>(this->Values[4 * i + k] / 255.0));
      }
    }
    AddColors(attributes, colors);
  }

private:
  static constexpr double Unspecified = 170.0; ///< Geomview's gray

  std::vector<double> Values; ///< four per color, 0 to 255
  bool HasAlpha = false;
  bool Found = false;
};

class Reader
{
public:
  Reader(const std::string& path, const TextFile& file)
    : Path(path),
      Text(file.Begin(), file.End(), '#')
  {
  }

  vtkSmartPointer<vtkPolyData> Read()
  {
    this->ReadHeader();
    this->ReadVertices();
    this->ReadFaces();
    return this->Mesh;
  }

private:
  void ReadHeader()
  {
    std::string_view word = this->Text.Word();
    const std::size_t end = FindKeywordEnd(word);
    if (end > 0)
    {
      std::string_view prefix = word.substr(0, end - 3);
      // Geomview's nOFF has vertices of n dimensions.
      const bool hasDimension = prefix.find('n') != prefix.npos && word[end - 3] == 'O';
      this->ReadPrefix(prefix);
      if (!prefix.empty() || hasDimension)
      {
        throw CommandError(BadInput,
          this->Path + ": the format " + std::string(word.substr(0, end)) +
            " has vertices of another dimension; export the mesh as OFF");
      }
      word.remove_prefix(end); // "OFF8 6 12" occurs in collections of models.
      word = word.empty() ? this->Text.Word() : word;
    }
    if (EqualsIgnoringCase(word, "BINARY"))
    {
      throw CommandError(
        BadInput, this->Path + ": binary OFF files cannot be read; export the mesh as text");
    }
    this->Vertices = this->Count(word);
    this->Faces = this->Count(this->Text.Word());
    // The number of edges, which some programs leave out, is in the same line.
    if (this->Text.CountWordsInLine() >= 1)
    {
      this->Text.WordInLine();
    }
    // A vertex and a face have at least six bytes.
    if (6.0 * static_cast<double>(this->Vertices) + 2.0 * static_cast<double>(this->Faces) >
      static_cast<double>(this->Text.Left()) + 1.0)
    {
      ThrowTruncated(this->Path, "face");
    }
  }

  /// Removes the variants from the prefix. MeshLab writes them in another order than Geomview, CSTOFF.
  void ReadPrefix(std::string_view& prefix)
  {
    for (std::size_t size = std::string_view::npos; size != prefix.size();)
    {
      size = prefix.size();
      this->HasTCoords = Take(prefix, "ST") || this->HasTCoords;
      this->HasColors = Take(prefix, "C") || this->HasColors;
      this->HasNormals = Take(prefix, "N") || this->HasNormals;
      this->HasWeights = Take(prefix, "4") || this->HasWeights;
    }
  }

  /// Returns the number of characters of the keyword, or 0 if the word starts with none.
  static std::size_t FindKeywordEnd(std::string_view word)
  {
    for (std::size_t end = 3; end <= std::min<std::size_t>(word.size(), 8); ++end)
    {
      const bool last = end == word.size() || std::isdigit(static_cast<unsigned char>(word[end]));
      if (last && EqualsIgnoringCase(word.substr(end - 3, 3), "OFF"))
      {
        return end;
      }
    }
    return 0;
  }

  static bool Take(std::string_view& word, std::string_view prefix)
  {
    const bool found =
      word.size() >= prefix.size() && EqualsIgnoringCase(word.substr(0, prefix.size()), prefix);
    word.remove_prefix(found ? prefix.size() : 0);
    return found;
  }

  long long Count(std::string_view word) const
  {
    long long count = 0;
    if (!ParseInteger(word, count) || count < 0)
    {
      throw CommandError(BadInput,
        this->Path + ": the file is damaged or not OFF: it does not start with OFF and its counts");
    }
    return count;
  }

  double Number()
  {
    double value = 0.0;
    const std::string_view word = this->Text.Word();
    if (word.empty())
    {
      ThrowTruncated(this->Path, "vertex");
    }
    if (!ParseNumber(word, value))
    {
      ThrowDamaged(this->Path, "'" + std::string(word.substr(0, 40)) + "' is not a number");
    }
    return value;
  }

  void ReadVertices()
  {
    const int required =
      (this->HasWeights ? 4 : 3) + (this->HasNormals ? 3 : 0) + (this->HasTCoords ? 2 : 0);
    // Several vertices may be in one line only if nothing is appended to them.
    TextScanner ahead = this->Text;
    ahead.Word();
    const int first = 1 + ahead.CountWordsInLine();
    const int extra = first - required;
    const bool hasColors = this->HasColors || extra == 3 || extra == 4;
    vtkNew<vtkPoints> points;
    points->SetDataTypeToDouble();
    points->SetNumberOfPoints(this->Vertices);
    vtkNew<vtkFloatArray> normals;
    normals->SetName("Normals");
    normals->SetNumberOfComponents(3);
    vtkNew<vtkFloatArray> coordinates;
    coordinates->SetName("TCoords");
    coordinates->SetNumberOfComponents(2);
    ColorColumn colors;
    for (long long i = 0; i < this->Vertices; ++i)
    {
      double x[4] = { 0.0, 0.0, 0.0, 1.0 };
      this->Numbers(x, this->HasWeights ? 4 : 3);
      const double weight = x[3] != 0.0 ? x[3] : 1.0;
      points->SetPoint(i, x[0] / weight, x[1] / weight, x[2] / weight);
      if (this->HasNormals)
      {
        this->Numbers(x, 3);
        normals->InsertNextTuple(x);
      }
      if (hasColors)
      {
        const int words = this->Text.CountWordsInLine() - (this->HasTCoords ? 2 : 0);
        colors.Read(this->Words(std::clamp(words, 0, 4)));
      }
      if (this->HasTCoords)
      {
        this->Numbers(x, 2);
        coordinates->InsertNextTuple(x);
      }
    }
    this->Mesh->SetPoints(points);
    if (this->HasNormals)
    {
      this->Mesh->GetPointData()->SetNormals(normals);
    }
    if (this->HasTCoords)
    {
      this->Mesh->GetPointData()->SetTCoords(coordinates);
    }
    colors.AddTo(this->Mesh->GetPointData());
  }

  void Numbers(double* values, int count)
  {
    for (int i = 0; i < count; ++i)
    {
      values[i] = this->Number();
    }
  }

  std::vector<std::string_view> Words(int count)
  {
    std::vector<std::string_view> words(count);
    for (std::string_view& word : words)
    {
      word = this->Text.WordInLine();
    }
    return words;
  }

  void ReadFaces()
  {
    vtkNew<vtkCellArray> polygons;
    ColorColumn colors;
    bool isStream = false; // All faces are in one line.
    std::vector<vtkIdType> corners;
    for (long long face = 0; face < this->Faces; ++face)
    {
      const std::string_view word = this->Text.Word();
      long long size = 0;
      if (word.empty())
      {
        ThrowTruncated(this->Path, "face");
      }
      if (!ParseInteger(word, size) || size < 0)
      {
        ThrowDamaged(
          this->Path, "face " + std::to_string(face) + " does not start with a number of vertices");
      }
      if (2.0 * static_cast<double>(size) > static_cast<double>(this->Text.Left()) + 1.0)
      {
        ThrowTruncated(this->Path, "face");
      }
      corners.resize(size);
      for (vtkIdType& corner : corners)
      {
        corner = this->Corner();
      }
      polygons->InsertNextCell(size, corners.data());
      const int words = this->Text.CountWordsInLine();
      isStream = isStream || (face == 0 && words > 4);
      colors.Read(this->Words(isStream ? 0 : std::min(words, 4)));
      if (!isStream)
      {
        this->Text.Line();
      }
    }
    this->Mesh->SetPolys(polygons);
    colors.AddTo(this->Mesh->GetCellData());
  }

  vtkIdType Corner()
  {
    const std::string_view word = this->Text.Word();
    long long corner = 0;
    if (word.empty())
    {
      ThrowTruncated(this->Path, "face");
    }
    if (!ParseInteger(word, corner))
    {
      ThrowDamaged(
        this->Path, "'" + std::string(word.substr(0, 40)) + "' is not the number of a vertex");
    }
    return corner;
  }

  const std::string& Path;
  TextScanner Text;
  long long Vertices = 0;
  long long Faces = 0;
  bool HasTCoords = false;
  bool HasColors = false;
  bool HasNormals = false;
  bool HasWeights = false;
  vtkSmartPointer<vtkPolyData> Mesh = vtkSmartPointer<vtkPolyData>::New();
};

}

vtkSmartPointer<vtkDataObject> ReadOff(const std::string& path)
{
  const TextFile file(path);
  return Reader(path, file).Read();
}

}
