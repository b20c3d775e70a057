// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "SceneExtractionSky.h"

#include "CollectionItems.h"
#include "Environment/EnvironmentLight.h"
#include "Scene.h"
#include "SceneExtractionColors.h"

#include "vtkAlgorithm.h"
#include "vtkCamera.h"
#include "vtkDataArray.h"
#include "vtkDataObject.h"
#include "vtkImageData.h"
#include "vtkPointData.h"
#include "vtkPropCollection.h"
#include "vtkRenderer.h"
#include "vtkSkybox.h"
#include "vtkTexture.h"

#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

namespace penumbra
{
namespace
{

/// Converts the images of a skybox. Returns null if one is missing.
std::shared_ptr<Sky> MakeSky(vtkSkybox* skybox, std::vector<std::string>& warnings)
{
  vtkTexture* texture = skybox->GetTexture();
  auto sky = std::make_shared<Sky>();
  const bool isCube = texture->GetCubeMap();
  for (int face = 0; face < (isCube ? 6 : 1); ++face)
  {
    std::shared_ptr<Texture> image =
      MakeTextureFace(texture, face, skybox->GetClassName(), warnings);
    if (!image)
    {
      return nullptr;
    }
    if (isCube)
    {
      image->Wrap = Texture::WrapModes::ClampToEdge;
    }
    sky->Faces.push_back(image);
  }
  sky->IsGammaCorrected = skybox->GetGammaCorrect();
  return sky;
}

/// Returns the rotation to the coordinates of environments.
glm::dmat3 FindEnvironmentRotation(vtkRenderer* renderer)
{
  const glm::dvec3 right = glm::make_vec3(renderer->GetEnvironmentRight());
  const glm::dvec3 up = glm::make_vec3(renderer->GetEnvironmentUp());
  return glm::transpose(glm::dmat3(right, up, glm::cross(right, up)));
}

/// Returns the floating-point colors of a texture, which are radiances, or null.
vtkDataArray* FindRadiances(vtkTexture* texture, int face)
{
  auto* image = vtkImageData::SafeDownCast(texture->GetInputDataObject(face, 0));
  vtkDataArray* colors = image ? image->GetPointData()->GetScalars() : nullptr;
  const bool isFloat =
    colors && (colors->GetDataType() == VTK_FLOAT || colors->GetDataType() == VTK_DOUBLE);
  return isFloat && colors->GetNumberOfComponents() >= 3 &&
      texture->GetColorMode() == VTK_COLOR_MODE_DIRECT_SCALARS
    ? colors
    : nullptr;
}

RadianceImage MakeRadianceImage(const Texture& texture, vtkDataArray* radiances)
{
  RadianceImage image{ texture.Width, texture.Height, {} };
  image.Texels.reserve(texture.Texels.size());
  for (std::size_t i = 0; i < texture.Texels.size(); ++i)
  {
    const glm::u8vec4 texel = texture.Texels[i];
    glm::vec3 color = glm::vec3(texture.IsSRGB ? texture.Decode(texel) : glm::vec4(texel) / 255.f);
    for (int c = 0; radiances && c < 3; ++c)
    {
      const double value = radiances->GetComponent(static_cast<vtkIdType>(i), c);
      color[c] = value > 0.0 && value < 1e30 ? static_cast<float>(value) : 0.f;
    }
    image.Texels.push_back(color);
  }
  return image;
}

}

bool IsSky(vtkProp* prop)
{
  auto* skybox = vtkSkybox::SafeDownCast(prop);
  vtkTexture* texture = skybox ? skybox->GetTexture() : nullptr;
  if (!texture || texture->GetNumberOfInputConnections(0) == 0)
  {
    return false;
  }
  return texture->GetCubeMap() ? skybox->GetProjection() == vtkSkybox::Cube
                               : skybox->GetProjection() == vtkSkybox::Sphere;
}

void ExtractSky(vtkRenderer* renderer, Scene& scene)
{
  for (vtkProp* prop : GetItems<vtkProp>(renderer->GetViewProps()))
  {
    if (!prop->GetVisibility() || !IsSky(prop))
    {
      continue;
    }
    if (std::shared_ptr<Sky> sky = MakeSky(vtkSkybox::SafeDownCast(prop), scene.Warnings))
    {
      sky->FromScene = FindEnvironmentRotation(renderer);
      sky->Depth = renderer->GetActiveCamera()->GetClippingRange()[1] * scene.Scale;
      scene.BackgroundColors.Surroundings = sky;
    }
  }
}

void ExtractEnvironmentLight(vtkRenderer* renderer, Scene& scene)
{
  vtkTexture* texture = renderer->GetEnvironmentTexture();
  if (!renderer->GetUseImageBasedLighting() || !texture ||
    texture->GetNumberOfInputConnections(0) == 0)
  {
    scene.EnvironmentReflections = nullptr;
    return;
  }
  const bool isCube = texture->GetCubeMap();
  const int count = isCube ? 6 : 1;
  std::uint64_t version = texture->GetMTime();
  for (int face = 0; face < count; ++face)
  {
    if (texture->GetNumberOfInputConnections(face) > 0)
    {
      texture->GetInputAlgorithm(face, 0)->Update();
    }
    if (vtkDataObject* image = texture->GetInputDataObject(face, 0))
    {
      version = std::max<std::uint64_t>(version, image->GetMTime());
    }
  }
  glm::dmat3 rotation = FindEnvironmentRotation(renderer);
  if (isCube)
  {
    rotation = rotation * rotation; // VTK turns cube maps when it filters and when it reads them
  }
  const std::shared_ptr<EnvironmentLight>& before = scene.EnvironmentReflections;
  if (before && before->GetVersion() == version && before->GetFromScene() == rotation)
  {
    return;
  }
  scene.EnvironmentReflections = nullptr;
  std::vector<RadianceImage> faces;
  bool isLinear = isCube || texture->GetUseSRGBColorSpace();
  for (int face = 0; face < count; ++face)
  {
    const std::shared_ptr<Texture> image =
      MakeTextureFace(texture, face, "Environment", scene.Warnings);
    if (!image)
    {
      return;
    }
    vtkDataArray* radiances = FindRadiances(texture, face);
    isLinear = isLinear || radiances;
    faces.push_back(MakeRadianceImage(*image, radiances));
  }
  // VTK takes 8-bit images of all directions as display colors in the diffuse part only.
  scene.EnvironmentReflections =
    std::make_shared<EnvironmentLight>(std::move(faces), rotation, isLinear ? 1.f : 2.2f, version);
}

}
