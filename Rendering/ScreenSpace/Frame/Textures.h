// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Allocates and reads float textures, and releases objects of OpenGL.
#ifndef penumbra_Textures_h
#define penumbra_Textures_h

#include "vtkPenumbraRenderingScreenSpaceModule.h" // for export macro, which tests need
#include "vtkSmartPointer.h"
#include "vtkTextureObject.h"

#include <vector>

class vtkOpenGLRenderWindow;
class vtkWindow;

namespace penumbra
{

/// Ensures that `texture` is a float texture of this size, with nearest filtering. A new texture is
/// cleared to zero; an existing one of the right size is kept. Returns whether the texture is new.
VTKPENUMBRARENDERINGSCREENSPACE_EXPORT bool Allocate(vtkSmartPointer<vtkTextureObject>& texture,
  vtkOpenGLRenderWindow* window, int width, int height, int components);

/// Reads all values of a float texture, in row-major order.
VTKPENUMBRARENDERINGSCREENSPACE_EXPORT std::vector<float> ReadBack(vtkTextureObject* texture);

/// Releases the graphics resources of textures or framebuffers, and sets their pointers to null.
template <typename... Pointers>
void Release(vtkWindow* window, Pointers&... pointers)
{
  const auto release = [window](auto& pointer) {
    if (pointer)
    {
      pointer->ReleaseGraphicsResources(window);
      pointer = nullptr;
    }
  };
  (release(pointers), ...);
}

}
#endif
