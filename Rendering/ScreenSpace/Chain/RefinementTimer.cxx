// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "RefinementTimer.h"

#include "StaticViewRefiner.h"

#include "vtkCallbackCommand.h"
#include "vtkNew.h"
#include "vtkRenderWindowInteractor.h"

#include <algorithm>
#include <map>
#include <mutex>

namespace penumbra
{

namespace
{

/// Time between two ticks, in milliseconds. The frames themselves usually take longer.
constexpr unsigned long TickDuration = 10;

/// The timers of all interactors. Windows of several threads may create them.
struct Registry
{
  std::mutex Mutex;
  std::map<vtkRenderWindowInteractor*, std::weak_ptr<RefinementTimer>> Timers;
};

Registry& GetRegistry()
{
  // Never deleted: windows may be deleted after static variables.
  static auto* const registry = new Registry;
  return *registry;
}

}

RefinementTimer::RefinementTimer(vtkRenderWindowInteractor* interactor)
  : Key(interactor),
    Interactor(interactor),
    TimerId(interactor->CreateRepeatingTimer(TickDuration))
{
  if (this->TimerId > 0)
  {
    vtkNew<vtkCallbackCommand> observer;
    observer->SetClientData(this);
    observer->SetCallback(&RefinementTimer::OnTimer);
    this->ObserverTag = interactor->AddObserver(vtkCommand::TimerEvent, observer);
  }
}

RefinementTimer::~RefinementTimer()
{
  {
    Registry& registry = GetRegistry();
    const std::lock_guard<std::mutex> lock(registry.Mutex);
    const auto entry = registry.Timers.find(this->Key);
    // A new interactor may have the address of a deleted one.
    if (entry != registry.Timers.end() && entry->second.expired())
    {
      registry.Timers.erase(entry);
    }
  }
  if (this->TimerId > 0 && this->Interactor)
  {
    this->Interactor->RemoveObserver(this->ObserverTag);
    this->Interactor->DestroyTimer(this->TimerId);
  }
}

std::shared_ptr<RefinementTimer> RefinementTimer::Find(vtkRenderWindowInteractor* interactor)
{
  Registry& registry = GetRegistry();
  {
    const std::lock_guard<std::mutex> lock(registry.Mutex);
    const auto entry = registry.Timers.find(interactor);
    const std::shared_ptr<RefinementTimer> timer =
      entry != registry.Timers.end() ? entry->second.lock() : nullptr;
    if (timer && timer->Interactor)
    {
      return timer;
    }
  }
  std::shared_ptr<RefinementTimer> timer(new RefinementTimer(interactor));
  if (timer->TimerId <= 0)
  {
    return nullptr;
  }
  const std::lock_guard<std::mutex> lock(registry.Mutex);
  registry.Timers[interactor] = timer;
  return timer;
}

void RefinementTimer::Remove(StaticViewRefiner* refiner)
{
  this->Refiners.erase(
    std::remove(this->Refiners.begin(), this->Refiners.end(), refiner), this->Refiners.end());
}

bool RefinementTimer::Has(StaticViewRefiner* refiner) const
{
  return std::find(this->Refiners.begin(), this->Refiners.end(), refiner) != this->Refiners.end();
}

void RefinementTimer::OnTimer(vtkObject*, unsigned long, void* self, void* timerId)
{
  // Keeps the timer if its last refiner stops.
  const std::shared_ptr<RefinementTimer> timer =
    static_cast<RefinementTimer*>(self)->shared_from_this();
  if (!timerId || *static_cast<int*>(timerId) != timer->TimerId)
  {
    return;
  }
  const std::vector<StaticViewRefiner*> refiners = timer->Refiners;
  for (StaticViewRefiner* refiner : refiners)
  {
    // Frames of others may have stopped it.
    if (timer->Has(refiner))
    {
      refiner->Tick(1.0 / static_cast<double>(refiners.size()));
    }
  }
}

}
