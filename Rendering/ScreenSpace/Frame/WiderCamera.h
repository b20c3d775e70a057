// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Another view of a renderer's scene than its camera's, and what may be seen in it.
#ifndef penumbra_WiderCamera_h
#define penumbra_WiderCamera_h

#include "ScreenView.h"

#include "vtkSmartPointer.h"

#include <vector>

class vtkCamera;
class vtkProp;
class vtkRenderer;

namespace penumbra
{

/// While it lives the renderer looks through a copy of its camera with another projection. The
/// renderer's own camera is never touched, and the lights that follow it see no difference.
class WiderCamera
{
public:
  WiderCamera(vtkRenderer* renderer, const ScreenView& view);
  ~WiderCamera();
  WiderCamera(const WiderCamera&) = delete;
  void operator=(const WiderCamera&) = delete;

private:
  vtkRenderer* Renderer;
  vtkSmartPointer<vtkCamera> Saved;
};

/// All that may be seen, what the renderer has culled included.
std::vector<vtkProp*> VisibleProps(vtkRenderer* renderer);

}
#endif
