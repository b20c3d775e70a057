// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Ends work early, with the best result so far.
#ifndef penumbra_WorkLimit_h
#define penumbra_WorkLimit_h

#include <atomic>
#include <functional>
#include <utility>

namespace penumbra
{

/// A limit of work, such as a time, that consists of parts, such as regions of an image. Once it is
/// reached, it stays reached until the next part begins. IsReached() may be called from any thread.
class WorkLimit
{
public:
  /// `test` returns true if the fraction that it receives of the limit is used up. It is called from
  /// several threads.
  explicit WorkLimit(std::function<bool(double)> test)
    : Test(std::move(test))
  {
  }

  /// Begins a part that may use the limit up to `fraction`, in (0, 1].
  void BeginPart(double fraction)
  {
    this->Fraction = fraction;
    this->Reached = false;
  }

  bool IsReached()
  {
    if (!this->Reached && this->Test(this->Fraction))
    {
      this->Reached = true;
      this->EndedWork = true;
    }
    return this->Reached;
  }

  /// Returns true if the limit of a part was reached.
  bool HasEndedWork() const { return this->EndedWork; }

private:
  std::function<bool(double)> Test;
  double Fraction = 1.0;
  std::atomic<bool> Reached{ false };
  std::atomic<bool> EndedWork{ false };
};

/// Returns true if there is a limit and it is reached.
inline bool IsReached(WorkLimit* limit)
{
  return limit && limit->IsReached();
}

}
#endif
