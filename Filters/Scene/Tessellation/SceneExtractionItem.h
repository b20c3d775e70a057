// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// One vtkPolyData and all that says how it is drawn: what actors, blocks and glyphs come down to
// before they become surfaces.
#ifndef penumbra_SceneExtractionItem_h
#define penumbra_SceneExtractionItem_h

#include "Execution/ParallelFor.h"
#include "Scene.h"

#include "vtkProperty.h"
#include "vtkSmartPointer.h"
#include "vtkUnsignedCharArray.h"

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

class vtkDataArray;
class vtkPolyData;

namespace penumbra
{

/// What a mapper made of scalars: at most one of the three ways.
struct Coloring
{
  enum class Modes
  {
    None,
    PerPoint,
    PerCell, ///< cells of the poly data
    Single,  ///< one colour, from field data
    Texture  ///< interpolated before mapping
  };
  Modes Mode = Modes::None;
  vtkSmartPointer<vtkUnsignedCharArray> Colors; ///< RGBA
  glm::u8vec4 SingleColor{ 255 };
  std::shared_ptr<const Texture> Map;
  vtkSmartPointer<vtkDataArray> Coordinates; ///< of Map, per point
};

/// Copies of one shape: a glyph mapper's.
struct Instances
{
  std::vector<glm::dmat4> Transforms; ///< to world
  std::vector<glm::u8vec4> Colors;
  std::vector<std::uint32_t> Ids; ///< of the points they stand at
  bool ByScalars = false;
};

struct DrawItem
{
  int ObjectId = 0;
  std::string Name; ///< for warnings
  vtkSmartPointer<vtkPolyData> Data;
  glm::dmat4 ToWorld{ 1.0 };
  vtkSmartPointer<vtkProperty> Property;
  vtkSmartPointer<vtkProperty> BackProperty; ///< null: as the front
  Coloring Colors;
  std::shared_ptr<const Texture> LitTexture;
  std::vector<glm::dvec4> ClippingPlanes; ///< world: what has dot(plane, (x, 1)) < 0 is cut away
  vtkSmartPointer<vtkDataArray> CellIds;  ///< per cell of Data, its id for `CellId`; null: its own
  std::shared_ptr<Instances> GlyphInstances; ///< null: drawn once, at ToWorld
  ProgressCallback Progress;                 ///< asked to stop, reading it throws Stopped
};

/// From the coordinates of data to those of a scene.
class SceneTransform
{
public:
  SceneTransform(const glm::dmat4& toWorld, const Scene& scene);
  glm::vec3 Point(const double x[3]) const;
  /// By the inverse transpose, as VTK's shaders do.
  glm::vec3 Normal(const double n[3]) const;

private:
  glm::dmat3 Linear;
  glm::dvec3 Shift;
  glm::dmat3 NormalMatrix;
};

Material MakeMaterial(vtkProperty* property);

}
#endif
