// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Worker processes that return a text, for results of readers, which may crash.
#ifndef penumbra_WorkerTexts_h
#define penumbra_WorkerTexts_h

#include <functional>
#include <string>
#include <vector>

namespace penumbra
{

/// Runs `count` tasks as RunWorkers() and stores their results in `texts`; those of failed tasks
/// are empty. Returns the largest exit status.
int RunForTexts(int count, int jobs, const std::function<std::string(int)>& task,
  std::vector<std::string>& texts);

}
#endif
