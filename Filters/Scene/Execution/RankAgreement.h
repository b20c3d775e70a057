// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// What the ranks of a parallel program find out together, each of which has a part of the data. Filters/Parallel
// implements it.
#ifndef penumbra_RankAgreement_h
#define penumbra_RankAgreement_h

#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace penumbra
{

/// Thrown on all ranks if one of them fails, with its message.
class RankFailure : public std::runtime_error
{
public:
  using std::runtime_error::runtime_error;
};

/// Names and values of settings that all ranks must agree on.
using SettingList = std::vector<std::pair<std::string, std::string>>;

/// Returns the exact value of numbers as a setting.
template <typename... Values>
std::string DescribeNumbers(const Values&... values)
{
  std::ostringstream text;
  text.precision(17);
  const char* separator = "";
  ((text << separator << values, separator = ", "), ...);
  return text.str();
}

/// All functions but IsFirst() are collective: every rank calls them in the same order.
class RankAgreement
{
public:
  virtual ~RankAgreement() = default;

  /// Returns true on the rank that reports what all have found.
  virtual bool IsFirst() const = 0;

  /// Throws RankFailure, with the name of the first setting that differs between ranks, if there is one.
  virtual void Compare(const SettingList& settings) = 0;

  /// Replaces each value by the sum over all ranks.
  virtual void Sum(std::vector<double>& values) = 0;

  /// Enlarges bounds to those of all ranks; empty ones begin with a minimum above the maximum.
  virtual void UniteBounds(double bounds[6]) = 0;

  /// Replaces sentences by those of all ranks, each once, on the first rank, and by none on the others.
  virtual void UniteSentences(std::vector<std::string>& sentences) = 0;

  /// Tells the other ranks that this one has failed. Returns the message of the first one that has.
  virtual std::string Fail(const std::string& message) = 0;
};

}
#endif
