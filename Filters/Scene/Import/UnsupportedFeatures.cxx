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

// Features that are newer than VTK 9.1.
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

/// Returns true if the actor has a texture transform. The name of its key changed in VTK 9.6.
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
  // Without OpenGL there are no shader properties, and GetShaderProperty() crashes.
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
  warn(property->GetInterpolation() == VTK_PBR,
    "physically based shading is not supported. Phong shading was used instead.");
  warn(property->GetNumberOfTextures() > 0,
    "textures of vtkProperty are not supported and were ignored.");
  warn(property->GetRenderPointsAsSpheres(),
    "points as spheres are not supported. They were rendered as squares.");
  warn(property->GetRenderLinesAsTubes(),
    "lines as tubes are not supported. They were rendered flat.");
  warn(HasCustomShaders(actor), "custom shaders are not supported and were ignored.");
  warn(UsesOtherCoordinates(actor, 0),
    "coordinate systems other than world are not supported. World coordinates were used.");
  warn(HasUnsupportedWrapMode(actor->GetTexture()),
    "texture wrap modes other than Repeat and ClampToEdge are not supported and were replaced.");
  warn(actor->GetTexture() && HasTextureTransform(actor),
    "texture transforms are not supported and were ignored.");
  warn(
    HasBlockTextures(actor->GetMapper()), "textures of blocks are not supported and were ignored.");
  warn(actor->GetTexture() && IsSeamless(actor->GetMapper()),
    "seamless texture coordinates are not supported. They were used unchanged.");
}

void WarnUnsupportedRenderer(vtkRenderer* renderer, std::vector<std::string>& warnings)
{
  const auto warn = [&](bool isUsed, const char* message) {
    if (isUsed)
    {
      warnings.emplace_back(message);
    }
  };
  warn(renderer->GetPass() != nullptr, "The render pass of the renderer was ignored.");
  warn(renderer->GetUseSSAO(), "Screen-space ambient occlusion of the renderer was ignored.");
  warn(renderer->GetUseShadows(),
    "Shadows of the renderer were ignored. Use the shadows of the ray caster.");
  warn(
    renderer->GetUseImageBasedLighting(), "Image-based lighting is not supported and was ignored.");
  warn(renderer->GetTexturedBackground(),
    "A textured background is not supported. The background color was used.");
  warn(renderer->GetGradientBackground() && HasUnsupportedGradient(renderer, 0),
    "Only vertical background gradients are supported. A vertical gradient was used.");
}

}
