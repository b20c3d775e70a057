// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "OrdinaryScenes.h"

#include "Scenes/TestScene.h"

#include "vtkActor.h"
#include "vtkCamera.h"
#include "vtkClipPolyData.h"
#include "vtkImageData.h"
#include "vtkLookupTable.h"
#include "vtkNew.h"
#include "vtkPLYReader.h"
#include "vtkParametricFunctionSource.h"
#include "vtkParametricRandomHills.h"
#include "vtkPlane.h"
#include "vtkPlaneSource.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkPolyDataMapper.h"
#include "vtkPolyDataReader.h"
#include "vtkProperty.h"
#include "vtkRenderer.h"
#include "vtkSTLReader.h"
#include "vtkTexture.h"
#include "vtkXMLPolyDataReader.h"

#include <cmath>

namespace penumbra
{
namespace
{

using Style = std::function<void(vtkProperty*)>;

template <typename Reader>
vtkSmartPointer<vtkPolyData> Read(const std::string& path)
{
  vtkNew<Reader> reader;
  reader->SetFileName(path.c_str());
  reader->Update();
  return reader->GetOutput();
}

vtkSmartPointer<vtkPolyData> ReadMesh(const std::string& path)
{
  const std::string extension = path.substr(path.rfind('.') + 1);
  return extension == "ply" ? Read<vtkPLYReader>(path)
    : extension == "stl"    ? Read<vtkSTLReader>(path)
    : extension == "vtk"    ? Read<vtkPolyDataReader>(path)
                            : Read<vtkXMLPolyDataReader>(path);
}

void ShowEdges(vtkProperty* property)
{
  property->EdgeVisibilityOn();
  property->SetOpacity(0.5);
}

void ShowWireframe(vtkProperty* property)
{
  property->SetRepresentationToWireframe();
  property->SetOpacity(0.3);
}

/// Resets the camera as the program does.
void Look(vtkRenderer* renderer)
{
  LookAlong(
    renderer, { 0.0, 0.0, -1.0 }, { 0.0, 1.0, 0.0 }, OrdinaryImageWidth, OrdinaryImageHeight);
}

void BuildMesh(vtkRenderer* renderer, const std::string& path, const Style& style)
{
  vtkProperty* const property = AddMesh(renderer, ReadMesh(path), true)->GetProperty();
  if (style)
  {
    style(property);
  }
  Look(renderer);
}

/// A half of a mesh, and the wireframe of the whole.
void BuildHalf(vtkRenderer* renderer, const std::string& path, bool wireframe)
{
  const vtkSmartPointer<vtkPolyData> mesh = ReadMesh(path);
  vtkNew<vtkPlane> plane;
  plane->SetOrigin(mesh->GetCenter());
  plane->SetNormal(1.0, 0.0, 0.0);
  vtkNew<vtkClipPolyData> clip;
  clip->SetInputData(mesh);
  clip->SetClipFunction(plane);
  clip->Update();
  AddMesh(renderer, clip->GetOutput(), true)->GetProperty()->SetColor(0.9, 0.5, 0.3);
  if (wireframe)
  {
    ShowWireframe(AddMesh(renderer, mesh, true)->GetProperty());
  }
  Look(renderer);
}

/// Hills colored by their heights. `translucent`: with edges and an opacity that is a sigmoid of the
/// height.
void BuildHills(vtkRenderer* renderer, bool translucent)
{
  vtkNew<vtkParametricRandomHills> hills;
  vtkNew<vtkParametricFunctionSource> source;
  source->SetParametricFunction(hills);
  source->SetScalarModeToZ();
  source->SetUResolution(100);
  source->SetVResolution(100);
  source->Update();
  vtkActor* const actor = AddMesh(renderer, source->GetOutput(), true);
  constexpr int colors = 256;
  vtkNew<vtkLookupTable> table;
  table->SetNumberOfTableValues(colors);
  table->Build();
  for (int i = 0; i < colors; ++i)
  {
    const double x = i / (colors - 1.0);
    const double opacity = 1.0 / (1.0 + std::exp(-10.0 * (x - 0.5)));
    table->SetTableValue(i, x, 0.5 + 0.3 * x, 1.0 - x, translucent ? opacity : 1.0);
  }
  vtkMapper* const mapper = actor->GetMapper();
  mapper->SetLookupTable(table);
  mapper->SetScalarRange(source->GetOutput()->GetScalarRange());
  mapper->ScalarVisibilityOn();
  actor->GetProperty()->SetEdgeVisibility(translucent);
  LookAlong(
    renderer, { -0.6, 0.5, -0.6 }, { 0.0, 0.0, 1.0 }, OrdinaryImageWidth, OrdinaryImageHeight);
}

/// A square with black and white texels, seen at a grazing angle.
void BuildCheckerboard(vtkRenderer* renderer, bool interpolate, bool textured)
{
  constexpr int texels = 512;
  vtkNew<vtkImageData> image;
  image->SetDimensions(texels, texels, 1);
  image->AllocateScalars(VTK_UNSIGNED_CHAR, 1);
  for (int j = 0; j < texels; ++j)
  {
    for (int i = 0; i < texels; ++i)
    {
      image->SetScalarComponentFromDouble(i, j, 0, 0, (i + j) % 2 ? 255 : 0);
    }
  }
  vtkNew<vtkTexture> texture;
  texture->SetInputData(image);
  texture->SetInterpolate(interpolate);
  vtkNew<vtkPlaneSource> plane;
  plane->Update();
  vtkActor* const actor = AddMesh(renderer, plane->GetOutput(), false);
  actor->SetTexture(textured ? texture.Get() : nullptr);
  vtkCamera* const camera = renderer->GetActiveCamera();
  camera->SetPosition(0.1, -0.75, 0.12);
  camera->SetFocalPoint(0.0, 0.0, 0.0);
  camera->SetViewUp(0.0, 0.0, 1.0);
  camera->SetViewAngle(40.0);
  renderer->ResetCameraClippingRange();
}

}

std::vector<OrdinaryScene> MakeOrdinaryScenes(const std::string& data)
{
  std::vector<OrdinaryScene> scenes;
  for (const char* name : { "head.ply", "brain.vtp", "bracket.stl", "terrain.vtp", "bell-jar.vtk",
         "nanotubes.vtp", "streamlines.vtk", "aggregate.vtk" })
  {
    const std::string path = data + "/" + name;
    const auto add = [&](const char* what, const Style& style) {
      scenes.push_back({ std::string(name) + ", " + what,
        [=](vtkRenderer* renderer) { BuildMesh(renderer, path, style); },
        [=](vtkRenderer* renderer) { BuildMesh(renderer, path, {}); } });
    };
    add("edges, opacity 0.5", ShowEdges);
    add("wireframe, opacity 0.3", ShowWireframe);
  }
  const std::string head = data + "/head.ply";
  scenes.push_back({ "head.ply, half, and wireframe of opacity 0.3",
    [=](vtkRenderer* renderer) { BuildHalf(renderer, head, true); },
    [=](vtkRenderer* renderer) { BuildHalf(renderer, head, false); } });
  const auto hideLines = [](vtkProperty* property) { property->SetRepresentationToWireframe(); };
  scenes.push_back({ "head.ply, hidden lines",
    [=](vtkRenderer* renderer) {
      BuildMesh(renderer, head, hideLines);
      renderer->UseHiddenLineRemovalOn();
    },
    [=](vtkRenderer* renderer) { BuildMesh(renderer, head, {}); } });
  scenes.push_back(
    { "hills, sigmoid opacity, edges", [](vtkRenderer* renderer) { BuildHills(renderer, true); },
      [](vtkRenderer* renderer) { BuildHills(renderer, false); } });
  for (const bool interpolate : { false, true })
  {
    scenes.push_back(
      { interpolate ? "checkerboard of 512 texels, interpolated" : "checkerboard of 512 texels",
        [=](vtkRenderer* renderer) { BuildCheckerboard(renderer, interpolate, true); },
        [=](vtkRenderer* renderer) { BuildCheckerboard(renderer, interpolate, false); } });
  }
  for (OrdinaryScene& scene : scenes)
  {
    for (auto* build : { &scene.Build, &scene.Plain })
    {
      *build = [inner = *build](vtkRenderer* renderer) {
        renderer->SetBackground(0.2, 0.3, 0.4);
        inner(renderer);
      };
    }
  }
  return scenes;
}

}
