// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Small complete files of the formats that the program reads, and ways to damage them.
#ifndef penumbra_testing_SampleFiles_h
#define penumbra_testing_SampleFiles_h

#include <cstddef>
#include <string>
#include <vector>

namespace penumbra_testing
{

/// A file to damage.
struct SampleFile
{
  std::string Damaged; ///< path in the folder
  std::string Opened;  ///< path of the file that refers to it, or the same
};

/// Writes files of all formats except those that VTK cannot write and that are not texts: .e, .cgns
/// and .dem.
std::vector<SampleFile> WriteSampleFiles(const std::string& folder);

/// Random numbers that are the same with every standard library.
class Dice
{
public:
  explicit Dice(unsigned long long seed)
    : State(seed * 2862933555777941757ull + 3037000493ull)
  {
  }

  std::size_t Below(std::size_t bound)
  {
    this->State = this->State * 6364136223846793005ull + 1442695040888963407ull;
    return static_cast<std::size_t>(this->State >> 33) % bound;
  }

private:
  unsigned long long State;
};

/// Kinds of damage.
enum class Damages
{
  Cut,       ///< truncated anywhere
  Scratched, ///< one byte in 200 replaced, at least two; half of them near the beginning
  Digits,    ///< digits replaced by others: valid but wrong counts and indices
  HugeCount, ///< one number of a text replaced by a huge or negative one
  Moved      ///< a block of bytes removed or duplicated
};
constexpr std::size_t NumberOfDamages = 5;
const char* NameOf(Damages damage);

std::string Damage(std::string bytes, Damages damage, Dice& dice);

}
#endif
