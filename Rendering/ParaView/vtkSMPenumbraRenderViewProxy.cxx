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
  static const bool draws =
    Capabilities::Supports(Capabilities::GetLocalCapabilities(), Capabilities::RENDERING);
  if (!draws && !this->Warned)
  {
    vtkErrorMacro("There is no display to draw by: start an X server, such as "
                  "xvfb-run -s \"-screen 0 1280x1024x24\" pvpython ...; filters need none.");
    this->Warned = true;
  }
  return draws && this->Superclass::IsContextReadyForRendering();
}

vtkImageData* vtkSMPenumbraRenderViewProxy::CaptureWindowInternal(
  int magnificationX, int magnificationY)
{
  if (!this->IsContextReadyForRendering())
  {
    return nullptr;
  }
  int shown[2] = { 0, 0 };
  vtkSMPropertyHelper(this, "ViewSize").Get(shown, 2);
  const int large[2] = { shown[0] * magnificationX, shown[1] * magnificationY };
  if ((magnificationX <= 1 && magnificationY <= 1) || std::max(large[0], large[1]) > LargestSide)
  {
    return this->Superclass::CaptureWindowInternal(magnificationX, magnificationY);
  }
  // Text is as large in a larger picture as it is in tiles: it follows the resolution.
  const int resolution = vtkSMPropertyHelper(this, "PPI").GetAsInt();
  vtkSMPropertyHelper(this, "PPI").Set(resolution * std::max(magnificationX, magnificationY));
  vtkSMPropertyHelper(this, "ViewSize").Set(large, 2);
  this->UpdateVTKObjects();
  vtkImageData* picture = this->Superclass::CaptureWindowInternal(1, 1);
  vtkSMPropertyHelper(this, "PPI").Set(resolution);
  vtkSMPropertyHelper(this, "ViewSize").Set(shown, 2);
  this->UpdateVTKObjects();
  vtkRenderWindow* window = this->GetRenderWindow();
  if (window && window->GetShowWindow())
  {
    this->StillRender(); // Nothing is left of what was shown.
  }
  return picture;
}

void vtkSMPenumbraRenderViewProxy::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
}
