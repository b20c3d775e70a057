// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Slots between the passes of a renderer, where Penumbra's passes are inserted: as close to the
// opaque geometry as possible, light shafts around ambient occlusion, independent of the order of
// insertion.
#ifndef penumbra_PassSlots_h
#define penumbra_PassSlots_h

#include "vtkNew.h"
#include "vtkPenumbraRenderingScreenSpaceModule.h" // for export macro
#include "vtkSetGet.h"

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
  vtkRenderPass* Pass = nullptr;           ///< current pass of the slot; null if there is none
  std::function<void(vtkRenderPass*)> Set; ///< replaces the pass of the slot
  bool OpaqueOnly = false;                 ///< the pass of the slot renders opaque props only
};

/// Finds the slots from the pass of the renderer inwards: through image processing, supersampling
/// and render steps, to the pass that draws. If the renderer has no pass, the only slot is empty.
/// Returns no slots if `renderer` is null.
VTKPENUMBRARENDERINGSCREENSPACE_EXPORT std::vector<PassSlot> FindPassSlots(vtkRenderer* renderer);

/// The same from a pass inwards.
std::vector<PassSlot> FindInnerSlots(const PassSlot& slot);

/// Finds the first slot whose pass satisfies `predicate`; null if there is none.
VTKPENUMBRARENDERINGSCREENSPACE_EXPORT const PassSlot* FindPass(
  const std::vector<PassSlot>& slots, const std::function<bool(vtkRenderPass*)>& predicate);

/// Finds the first pass of a class; null if there is none.
template <typename Pass>
Pass* FindPassOf(const std::vector<PassSlot>& slots)
{
  const PassSlot* slot =
    FindPass(slots, [](vtkRenderPass* pass) { return Pass::SafeDownCast(pass) != nullptr; });
  return slot ? Pass::SafeDownCast(slot->Pass) : nullptr;
}

/// Gives a renderer without a pass the render steps that it would run itself. Returns the slots.
VTKPENUMBRARENDERINGSCREENSPACE_EXPORT std::vector<PassSlot> EnsurePassSlots(vtkRenderer* renderer);

/// Removes `pass`. If it was the last pass of Penumbra, the render steps made by EnsurePassSlots()
/// are removed, too.
VTKPENUMBRARENDERINGSCREENSPACE_EXPORT void RemovePass(
  vtkRenderer* renderer, vtkImageProcessingPass* pass);

/// Returns the first pass of a class in `renderer`. If there is none, inserts a new one in the slot that
/// choose(slots) returns. Returns null, with a warning, if `renderer` is null.
template <typename Pass, typename Choose>
Pass* AddPass(vtkRenderer* renderer, const Choose& choose)
{
  if (!renderer)
  {
    vtkGenericWarningMacro("The renderer is null; pass a vtkRenderer to AddTo().");
    return nullptr;
  }
  if (Pass* present = FindPassOf<Pass>(FindPassSlots(renderer)))
  {
    return present;
  }
  const PassSlot slot = choose(EnsurePassSlots(renderer));
  vtkNew<Pass> pass;
  pass->SetDelegatePass(slot.Pass);
  pass->SetOpaqueOnly(slot.OpaqueOnly);
  slot.Set(pass);
  return pass;
}

/// Prepares `pass` to render in `window`, whose context is current. If `last` is another window,
/// releases the resources of `pass` in the context of `last`. Sets `last` to `window`.
VTKPENUMBRARENDERINGSCREENSPACE_EXPORT void MoveToWindow(
  vtkRenderPass* pass, vtkOpenGLRenderWindow*& last, vtkOpenGLRenderWindow* window);

}
#endif
