// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "SceneExtractionItem.h"

#include "SceneCoordinates.h"

#include "vtkCellArray.h"
#include "vtkDataArray.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace penumbra
{
namespace
{

/// Extends `bounds` by the finite points of `item`, transformed by `toWorld`.
void AddBounds(const DrawItem& item, const glm::dmat4& toWorld, double bounds[6])
{
  for (vtkIdType i = 0; i < item.Data->GetNumberOfPoints(); ++i)
  {
    double x[3];
    item.Data->GetPoints()->GetPoint(i, x);
    const glm::dvec4 world = toWorld * glm::dvec4(x[0], x[1], x[2], 1.0);
    for (int k = 0; k < 3; ++k)
    {
      if (std::isfinite(world[k]))
      {
        bounds[2 * k] = std::min(bounds[2 * k], world[k]);
        bounds[2 * k + 1] = std::max(bounds[2 * k + 1], world[k]);
      }
    }
  }
}

/// Returns the largest radius of the spheres and tubes of `item`.
double FindRadius(const DrawItem& item, double pointWidth)
{
  if (item.Radii)
  {
    double range[2];
    item.Radii->GetFiniteRange(range);
    return std::max(range[1], 0.0);
  }
  double radius = std::max(item.PointRadius, item.LineRadius);
  if (item.Property->GetRenderPointsAsSpheres())
  {
    radius = std::max(radius, 0.5 * item.Property->GetPointSize() * pointWidth);
  }
  if (item.Property->GetRenderLinesAsTubes())
  {
    radius = std::max(radius, 0.5 * item.Property->GetLineWidth() * pointWidth);
  }
  return radius;
}

}

void ComputeBounds(const std::vector<DrawItem>& items, double bounds[6])
{
  std::fill_n(bounds, 6, std::numeric_limits<double>::infinity());
  bounds[1] = bounds[3] = bounds[5] = -bounds[0];
  for (const DrawItem& item : items)
  {
    if (!item.GlyphInstances)
    {
      AddBounds(item, item.ToWorld, bounds);
      continue;
    }
    for (const glm::dmat4x3& transform : item.GlyphInstances->Transforms)
    {
      AddBounds(item, glm::dmat4(transform), bounds);
    }
  }
}

double FindLargestRadius(const std::vector<DrawItem>& items, double pointWidth)
{
  double radius = 0.0;
  for (const DrawItem& item : items)
  {
    radius = std::max(radius, FindRadius(item, pointWidth));
  }
  return radius;
}

bool HasLinesOrPoints(const DrawItem& item)
{
  return item.Data->GetLines()->GetNumberOfCells() + item.Data->GetVerts()->GetNumberOfCells() > 0;
}

bool DependsOnCamera(const DrawItem& item)
{
  vtkProperty* property = item.Property;
  const bool hasPoints = item.Data->GetVerts()->GetNumberOfCells() > 0;
  const bool hasLines = item.Data->GetLines()->GetNumberOfCells() > 0;
  return item.FacingSplats || !item.PolygonOffset.IsZero() ||
    property->GetRepresentation() != VTK_SURFACE || property->GetEdgeVisibility() ||
    property->GetVertexVisibility() || property->GetRenderPointsAsSpheres() ||
    property->GetRenderLinesAsTubes() || (hasPoints && !item.Radii && !(item.PointRadius > 0.0)) ||
    (hasLines && !(item.LineRadius > 0.0));
}

bool DependsOnOthers(const DrawItem& item)
{
  return HasLinesOrPoints(item) && !(item.LineOffset.IsZero() && item.PointOffset.IsZero());
}

SceneTransform::SceneTransform(const glm::dmat4& toWorld, const SceneCoordinates& coordinates)
  : Linear(coordinates.Scale * glm::dmat3(toWorld)),
    Shift(coordinates.Scale * (glm::dvec3(toWorld[3]) - coordinates.Origin))
{
  // Removing the scale keeps the lengths of normals and avoids overflow and underflow.
  const double size = std::cbrt(std::abs(glm::determinant(this->Linear)));
  this->NormalMatrix =
    size > 0.0 ? glm::transpose(glm::inverse(this->Linear / size)) : glm::dmat3(1.0);
}

glm::vec3 SceneTransform::Point(const double x[3]) const
{
  return this->Linear * glm::dvec3(x[0], x[1], x[2]) + this->Shift;
}

glm::vec3 SceneTransform::Normal(const double n[3]) const
{
  return this->NormalMatrix * glm::dvec3(n[0], n[1], n[2]);
}

Material MakeMaterial(vtkProperty* property)
{
  const auto color = [](const double* c) { return glm::vec3(c[0], c[1], c[2]); };
  Material material;
  material.AmbientColor = color(property->GetAmbientColor());
  material.DiffuseColor = color(property->GetDiffuseColor());
  material.SpecularColor = color(property->GetSpecularColor());
  material.Ambient = static_cast<float>(property->GetAmbient());
  material.Diffuse = static_cast<float>(property->GetDiffuse());
  material.Specular = static_cast<float>(property->GetSpecular());
  material.SpecularPower = static_cast<float>(property->GetSpecularPower());
  material.Opacity = static_cast<float>(property->GetOpacity());
  material.Lighting = property->GetLighting();
  if (property->GetInterpolation() == VTK_PBR)
  {
    material.PhysicallyBased = true;
    material.Metallic = static_cast<float>(property->GetMetallic());
    material.Roughness = static_cast<float>(property->GetRoughness());
    material.BaseReflectance =
      static_cast<float>(vtkProperty::ComputeReflectanceFromIOR(property->GetBaseIOR(), 1.0));
    material.EdgeTint = color(property->GetEdgeTint());
    material.Anisotropy = static_cast<float>(property->GetAnisotropy());
    material.AnisotropyRotation = static_cast<float>(property->GetAnisotropyRotation());
    material.NormalScale = static_cast<float>(property->GetNormalScale());
    material.OcclusionStrength = static_cast<float>(property->GetOcclusionStrength());
    material.EmissiveFactor = color(property->GetEmissiveFactor());
    material.CoatStrength = static_cast<float>(property->GetCoatStrength());
    material.CoatRoughness = static_cast<float>(property->GetCoatRoughness());
    material.CoatReflectance =
      static_cast<float>(vtkProperty::ComputeReflectanceFromIOR(property->GetCoatIOR(), 1.0));
    material.CoatColor = color(property->GetCoatColor());
    material.CoatNormalScale = static_cast<float>(property->GetCoatNormalScale());
  }
  return material;
}

}
