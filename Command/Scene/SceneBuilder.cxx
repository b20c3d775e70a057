// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "SceneBuilder.h"

#include "Annotations.h"
#include "Coloring.h"
#include "Files/ImageFiles.h"
#include "Input/Surfaces.h"
#include "Looks.h"
#include "Materials.h"
#include "Options/RenderOptions.h"
#include "Processes/CommandError.h"

#include "vtkActor.h"
#include "vtkCamera.h"
#include "vtkCellData.h"
#include "vtkCleanPolyData.h"
#include "vtkFieldData.h"
#include "vtkLight.h"
#include "vtkLookupTable.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkPolyDataMapper.h"
#include "vtkPolyDataNormals.h"
#include "vtkRenderer.h"
#include "vtkStringArray.h"
// VTK 9.2 lacks this filter; its rasterizer shows the edges between the parts of curved cells.
#if __has_include("vtkRecoverGeometryWireframe.h")
#define PENUMBRA_HAS_RECOVER_GEOMETRY_WIREFRAME
#include "vtkRecoverGeometryWireframe.h"
#endif

#include <algorithm>
#include <cmath>

namespace penumbra
{

namespace
{

// Computes point normals. Coincident points are merged first if the mesh has no point arrays, so that
// meshes that repeat the points of every triangle become smooth, too.
vtkSmartPointer<vtkPolyData> ComputeNormals(vtkPolyData* mesh, double featureAngle)
{
  vtkNew<vtkPolyData> input;
  input->ShallowCopy(mesh);
  input->GetPointData()->SetNormals(nullptr);
  vtkNew<vtkCleanPolyData> merge;
  merge->SetInputData(input);
  merge->SetTolerance(0.0);
  merge->ConvertLinesToPointsOff();
  merge->ConvertPolysToLinesOff();
  merge->ConvertStripsToPolysOff();
  vtkNew<vtkPolyDataNormals> normals;
  if (input->GetPointData()->GetNumberOfArrays() == 0)
  {
    normals->SetInputConnection(merge->GetOutputPort());
  }
  else
  {
    normals->SetInputData(input);
  }
  normals->SetFeatureAngle(featureAngle);
  normals->SplittingOn();
  normals->Update();
  return normals->GetOutput();
}

#ifdef PENUMBRA_HAS_RECOVER_GEOMETRY_WIREFRAME
/// Sets the array that holds the faces of curved cells. Before VTK 9.3, its name is fixed.
template <typename Filter>
auto SetFaces(Filter* filter, int) -> decltype(filter->SetCellIdsAttribute(CurvedFaces))
{
  filter->SetCellIdsAttribute(CurvedFaces);
}
template <typename Filter>
void SetFaces(Filter*, long)
{
}

// Marks the edges between the parts of curved cells, which the rasterizer would draw, as hidden.
vtkSmartPointer<vtkPolyData> HideInnerEdges(vtkPolyData* mesh)
{
  if (!mesh->GetCellData()->HasArray(CurvedFaces))
  {
    return mesh;
  }
  vtkNew<vtkRecoverGeometryWireframe> edges;
  edges->SetInputData(mesh);
  SetFaces(edges.Get(), 0);
  edges->Update();
  return edges->GetOutput();
}
#else
vtkSmartPointer<vtkPolyData> HideInnerEdges(vtkPolyData* mesh)
{
  return mesh;
}
#endif

/// Returns the mesh with its name, for messages.
vtkSmartPointer<vtkPolyData> AddName(vtkPolyData* mesh, const std::string& name)
{
  vtkNew<vtkStringArray> array;
  array->SetName(SourceName);
  array->InsertNextValue(name);
  auto named = vtkSmartPointer<vtkPolyData>::New();
  named->ShallowCopy(mesh);
  named->GetFieldData()->AddArray(array);
  return named;
}

void AddLights(vtkRenderer* renderer, const Surfaces& surfaces, const RenderOptions& options)
{
  renderer->AutomaticLightCreationOff();
  if (options.Lights.empty() && !surfaces.Lights.empty())
  {
    for (vtkLight* light : surfaces.Lights)
    {
      const auto copy = vtkSmartPointer<vtkLight>::Take(light->ShallowClone());
      copy->SetIntensity(options.LightIntensity * light->GetIntensity());
      renderer->AddLight(copy);
    }
  }
  else if (options.Lights.empty() && !AddLookLights(renderer, options))
  {
    vtkNew<vtkLight> headlight;
    headlight->SetLightTypeToHeadlight();
    headlight->SetIntensity(options.LightIntensity);
    renderer->AddLight(headlight);
  }
  for (const std::array<double, 4>& position : options.Lights)
  {
    vtkNew<vtkLight> light;
    light->SetLightTypeToSceneLight();
    const bool positional = position[3] > 0.0;
    // Directions may have any length: scale the largest component to 1.
    const double largest =
      std::max({ std::abs(position[0]), std::abs(position[1]), std::abs(position[2]) });
    const double scale = 1.0 / (positional ? position[3] : largest);
    light->SetPosition(position[0] * scale, position[1] * scale, position[2] * scale);
    light->SetFocalPoint(0.0, 0.0, 0.0);
    light->SetPositional(positional);
    light->SetConeAngle(180.0);
    light->SetIntensity(options.LightIntensity);
    renderer->AddLight(light);
  }
}

/// Returns the options with the camera of --camera-index in place of those that are not given.
RenderOptions UseFileCamera(const Surfaces& surfaces, RenderOptions options)
{
  CameraOptions& camera = options.Camera;
  if (camera.Index < 0)
  {
    return options;
  }
  const int count = static_cast<int>(surfaces.Cameras.size());
  if (camera.Index >= count)
  {
    throw CommandError(BadInput,
      "--camera-index " + std::to_string(camera.Index) + ": the files have " +
        (count == 0 ? "no cameras; leave the option out"
                    : "the cameras 0 to " + std::to_string(count - 1)));
  }
  vtkCamera* found = surfaces.Cameras[camera.Index];
  const auto vector = [](const double* values) {
    return Vector3{ values[0], values[1], values[2] };
  };
  camera.Position = camera.Position.value_or(vector(found->GetPosition()));
  camera.FocalPoint = camera.FocalPoint.value_or(vector(found->GetFocalPoint()));
  camera.ViewUp = camera.ViewUp.value_or(vector(found->GetViewUp()));
  camera.ViewAngle = camera.HasViewAngle ? camera.ViewAngle : found->GetViewAngle();
  camera.Orthographic = camera.Orthographic || found->GetParallelProjection();
  if (std::isnan(camera.ParallelScale))
  {
    camera.ParallelScale = found->GetParallelScale();
  }
  return options;
}

/// Returns true if text must be dark: on a light background, and on the paper of a figure.
bool NeedsDarkText(const RenderOptions& options, const Vector3& background)
{
  if (!options.Background)
  {
    return IsVectorGraphic(options.Output);
  }
  // Luma of [ITU-R BT.601].
  return 0.299 * background[0] + 0.587 * background[1] + 0.114 * background[2] > 0.5;
}

}

vtkSmartPointer<vtkRenderer> BuildScene(
  const Surfaces& surfaces, const RenderOptions& options, double unitsPerPoint)
{
  auto renderer = vtkSmartPointer<vtkRenderer>::New();
  std::vector<vtkPolyDataMapper*> mappers;
  for (std::size_t i = 0; i < surfaces.Meshes.size(); ++i)
  {
    const vtkSmartPointer<vtkPolyData>& mesh = surfaces.Meshes[i];
    vtkActor* material = surfaces.Actors[i];
    vtkSmartPointer<vtkPolyData> drawn =
      std::isnan(options.FeatureAngle) ? mesh : ComputeNormals(mesh, options.FeatureAngle);
    if (options.ShowEdges || options.Representation == "wireframe")
    {
      drawn = HideInnerEdges(drawn);
    }
    drawn = AddName(AddTangents(drawn, material), surfaces.Names[i]);
    const auto mapper = MakeMapper(drawn, material);
    mappers.push_back(mapper);
    renderer->AddActor(MakeActor(mapper, material, options, unitsPerPoint));
  }
  const Vector3 background = options.BackgroundColor.value_or(Vector3{ 0, 0, 0 });
  const bool darkText = NeedsDarkText(options, background);
  if (options.Coloring.Enabled && !mappers.empty())
  {
    const ColorScale scale = ColorByData(mappers, options.Coloring);
    if (options.Coloring.ScalarBar)
    {
      AddScalarBar(renderer, scale.Table, scale.Array, options, darkText);
    }
    RemoveMaterialsOfColored(renderer, options, unitsPerPoint);
  }
  AddLabels(renderer, surfaces.Files, options, darkText);
  renderer->SetBackground(background[0], background[1], background[2]);
  renderer->SetBackgroundAlpha(options.Background ? 1.0 : 0.0);
  PlaceCamera(renderer, UseLookCamera(renderer, UseFileCamera(surfaces, options)));
  AddLights(renderer, surfaces, options);
  return renderer;
}

}
