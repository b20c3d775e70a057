// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "UnsupportedFeatures.h"

#include "SceneExtractionBlocks.h"

#include "vtkActor.h"
#include "vtkInformation.h"
#include "vtkInformationKeyLookup.h"
#include "vtkObjectFactory.h"
#include "vtkPolyDataMapper.h"
#include "vtkProperty.h"
#include "vtkRenderPass.h"
#include "vtkRenderer.h"
#include "vtkShaderProperty.h"
#include "vtkTexture.h"

namespace penumbra
{
namespace
{

// Newer than VTK 9.1: asked where they exist.
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
template <typename Renderer>
auto HasUnsupportedGradient(Renderer* renderer, int)
  -> decltype(static_cast<int>(renderer->GetGradientMode()) != 0)
{
  return static_cast<int>(renderer->GetGradientMode()) != 0;
}
template <typename Renderer>
bool HasUnsupportedGradient(Renderer*, long)
{
  return false;
}

/// The key's name changed in VTK 9.6.
bool HasTextureTransform(vtkActor* actor)
{
  vtkInformation* keys = actor->GetPropertyKeys();
  for (const char* name : { "GENERAL_TEXTURE_TRANSFORM", "GeneralTextureTransform" })
  {
    vtkInformationKey* key = vtkInformationKeyLookup::Find(name, "vtkProp");
    if (keys && key && keys->Has(key))
    {
      return true;
    }
  }
  return false;
}

bool HasCustomShaders(vtkActor* actor)
{
  // Where no OpenGL is linked, nobody can have made shaders, and asking the actor for them crashes.
  if (!vtkObjectFactory::HasOverrideAny("vtkShaderProperty"))
  {
    return false;
  }
  vtkShaderProperty* shaders = actor->GetShaderProperty();
  return shaders->HasVertexShaderCode() || shaders->HasFragmentShaderCode() ||
    shaders->HasGeometryShaderCode() || shaders->GetNumberOfShaderReplacements() > 0;
}

bool HasUnsupportedWrapMode(vtkTexture* texture)
{
  return texture &&
    (texture->GetWrap() == vtkTexture::MirroredRepeat ||
      texture->GetWrap() == vtkTexture::ClampToBorder);
}

bool IsSeamless(vtkMapper* mapper)
{
  auto* polygons = vtkPolyDataMapper::SafeDownCast(mapper);
  return polygons && (polygons->GetSeamlessU() || polygons->GetSeamlessV());
}

}

void WarnUnsupportedActor(
  vtkActor* actor, const std::string& name, std::vector<std::string>& warnings)
{
  const auto warn = [&](bool isUsed, const char* message) {
    if (isUsed)
    {
      warnings.push_back(name + ": " + message);
    }
  };
  vtkProperty* property = actor->GetProperty();
  warn(property->GetInterpolation() == VTK_PBR, "physically based shading is drawn as Phong's.");
  warn(property->GetNumberOfTextures() > 0, "textures of properties are not supported; left out.");
  warn(
    property->GetRenderPointsAsSpheres(), "points as spheres are not supported; drawn as squares.");
  warn(property->GetRenderLinesAsTubes(), "lines as tubes are not supported; drawn flat.");
  warn(HasCustomShaders(actor), "shaders of its own are not supported; left out.");
  warn(UsesOtherCoordinates(actor, 0), "only world coordinates are supported; drawn in these.");
  warn(HasUnsupportedWrapMode(actor->GetTexture()),
    "textures repeat or stop at their edge; drawn so.");
  warn(actor->GetTexture() && HasTextureTransform(actor),
    "texture transforms are not supported; left out.");
  warn(HasBlockTextures(actor->GetMapper()), "textures of blocks are not supported; left out.");
  warn(actor->GetTexture() && IsSeamless(actor->GetMapper()),
    "seamless texture coordinates are not supported; drawn as they are.");
}

void WarnUnsupportedRenderer(vtkRenderer* renderer, std::vector<std::string>& warnings)
{
  const auto warn = [&](bool isUsed, const char* message) {
    if (isUsed)
    {
      warnings.emplace_back(message);
    }
  };
  warn(renderer->GetPass() != nullptr, "Render passes of the renderer are left out.");
  warn(renderer->GetUseSSAO(), "Screen-space ambient occlusion of the renderer is left out.");
  warn(renderer->GetUseShadows(), "Shadows of the renderer are left out: ask the ray caster.");
  warn(renderer->GetUseImageBasedLighting(), "Image-based lighting is not supported; left out.");
  warn(renderer->GetTexturedBackground(),
    "A textured background is not supported: the background colour is drawn.");
  warn(renderer->GetGradientBackground() && HasUnsupportedGradient(renderer, 0),
    "Only gradients from bottom to top are supported; drawn so.");
}

}
