// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Report of a run: warnings on stderr, statistics as JSON.
#ifndef penumbra_Report_h
#define penumbra_Report_h

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

class vtkFieldData;

namespace penumbra
{

/// Prints all warnings in one line; nothing if there are none.
void PrintWarnings(const std::vector<std::string>& warnings);

/// Converts arrays with one value to JSON, integral values to integers.
nlohmann::json ToJson(vtkFieldData* statistics);

/// Returns the peak memory of the process in bytes.
unsigned long long PeakMemory();

}
#endif
