// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "RandomScenes.h"

#include "RandomExtras.h"
#include "RandomMeshes.h"
#include "RandomProps.h"

#include "vtkActor.h"
#include "vtkCamera.h"
#include "vtkCubeSource.h"
#include "vtkImageData.h"
#include "vtkLight.h"
#include "vtkNew.h"
#include "vtkPenumbraMedium.h"
#include "vtkPenumbraRayCaster.h"
#include "vtkPolyDataMapper.h"
#include "vtkProp.h"
#include "vtkRenderWindow.h"
#include "vtkRenderer.h"
#include "vtkTexture.h"
#include "vtkVersionMacros.h"

#include <algorithm>
#include <cstdio>

namespace penumbra_soak
{
namespace
{

/// Streams of random numbers; props follow.
enum Streams
{
  ViewStream,
  LightStream,
  BackgroundStream,
  EffectStream,
  FirstPropStream,
  FirstExtraStream = 1000
};

/// Where the scene lies in the world.
struct Place
{
  glm::dvec3 Center{ 0.0 };
  double Unit = 1.0;
};

Place MakePlace(Random& random, RandomScene& scene)
{
  Place place;
  if (random.Chance(0.2))
  {
    place.Unit = random.Pick({ 1e-5, 1e-3, 1e3, 1e6 });
    scene.Description += "unit " + std::to_string(place.Unit) + "; ";
  }
  if (random.Chance(0.12))
  {
    place.Center = random.Pick({ 1e2, 1e4, 1e6 }) * place.Unit * random.Direction();
    scene.Description += "far from the origin; ";
    scene.ComparesWithVTK = false; // single precision
  }
  return place;
}

void AddProps(std::uint64_t seed, Random& random, const Place& place, RandomScene& scene,
  const std::vector<int>& kept, bool extras)
{
  const bool difficult = random.Chance(0.35);
  const int count = random.Chance(0.1) ? 20 : 1 + random.Below(7);
  bool translucent = false;
  for (int i = 0; i < count; ++i)
  {
    Random own(seed, FirstPropStream + i);
    const glm::dvec3 center = place.Center + place.Unit * own.Vector();
    RandomProp prop = MakeRandomProp(own, scene.Renderer, difficult, center, place.Unit);
    if (!kept.empty() && std::find(kept.begin(), kept.end(), i) == kept.end())
    {
      continue;
    }
    scene.Renderer->AddViewProp(prop.Prop);
    if (extras)
    {
      Random more(seed, FirstExtraStream + i);
      AddRandomExtras(more, scene.Renderer, place.Unit, prop);
    }
    scene.Description += std::to_string(i) + ": " + prop.Description + "; ";
    scene.ComparesWithVTK = scene.ComparesWithVTK && !prop.Arbitrary;
    scene.NeedsCaster = scene.NeedsCaster || prop.NeedsCaster;
    translucent = translucent || prop.Translucent;
  }
  if (translucent)
  {
    scene.Renderer->SetUseDepthPeeling(true);
    scene.Renderer->SetMaximumNumberOfPeels(100);
    scene.Renderer->SetOcclusionRatio(0.0);
  }
}

void SetView(Random& random, const Place& place, RandomScene& scene)
{
  vtkCamera* camera = scene.Renderer->GetActiveCamera();
  const glm::dvec3 direction = random.Direction();
  const glm::dvec3 target = place.Center + 0.3 * place.Unit * random.Vector();
  double angle = random.Chance(0.7) ? 30.0 : random.Scale(0.01, 150.0);
  double distance = 4.5 * place.Unit * std::tan(0.2618) / std::tan(angle * 0.0087266);
  if (random.Chance(0.1))
  {
    distance *= random.Between(0.05, 0.4); // close to props or inside of them
    scene.Description += "close; ";
  }
  camera->SetFocalPoint(target.x, target.y, target.z);
  camera->SetPosition(target.x - distance * direction.x, target.y - distance * direction.y,
    target.z - distance * direction.z);
  camera->SetViewAngle(angle);
  camera->SetViewUp(0.0, std::abs(direction.y) > 0.9 ? 0.0 : 1.0, std::abs(direction.y) > 0.9);
  camera->Roll(random.Between(0.0, 360.0));
  if (random.Chance(0.2))
  {
    camera->ParallelProjectionOn();
    camera->SetParallelScale(place.Unit * random.Scale(0.5, 3.0));
    scene.Description += "parallel; ";
  }
  if (random.Chance(0.08))
  {
    camera->SetWindowCenter(random.Between(-0.5, 0.5), random.Between(-0.5, 0.5));
    scene.Description += "off-axis; ";
  }
  scene.Renderer->ResetCameraClippingRange();
  if (random.Chance(0.06))
  {
    double range[2];
    camera->GetClippingRange(range);
    const double near = range[0] + 0.4 * random.Unit() * (range[1] - range[0]);
    camera->SetClippingRange(near, near + 0.5 * (range[1] - near));
    scene.Description += "clipping range; ";
  }
  char text[64];
  std::snprintf(text, sizeof(text), "angle %.3g; ", angle);
  scene.Description += text;
  // Single precision of VTK's depth and of its matrices.
  scene.ComparesWithVTK = scene.ComparesWithVTK && angle > 2.0;
}

void AddLights(Random& random, const Place& place, RandomScene& scene)
{
  if (random.Chance(0.4))
  {
    return; // the headlight
  }
  const int count = 1 + random.Below(3);
  scene.Description += std::to_string(count) + " lights; ";
  for (int i = 0; i < count; ++i)
  {
    vtkNew<vtkLight> light;
    const glm::dvec3 position = place.Center + 4.0 * place.Unit * random.Direction();
    light->SetLightType(random.Pick({ VTK_LIGHT_TYPE_HEADLIGHT, VTK_LIGHT_TYPE_CAMERA_LIGHT,
      VTK_LIGHT_TYPE_SCENE_LIGHT, VTK_LIGHT_TYPE_SCENE_LIGHT }));
    if (light->GetLightType() == VTK_LIGHT_TYPE_SCENE_LIGHT)
    {
      light->SetPosition(position.x, position.y, position.z);
      light->SetFocalPoint(place.Center.x, place.Center.y, place.Center.z);
      light->SetPositional(random.Chance(0.5));
      light->SetConeAngle(random.Chance(0.5) ? 90.0 : random.Between(5.0, 60.0));
      light->SetExponent(random.Between(0.5, 3.0));
      if (random.Chance(0.3))
      {
        light->SetAttenuationValues(1.0, 0.1 / place.Unit, 0.0);
      }
    }
    const glm::dvec3 color = random.Color();
    light->SetColor(color.r, color.g, color.b);
    light->SetIntensity(random.Scale(0.2, 2.0));
    light->SetSwitch(random.Chance(0.95));
    scene.Renderer->AddLight(light);
  }
}

void SetBackground(Random& random, RandomScene& scene)
{
  const glm::dvec3 color = random.Color();
  scene.Renderer->SetBackground(color.r, color.g, color.b);
  if (random.Chance(0.2))
  {
    const glm::dvec3 other = random.Color();
    scene.Renderer->SetBackground2(other.r, other.g, other.b);
    scene.Renderer->GradientBackgroundOn();
#if VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 3, 0)
    scene.Renderer->SetGradientMode(static_cast<vtkViewport::GradientModes>(random.Below(4)));
#endif
    scene.Description += "gradient; ";
  }
  else if (random.Chance(0.08))
  {
    vtkNew<vtkTexture> texture;
    texture->SetInputData(MakeRandomImage(random));
    texture->SetInterpolate(random.Chance(0.5));
    scene.Renderer->SetBackgroundTexture(texture);
    scene.Renderer->TexturedBackgroundOn();
    scene.ComparesTiles = false; // sampled at the centers of pixels, as VTK does
    scene.Description += "textured background; ";
  }
  if (random.Chance(0.08))
  {
    vtkNew<vtkRenderer> layer;
    vtkNew<vtkCubeSource> cube;
    vtkNew<vtkPolyDataMapper> mapper;
    mapper->SetInputConnection(cube->GetOutputPort());
    vtkNew<vtkActor> actor;
    actor->SetMapper(mapper);
    actor->RotateX(30.0);
    actor->RotateY(random.Between(0.0, 90.0));
    layer->AddActor(actor);
    layer->SetLayer(1);
    layer->SetViewport(0.0, 0.0, random.Between(0.2, 1.0), random.Between(0.2, 1.0));
    layer->InteractiveOff();
    scene.Window->SetNumberOfLayers(2);
    scene.Window->AddRenderer(layer);
    layer->ResetCamera();
    scene.NeedsCaster = true;
    scene.Description += "layer above; ";
  }
}

using Setting = std::function<void(vtkPenumbraRayCaster*)>;

/// Appends a setting with a probability and describes it.
void Add(Random& random, RandomScene& scene, std::vector<Setting>& settings, double probability,
  const char* description, const Setting& setting)
{
  if (random.Chance(probability))
  {
    settings.push_back(setting);
    scene.Effects = true;
    scene.Description += std::string(description) + "; ";
  }
}

/// `frequency` multiplies the probabilities of light effects.
void ChooseSettings(Random& random, const Place& place, double frequency, RandomScene& scene)
{
  scene.Tolerance = 1.0 / random.Pick({ 64.0, 256.0, 256.0, 256.0, 512.0 });
  scene.Shadows = random.Chance(0.25 * frequency);
  const double tolerance = scene.Tolerance;
  std::vector<Setting> plain{ [tolerance](vtkPenumbraRayCaster* caster) {
    caster->SetTolerance(tolerance);
    caster->SetResolution(ImageSide, ImageSide);
    caster->SetNumberOfThreads(1);
  } };
  if (random.Chance(0.1))
  {
    plain.push_back([](vtkPenumbraRayCaster* c) { c->GeometryArraysOn(); });
  }
  std::vector<Setting> all = plain;
  if (scene.Shadows)
  {
    all.push_back([](vtkPenumbraRayCaster* c) { c->ShadowsOn(); });
    scene.Description += "shadows; ";
    Add(random, scene, all, 0.2 * frequency, "soft shadows",
      [radius = place.Unit * random.Between(0.05, 0.6), angle = random.Between(0.5, 20.0)](
        vtkPenumbraRayCaster* c) {
        c->SetLightRadius(radius);
        c->SetLightAngle(angle);
      });
  }
  Add(random, scene, all, 0.06 * frequency, "ambient occlusion",
    [radius = place.Unit * random.Scale(0.05, 10.0)](vtkPenumbraRayCaster* c) {
      c->AmbientOcclusionOn();
      c->SetAmbientOcclusionRadius(radius);
    });
  Add(random, scene, all, 0.05 * frequency, "indirect light",
    [color = random.Color(), albedo = random.Unit(), bounces = 1 + random.Below(3)](
      vtkPenumbraRayCaster* c) {
      c->IndirectLightOn();
      c->SetEnvironmentColor(color.r, color.g, color.b);
      c->SetAlbedo(albedo);
      c->SetBounces(bounces);
    });
  Add(random, scene, all, 0.06 * frequency, "medium",
    [scattering = random.Scale(0.01, 0.3) / place.Unit](vtkPenumbraRayCaster* c) {
      vtkNew<vtkPenumbraMedium> medium;
      medium->SetScattering(scattering);
      medium->SetExtinction(1.2 * scattering);
      c->SetMedium(medium);
    });
  const bool effects = scene.Effects;
  Add(random, scene, all, 0.05, "radii",
    [radius = place.Unit * random.Scale(0.005, 0.1)](vtkPenumbraRayCaster* c) {
      c->SetPointRadius(radius);
      c->SetLineRadius(radius);
    });
  scene.NeedsCaster = scene.NeedsCaster || (scene.Effects && !effects);
  scene.Effects = effects;
  const auto apply = [](const std::vector<Setting>& settings) {
    return [settings](vtkPenumbraRayCaster* caster) {
      for (const Setting& setting : settings)
      {
        setting(caster);
      }
    };
  };
  scene.Choose = apply(all);
  scene.ChoosePlain = apply(plain);
}

}

RandomScene MakeRandomScene(
  std::uint64_t seed, const std::vector<int>& kept, double effects, bool extras)
{
  RandomScene scene;
  scene.Window = vtkSmartPointer<vtkRenderWindow>::New();
  scene.Window->SetOffScreenRendering(1);
  scene.Window->SetMultiSamples(0);
  scene.Window->SetAlphaBitPlanes(1);
  scene.Window->SetSize(ImageSide, ImageSide);
  scene.Renderer = vtkSmartPointer<vtkRenderer>::New();
  scene.Window->AddRenderer(scene.Renderer);
  Random view(seed, ViewStream);
  Random lights(seed, LightStream);
  Random background(seed, BackgroundStream);
  Random settings(seed, EffectStream);
  const Place place = MakePlace(view, scene);
  AddProps(seed, view, place, scene, kept, extras);
  SetView(view, place, scene);
  AddLights(lights, place, scene);
  SetBackground(background, scene);
  ChooseSettings(settings, place, effects, scene);
  return scene;
}

}
