// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ImporterScene.h"

#include "SizeOnlyWindow.h"

#include "vtkImporter.h"
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

}
