// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Surfaces and appearance of 3DS and VRML files, which VTK's importers read.
#include "Appearance.h"

#include "CollectionItems.h"
#include "Files/MappedFile.h"
#include "Processes/CommandError.h"
#include "Processes/MessageLog.h"
#include "SizeOnlyWindow.h"

#include "vtk3DS.h"
#include "vtk3DSImporter.h"
#include "vtkActor.h"
#include "vtkActorCollection.h"
#include "vtkCamera.h"
#include "vtkDataArray.h"
#include "vtkLight.h"
#include "vtkLightCollection.h"
#include "vtkMapper.h"
#include "vtkMatrix4x4.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkRenderer.h"
#include "vtkReverseSense.h"
#include "vtkTransform.h"
#include "vtkTransformFilter.h"
#include "vtkVRMLImporter.h"

#include <string_view>

namespace penumbra
{

namespace
{

/// Removes point arrays of another length, such as normals of polygons, which VTK's VRML importer adds.
void RemoveOtherArrays(vtkPolyData* mesh)
{
  vtkPointData* const arrays = mesh->GetPointData();
  vtkDataArray* const colors = arrays->GetScalars();
  if (colors && colors->GetNumberOfTuples() == mesh->GetNumberOfPoints() + 1)
  {
    colors->SetNumberOfTuples(
      mesh->GetNumberOfPoints()); // That importer counts one color of vertices too many.
  }
  for (int i = arrays->GetNumberOfArrays() - 1; i >= 0; --i)
  {
    if (arrays->GetAbstractArray(i)->GetNumberOfTuples() != mesh->GetNumberOfPoints())
    {
      arrays->RemoveArray(i);
    }
  }
}

/// Returns the surface of an actor in world coordinates; null: it has none.
vtkSmartPointer<vtkPolyData> ExtractSurface(vtkActor* actor)
{
  vtkMapper* mapper = actor->GetMapper();
  if (!mapper)
  {
    return nullptr;
  }
  mapper->Update();
  auto* mesh = vtkPolyData::SafeDownCast(mapper->GetInput());
  if (mesh)
  {
    RemoveOtherArrays(mesh);
  }
  vtkMatrix4x4* matrix = actor->GetMatrix();
  if (!mesh || mesh->GetNumberOfPoints() == 0 || matrix->IsIdentity())
  {
    return mesh;
  }
  vtkNew<vtkTransform> transform;
  transform->SetMatrix(matrix);
  vtkNew<vtkTransformFilter> filter;
  filter->SetTransform(transform);
  filter->SetInputData(mesh);
  filter->Update();
  if (matrix->Determinant() >= 0.0)
  {
    return vtkPolyData::SafeDownCast(filter->GetOutput());
  }
  vtkNew<vtkReverseSense> reverse;
  reverse->SetInputConnection(filter->GetOutputPort());
  reverse->Update();
  return reverse->GetOutput();
}

/// Runs `importer` and returns its surfaces. Throws CommandError if it fails.
vtkSmartPointer<vtkDataObject> Import(
  const std::string& path, const std::string& format, vtkImporter* importer, Appearance& appearance)
{
  TakeErrors();
  vtkRenderer* renderer = RunImporter(importer);
  vtkNew<vtkMultiBlockDataSet> blocks;
  for (vtkActor* actor : GetItems<vtkActor>(renderer->GetActors()))
  {
    const vtkSmartPointer<vtkPolyData> mesh = ExtractSurface(actor);
    if (mesh && mesh->GetNumberOfPoints() > 0)
    {
      blocks->SetBlock(blocks->GetNumberOfBlocks(), mesh);
      appearance.Actors.push_back(actor);
    }
  }
  const std::vector<std::string> errors = TakeErrors();
  RequireMemory(errors);
  if (!errors.empty())
  {
    throw CommandError(
      BadInput, path + ": the file is damaged or not " + format + ": " + errors.front());
  }
  appearance.Lights = GetItems<vtkLight, vtkSmartPointer<vtkLight>>(renderer->GetLights());
  return blocks;
}

}

vtkRenderer* RunImporter(vtkImporter* importer)
{
  vtkNew<SizeOnlyWindow> window;
  vtkNew<SizeOnlyRenderer> renderer;
  window->AddRenderer(renderer);
  importer->SetRenderWindow(window);
  importer->Update();
  return importer->GetRenderer();
}

vtkSmartPointer<vtkDataObject> Import3ds(
  const std::string& path, vtkDataObject*, Appearance& appearance)
{
  vtkNew<vtk3DSImporter> importer;
  importer->SetFileName(path.c_str());
  const vtkSmartPointer<vtkDataObject> data = Import(path, "3D Studio", importer, appearance);
  for (vtk3DSCamera* camera = importer->CameraList; camera;
       camera = reinterpret_cast<vtk3DSCamera*>(camera->next))
  {
    if (camera->aCamera)
    {
      appearance.Cameras.insert(
        appearance.Cameras.begin(), camera->aCamera); // The list is reversed.
    }
  }
  return data;
}

vtkSmartPointer<vtkDataObject> ImportVrml(
  const std::string& path, vtkDataObject*, Appearance& appearance)
{
  vtkNew<vtkVRMLImporter> importer;
  importer->SetFileName(path.c_str());
  const vtkSmartPointer<vtkDataObject> data = Import(path, "VRML 2", importer, appearance);
  for (const vtkSmartPointer<vtkActor>& actor : appearance.Actors)
  {
    actor->GetMapper()->UseLookupTableScalarRangeOn(); // Its table has the colors of the vertices.
  }
  const MappedFile file(path);
  const std::string_view text(file.Begin(), file.Size());
  if (text.find("colorIndex") != text.npos || text.find("colorPerVertex FALSE") != text.npos)
  {
    appearance.Warnings.push_back(
      "colors of polygons, and of vertices by colorIndex, are not read");
  }
  return data;
}

vtkSmartPointer<vtkDataObject> Read3ds(const std::string& path)
{
  Appearance ignored;
  return Import3ds(path, nullptr, ignored);
}

vtkSmartPointer<vtkDataObject> ReadVrml(const std::string& path)
{
  Appearance ignored;
  return ImportVrml(path, nullptr, ignored);
}

}
