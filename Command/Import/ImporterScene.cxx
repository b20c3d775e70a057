// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ImporterScene.h"

#include "SizeOnlyWindow.h"

#include "vtkActor.h"
#include "vtkActorCollection.h"
#include "vtkImporter.h"
#include "vtkLight.h"
#include "vtkLightCollection.h"
#include "vtkNew.h"

namespace penumbra
{

vtkRenderer* RunImporter(vtkImporter* importer)
{
  vtkNew<SizeOnlyWindow> window;
  vtkNew<SizeOnlyRenderer> renderer;
  window->AddRenderer(renderer);
  importer->SetRenderWindow(window);
  importer->Update();
  return importer->GetRenderer();
}

std::vector<vtkSmartPointer<vtkActor>> GetActors(vtkRenderer* renderer)
{
  std::vector<vtkSmartPointer<vtkActor>> actors;
  // VTK 9.2 fills the collection again in each call.
  vtkActorCollection* const collection = renderer->GetActors();
  vtkCollectionSimpleIterator cookie;
  collection->InitTraversal(cookie);
  while (vtkActor* actor = collection->GetNextActor(cookie))
  {
    actors.emplace_back(actor);
  }
  return actors;
}

std::vector<vtkSmartPointer<vtkLight>> GetLights(vtkRenderer* renderer)
{
  std::vector<vtkSmartPointer<vtkLight>> lights;
  vtkCollectionSimpleIterator cookie;
  renderer->GetLights()->InitTraversal(cookie);
  while (vtkLight* light = renderer->GetLights()->GetNextLight(cookie))
  {
    lights.emplace_back(light);
  }
  return lights;
}

}
