// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Report of a run: warnings on stderr, statistics as JSON.
#ifndef penumbra_Report_h
#define penumbra_Report_h

#include <map>
#include <string>
#include <variant>
#include <vector>

class vtkFieldData;

namespace penumbra
{

/// Puts the name of a file before each warning.
void NameFile(const std::string& path, std::vector<std::string>& warnings);

/// Prints all warnings in one line; nothing if there are none.
void PrintWarnings(const std::vector<std::string>& warnings);

using ReportValue = std::variant<bool, long long, double, std::string>;
using ReportTable = std::map<std::string, ReportValue>;
using Report = std::map<std::string, std::variant<ReportValue, ReportTable>>;

/// Converts arrays with one value, integral values to integers.
ReportTable ToTable(vtkFieldData* statistics);

/// Returns the report as JSON.
std::string FormatJson(const Report& report);

/// Returns the peak memory of the process in bytes.
long long PeakMemory();

}
#endif
