// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// What reading one file may cost: a damaged file on which its reader never ends, or for which it asks
// for memory out of all proportion, is told as one.
#ifndef penumbra_ReadLimit_h
#define penumbra_ReadLimit_h

#include <string>

namespace CLI
{
class App;
class Option;
}

namespace penumbra
{

CLI::Option* AddReadLimitOption(CLI::App& app);

/// While it lives, time and memory are limited. When the time is over the process removes its temporary
/// files, says one line and exits with BadInput; memory beyond the limit throws std::bad_alloc. To be
/// used in a worker, one at a time.
class ReadLimit
{
public:
  explicit ReadLimit(const std::string& path);
  ~ReadLimit();

  ReadLimit(const ReadLimit&) = delete;
  void operator=(const ReadLimit&) = delete;

  /// Does the file, not the machine, set the limit of memory?
  bool IsByFile() const { return this->ByFile; }

private:
  unsigned long long Memory = 0; ///< the limit before
  bool ByFile = false;
};

}
#endif
