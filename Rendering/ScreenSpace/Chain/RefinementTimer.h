// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Repeating timer that the refiners of all passes of a window share, with the time of each tick. Some interactors,
// such as the Qt widget of VTK's Python package, have a single timer.
#ifndef penumbra_RefinementTimer_h
#define penumbra_RefinementTimer_h

#include "vtkWeakPointer.h"

#include <memory>
#include <vector>

class vtkObject;
class vtkRenderWindowInteractor;

namespace penumbra
{

class StaticViewRefiner;

class RefinementTimer : public std::enable_shared_from_this<RefinementTimer>
{
public:
  /// Returns the timer of an interactor, a new one if there is none. Null if the interactor creates no timer.
  static std::shared_ptr<RefinementTimer> Find(vtkRenderWindowInteractor* interactor);

  /// Destroys the timer of the interactor.
  ~RefinementTimer();
  RefinementTimer(const RefinementTimer&) = delete;
  RefinementTimer& operator=(const RefinementTimer&) = delete;

  void Add(StaticViewRefiner* refiner) { this->Refiners.push_back(refiner); }
  void Remove(StaticViewRefiner* refiner);

private:
  explicit RefinementTimer(vtkRenderWindowInteractor* interactor);
  static void OnTimer(vtkObject*, unsigned long, void* self, void* timerId);
  bool Has(StaticViewRefiner* refiner) const;

  vtkRenderWindowInteractor* Key; ///< also after it was deleted
  vtkWeakPointer<vtkRenderWindowInteractor> Interactor;
  std::vector<StaticViewRefiner*> Refiners;
  unsigned long ObserverTag = 0;
  int TimerId = 0;
};

}
#endif
