// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "StaticViewRefiner.h"

#include "RefinementTimer.h"

#include "vtkCamera.h"
#include "vtkPropCollection.h"
#include "vtkRenderWindow.h"
#include "vtkRenderWindowInteractor.h"
#include "vtkRenderer.h"
#include "vtkRendererCollection.h"

#include <algorithm>

namespace penumbra
{

namespace
{

/// Number of ticks without a frame of the application before refinement starts. Counted in ticks, so
/// that an animation whose frames are slow is not slowed down further.
constexpr int QuietTicks = 5;

/// Update rate above which frames are interactive, per second. VTK's interactor styles and ParaView
/// set 5 to 15 during interaction and at most 0.002 afterwards.
constexpr double InteractiveUpdateRate = 1.0;

/// A frame that a refiner renders, of which those of other passes in the window need to know.
struct RequestedFrame
{
  vtkRenderWindow* Window;
  bool ChangedBefore; ///< the scene changed between the last frame and this one
};
thread_local const RequestedFrame* Requested = nullptr;

/// Returns whether a refiner is rendering the window.
bool IsRequested(vtkRenderWindow* window)
{
  return Requested && Requested->Window == window;
}

/// Sets Requested until the end of the scope.
class RequestScope
{
public:
  explicit RequestScope(const RequestedFrame& frame)
    : Outer(std::exchange(Requested, &frame))
  {
  }
  ~RequestScope() { Requested = this->Outer; }
  RequestScope(const RequestScope&) = delete;
  RequestScope& operator=(const RequestScope&) = delete;

private:
  const RequestedFrame* Outer;
};

/// Returns the time of the last change of a prop, a camera or a renderer of the window.
vtkMTimeType FindSceneTime(vtkRenderWindow* window)
{
  vtkMTimeType time = window->GetRenderers()->GetMTime();
  vtkCollectionSimpleIterator at;
  window->GetRenderers()->InitTraversal(at);
  while (vtkRenderer* renderer = window->GetRenderers()->GetNextRenderer(at))
  {
    vtkPropCollection* props = renderer->GetViewProps();
    time = std::max({ time, renderer->GetMTime(), props->GetMTime() });
    if (renderer->IsActiveCameraCreated())
    {
      time = std::max(time, renderer->GetActiveCamera()->GetMTime());
    }
    vtkCollectionSimpleIterator position;
    props->InitTraversal(position);
    while (vtkProp* prop = props->GetNextProp(position))
    {
      time = std::max(time, prop->GetVisibility() ? prop->GetRedrawMTime() : prop->GetMTime());
    }
  }
  return time;
}

}

bool IsInteractive(vtkRenderWindow* window)
{
  return window->GetDesiredUpdateRate() >= InteractiveUpdateRate;
}

StaticViewRefiner::~StaticViewRefiner()
{
  this->Stop();
}

void StaticViewRefiner::RecordFrame(vtkRenderer* renderer, bool unfinished, bool changed)
{
  vtkRenderWindow* window = renderer->GetRenderWindow();
  vtkRenderWindowInteractor* interactor = window->GetInteractor();
  if (this->Interactor != interactor || IsInteractive(window))
  {
    this->Stop();
  }
  const bool isRequested = IsRequested(window);
  const bool hasChanged = isRequested && changed;
  const bool changesAlways =
    hasChanged && (!Requested->ChangedBefore || this->Changed.count(renderer) > 0);
  this->Changed.erase(renderer);
  if (!unfinished || !interactor || IsInteractive(window) || changesAlways)
  {
    this->Unfinished.erase(renderer);
    return;
  }
  this->Unfinished.insert(renderer);
  if (hasChanged)
  {
    this->Changed.insert(renderer);
  }
  this->SceneTime = FindSceneTime(window);
  // One frame for all passes of the window.
  this->TicksToWait = isRequested ? std::max(this->TicksToWait, 1) : QuietTicks;
  this->Start(interactor);
}

void StaticViewRefiner::Start(vtkRenderWindowInteractor* interactor)
{
  if (this->Timer || !interactor->GetInitialized() || !interactor->GetEnabled())
  {
    return;
  }
  this->Interactor = interactor;
  this->Timer = RefinementTimer::Find(interactor);
  if (this->Timer)
  {
    this->Timer->Add(this);
  }
}

void StaticViewRefiner::Tick(double share)
{
  vtkRenderWindowInteractor* interactor = this->Interactor;
  vtkRenderWindow* window = interactor->GetRenderWindow();
  const bool canRender = window && interactor->GetEnabled() && interactor->GetEnableRender();
  if (!canRender || IsInteractive(window) || this->Unfinished.empty())
  {
    // The last frame of an interaction starts the timer again.
    this->Stop();
  }
  else if (this->TicksToWait > 0)
  {
    --this->TicksToWait;
  }
  else if (!IsRequested(window) && !window->CheckInRenderStatus() && this->HasNewImage(share))
  {
    this->RequestFrame(window);
  }
}

void StaticViewRefiner::RequestFrame(vtkRenderWindow* window)
{
  const RequestedFrame frame = { window, FindSceneTime(window) != this->SceneTime };
  const RequestScope scope(frame);
  const std::weak_ptr<bool> alive = this->Alive;
  this->Unfinished.clear(); // Renderers that were removed render no more frames.
  this->Interactor->Render();
  // Observers of the frame may have removed the pass.
  if (!alive.expired())
  {
    this->TicksToWait = 0;
    if (this->Unfinished.empty())
    {
      this->Stop();
    }
  }
}

/// Works on the images of all unfinished renderers of the window.
bool StaticViewRefiner::HasNewImage(double share) const
{
  vtkRendererCollection* renderers = this->Interactor->GetRenderWindow()->GetRenderers();
  bool isNew = !this->Advance;
  bool isKnown = false;
  for (vtkRenderer* renderer : this->Unfinished)
  {
    // Renderers that were removed render no more frames.
    if (this->Advance && renderers->IsItemPresent(renderer) != 0)
    {
      isKnown = true;
      isNew =
        this->Advance(renderer, share / static_cast<double>(this->Unfinished.size())) || isNew;
    }
  }
  return isNew || !isKnown;
}

void StaticViewRefiner::Stop()
{
  this->Interactor = nullptr;
  this->Unfinished.clear();
  this->Changed.clear();
  if (const std::shared_ptr<RefinementTimer> timer = std::exchange(this->Timer, nullptr))
  {
    timer->Remove(this);
  }
}

}
