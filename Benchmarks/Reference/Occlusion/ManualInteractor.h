// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Interactor whose timers are fired by its owner.
#ifndef penumbra_occlusion_ManualInteractor_h
#define penumbra_occlusion_ManualInteractor_h

#include "vtkCommand.h"
#include "vtkObjectFactory.h"
#include "vtkRenderWindowInteractor.h"

#include <set>

namespace penumbra
{

class ManualInteractor : public vtkRenderWindowInteractor
{
public:
  static ManualInteractor* New() { VTK_STANDARD_NEW_BODY(ManualInteractor); }
  vtkTypeMacro(ManualInteractor, vtkRenderWindowInteractor);

  void Initialize() override
  {
    this->Initialized = 1;
    this->Enabled = 1;
  }

  /// Fires every timer `count` times.
  void Tick(int count = 1)
  {
    for (int i = 0; i < count; ++i)
    {
      for (int timer : std::set<int>(this->Timers))
      {
        int id = this->GetVTKTimerId(timer);
        this->InvokeEvent(vtkCommand::TimerEvent, &id);
      }
    }
  }

  std::set<int> Timers;

protected:
  int InternalCreateTimer(int, int, unsigned long) override
  {
    this->Timers.insert(++this->LastTimer);
    return this->LastTimer;
  }
  int InternalDestroyTimer(int timer) override
  {
    return static_cast<int>(this->Timers.erase(timer));
  }

private:
  int LastTimer = 0;
};

}
#endif
