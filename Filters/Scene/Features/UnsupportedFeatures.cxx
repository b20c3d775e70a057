// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "UnsupportedFeatures.h"

#include "SceneFeatures.h"

#include "vtkActor.h"
#include "vtkMapper.h"
#include "vtkObjectFactory.h"
#include "vtkProperty.h"
#include "vtkSelection.h"
#include "vtkShaderProperty.h"
#include "vtkTexture.h"
#include "vtkVersionMacros.h"

#include <algorithm>
#include <cstring>
#include <iterator>

namespace penumbra
{
namespace
{

#if VTK_VERSION_NUMBER < VTK_VERSION_CHECK(9, 7, 0)
// Coordinate systems are newer than VTK 9.1. Matrices of assembly paths include them; tested with
// VTK 9.7 only.
template <typename Prop>
auto UsesOtherCoordinates(Prop* prop, int) -> decltype(prop->GetCoordinateSystem() != Prop::WORLD)
{
  return prop->GetCoordinateSystem() != Prop::WORLD;
}
template <typename Prop>
bool UsesOtherCoordinates(Prop*, long)
{
  return false;
}
#endif

bool HasCustomShaders(vtkActor* actor)
{
  // GetShaderProperty() crashes if no OpenGL module is loaded.
  if (!vtkObjectFactory::HasOverrideAny("vtkShaderProperty"))
  {
    return false;
  }
  vtkShaderProperty* shaders = actor->GetShaderProperty();
  return shaders->HasVertexShaderCode() || shaders->HasFragmentShaderCode() ||
    shaders->HasGeometryShaderCode() || shaders->GetNumberOfShaderReplacements() > 0;
}

/// Returns true for mappers of which only the polygons are drawn.
bool IsKnownMapper(vtkMapper* mapper)
{
  static const char* const names[] = { "vtkPolyDataMapper", "vtkOpenGLPolyDataMapper",
    "vtkWebGPUPolyDataMapper", "vtkCompositePolyDataMapper", "vtkCompositePolyDataMapper2",
    "vtkOpenGLCompositePolyDataMapper", "vtkOpenGLBatchedPolyDataMapper",
    "vtkWebGPUCompositePolyDataMapper", "vtkDataSetMapper", "vtkGlyph3DMapper",
    "vtkOpenGLGlyph3DMapper", "vtkLabeledContourMapper", "vtkPointGaussianMapper",
    "vtkOpenGLPointGaussianMapper", "vtkOpenGLSphereMapper", "vtkOpenGLStickMapper" };
  return std::any_of(std::begin(names), std::end(names),
    [&](const char* name) { return std::strcmp(mapper->GetClassName(), name) == 0; });
}

/// Returns true if the property has a texture that is not part of a physically based material.
bool HasOtherTextures(vtkProperty* property)
{
  static const char* const names[] = { "albedoTex", "normalTex", "materialTex", "emissiveTex",
    "anisotropyTex", "coatNormalTex" };
  const bool isPhysicallyBased = property->GetInterpolation() == VTK_PBR;
  for (const auto& [name, texture] : property->GetAllTextures())
  {
    const bool isKnown = std::any_of(
      std::begin(names), std::end(names), [&name = name](const char* key) { return name == key; });
    if (texture && !(isKnown && isPhysicallyBased))
    {
      return true;
    }
  }
  return false;
}

}

void WarnUnsupportedActor(
  vtkActor* actor, const std::string& name, std::vector<std::string>& warnings)
{
  const auto warn = [&](bool isUsed, Feature feature) {
    if (isUsed)
    {
      WarnFeature(feature, name, warnings);
    }
  };
  vtkProperty* property = actor->GetProperty();
  vtkMapper* mapper = actor->GetMapper();
  warn(HasOtherTextures(property), Feature::MultiTexturing);
  warn(HasCustomShaders(actor), Feature::CustomShaders);
#if VTK_VERSION_NUMBER < VTK_VERSION_CHECK(9, 7, 0)
  if (UsesOtherCoordinates(actor, 0))
  {
    warnings.push_back(name +
      ": the coordinate system is treated as world coordinates. Set the "
      "coordinate system to WORLD.");
  }
#endif
  // ParaView sets an empty selection if nothing is selected.
  const vtkSelection* const selection = mapper->GetSelection();
  warn(selection && selection->GetNumberOfNodes() > 0, Feature::Selection);
  if (!IsKnownMapper(mapper))
  {
    WarnFeature(Feature::DerivedMappers, name + " (" + mapper->GetClassName() + ")", warnings);
  }
}

}
