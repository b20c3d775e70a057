// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// What a run says at its end: warnings on stderr, counts and times as JSON.
#ifndef penumbra_Report_h
#define penumbra_Report_h

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

class vtkFieldData;

namespace penumbra
{

/// All in one line; nothing where there are none.
void PrintWarnings(const std::vector<std::string>& warnings);

/// Arrays of one value by their names; whole numbers as such.
nlohmann::json ToJson(vtkFieldData* statistics);

/// In bytes, of this process.
unsigned long long PeakMemory();

}
#endif
