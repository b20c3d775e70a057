// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Calls back when a window releases its OpenGL resources. VTK 9.1 and 9.2 do not install the header
// of their callback class, but every texture object registers one, so this is a texture object
// without a texture.
#ifndef penumbra_WindowReleaseNotifier_h
#define penumbra_WindowReleaseNotifier_h

#include "vtkTextureObject.h"

#include <functional>

namespace penumbra
{

class WindowReleaseNotifier : public vtkTextureObject
{
public:
  static WindowReleaseNotifier* New();
  vtkTypeMacro(WindowReleaseNotifier, vtkTextureObject);

  /// Calls `released` once, when `window` releases its resources.
  void Watch(vtkOpenGLRenderWindow* window, std::function<void(vtkWindow*)> released);

  /// Stops watching without a call.
  void Stop(vtkWindow* window);

  void ReleaseGraphicsResources(vtkWindow* window) override;

protected:
  WindowReleaseNotifier() = default;
  ~WindowReleaseNotifier() override = default;

private:
  std::function<void(vtkWindow*)> Released;
};

}
#endif
