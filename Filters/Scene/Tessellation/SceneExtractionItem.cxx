// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "SceneExtractionItem.h"

#include "Scene.h"

#include <cmath>

namespace penumbra
{

SceneTransform::SceneTransform(const glm::dmat4& toWorld, const Scene& scene)
  : Linear(scene.Scale * glm::dmat3(toWorld)),
    Shift(scene.Scale * (glm::dvec3(toWorld[3]) - scene.Origin))
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
