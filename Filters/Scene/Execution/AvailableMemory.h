// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Refuses work that does not fit into memory before the machine swaps or ends the process.
#ifndef penumbra_AvailableMemory_h
#define penumbra_AvailableMemory_h

#include "vtkPenumbraFiltersSceneModule.h" // for export macro, which tests need

#include <stdexcept>
#include <string>

namespace penumbra
{

/// Memory is insufficient. The text says for what, how much is needed, and how much there is.
class InsufficientMemory : public std::runtime_error
{
public:
  using std::runtime_error::runtime_error;
};

/// Returns the number of bytes that this process can allocate without swapping: the least of what
/// the system has available, what its control groups grant, and what its resource limits allow; on
/// other systems than Linux, infinity. `root` replaces the root folder of the files of the system.
/// The environment variable PENUMBRA_AVAILABLE_MEMORY, in MiB, replaces the result; throws
/// std::runtime_error unless it is a positive number.
VTKPENUMBRAFILTERSSCENE_EXPORT double FindAvailableMemory(const std::string& root = "");

/// Throws InsufficientMemory if `bytes` exceed FindAvailableMemory(). `what` is the plural noun of
/// the message, such as "100000000 glyphs".
VTKPENUMBRAFILTERSSCENE_EXPORT void RequireMemory(double bytes, const std::string& what);

}
#endif
