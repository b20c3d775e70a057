// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "FeatureMaterials.h"

#include "FeatureProps.h"

#include "vtkActor.h"
#include "vtkCylinderSource.h"
#include "vtkImageData.h"
#include "vtkLight.h"
#include "vtkNew.h"
#include "vtkPlaneSource.h"
#include "vtkPolyDataMapper.h"
#include "vtkPolyDataTangents.h"
#include "vtkProperty.h"
#include "vtkRenderer.h"
#include "vtkTexture.h"
#include "vtkTriangleFilter.h"

#include <cmath>
#include <functional>

using penumbra::Feature;

namespace
{

/// Returns a texture whose color at (s, t) in [0, 1]^2 is a function.
vtkSmartPointer<vtkTexture> MakeTexture(
  const std::function<void(double s, double t, double color[3])>& compute)
{
  constexpr int Size = 64;
  vtkNew<vtkImageData> image;
  image->SetDimensions(Size, Size, 1);
  image->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
  for (int p = 0; p < Size * Size; ++p)
  {
    double color[3];
    compute((p % Size + 0.5) / Size, (p / Size + 0.5) / Size, color);
    for (int k = 0; k < 3; ++k)
    {
      image->SetScalarComponentFromDouble(p % Size, p / Size, 0, k, std::lround(255.0 * color[k]));
    }
  }
  auto texture = vtkSmartPointer<vtkTexture>::New();
  texture->SetInputData(image);
  texture->InterpolateOn();
  return texture;
}

/// Normals of waves with `count` periods along each side.
vtkSmartPointer<vtkTexture> MakeWaves(double count)
{
  return MakeTexture([count](double s, double t, double color[3]) {
    const double normal[3] = { 0.5 * std::sin(6.2831853 * count * s),
      0.5 * std::sin(6.2831853 * count * t), 1.0 };
    const double length = std::hypot(normal[0], normal[1], normal[2]);
    for (int k = 0; k < 3; ++k)
    {
      color[k] = 0.5 + 0.5 * normal[k] / length;
    }
  });
}

vtkSmartPointer<vtkTexture> MakeRamps()
{
  return MakeTexture([](double s, double t, double color[3]) {
    color[0] = 0.3 + 0.7 * s;
    color[1] = 0.2 + 0.8 * t;
    color[2] = 1.0 - s;
  });
}

void SetMaterial(vtkProperty* property, Feature feature)
{
  property->SetInterpolationToPBR();
  property->SetMetallic(0.4);
  property->SetRoughness(0.45);
  switch (feature)
  {
    case Feature::NormalTexture:
      property->SetNormalTexture(MakeWaves(3.0));
      property->SetNormalScale(0.8);
      break;
    case Feature::MaterialTexture:
      property->SetMetallic(1.0);
      property->SetRoughness(0.8);
      property->SetOcclusionStrength(0.7);
      property->SetORMTexture(MakeRamps());
      break;
    case Feature::EmissiveTexture:
    {
      vtkSmartPointer<vtkTexture> texture = MakeRamps();
      texture->UseSRGBColorSpaceOn();
      property->SetEmissiveTexture(texture);
      property->SetEmissiveFactor(0.2, 0.5, 0.3);
      break;
    }
    case Feature::Anisotropy:
      property->SetMetallic(0.9);
      property->SetAnisotropy(0.8);
      property->SetAnisotropyRotation(0.3);
      property->SetAnisotropyTexture(MakeRamps());
      break;
    default:
      property->SetCoatStrength(0.8);
      property->SetCoatRoughness(0.25);
      property->SetCoatIOR(1.8);
      property->SetCoatColor(0.7, 0.9, 1.0);
      property->SetCoatNormalScale(0.6);
      property->SetCoatNormalTexture(MakeWaves(2.0));
      break;
  }
}

void AddWithTangents(vtkRenderer* renderer, vtkAlgorithm* source, Feature feature)
{
  vtkNew<vtkTriangleFilter> triangles;
  triangles->SetInputConnection(source->GetOutputPort());
  vtkNew<vtkPolyDataTangents> tangents;
  tangents->SetInputConnection(triangles->GetOutputPort());
  SetMaterial(Add(renderer, Make(tangents.Get()))->GetProperty(), feature);
}

/// Adds a tube and a rectangle with a physically based material that uses a feature.
/// @param headlight If false, a directional and a positional light are added.
void AddMaterial(vtkRenderer* renderer, Feature feature, bool headlight)
{
  vtkNew<vtkCylinderSource> tube;
  tube->CappingOff();
  tube->SetResolution(64);
  AddWithTangents(renderer, tube, feature);
  vtkNew<vtkPlaneSource> plane;
  plane->SetOrigin(0.6, -0.5, 0.0);
  plane->SetPoint1(1.6, -0.5, 0.0);
  plane->SetPoint2(0.6, 0.5, 0.0);
  AddWithTangents(renderer, plane, feature);
  if (!headlight)
  {
    vtkNew<vtkLight> light;
    light->SetPosition(3.0, 5.0, 6.0);
    light->SetFocalPoint(1.0, 1.0, 0.0);
    light->SetColor(1.0, 0.9, 0.8);
    renderer->AddLight(light);
    vtkNew<vtkLight> positional;
    positional->SetPositional(true);
    positional->SetConeAngle(90.0);
    positional->SetPosition(-2.0, 1.0, 3.0);
    positional->SetIntensity(0.6);
    renderer->AddLight(positional);
  }
  Look(renderer);
}

}

void AddMaterialScenes(std::vector<FeatureScene>& scenes)
{
  for (const bool headlight : { true, false })
  {
    for (const Feature key : { Feature::NormalTexture, Feature::MaterialTexture,
           Feature::EmissiveTexture, Feature::Anisotropy, Feature::ClearCoat })
    {
      // The column of pixels where the texture coordinates of the tube start again differs.
      scenes.push_back({ key,
        [key, headlight](
          vtkRenderer* renderer, vtkRenderWindow*) { AddMaterial(renderer, key, headlight); },
        0.004 });
    }
  }
}
