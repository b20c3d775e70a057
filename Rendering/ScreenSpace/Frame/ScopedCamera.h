// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Another view of a renderer's scene than its camera's, and what may be seen in it.
#ifndef penumbra_ScopedCamera_h
#define penumbra_ScopedCamera_h

#include "ScreenTransform.h"

#include "vtkSmartPointer.h"

#include <vector>

class vtkCamera;
class vtkProp;
class vtkRenderer;

namespace penumbra
{

/// While it lives the renderer looks through a copy of its camera with another projection. The
/// renderer's own camera is never touched, and the lights that follow it see no difference.
class ScopedCamera
{
public:
  ScopedCamera(vtkRenderer* renderer, const ScreenTransform& view);
  ~ScopedCamera();
  ScopedCamera(const ScopedCamera&) = delete;
  void operator=(const ScopedCamera&) = delete;

private:
  vtkRenderer* Renderer;
  vtkSmartPointer<vtkCamera> Saved;
};

/// All that may be seen, what the renderer has culled included.
std::vector<vtkProp*> VisibleProps(vtkRenderer* renderer);

}
#endif
