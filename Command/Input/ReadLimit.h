// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Time and memory limits for reading a file. Readers may loop forever or allocate excessive memory
// on damaged files.
#ifndef penumbra_ReadLimit_h
#define penumbra_ReadLimit_h

#include <string>

namespace penumbra
{

class CommandLine;
class Option;

/// Adds --read-limit.
Option AddReadLimitOption(const CommandLine& app);

/// Limits time and memory during its lifetime. At the time limit the process removes its temporary
/// files, prints one line and exits with BadInput; allocations beyond the memory limit throw
/// std::bad_alloc. Use in worker processes, one object at a time.
class ReadLimit
{
public:
  explicit ReadLimit(const std::string& path);
  ~ReadLimit();

  ReadLimit(const ReadLimit&) = delete;
  void operator=(const ReadLimit&) = delete;

  /// Returns whether the memory limit follows from the file, not from the machine.
  bool IsByFile() const { return this->ByFile; }

private:
  unsigned long long Memory = 0; ///< limit before construction, in bytes
  bool ByFile = false;
};

}
#endif
