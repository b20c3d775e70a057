// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "LimitScenes.h"

#include "Scenes/Adversaries.h"
#include "vtkPenumbraBruteForceIrradiance.h"
#include "vtkPenumbraIrradianceFilter.h"
#include "vtkPenumbraRayCaster.h"

#include "vtkActor.h"
#include "vtkActorCollection.h"
#include "vtkCamera.h"
#include "vtkCleanPolyData.h"
#include "vtkNew.h"
#include "vtkPLYReader.h"
#include "vtkParametricFunctionSource.h"
#include "vtkParametricSuperEllipsoid.h"
#include "vtkPolyData.h"
#include "vtkPolyDataNormals.h"
#include "vtkProperty.h"
#include "vtkRenderer.h"
#include "vtkTriangleFilter.h"
#include "vtkXMLPolyDataReader.h"

namespace penumbra
{
namespace
{

using Tasks = LimitScene::Tasks;

vtkSmartPointer<vtkPolyData> MakeSuperEllipsoid()
{
  vtkNew<vtkParametricSuperEllipsoid> shape;
  shape->SetN1(0.3);
  shape->SetN2(0.4);
  vtkNew<vtkParametricFunctionSource> source;
  source->SetParametricFunction(shape);
  source->SetUResolution(120);
  source->SetVResolution(120);
  source->SetWResolution(120);
  vtkNew<vtkTriangleFilter> triangles;
  triangles->SetInputConnection(source->GetOutputPort());
  vtkNew<vtkCleanPolyData> clean;
  clean->SetInputConnection(triangles->GetOutputPort());
  vtkNew<vtkPolyDataNormals> normals;
  normals->SetInputConnection(clean->GetOutputPort());
  normals->Update();
  return normals->GetOutput();
}

template <typename Reader>
vtkSmartPointer<vtkPolyData> Read(const std::string& path)
{
  vtkNew<Reader> reader;
  reader->SetFileName(path.c_str());
  reader->Update();
  return reader->GetOutput();
}

/// Returns a scene that draws an adversary.
LimitScene DrawAdversary(
  const std::string& name, const std::string& adversary, int n, int width, int height)
{
  LimitScene scene = MakeScene({ name, adversary, Tasks::Draw }, n);
  scene.Name = name;
  scene.Width = width;
  scene.Height = height;
  return scene;
}

void ShowWideEdges(vtkProperty* property)
{
  property->EdgeVisibilityOn();
  property->SetLineWidth(2.f);
}

vtkSmartPointer<vtkRenderer> NewRenderer(const LimitScene& scene, vtkPolyData* mesh)
{
  vtkSmartPointer<vtkRenderer> renderer = NewAdversaryRenderer(mesh, 1.0);
  if (scene.Prepare)
  {
    scene.Prepare(renderer->GetActors()->GetLastActor()->GetProperty());
  }
  if (scene.ResetCamera)
  {
    renderer->GetActiveCamera()->SetPosition(0.8, 1.0, 1.2);
    renderer->ResetCamera();
  }
  return renderer;
}

}

const std::vector<LimitFamily>& GetLimitFamilies()
{
  static const std::vector<LimitFamily> families = [] {
    std::vector<LimitFamily> all;
    for (const Adversary& adversary : Adversaries())
    {
      all.push_back({ adversary.Name, adversary.Name, Tasks::Draw });
    }
    all.push_back({ "Copies, occlusion", "Copies", Tasks::DrawWithOcclusion });
    all.push_back({ "Soup, baked", "Soup", Tasks::Bake });
    all.push_back({ "Fan, baked", "Fan", Tasks::Bake });
    return all;
  }();
  return families;
}

LimitScene MakeScene(const LimitFamily& family, int n)
{
  const Adversary* adversary = FindAdversary(family.Adversary);
  LimitScene scene;
  scene.Name = family.Name;
  scene.Task = family.Task;
  scene.Primitives = n;
  scene.MakeMesh = [adversary, n] { return adversary->Make(n); };
  scene.Prepare = adversary->Prepare;
  return scene;
}

std::vector<LimitScene> MakeSingleScenes(const std::string& data)
{
  std::vector<LimitScene> scenes;
  scenes.push_back({ "superellipsoid 120x120, 256x256", Tasks::Draw, 28322, 256, 256,
    MakeSuperEllipsoid, {}, true });
  const auto brain = [data] { return Read<vtkXMLPolyDataReader>(data + "/brain.vtp"); };
  scenes.push_back({ "brain.vtp, wireframe, 400x240", Tasks::Draw, 43999, 400, 240, brain,
    [](vtkProperty* property) { property->SetRepresentationToWireframe(); }, true });
  const auto head = [data] { return Read<vtkPLYReader>(data + "/head.ply"); };
  scenes.push_back({ "head.ply, edges of 2 pixels, 1000x600", Tasks::Draw, 17678, 1000, 600, head,
    ShowWideEdges, true });
  scenes.push_back({ "head.ply, edges of 2 pixels, 500x300", Tasks::Draw, 17678, 500, 300, head,
    ShowWideEdges, true });
  for (const int n : { 60, 80, 100, 120 })
  {
    scenes.push_back(DrawAdversary(
      std::to_string(n) + " slivers in a few pixels, 256x256", "Slivers", n, 256, 256));
  }
  scenes.push_back(
    DrawAdversary("300 clusters of 100 triangles, 1000x600", "Clusters", 30000, 1000, 600));
  scenes.push_back(DrawAdversary("30 streamlines, 700x500", "Streamlines", 715, 700, 500));
  scenes.push_back(DrawAdversary("60 streamlines, 700x500", "Streamlines", 1391, 700, 500));
  scenes.push_back(DrawAdversary("3,000 hairs, 256x256", "Hair", 3000, 256, 256));
  scenes.push_back(DrawAdversary("comb of 8,000 corners, 256x256", "Comb", 8000, 256, 256));
  scenes.push_back(
    DrawAdversary("random polygon of 8,000 corners, 256x256", "RandomPolygon", 8000, 256, 256));
  scenes.push_back(MakeScene({ "fan of 80,000 triangles, baked", "Fan", Tasks::Bake }, 80000));
  return scenes;
}

LimitScene MakePlainScene(const LimitScene& scene)
{
  LimitScene plain = scene;
  plain.Name = "plain mesh";
  plain.Prepare = {};
  plain.ResetCamera = false;
  plain.MakeMesh = [n = scene.Primitives,
                     aspect = static_cast<double>(scene.Width) / scene.Height] {
    return MakePlainMesh(n, aspect);
  };
  return plain;
}

void RunScene(const LimitScene& scene, vtkPolyData* mesh)
{
  if (scene.Task == Tasks::Bake)
  {
    vtkNew<vtkPenumbraIrradianceFilter> filter;
    filter->SetInputData(mesh);
    filter->SetNumberOfThreads(1);
    filter->Update();
    return;
  }
  vtkNew<vtkPenumbraRayCaster> caster;
  caster->SetRenderer(NewRenderer(scene, mesh));
  caster->SetResolution(scene.Width, scene.Height);
  caster->SetNumberOfThreads(1);
  if (scene.Task == Tasks::DrawWithOcclusion)
  {
    caster->AmbientOcclusionOn();
    caster->SetIrradianceProvider(vtkNew<vtkPenumbraBruteForceIrradiance>());
  }
  caster->Update();
}

}
