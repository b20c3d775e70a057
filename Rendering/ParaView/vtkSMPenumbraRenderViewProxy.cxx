// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSMPenumbraRenderViewProxy.h"

#include "vtkObjectFactory.h"
#include "vtkPVRenderingCapabilitiesInformation.h"
#include "vtkRenderWindow.h"
#include "vtkSMPropertyHelper.h"

#include <algorithm>

vtkStandardNewMacro(vtkSMPenumbraRenderViewProxy);

bool vtkSMPenumbraRenderViewProxy::IsContextReadyForRendering()
{
  using Capabilities = vtkPVRenderingCapabilitiesInformation;
  static const bool canRender =
    Capabilities::Supports(Capabilities::GetLocalCapabilities(), Capabilities::RENDERING);
  if (!canRender && !this->Warned)
  {
    vtkErrorMacro("The render view needs an X display, and none is available: start an X server, "
                  "for example with "
                  "xvfb-run -a -s \"-screen 0 1280x1024x24 -noreset\" pvpython script.py. Filters "
                  "do not need one.");
    this->Warned = true;
  }
  return canRender && this->Superclass::IsContextReadyForRendering();
}

vtkImageData* vtkSMPenumbraRenderViewProxy::CaptureWindowInternal(
  int magnificationX, int magnificationY)
{
  if (!this->IsContextReadyForRendering())
  {
    return nullptr;
  }
  int viewSize[2] = { 0, 0 };
  vtkSMPropertyHelper(this, "ViewSize").Get(viewSize, 2);
  const int imageSize[2] = { viewSize[0] * magnificationX, viewSize[1] * magnificationY };
  if ((magnificationX <= 1 && magnificationY <= 1) ||
    std::max(imageSize[0], imageSize[1]) > LargestSide)
  {
    return this->Superclass::CaptureWindowInternal(magnificationX, magnificationY);
  }
  // Scale the PPI as well, so that text has the same size relative to the image as with tiles.
  const int resolution = vtkSMPropertyHelper(this, "PPI").GetAsInt();
  vtkSMPropertyHelper(this, "PPI").Set(resolution * std::max(magnificationX, magnificationY));
  vtkSMPropertyHelper(this, "ViewSize").Set(imageSize, 2);
  this->UpdateVTKObjects();
  vtkImageData* image = this->Superclass::CaptureWindowInternal(1, 1);
  vtkSMPropertyHelper(this, "PPI").Set(resolution);
  vtkSMPropertyHelper(this, "ViewSize").Set(viewSize, 2);
  this->UpdateVTKObjects();
  vtkRenderWindow* window = this->GetRenderWindow();
  if (window && window->GetShowWindow())
  {
    this->StillRender(); // Restore the content of the visible window.
  }
  return image;
}

void vtkSMPenumbraRenderViewProxy::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
}
