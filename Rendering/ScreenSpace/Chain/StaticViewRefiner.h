// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Renders further frames of a static view through the interactor of its window, at most one per tick of a repeating
// timer until the view has converged. The timer is then destroyed. Frames that the application renders take
// precedence: the refiner then waits.
#ifndef penumbra_StaticViewRefiner_h
#define penumbra_StaticViewRefiner_h

#include "vtkPenumbraRenderingScreenSpaceModule.h" // for export macro
#include "vtkType.h"
#include "vtkWeakPointer.h"

#include <functional>
#include <memory>
#include <set>
#include <utility>

class vtkRenderWindow;
class vtkRenderWindowInteractor;
class vtkRenderer;

namespace penumbra
{

class RefinementTimer;

/// Returns whether the application requests fast frames: the desired update rate of the window is
/// at least one frame per second, as interactor styles set it during interaction.
bool IsInteractive(vtkRenderWindow* window);

class VTKPENUMBRARENDERINGSCREENSPACE_EXPORT StaticViewRefiner
{
public:
  /// `advance` works on the next frame of a renderer before it is requested, for a share of the time of a tick, and
  /// returns true once the frame would show something new. Empty: every frame does.
  using AdvanceFunction = std::function<bool(vtkRenderer*, double share)>;
  explicit StaticViewRefiner(AdvanceFunction advance = nullptr)
    : Advance(std::move(advance))
  {
  }
  ~StaticViewRefiner();
  StaticViewRefiner(const StaticViewRefiner&) = delete;
  void operator=(const StaticViewRefiner&) = delete;

  /// Call this after every frame of a renderer. Requests further frames if `unfinished` is true, but not if
  /// the scene `changed` during a frame that a refiner requested, or before two of them in succession: it then
  /// changes in every frame.
  void RecordFrame(vtkRenderer* renderer, bool unfinished, bool changed);

  /// Requests no further frames.
  void Stop();

private:
  friend class RefinementTimer;
  void Start(vtkRenderWindowInteractor* interactor);
  void Tick(double share);
  void RequestFrame(vtkRenderWindow* window);
  bool HasNewImage(double share) const;

  AdvanceFunction Advance;
  vtkWeakPointer<vtkRenderWindowInteractor> Interactor;
  std::set<vtkRenderer*> Unfinished; ///< renderers whose last frame requested another one
  std::set<vtkRenderer*> Changed;    ///< renderers whose last frame was requested and changed
  vtkMTimeType SceneTime = 0;        ///< of the window after the last frame
  std::shared_ptr<RefinementTimer> Timer;
  int TicksToWait = 0;
  std::shared_ptr<bool> Alive = std::make_shared<bool>(true); ///< expires in the destructor
};

}
#endif
