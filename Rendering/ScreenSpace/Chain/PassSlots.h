// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Where the passes of a renderer hang, and so where those of ours belong: as close to the opaque
// geometry as can be, light shafts around ambient occlusion, whichever came first.
#ifndef penumbra_PassSlots_h
#define penumbra_PassSlots_h

#include "vtkPenumbraRenderingScreenSpaceModule.h" // for export macro

#include <functional>
#include <vector>

class vtkImageProcessingPass;
class vtkOpenGLRenderWindow;
class vtkRenderPass;
class vtkRenderer;

namespace penumbra
{

struct PassSlot
{
  vtkRenderPass* Pass = nullptr;           ///< what hangs here
  std::function<void(vtkRenderPass*)> Set; ///< hangs another pass here
  bool OpaqueOnly = false;                 ///< what hangs here draws opaque props alone
};

/// From the renderer's own pass inwards, through image processing, supersampling and the stages of a
/// renderer, to what draws; that last one has no pass where the renderer has none. No renderer: no place.
VTKPENUMBRARENDERINGSCREENSPACE_EXPORT std::vector<PassSlot> FindPassSlots(vtkRenderer* renderer);

/// The first place whose pass `isWanted`; null if there is none.
VTKPENUMBRARENDERINGSCREENSPACE_EXPORT const PassSlot* FindPass(
  const std::vector<PassSlot>& places, const std::function<bool(vtkRenderPass*)>& isWanted);

/// The first pass of a class; null if there is none.
template <typename Pass>
Pass* FindPassOf(const std::vector<PassSlot>& places)
{
  const PassSlot* place =
    FindPass(places, [](vtkRenderPass* pass) { return Pass::SafeDownCast(pass) != nullptr; });
  return place ? Pass::SafeDownCast(place->Pass) : nullptr;
}

/// Stages like those of a renderer without a pass, if it has none; then the places.
VTKPENUMBRARENDERINGSCREENSPACE_EXPORT std::vector<PassSlot> EnsurePassSlots(vtkRenderer* renderer);

/// Takes `pass` out, and with the last pass of ours the stages that were made for it.
VTKPENUMBRARENDERINGSCREENSPACE_EXPORT void RemovePass(
  vtkRenderer* renderer, vtkImageProcessingPass* pass);

/// `pass` draws in `window` now, whose context is current: what it made in `last`, if that is another
/// one, is released in the context of that one. `last` becomes `window`.
VTKPENUMBRARENDERINGSCREENSPACE_EXPORT void MoveToWindow(
  vtkRenderPass* pass, vtkOpenGLRenderWindow*& last, vtkOpenGLRenderWindow* window);

}
#endif
