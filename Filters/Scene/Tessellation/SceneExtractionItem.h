// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// One vtkPolyData with its transform and appearance. Actors, blocks and glyphs are converted to
// draw items before they become surfaces.
#ifndef penumbra_SceneExtractionItem_h
#define penumbra_SceneExtractionItem_h

#include "DepthOffset.h"
#include "Execution/ParallelFor.h"
#include "Material.h"

#include "vtkProperty.h"
#include "vtkSmartPointer.h"
#include "vtkUnsignedCharArray.h"

#include <glm/glm.hpp>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

class vtkDataArray;
class vtkPolyData;

namespace penumbra
{

struct Scene;
struct SceneCoordinates;
class SurfaceSlopes;

/// Result of mapping scalars to colors.
struct Coloring
{
  enum class Modes
  {
    None,
    PerPoint,
    PerCell, ///< per cell of the poly data
    Single,  ///< one color, from field data
    Texture  ///< scalars are interpolated before mapping, through Map
  };
  Modes Mode = Modes::None;
  vtkSmartPointer<vtkUnsignedCharArray> Colors; ///< RGBA
  glm::u8vec4 SingleColor{ 255 };
  std::shared_ptr<const Texture> Map;
  vtkSmartPointer<vtkDataArray> Coordinates; ///< texture coordinates in Map, per point
};

/// Instances of one glyph shape of a glyph mapper.
struct Instances
{
  std::vector<glm::dmat4x3> Transforms; ///< shape to world
  std::vector<glm::u8vec4> Colors;
  std::vector<std::uint32_t> Ids; ///< indices of the glyphs' points
  bool ByScalars = false;
};

/// Images around points that face the camera, see vtkPointGaussianMapper.
struct Splats
{
  std::vector<float> Radii; ///< per point, in the coordinates of the data
  double Extent = 1.0;      ///< half the width of the image, in radii
  bool IsAdditive = false;  ///< see Surface::IsAdditive
};

/// One vtkPolyData with its transform and appearance.
struct DrawItem
{
  int ObjectId = 0;
  std::string Name; ///< for warnings
  vtkSmartPointer<vtkPolyData> Data;
  glm::dmat4 ToWorld{ 1.0 };
  vtkSmartPointer<vtkProperty> Property;
  vtkSmartPointer<vtkProperty> BackProperty; ///< null: same as Property
  Coloring Colors;
  std::shared_ptr<const Texture> LitTexture;
  std::shared_ptr<const Texture> BaseColorTexture;
  std::shared_ptr<const MaterialTextures> DetailTextures;
  std::vector<glm::dvec4>
    ClippingPlanes; ///< in world coordinates; points with dot(plane, (x, 1)) < 0 are clipped
  vtkSmartPointer<vtkDataArray>
    CellIds; ///< value of the array CellId per cell of Data; null: the cell's index
  /// Radius of points that are drawn as spheres and of lines that are drawn as tubes, in world
  /// units. 0: as the property requests.
  double PointRadius = 0.0;
  double LineRadius = 0.0;
  bool HasFlatTubes = false; ///< lines that are drawn as tubes are cylinders with flat ends
  /// Offsets of the primitives, relative to those of most surfaces.
  DepthOffset PolygonOffset;
  DepthOffset LineOffset;
  DepthOffset PointOffset;
  std::shared_ptr<const SurfaceSlopes> Slopes; ///< those that offsets multiply; may be null
  bool ForceOpaque = false;                    ///< see Surface
  bool RemoveHiddenLines = false; ///< its polygons hide the lines of this and other items
  /// Radius of each point of Data in world units. Replaces PointRadius and LineRadius; null: none.
  vtkSmartPointer<vtkDataArray> Radii;
  std::shared_ptr<Instances> GlyphInstances;  ///< null: drawn once, with ToWorld
  std::shared_ptr<const Splats> FacingSplats; ///< if set, each vertex is a splat of LitTexture
  ProgressCallback Progress; ///< on a stop request, reading the item throws Stopped
};

/// Bounds of the finite points of all items in world coordinates; those without any are infinite, and
/// the lower ones above the upper ones.
void ComputeBounds(const std::vector<DrawItem>& items, double bounds[6]);

/// Returns the largest radius of the spheres and tubes of all items, in world units. `pointWidth` is the
/// width of 1/72 inch of the image.
double FindLargestRadius(const std::vector<DrawItem>& items, double pointWidth);

bool HasLinesOrPoints(const DrawItem& item);

/// Returns true if the surfaces of `item` may depend on the camera: lines and points with a size in
/// pixels, images that face the camera, normals of wireframes.
bool DependsOnCamera(const DrawItem& item);

/// Returns true if the surfaces of `item` depend on those of others, through its offset.
bool DependsOnOthers(const DrawItem& item);

/// Transform from the coordinates of a data set to scene coordinates.
class SceneTransform
{
public:
  SceneTransform(const glm::dmat4& toWorld, const SceneCoordinates& coordinates);
  glm::vec3 Point(const double x[3]) const;
  /// Transforms a normal by the inverse transpose, as VTK's shaders do. The result is not
  /// normalized.
  glm::vec3 Normal(const double n[3]) const;
  glm::dmat4x3 GetMatrix() const
  {
    return { this->Linear[0], this->Linear[1], this->Linear[2], this->Shift };
  }

private:
  glm::dmat3 Linear;
  glm::dvec3 Shift;
  glm::dmat3 NormalMatrix;
};

Material MakeMaterial(vtkProperty* property);

}
#endif
