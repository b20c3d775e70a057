// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "StaticViewRefiner.h"

#include "vtkCallbackCommand.h"
#include "vtkNew.h"
#include "vtkRenderWindow.h"
#include "vtkRenderWindowInteractor.h"
#include "vtkRenderer.h"
#include "vtkRendererCollection.h"

namespace penumbra
{

namespace
{

/// Time between two ticks, in milliseconds. The frames themselves usually take longer.
constexpr unsigned long TickDuration = 10;

/// Number of ticks without a frame of the application before refinement starts. Counted in ticks, so
/// that an animation whose frames are slow is not slowed down further.
constexpr int QuietTicks = 5;

/// Update rate above which frames are interactive, per second. VTK's interactor styles and ParaView
/// set 5 to 15 during interaction and at most 0.002 afterwards.
constexpr double InteractiveUpdateRate = 1.0;

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
  if (!unfinished || !interactor || IsInteractive(window) || (this->Rendering && changed))
  {
    this->Unfinished.erase(renderer);
    return;
  }
  this->Unfinished.insert(renderer);
  if (!this->Rendering)
  {
    this->TicksToWait = QuietTicks;
    this->Start(interactor);
  }
}

void StaticViewRefiner::Start(vtkRenderWindowInteractor* interactor)
{
  if (this->TimerId > 0 || !interactor->GetInitialized() || !interactor->GetEnabled())
  {
    return;
  }
  this->Interactor = interactor;
  this->TimerId = interactor->CreateRepeatingTimer(TickDuration);
  if (this->TimerId > 0)
  {
    vtkNew<vtkCallbackCommand> observer;
    observer->SetClientData(this);
    observer->SetCallback(&StaticViewRefiner::OnTimer);
    this->ObserverTag = interactor->AddObserver(vtkCommand::TimerEvent, observer);
  }
}

void StaticViewRefiner::OnTimer(vtkObject*, unsigned long, void* self, void* timerId)
{
  auto* refiner = static_cast<StaticViewRefiner*>(self);
  if (timerId && *static_cast<int*>(timerId) == refiner->TimerId)
  {
    refiner->Tick();
  }
}

void StaticViewRefiner::Tick()
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
  else if (!this->Rendering && !window->CheckInRenderStatus() && this->HasNewImage())
  {
    this->Unfinished.clear(); // Renderers that were removed render no more frames.
    this->Rendering = true;
    interactor->Render();
    this->Rendering = false;
    if (this->Unfinished.empty())
    {
      this->Stop();
    }
  }
}

/// Works on the images of all unfinished renderers of the window.
bool StaticViewRefiner::HasNewImage() const
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
      isNew = this->Advance(renderer) || isNew;
    }
  }
  return isNew || !isKnown;
}

void StaticViewRefiner::Stop()
{
  if (this->TimerId > 0 && this->Interactor)
  {
    this->Interactor->RemoveObserver(this->ObserverTag);
    this->Interactor->DestroyTimer(this->TimerId);
  }
  this->Interactor = nullptr;
  this->TimerId = 0;
  this->Unfinished.clear();
}

}
