// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "SceneExtractionGlyphs.h"

#include "Execution/AvailableMemory.h"
#include "SceneExtractionColors.h"

#include "vtkCellArray.h"
#include "vtkDataSet.h"
#include "vtkGlyph3DMapper.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"

#include <glm/gtc/quaternion.hpp>

#include <algorithm>
#include <cmath>

namespace penumbra
{
namespace
{

/// Scale factor that vtkGlyph3DMapper uses instead of 0.
constexpr double MinimumScale = 1e-10;

/// Returns the default shape of vtkGlyph3DMapper: a line of length 1 along x.
vtkSmartPointer<vtkPolyData> MakeDefaultShape()
{
  vtkNew<vtkPoints> points;
  points->InsertNextPoint(0.0, 0.0, 0.0);
  points->InsertNextPoint(1.0, 0.0, 0.0);
  vtkNew<vtkCellArray> lines;
  const vtkIdType line[2] = { 0, 1 };
  lines->InsertNextCell(2, line);
  auto shape = vtkSmartPointer<vtkPolyData>::New();
  shape->SetPoints(points);
  shape->SetLines(lines);
  return shape;
}

double ComputeNorm(vtkDataArray* array, vtkIdType i)
{
  double sum = 0.0;
  for (int k = 0; k < array->GetNumberOfComponents(); ++k)
  {
    sum += array->GetComponent(i, k) * array->GetComponent(i, k);
  }
  return std::sqrt(sum);
}

/// Reads the arrays that transform, mask and select glyphs.
class GlyphPlacement
{
public:
  GlyphPlacement(vtkGlyph3DMapper* mapper, vtkDataSet* data, ScalarMapper* arrays)
    : Mapper(mapper),
      Data(data)
  {
    const auto find = [&](bool wanted, int which) -> vtkDataArray* {
      vtkDataArray* array = wanted ? arrays->FindArray(mapper, which, data) : nullptr;
      return array && array->GetNumberOfTuples() >= data->GetNumberOfPoints() ? array : nullptr;
    };
    const int mode = mapper->GetScaleMode();
    this->Mask = find(mapper->GetMasking(), vtkGlyph3DMapper::MASK);
    this->Index = find(mapper->GetSourceIndexing(), vtkGlyph3DMapper::SOURCE_INDEX);
    this->Scale = find(
      mapper->GetScaling() && mode != vtkGlyph3DMapper::NO_DATA_SCALING, vtkGlyph3DMapper::SCALE);
    this->Orientation = find(mapper->GetOrient(), vtkGlyph3DMapper::ORIENTATION);
  }

  bool IsShown(vtkIdType i) const { return !this->Mask || this->Mask->GetComponent(i, 0) != 0.0; }

  int SelectShape(vtkIdType i, int count) const
  {
    const double value = this->Index ? ComputeNorm(this->Index, i) : 0.0;
    return value < count - 1 ? static_cast<int>(value) : count - 1;
  }

  glm::dmat4 ComputeTransform(vtkIdType i) const
  {
    double x[3];
    this->Data->GetPoint(i, x);
    const glm::dmat3 rotation = this->ComputeRotation(i);
    const glm::dvec3 scale = this->ComputeScale(i);
    return { glm::dvec4(scale.x * rotation[0], 0.0), glm::dvec4(scale.y * rotation[1], 0.0),
      glm::dvec4(scale.z * rotation[2], 0.0), glm::dvec4(x[0], x[1], x[2], 1.0) };
  }

private:
  glm::dvec3 ComputeScale(vtkIdType i) const
  {
    if (!this->Mapper->GetScaling())
    {
      return glm::dvec3(1.0);
    }
    glm::dvec3 scale(1.0);
    if (this->Scale && this->Mapper->GetScaleMode() == vtkGlyph3DMapper::SCALE_BY_MAGNITUDE)
    {
      scale = glm::dvec3(ComputeNorm(this->Scale, i));
    }
    else if (this->Scale && this->Scale->GetNumberOfComponents() == 3)
    {
      this->Scale->GetTuple(i, &scale.x);
    }
    if (this->Mapper->GetClamping() && this->Scale)
    {
      double range[2];
      this->Mapper->GetRange(range);
      const double span = range[1] == range[0] ? 1.0 : range[1] - range[0];
      scale = (glm::clamp(scale, range[0], range[1]) - range[0]) / span;
    }
    scale *= this->Mapper->GetScaleFactor();
    for (int k = 0; k < 3; ++k)
    {
      scale[k] = scale[k] == 0.0 ? MinimumScale : scale[k];
    }
    return scale;
  }

  glm::dmat3 ComputeRotation(vtkIdType i) const
  {
    const int mode = this->Mapper->GetOrientationMode();
    const int components = mode == vtkGlyph3DMapper::QUATERNION ? 4 : 3;
    if (!this->Orientation || this->Orientation->GetNumberOfComponents() != components)
    {
      return glm::dmat3(1.0);
    }
    double v[4];
    this->Orientation->GetTuple(i, v);
    if (mode == vtkGlyph3DMapper::QUATERNION)
    {
      return glm::mat3_cast(glm::normalize(glm::dquat(v[0], v[1], v[2], v[3])));
    }
    const glm::dvec3 direction(v[0], v[1], v[2]);
    if (mode == vtkGlyph3DMapper::ROTATION)
    {
      const glm::dvec3 angles = glm::radians(direction);
      return glm::mat3_cast(glm::angleAxis(angles.z, glm::dvec3(0.0, 0.0, 1.0)) *
        glm::angleAxis(angles.x, glm::dvec3(1.0, 0.0, 0.0)) *
        glm::angleAxis(angles.y, glm::dvec3(0.0, 1.0, 0.0)));
    }
    // Rotate by 180 degrees about the bisector of the x axis and the direction, as VTK does.
    const glm::dvec3 bisector = direction + glm::dvec3(glm::length(direction), 0.0, 0.0);
    const double length = glm::length(bisector);
    if (direction.y == 0.0 && direction.z == 0.0)
    {
      return direction.x < 0.0 ? glm::mat3_cast(glm::dquat(0.0, 0.0, 1.0, 0.0)) : glm::dmat3(1.0);
    }
    return length > 0.0 ? glm::mat3_cast(glm::dquat(0.0, bisector / length)) : glm::dmat3(1.0);
  }

  vtkGlyph3DMapper* Mapper;
  vtkDataSet* Data;
  vtkDataArray* Mask;
  vtkDataArray* Index;
  vtkDataArray* Scale;
  vtkDataArray* Orientation;
};

}

std::vector<DrawItem> MakeGlyphs(vtkGlyph3DMapper* mapper, vtkDataSet* data,
  const DrawItem& prototype, ScalarMapper* scalars, std::vector<std::string>& warnings)
{
  if (mapper->GetUseSourceTableTree())
  {
    warnings.push_back(
      prototype.Name + ": glyphs from a source table tree are not supported and were skipped.");
    return {};
  }
  std::vector<DrawItem> shapes;
  const int sources = std::max(1, mapper->GetNumberOfInputConnections(1));
  for (int i = 0; i < sources; ++i)
  {
    DrawItem shape = prototype;
    shape.Data = mapper->GetSource(i);
    if (!shape.Data)
    {
      shape.Data = MakeDefaultShape();
    }
    shape.GlyphInstances = std::make_shared<Instances>();
    shapes.push_back(std::move(shape));
  }
  scalars->InterpolateScalarsBeforeMappingOff();
  const Coloring coloring = scalars->Map(data);
  const bool colored = coloring.Mode == Coloring::Modes::PerPoint;
  double propertyColor[3];
  prototype.Property->GetColor(propertyColor);
  // The opacity multiplies the color here and once more in the material, as in VTK.
  const glm::u8vec4 color(glm::dvec4(propertyColor[0], propertyColor[1], propertyColor[2],
                            prototype.Property->GetOpacity()) *
      255.0 +
    0.5);
  RequireMemory(static_cast<double>(data->GetNumberOfPoints()) *
      (sizeof(glm::dmat4x3) + 2 * sizeof(glm::u8vec4)),
    std::to_string(data->GetNumberOfPoints()) + " glyphs");
  const GlyphPlacement placement(mapper, data, scalars);
  if (sources == 1)
  {
    Instances& instances = *shapes[0].GlyphInstances;
    instances.Transforms.reserve(static_cast<std::size_t>(data->GetNumberOfPoints()));
    instances.Ids.reserve(instances.Transforms.capacity());
    instances.Colors.reserve(instances.Transforms.capacity());
  }
  for (vtkIdType i = 0; i < data->GetNumberOfPoints(); ++i)
  {
    if (!placement.IsShown(i))
    {
      continue;
    }
    Instances& instances = *shapes[placement.SelectShape(i, sources)].GlyphInstances;
    instances.ByScalars = colored;
    instances.Transforms.emplace_back(prototype.ToWorld * placement.ComputeTransform(i));
    instances.Ids.push_back(static_cast<std::uint32_t>(i));
    glm::u8vec4 mapped = color;
    if (colored)
    {
      const unsigned char* c = coloring.Colors->GetPointer(4 * i);
      mapped = { c[0], c[1], c[2],
        static_cast<unsigned char>(c[3] * prototype.Property->GetOpacity() + 0.5) };
    }
    instances.Colors.push_back(mapped);
  }
  return shapes;
}

}
