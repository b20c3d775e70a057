// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Scoped override of the camera of a renderer, and the visible props of a renderer.
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

/// Replaces the camera of the renderer, for the lifetime of this object, by default by a copy with
/// another projection. The original camera is not modified, and lights that follow the camera do not
/// change.
class ScopedCamera
{
public:
  ScopedCamera(vtkRenderer* renderer, const ScreenTransform& view);

  /// Replaces the camera by one that is independent of it. `view`: a rigid transform from world
  /// coordinates; the camera looks along -z.
  ScopedCamera(vtkRenderer* renderer, const Matrix& view, const Matrix& projection);
  ~ScopedCamera();
  ScopedCamera(const ScopedCamera&) = delete;
  void operator=(const ScopedCamera&) = delete;

private:
  vtkRenderer* Renderer;
  vtkSmartPointer<vtkCamera> Saved;
};

/// Returns all visible props, including those that the renderer culled.
std::vector<vtkProp*> VisibleProps(vtkRenderer* renderer);

}
#endif
