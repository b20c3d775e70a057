// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "FeatureProps.h"
#include "SceneList.h"

#include "vtkActor.h"
#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkOpenGLRenderer.h"
#include "vtkPBRIrradianceTexture.h"
#include "vtkPBRLUTTexture.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkProperty.h"
#include "vtkScalarsToColors.h"
#include "vtkTexture.h"

#include <cmath>

using penumbra::Feature;

namespace
{

/// Returns an image with smooth gradients.
vtkSmartPointer<vtkImageData> MakeGradients(int width, int height, bool isFloat, int phase)
{
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(width, height, 1);
  image->AllocateScalars(isFloat ? VTK_FLOAT : VTK_UNSIGNED_CHAR, 3);
  for (int j = 0; j < height; ++j)
  {
    for (int i = 0; i < width; ++i)
    {
      const double x = 6.283185 * i / width;
      const double y = 3.141593 * j / height;
      const double color[] = { 0.5 + 0.45 * std::sin(x + phase), 0.5 + 0.45 * std::cos(2.0 * y),
        0.5 + 0.4 * std::sin(2.0 * x + y) };
      for (int k = 0; k < 3; ++k)
      {
        image->SetScalarComponentFromDouble(i, j, 0, k, (isFloat ? 1.5 : 255.0) * color[k]);
      }
    }
  }
  return image;
}

/// Lets a renderer use image-based lighting. Each face of a cube has another phase.
vtkTexture* SetEnvironment(Renderer renderer, bool isCube, bool isFloat)
{
  vtkNew<vtkTexture> texture;
  texture->InterpolateOn();
  texture->MipmapOn();
  texture->SetCubeMap(isCube);
  for (int face = 0; face < (isCube ? 6 : 1); ++face)
  {
    texture->SetInputDataObject(face, MakeGradients(isCube ? 64 : 128, 64, isFloat, face));
  }
  if (isFloat)
  {
    texture->SetColorModeToDirectScalars();
  }
  // VTK's table of reflectances is larger than this comparison needs; software computes it for seconds.
  auto* reference = vtkOpenGLRenderer::SafeDownCast(renderer);
  reference->GetEnvMapLookupTable()->SetLUTSize(64);
  reference->GetEnvMapLookupTable()->SetLUTSamples(256);
  if (isCube)
  {
    reference->UseSphericalHarmonicsOff(); // VTK has those of other images only
    reference->GetEnvMapIrradiance()->SetIrradianceSize(16);
  }
  renderer->SetEnvironmentTexture(texture);
  renderer->UseImageBasedLightingOn();
  return texture;
}

void AddCoatedSphere(Renderer renderer)
{
  vtkProperty* property = Add(renderer, MakeSphere(64))->GetProperty();
  property->SetInterpolationToPBR();
  property->SetMetallic(0.3);
  property->SetRoughness(0.6);
  property->SetCoatStrength(0.7);
  property->SetCoatRoughness(0.2);
  property->SetCoatColor(0.9, 0.5, 0.3);
}

}

void AddEnvironments(SceneList& add)
{
  for (const bool isCube : { false, true })
  {
    for (const bool isFloat : { false, true })
    {
      add(
        Feature::ImageBasedLighting,
        [isCube, isFloat](Renderer r, Window) {
          AddPhysicallyBased(r, false, true);
          SetEnvironment(r, isCube, isFloat);
          if (isFloat)
          {
            r->SetEnvironmentUp(0.0, 0.0, 1.0);
            r->SetEnvironmentRight(0.0, 1.0, 0.0);
          }
          Look(r);
        },
        0.01);
    }
  }
  add(
    Feature::ImageBasedLighting,
    [](Renderer r, Window) {
      AddCoatedSphere(r);
      SetEnvironment(r, false, false)->UseSRGBColorSpaceOn();
      r->ResetCamera();
    },
    0.01);
  // Without lights, the environment is all there is.
  add(
    Feature::ImageBasedLighting,
    [](Renderer r, Window) {
      AddCoatedSphere(r);
      SetEnvironment(r, false, false);
      r->AutomaticLightCreationOff();
      r->ResetCamera();
    },
    0.01);
}
