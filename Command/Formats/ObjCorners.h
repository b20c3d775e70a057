// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Points of an OBJ file: one for each combination of a vertex, a texture coordinate and a normal.
#ifndef penumbra_ObjCorners_h
#define penumbra_ObjCorners_h

#include "vtkSmartPointer.h"
#include "vtkType.h"

#include <cstddef>
#include <string_view>
#include <vector>

class vtkCellArray;
class vtkPolyData;

namespace penumbra
{

/// Indices of a vertex, a texture coordinate and a normal; -1: none.
struct ObjCorner
{
  int Vertex = -1;
  int TCoord = -1;
  int Normal = -1;
};

/// Cells whose corners are codes of ObjCorners.
struct ObjCells
{
  std::vector<int> Codes;
  std::vector<std::size_t> Ends; ///< in Codes, of each cell
  std::vector<bool> HasNormals;  ///< of each cell

  std::size_t Size() const { return this->Ends.size(); }
};

class ObjCorners
{
public:
  /// `limit`: no valid file of this size has so many vertices.
  explicit ObjCorners(std::size_t limit)
    : Limit(limit)
  {
  }

  /// `values`: coordinates, then as many components of a color as `colorComponents`.
  void AddVertex(const double* values, int colorComponents);
  void AddNormal(const float normal[3]);
  void AddTCoord(const float coordinates[2]);

  /// Parses "v", "v/t", "v//n" or "v/t/n"; returns false if it is none. A vertex may be defined
  /// later; texture coordinates and normals that are not defined are left out.
  bool Parse(std::string_view word, ObjCorner& corner) const;

  /// Appends a cell.
  void Insert(const std::vector<ObjCorner>& corners, ObjCells& cells);

  /// Returns the number of vertices that cells use, which may exceed those of the file.
  std::size_t UsedVertices() const { return this->Firsts.size(); }
  std::size_t NumberOfVertices() const { return this->Vertices.size() / 3; }

  /// If only some polygons have normals, the others get normals of their own.
  void CompleteNormals(ObjCells& polygons);

  /// Sets the points and their arrays.
  void AddTo(vtkPolyData* mesh) const;
  vtkSmartPointer<vtkCellArray> MakeCells(const ObjCells& cells) const;

private:
  struct Point
  {
    ObjCorner Corner;
    int Next = -1; ///< next duplicate of the vertex
  };

  int Encode(const ObjCorner& corner);
  int AddDuplicate(const ObjCorner& corner);
  const ObjCorner& Decode(int code) const;

  std::size_t Limit;
  std::vector<double> Vertices;
  std::vector<float> Colors; ///< four per vertex from the first color on
  int ColorComponents = 0;
  std::vector<float> Normals;
  std::vector<float> TCoords;
  std::vector<Point> Firsts;     ///< the first corner of each vertex: codes from 0
  std::vector<Point> Duplicates; ///< other corners: codes from -1 downward
  bool HasNormals = false;       ///< a corner has a normal
  bool HasTCoords = false;
};

}
#endif
