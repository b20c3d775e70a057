// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// A window and a renderer without a graphics context, for props that compute their layout from the
// size of the window.
#ifndef penumbra_SizeOnlyWindow_h
#define penumbra_SizeOnlyWindow_h

#include "vtkRenderWindow.h"
#include "vtkRenderer.h"

namespace penumbra
{

/// A window of a given size without a graphics context.
class SizeOnlyWindow : public vtkRenderWindow
{
public:
  vtkTypeMacro(SizeOnlyWindow, vtkRenderWindow);
  static SizeOnlyWindow* New()
  {
    auto* window = new SizeOnlyWindow;
    window->InitializeObjectBase();
    return window;
  }

  /// Makes the window report that it has rendered. VTK places labels only in such windows.
  void SetHasRendered() { this->NeverRendered = 0; }
};

/// A renderer for SizeOnlyWindow.
class SizeOnlyRenderer : public vtkRenderer
{
public:
  vtkTypeMacro(SizeOnlyRenderer, vtkRenderer);
  static SizeOnlyRenderer* New()
  {
    auto* renderer = new SizeOnlyRenderer;
    renderer->InitializeObjectBase();
    return renderer;
  }
};

}
#endif
