// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Communication between the ranks of a controller that cannot leave a rank waiting: each step begins with
// the ranks telling each other whether one of them has failed.
#ifndef penumbra_RankGroup_h
#define penumbra_RankGroup_h

#include "Execution/RankAgreement.h"

#include <functional>
#include <string>
#include <vector>

class vtkMultiProcessController;

namespace penumbra
{

/// All functions that are not const are collective: every rank calls them in the same order. They throw
/// RankFailure on every rank if one of them calls Fail() instead.
class RankGroup final : public RankAgreement
{
public:
  /// `controller` must outlive the group.
  explicit RankGroup(vtkMultiProcessController* controller);

  int GetRank() const { return this->Rank; }
  int GetCount() const { return this->Count; }
  bool IsFirst() const override { return this->Rank == 0; }

  void Compare(const SettingList& settings) override;
  void Sum(std::vector<double>& values) override;
  void UniteBounds(double bounds[6]) override;
  void UniteSentences(std::vector<std::string>& sentences) override;
  std::string Fail(const std::string& message) override;

  /// Returns the messages of all ranks, by rank.
  std::vector<std::string> AllGather(const std::string& message);

  /// Sends make(r) to rank r. Returns the messages for this rank, by sender.
  std::vector<std::string> Exchange(const std::function<std::string(int)>& make);

  /// Passes a message from rank to rank: each replaces it by what `change` makes of it. Returns that of the
  /// last rank.
  template <typename Change>
  std::string Chain(std::string message, const Change& change)
  {
    this->Begin(Steps::Chain, {});
    if (this->Rank > 0)
    {
      message = this->Receive(this->Rank - 1);
    }
    message = change(message);
    if (this->Rank + 1 < this->Count)
    {
      this->Send(message, this->Rank + 1);
    }
    return this->AllGather(message).back();
  }

  /// Returns the number of bytes that this rank has received from others.
  long long GetReceivedBytes() const { return this->ReceivedBytes; }

private:
  enum class Steps
  {
    AllGather,
    Exchange,
    Chain,
    Fail
  };

  void Begin(Steps step, const std::string& failure);
  std::vector<std::string> GatherAll(const std::string& message);
  void Send(const std::string& message, int rank);
  std::string Receive(int rank);

  vtkMultiProcessController* const Controller;
  const int Rank, Count;
  long long ReceivedBytes = 0;
};

}
#endif
