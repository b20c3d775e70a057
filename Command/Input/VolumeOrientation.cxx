// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "VolumeOrientation.h"

#include "Files/FileExtension.h"
#include "Formats/TextScanner.h"
#include "Processes/CommandError.h"

#include "vtkImageData.h"
#include "vtkMath.h"
#include "vtkMatrix3x3.h"
#include "vtkMatrix4x4.h"
#include "vtkMetaImageReader.h"
#include "vtkNIFTIImageReader.h"
#include "vtkNew.h"
#include "vtkNrrdReader.h"
#include "vtkObjectFactory.h"
#include "vtkStringArray.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <map>
#include <string>
#include <vector>

namespace penumbra
{

namespace
{

/// Position of the first voxel and the steps to the next voxel along each axis.
struct Frame
{
  double Origin[3] = { 0.0, 0.0, 0.0 };
  double Steps[3][3] = { { 1.0, 0.0, 0.0 }, { 0.0, 1.0, 0.0 }, { 0.0, 0.0, 1.0 } };
};

/// The header of an NRRD file.
struct NrrdHeader
{
  /// False: the header does not tell the axes of space from those of components.
  bool IsKnown = false;
  int Sizes[3] = { 1, 1, 1 }; ///< of the spatial axes
  int Components = 1;         ///< product of the axes before the spatial ones
  Frame Placement;
};

using Fields = std::map<std::string, std::string>;
using Vector = std::vector<double>;

/// Reads the fields up to the empty line, in lower case and without spaces in their names.
Fields ReadFields(const std::string& path)
{
  std::ifstream file(path, std::ios::binary);
  Fields fields;
  std::string line;
  while (std::getline(file, line))
  {
    line.erase(line.find_last_not_of(" \t\r") + 1);
    if (line.empty())
    {
      break;
    }
    const std::size_t colon = line.find(':');
    if (line[0] != '#' && colon != line.npos && line.compare(colon, 2, ":=") != 0)
    {
      std::string name = LowerCase(line.substr(0, colon));
      name.erase(std::remove(name.begin(), name.end(), ' '), name.end());
      fields[name] = line.substr(colon + 1);
    }
  }
  return fields;
}

std::vector<std::string> SplitWords(const std::string& text)
{
  TextScanner scanner(text.data(), text.data() + text.size());
  std::vector<std::string> words;
  for (std::string_view word = scanner.Word(); !word.empty(); word = scanner.Word())
  {
    words.emplace_back(word);
  }
  return words;
}

/// Splits "(1,0,0) none (0, 1, 0)" into vectors; those of "none" are empty.
std::vector<Vector> SplitVectors(const std::string& text)
{
  std::vector<Vector> vectors;
  for (std::size_t at = 0; (at = text.find_first_not_of(" \t", at)) != text.npos;)
  {
    vectors.emplace_back();
    if (text[at] != '(')
    {
      at = std::min(text.find_first_of(" \t", at), text.size());
      continue;
    }
    const std::size_t end = std::min(text.find(')', at), text.size());
    std::string inside = text.substr(at + 1, end - at - 1);
    std::replace(inside.begin(), inside.end(), ',', ' ');
    for (const std::string& word : SplitWords(inside))
    {
      double number = 0.0;
      ParseNumber(word, number);
      vectors.back().push_back(number);
    }
    at = std::min(end + 1, text.size());
  }
  return vectors;
}

bool IsSpatialKind(const std::string& kind)
{
  return kind == "domain" || kind == "space";
}

double NumberOr(const std::vector<std::string>& words, std::size_t index, double otherwise)
{
  double number = 0.0;
  const bool found =
    index < words.size() && ParseNumber(words[index], number) && std::isfinite(number);
  return found ? number : otherwise;
}

/// Returns the spatial axes; empty if the header does not tell.
std::vector<std::size_t> FindSpatialAxes(
  Fields& fields, std::size_t dimension, const std::vector<Vector>& directions)
{
  const std::vector<std::string> kinds = SplitWords(LowerCase(fields["kinds"]));
  std::vector<std::size_t> axes;
  for (std::size_t axis = 0; axis < dimension; ++axis)
  {
    const bool isSpatial = directions.size() == dimension ? !directions[axis].empty()
      : kinds.size() == dimension                         ? IsSpatialKind(kinds[axis])
                                                          : false;
    if (isSpatial)
    {
      axes.push_back(axis);
    }
  }
  const bool isMeasured = !fields["spacings"].empty() || !fields["axismins"].empty();
  if (axes.empty() && dimension <= 3 && isMeasured)
  {
    for (std::size_t axis = 0; axis < dimension; ++axis)
    {
      axes.push_back(axis);
    }
  }
  return axes;
}

NrrdHeader ReadNrrdHeader(const std::string& path)
{
  Fields fields = ReadFields(path);
  const std::vector<std::string> sizes = SplitWords(fields["sizes"]);
  for (const std::string& size : sizes)
  {
    const double number = NumberOr({ size }, 0, 0.0);
    if (!(number >= 1.0 && number <= std::numeric_limits<int>::max() &&
          number == std::floor(number)))
    {
      throw CommandError(BadInput,
        path + ": the file is damaged: 'sizes' must be integers from 1 to 2147483647, not '" +
          size + "'");
    }
  }
  const std::vector<Vector> directions = SplitVectors(fields["spacedirections"]);
  const std::vector<std::size_t> axes = FindSpatialAxes(fields, sizes.size(), directions);
  NrrdHeader header;
  if (axes.empty() || axes.size() > 3 || axes.back() - axes.front() + 1 != axes.size())
  {
    return header;
  }
  header.IsKnown = true;
  double components = 1.0;
  for (std::size_t axis = 0; axis < axes.front(); ++axis)
  {
    components *= NumberOr(sizes, axis, 1.0);
  }
  header.Components = static_cast<int>(std::clamp(components, 1.0, 1e6));
  const std::vector<Vector> origin = SplitVectors(fields["spaceorigin"]);
  const std::vector<std::string> spacings = SplitWords(fields["spacings"]);
  const std::vector<std::string> minima = SplitWords(fields["axismins"]);
  for (std::size_t i = 0; i < axes.size(); ++i)
  {
    const std::size_t axis = axes[i];
    header.Sizes[i] = static_cast<int>(std::clamp(NumberOr(sizes, axis, 1.0), 1.0, 2147483647.0));
    if (directions.size() == sizes.size() && !directions[axis].empty())
    {
      for (std::size_t k = 0; k < 3; ++k)
      {
        header.Placement.Steps[i][k] = k < directions[axis].size() ? directions[axis][k] : 0.0;
      }
    }
    else
    {
      header.Placement.Steps[i][i] = NumberOr(spacings, axis, 1.0);
      header.Placement.Origin[i] = NumberOr(minima, axis, 0.0);
    }
  }
  for (std::size_t k = 0; k < 3 && !origin.empty() && k < origin[0].size(); ++k)
  {
    header.Placement.Origin[k] = origin[0][k];
  }
  return header;
}

void SetFrame(vtkDataObject* data, const std::string& path, Frame frame)
{
  vtkImageData* image = vtkImageData::SafeDownCast(data);
  if (!image)
  {
    return;
  }
  if (image->GetDimensions()[2] == 1)
  {
    // The third axis of a slice may be missing.
    double normal[3];
    vtkMath::Cross(frame.Steps[0], frame.Steps[1], normal);
    vtkMath::Normalize(normal);
    if (std::abs(vtkMath::Dot(normal, frame.Steps[2])) <= 1e-6 * vtkMath::Norm(frame.Steps[2]))
    {
      std::copy(normal, normal + 3, frame.Steps[2]);
    }
  }
  double spacing[3];
  vtkNew<vtkMatrix3x3> direction;
  for (int axis = 0; axis < 3; ++axis)
  {
    spacing[axis] = vtkMath::Norm(frame.Steps[axis]);
    for (int i = 0; i < 3; ++i)
    {
      direction->SetElement(i, axis, frame.Steps[axis][i] / spacing[axis]);
    }
  }
  const double volume = direction->Determinant();
  if (!std::isfinite(volume) || std::abs(volume) < 1e-6)
  {
    throw CommandError(
      BadInput, path + ": the axes of the volume are parallel or zero; correct its orientation");
  }
  image->SetOrigin(frame.Origin);
  image->SetSpacing(spacing);
  image->SetDirectionMatrix(direction);
}

std::vector<double> ParseNumbers(std::string_view text)
{
  TextScanner words(text.data(), text.data() + text.size());
  std::vector<double> numbers;
  double number = 0.0;
  for (std::string_view word = words.Word(); !word.empty(); word = words.Word())
  {
    if (!ParseNumber(word, number))
    {
      break;
    }
    numbers.push_back(number);
  }
  return numbers;
}

struct MetaImageHeader
{
  std::vector<double> Origin;
  std::vector<double> Spacing;
  std::vector<double> Matrix;
  std::vector<double> Sizes; ///< numbers of voxels
};

MetaImageHeader ReadMetaImageHeader(const std::string& path)
{
  std::ifstream file(path, std::ios::binary);
  MetaImageHeader header;
  std::vector<double> size;
  std::string line;
  while (std::getline(file, line))
  {
    const std::size_t sign = line.find('=');
    if (sign == line.npos)
    {
      break;
    }
    TextScanner words(line.data(), line.data() + sign);
    const std::string_view key = words.Word();
    const std::vector<double> numbers = ParseNumbers(std::string_view(line).substr(sign + 1));
    if (key == "Offset" || key == "Position" || key == "Origin")
    {
      header.Origin = numbers;
    }
    else if (key == "TransformMatrix" || key == "Rotation" || key == "Orientation")
    {
      header.Matrix = numbers;
    }
    else if (key == "DimSize")
    {
      header.Sizes = numbers;
    }
    else if (key == "ElementSpacing")
    {
      header.Spacing = numbers;
    }
    else if (key == "ElementSize")
    {
      size = numbers;
    }
    else if (key == "ElementDataFile")
    {
      break; // Data may follow.
    }
  }
  header.Spacing = header.Spacing.empty() ? size : header.Spacing;
  return header;
}

/// Reads components by the header.
class NrrdReader : public vtkNrrdReader
{
public:
  static NrrdReader* New();
  vtkTypeMacro(NrrdReader, vtkNrrdReader);

  NrrdHeader Header;

protected:
  using vtkNrrdReader::ReadHeader;
  int ReadHeader(vtkCharArray* buffer) override
  {
    const int result = this->Superclass::ReadHeader(buffer);
    if (result && this->Header.IsKnown)
    {
      this->FileLowerLeft = 1; // The superclass flips the rows of some spaces.
      this->NumberOfScalarComponents = this->Header.Components;
      const bool isSplit = this->DataFiles->GetNumberOfValues() > 1;
      this->FileDimensionality = isSplit ? 2 : 3;
      for (int axis = 0; axis < 3; ++axis)
      {
        this->DataExtent[2 * axis] = 0;
        this->DataExtent[2 * axis + 1] = this->Header.Sizes[axis] - 1;
      }
    }
    return result;
  }
};

vtkStandardNewMacro(NrrdReader);

}

vtkSmartPointer<vtkAlgorithm> MakeNrrdReader(const std::string& path)
{
  auto reader = vtkSmartPointer<NrrdReader>::New();
  reader->Header = ReadNrrdHeader(path);
  reader->SetFileName(path.c_str());
  return reader;
}

void OrientNrrd(
  vtkAlgorithm* reader, const std::string& path, vtkDataObject* image, std::vector<std::string>&)
{
  const NrrdHeader& header = static_cast<NrrdReader*>(reader)->Header;
  if (header.IsKnown)
  {
    SetFrame(image, path, header.Placement);
  }
}

vtkSmartPointer<vtkAlgorithm> MakeMetaImageReader(const std::string& path)
{
  const std::size_t dimensions = ReadMetaImageHeader(path).Sizes.size();
  if (dimensions > 3)
  {
    throw CommandError(BadInput,
      path + ": the volume has " + std::to_string(dimensions) +
        " dimensions instead of 3; write one file per volume");
  }
  auto reader = vtkSmartPointer<vtkMetaImageReader>::New();
  reader->SetFileName(path.c_str());
  return reader;
}

void OrientMetaImage(
  vtkAlgorithm*, const std::string& path, vtkDataObject* image, std::vector<std::string>&)
{
  const MetaImageHeader header = ReadMetaImageHeader(path);
  const std::vector<double>& matrix = header.Matrix;
  const std::size_t dimension = matrix.size() == 4 ? 2 : 3;
  Frame frame;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    frame.Origin[axis] = axis < header.Origin.size() ? header.Origin[axis] : 0.0;
    // The matrix lists the direction of one axis after the other.
    for (std::size_t i = 0; i < dimension && axis < dimension && !matrix.empty(); ++i)
    {
      frame.Steps[axis][i] =
        axis * dimension + i < matrix.size() ? matrix[axis * dimension + i] : frame.Steps[axis][i];
    }
    const bool hasStep = axis < header.Spacing.size() && header.Spacing[axis] != 0.0;
    vtkMath::MultiplyScalar(frame.Steps[axis], hasStep ? std::abs(header.Spacing[axis]) : 1.0);
  }
  SetFrame(image, path, frame);
}

void OrientNifti(vtkAlgorithm* algorithm, const std::string& path, vtkDataObject* data,
  std::vector<std::string>& warnings)
{
  auto* reader = static_cast<vtkNIFTIImageReader*>(algorithm);
  if (reader->GetTimeDimension() > 1)
  {
    warnings.push_back("only the first of " + std::to_string(reader->GetTimeDimension()) +
      " volumes is read; write one file per volume");
  }
  vtkImageData* image = vtkImageData::SafeDownCast(data);
  vtkMatrix4x4* matrix =
    reader->GetSFormMatrix() ? reader->GetSFormMatrix() : reader->GetQFormMatrix();
  if (!matrix || !image)
  {
    return;
  }
  Frame frame;
  for (int axis = 0; axis < 3; ++axis)
  {
    frame.Origin[axis] = matrix->GetElement(axis, 3);
    for (int i = 0; i < 3; ++i)
    {
      frame.Steps[axis][i] = matrix->GetElement(i, axis) * image->GetSpacing()[axis];
    }
  }
  SetFrame(data, path, frame);
}

}
