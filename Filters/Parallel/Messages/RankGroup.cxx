// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "RankGroup.h"

#include "ByteStream.h"

#include "vtkBoundingBox.h"
#include "vtkMultiProcessController.h"
#include "vtkType.h"

#include <algorithm>
#include <utility>

namespace penumbra
{
namespace
{

constexpr int Tag = 7301;
/// Maximum size of a part of a message: MPI counts in 32 bits.
constexpr std::size_t MaximumPart = std::size_t{ 1 } << 30;

}

RankGroup::RankGroup(vtkMultiProcessController* controller)
  : Controller(controller),
    Rank(controller->GetLocalProcessId()),
    Count(controller->GetNumberOfProcesses())
{
}

void RankGroup::Begin(Steps step, const std::string& failure)
{
  const auto own = static_cast<vtkIdType>(step);
  std::vector<vtkIdType> steps(static_cast<std::size_t>(this->Count));
  this->Controller->AllGather(&own, steps.data(), 1);
  const auto failed = static_cast<vtkIdType>(Steps::Fail);
  if (std::find(steps.begin(), steps.end(), failed) != steps.end())
  {
    const std::vector<std::string> failures = this->GatherAll(failure);
    const auto first = std::find(steps.begin(), steps.end(), failed) - steps.begin();
    throw RankFailure("Rank " + std::to_string(first) + ": " + failures[first]);
  }
  if (std::any_of(steps.begin(), steps.end(), [&](vtkIdType other) { return other != own; }))
  {
    throw RankFailure("The ranks do not do the same: their renderers or inputs differ.");
  }
}

std::vector<std::string> RankGroup::GatherAll(const std::string& message)
{
  const auto own = static_cast<vtkIdType>(message.size());
  std::vector<vtkIdType> sizes(static_cast<std::size_t>(this->Count));
  this->Controller->AllGather(&own, sizes.data(), 1);
  std::vector<vtkIdType> offsets(sizes.size(), 0);
  for (std::size_t i = 1; i < sizes.size(); ++i)
  {
    offsets[i] = offsets[i - 1] + sizes[i - 1];
  }
  std::string all(static_cast<std::size_t>(offsets.back() + sizes.back()), '\0');
  this->Controller->AllGatherV(message.data(), all.data(), own, sizes.data(), offsets.data());
  std::vector<std::string> messages;
  for (std::size_t i = 0; i < sizes.size(); ++i)
  {
    messages.push_back(
      all.substr(static_cast<std::size_t>(offsets[i]), static_cast<std::size_t>(sizes[i])));
  }
  this->ReceivedBytes += static_cast<long long>(all.size() - message.size());
  return messages;
}

std::vector<std::string> RankGroup::AllGather(const std::string& message)
{
  this->Begin(Steps::AllGather, {});
  return this->GatherAll(message);
}

// In each round, every rank has one partner. The lower one of both sends first. One message is made at a time. If that
// fails, the partners, which wait for messages, receive empty ones; they learn of the failure in the next step.
std::vector<std::string> RankGroup::Exchange(const std::function<std::string(int)>& make)
{
  this->Begin(Steps::Exchange, {});
  std::vector<std::string> received(static_cast<std::size_t>(this->Count));
  std::exception_ptr failure;
  const auto tryToMake = [&](int rank) {
    try
    {
      return failure ? std::string() : make(rank);
    }
    catch (...)
    {
      failure = std::current_exception();
      return std::string();
    }
  };
  for (int round = 0; round < this->Count; ++round)
  {
    const int partner = (round - this->Rank + this->Count) % this->Count;
    if (partner == this->Rank)
    {
      received[partner] = tryToMake(partner);
      continue;
    }
    if (this->Rank < partner)
    {
      this->Send(tryToMake(partner), partner);
    }
    received[partner] = this->Receive(partner);
    if (this->Rank > partner)
    {
      this->Send(tryToMake(partner), partner);
    }
  }
  if (failure)
  {
    std::rethrow_exception(failure);
  }
  return received;
}

void RankGroup::Compare(const SettingList& settings)
{
  ByteWriter own;
  for (const auto& [name, value] : settings)
  {
    own.Add(name);
    own.Add(value);
  }
  const std::vector<std::string> messages = this->AllGather(own.Take());
  for (std::size_t rank = 1; rank < messages.size(); ++rank)
  {
    ByteReader first(messages[0]);
    ByteReader other(messages[rank]);
    while (!first.IsAtEnd() && !other.IsAtEnd())
    {
      const std::string name = first.Get<std::string>();
      const std::string value = first.Get<std::string>();
      if (other.Get<std::string>() != name || other.Get<std::string>() != value)
      {
        throw RankFailure("The ranks 0 and " + std::to_string(rank) + " disagree about " + name +
          ". Give all ranks the same settings.");
      }
    }
  }
}

void RankGroup::Sum(std::vector<double>& values)
{
  ByteWriter own;
  own.Add(values);
  std::fill(values.begin(), values.end(), 0.0);
  for (const std::string& message : this->AllGather(own.Take()))
  {
    ByteReader reader(message);
    const auto other = reader.Get<std::vector<double>>();
    std::transform(other.begin(), other.end(), values.begin(), values.begin(), std::plus<double>());
  }
}

void RankGroup::UniteBounds(double bounds[6])
{
  ByteWriter own;
  own.Add(std::vector<double>(bounds, bounds + 6));
  vtkBoundingBox box;
  for (const std::string& message : this->AllGather(own.Take()))
  {
    const auto other = ByteReader(message).Get<std::vector<double>>();
    if (vtkBoundingBox::IsValid(other.data()))
    {
      box.AddBounds(other.data());
    }
  }
  if (box.IsValid())
  {
    box.GetBounds(bounds);
  }
}

void RankGroup::UniteSentences(std::vector<std::string>& sentences)
{
  ByteWriter own;
  for (const std::string& sentence : sentences)
  {
    own.Add(sentence);
  }
  sentences.clear();
  for (const std::string& message : this->AllGather(own.Take()))
  {
    ByteReader reader(message);
    while (this->IsFirst() && !reader.IsAtEnd())
    {
      std::string sentence = reader.Get<std::string>();
      if (std::find(sentences.begin(), sentences.end(), sentence) == sentences.end())
      {
        sentences.push_back(std::move(sentence));
      }
    }
  }
}

std::string RankGroup::Fail(const std::string& message)
{
  try
  {
    this->Begin(Steps::Fail, message);
  }
  catch (const RankFailure& failure)
  {
    return failure.what();
  }
  return message;
}

void RankGroup::Send(const std::string& message, int rank)
{
  const auto size = static_cast<vtkIdType>(message.size());
  this->Controller->Send(&size, 1, rank, Tag);
  for (std::size_t at = 0; at < message.size(); at += MaximumPart)
  {
    const std::size_t part = std::min(MaximumPart, message.size() - at);
    this->Controller->Send(message.data() + at, static_cast<vtkIdType>(part), rank, Tag);
  }
}

std::string RankGroup::Receive(int rank)
{
  vtkIdType size = 0;
  this->Controller->Receive(&size, 1, rank, Tag);
  std::string message(static_cast<std::size_t>(size), '\0');
  for (std::size_t at = 0; at < message.size(); at += MaximumPart)
  {
    const std::size_t part = std::min(MaximumPart, message.size() - at);
    this->Controller->Receive(&message[at], static_cast<vtkIdType>(part), rank, Tag);
  }
  this->ReceivedBytes += static_cast<long long>(message.size());
  return message;
}

}
