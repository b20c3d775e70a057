// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "MeshReaders.h"

#include "MeshArrays.h"
#include "TextFile.h"
#include "TextScanner.h"

#include "vtkCellArray.h"
#include "vtkNew.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"
#include "vtkType.h"

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <vector>

namespace penumbra
{

namespace
{

class PointMerger
{
public:
  /// Returns the id of the point with exactly these coordinates; adds it if there is none.
  vtkIdType Insert(const double point[3]);

  /// `type`: VTK_FLOAT or VTK_DOUBLE.
  vtkSmartPointer<vtkPoints> MakePoints(int type) const;

private:
  std::size_t FindSlot(const double point[3]) const;
  void Grow();

  std::vector<double> Coordinates;
  std::vector<vtkIdType> Slots; ///< open addressing; -1: empty; the size is a power of two
};

vtkIdType PointMerger::Insert(const double coordinates[3])
{
  // Adding 0 makes 0 of -0.
  const double point[3] = { coordinates[0] + 0.0, coordinates[1] + 0.0, coordinates[2] + 0.0 };
  if (2 * (this->Coordinates.size() / 3 + 1) > this->Slots.size())
  {
    this->Grow();
  }
  vtkIdType& slot = this->Slots[this->FindSlot(point)];
  if (slot < 0)
  {
    slot = static_cast<vtkIdType>(this->Coordinates.size() / 3);
    this->Coordinates.insert(this->Coordinates.end(), point, point + 3);
  }
  return slot;
}

std::size_t PointMerger::FindSlot(const double point[3]) const
{
  std::uint64_t hash = 0;
  for (int i = 0; i < 3; ++i)
  {
    std::uint64_t bits;
    std::memcpy(&bits, point + i, sizeof(bits));
    hash = (hash ^ bits ^ (bits >> 32)) * 0x9e3779b97f4a7c15ull;
    hash ^= hash >> 29;
  }
  const std::size_t mask = this->Slots.size() - 1;
  std::size_t slot = static_cast<std::size_t>(hash) & mask;
  while (this->Slots[slot] >= 0 &&
    std::memcmp(&this->Coordinates[3 * this->Slots[slot]], point, 3 * sizeof(double)) != 0)
  {
    slot = (slot + 1) & mask;
  }
  return slot;
}

void PointMerger::Grow()
{
  this->Slots.assign(this->Slots.empty() ? 1024 : 2 * this->Slots.size(), -1);
  for (std::size_t i = 0; i < this->Coordinates.size(); i += 3)
  {
    this->Slots[this->FindSlot(&this->Coordinates[i])] = static_cast<vtkIdType>(i / 3);
  }
}

vtkSmartPointer<vtkPoints> PointMerger::MakePoints(int type) const
{
  auto points = vtkSmartPointer<vtkPoints>::New();
  points->SetDataType(type);
  points->SetNumberOfPoints(static_cast<vtkIdType>(this->Coordinates.size() / 3));
  for (std::size_t i = 0; i < this->Coordinates.size(); i += 3)
  {
    points->SetPoint(static_cast<vtkIdType>(i / 3), &this->Coordinates[i]);
  }
  return points;
}

constexpr std::size_t BinaryHeaderSize = 84; ///< 80 bytes of text, number of triangles
constexpr std::size_t BinaryTriangleSize = 50;

class Triangles
{
public:
  void Insert(const double corners[3][3])
  {
    vtkIdType ids[3];
    for (int i = 0; i < 3; ++i)
    {
      ids[i] = this->Points.Insert(corners[i]);
    }
    const bool isDegenerate = ids[0] == ids[1] || ids[0] == ids[2] || ids[1] == ids[2];
    (isDegenerate ? this->Degenerate : this->Cells)->InsertNextCell(3, ids);
  }

  vtkSmartPointer<vtkPolyData> MakeMesh(int type) const
  {
    auto mesh = vtkSmartPointer<vtkPolyData>::New();
    mesh->SetPoints(this->Points.MakePoints(type));
    // A mesh of points only would be rendered as a point cloud.
    mesh->SetPolys(this->Cells->GetNumberOfCells() > 0 ? this->Cells : this->Degenerate);
    return mesh;
  }

private:
  PointMerger Points;
  vtkNew<vtkCellArray> Cells;
  vtkNew<vtkCellArray> Degenerate; ///< triangles with coincident corners
};

std::size_t DeclaredTriangles(const TextFile& file)
{
  std::uint32_t count = 0;
  if (file.Size() >= BinaryHeaderSize)
  {
    std::memcpy(&count, file.Begin() + BinaryHeaderSize - sizeof(count), sizeof(count));
  }
  return count;
}

/// Binary files may start with "solid", too.
bool IsAscii(const TextFile& file)
{
  const bool isBinary = file.Size() >= BinaryHeaderSize &&
    file.Size() == BinaryHeaderSize + BinaryTriangleSize * DeclaredTriangles(file);
  TextScanner text(file.Begin(), file.End());
  const std::string_view word = text.Word();
  const std::size_t head = file.Size() < 512 ? file.Size() : 512;
  return !isBinary && word.size() >= 5 && EqualsIgnoringCase(word.substr(0, 5), "solid") &&
    !std::memchr(file.Begin(), '\0', head);
}

/// Returns the number of triangles in the file, also of those that it does not declare.
std::size_t HeldTriangles(const TextFile& file)
{
  return (file.Size() - BinaryHeaderSize) / BinaryTriangleSize;
}

/// Programs that write while they compute may leave the number of the header at 0.
std::size_t TrianglesToRead(const TextFile& file)
{
  const std::size_t declared = DeclaredTriangles(file);
  return declared == 0 ? HeldTriangles(file) : declared;
}

vtkSmartPointer<vtkPolyData> ReadBinary(const std::string& path, const TextFile& file)
{
  if (file.Size() < BinaryHeaderSize)
  {
    ThrowTruncated(path, "triangle");
  }
  const std::size_t count = TrianglesToRead(file);
  if (count > HeldTriangles(file))
  {
    ThrowDamaged(path,
      "it has " + std::to_string(HeldTriangles(file)) + " of the " + std::to_string(count) +
        " triangles that its header declares");
  }
  Triangles triangles;
  const char* at = file.Begin() + BinaryHeaderSize;
  for (std::size_t i = 0; i < count; ++i, at += BinaryTriangleSize)
  {
    float values[12]; // normal, corners
    std::memcpy(values, at, sizeof(values));
    double corners[3][3];
    for (int k = 0; k < 9; ++k)
    {
      corners[k / 3][k % 3] = values[3 + k];
    }
    triangles.Insert(corners);
  }
  return triangles.MakeMesh(VTK_FLOAT);
}

/// Reads the corners of a loop; returns the number of corners, at most 3, or -1 at a wrong number.
int ReadLoop(TextScanner& text, double corners[3][3])
{
  int count = 0;
  for (std::string_view word = text.Word(); EqualsIgnoringCase(word, "vertex"); word = text.Word())
  {
    double point[3];
    for (double& coordinate : point)
    {
      if (!ParseNumber(text.Word(), coordinate))
      {
        return -1;
      }
    }
    if (count < 3)
    {
      std::memcpy(corners[count], point, sizeof(point));
    }
    ++count;
  }
  return count;
}

/// Skips the name of a solid: the rest of the line, or what is before the first facet.
void SkipName(TextScanner& text)
{
  for (std::string_view word = text.WordInLine(); !word.empty(); word = text.WordInLine())
  {
    if (EqualsIgnoringCase(word, "facet") && EqualsIgnoringCase(text.Peek(), "normal"))
    {
      return;
    }
  }
}

vtkSmartPointer<vtkPolyData> ReadAscii(const std::string& path, const TextFile& file)
{
  TextScanner text(file.Begin(), file.End());
  Triangles triangles;
  text.Word();
  SkipName(text);
  bool isOpen = true;
  while (!text.AtEnd())
  {
    const std::string_view word = text.Word();
    if (EqualsIgnoringCase(word, "outer") || EqualsIgnoringCase(word, "loop"))
    {
      if (EqualsIgnoringCase(text.Peek(), "loop"))
      {
        text.Word();
      }
      double corners[3][3];
      const int count = ReadLoop(text, corners);
      if (count != 3)
      {
        text.AtEnd() ? ThrowTruncated(path, "line, 'endsolid'")
                     : ThrowDamaged(path, "a facet does not have three vertices");
      }
      triangles.Insert(corners);
    }
    else if (EqualsIgnoringCase(word, "endsolid"))
    {
      isOpen = false;
      text.Line();
    }
    else if (EqualsIgnoringCase(word, "end"))
    {
      isOpen = isOpen && !EqualsIgnoringCase(text.WordInLine(), "solid");
      text.Line();
    }
    else if (EqualsIgnoringCase(word, "solid"))
    {
      isOpen = true;
      SkipName(text);
    }
  }
  if (isOpen)
  {
    ThrowTruncated(path, "line, 'endsolid'");
  }
  return triangles.MakeMesh(VTK_DOUBLE);
}

/// Returns what ReadBinary() does not read, such as triangles that the header does not declare; empty if it reads all.
std::string DescribeUnread(const TextFile& file)
{
  const std::size_t read = BinaryHeaderSize + BinaryTriangleSize * TrianglesToRead(file);
  // Zeros and white space are padding.
  const bool isPadding =
    std::string_view(file.Begin() + read, file.Size() - read)
      .find_first_not_of(std::string_view("\0 \t\r\n", 5)) == std::string_view::npos;
  if (isPadding)
  {
    return std::string();
  }
  const std::size_t rest = file.Size() - read;
  const std::string skipped = std::to_string(rest) + (rest == 1 ? " byte" : " bytes");
  return DeclaredTriangles(file) == 0
    ? "it ends within a triangle, whose " + skipped + " were skipped; copy it again"
    : "the number of triangles in its header is " + std::to_string(DeclaredTriangles(file)) +
      "; the " + skipped + " after them, as many as " + std::to_string(rest / BinaryTriangleSize) +
      " triangles have, were skipped; export it again";
}

}

vtkSmartPointer<vtkDataObject> ReadStl(const std::string& path)
{
  const TextFile file(path);
  if (IsAscii(file))
  {
    return ReadAscii(path, file);
  }
  vtkSmartPointer<vtkPolyData> mesh = ReadBinary(path, file);
  const std::string unread = DescribeUnread(file);
  if (!unread.empty())
  {
    AddUnread(mesh, unread);
  }
  return mesh;
}

}
