// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "SceneExtractionSky.h"

#include "Scene.h"
#include "SceneExtractionColors.h"

#include "vtkCamera.h"
#include "vtkImageData.h"
#include "vtkPropCollection.h"
#include "vtkRenderer.h"
#include "vtkSkybox.h"
#include "vtkTexture.h"

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

glm::dvec3 ToVector(const double* x)
{
  return { x[0], x[1], x[2] };
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
  vtkPropCollection* props = renderer->GetViewProps();
  vtkCollectionSimpleIterator position;
  props->InitTraversal(position);
  while (vtkProp* prop = props->GetNextProp(position))
  {
    if (!prop->GetVisibility() || !IsSky(prop))
    {
      continue;
    }
    if (std::shared_ptr<Sky> sky = MakeSky(vtkSkybox::SafeDownCast(prop), scene.Warnings))
    {
      const glm::dvec3 right = ToVector(renderer->GetEnvironmentRight());
      const glm::dvec3 up = ToVector(renderer->GetEnvironmentUp());
      sky->FromScene = glm::transpose(glm::dmat3(right, up, glm::cross(right, up)));
      sky->Depth = renderer->GetActiveCamera()->GetClippingRange()[1] * scene.Scale;
      scene.BackgroundColors.Surroundings = sky;
    }
  }
}

}
