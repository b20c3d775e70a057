// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "Report.h"

#include "Processes/MessageLog.h"

#include "vtkDataArray.h"
#include "vtkFieldData.h"

#include <nlohmann/json.hpp>

#include <cmath>

#include <sys/resource.h>

namespace penumbra
{

void NameFile(const std::string& path, std::vector<std::string>& warnings)
{
  for (std::string& warning : warnings)
  {
    warning.insert(0, path + ": ");
  }
}

void PrintWarnings(const std::vector<std::string>& warnings)
{
  std::string line;
  for (const std::string& warning : warnings)
  {
    line += (line.empty() ? "warning: " : "; ") + warning;
  }
  if (!line.empty())
  {
    PrintMessage(line);
  }
}

ReportTable ToTable(vtkFieldData* statistics)
{
  ReportTable table;
  for (int i = 0; i < statistics->GetNumberOfArrays(); ++i)
  {
    vtkDataArray* array = statistics->GetArray(i);
    if (array && array->GetName() && array->GetNumberOfTuples() > 0)
    {
      const double value = array->GetComponent(0, 0);
      const bool isCount = value == std::floor(value);
      table[array->GetName()] =
        isCount ? ReportValue(static_cast<long long>(value)) : ReportValue(value);
    }
  }
  return table;
}

std::string FormatJson(const Report& report)
{
  const auto convert = [](const ReportValue& value) {
    return std::visit([](const auto& held) { return nlohmann::json(held); }, value);
  };
  nlohmann::json json = nlohmann::json::object();
  for (const auto& [name, entry] : report)
  {
    if (const ReportTable* table = std::get_if<ReportTable>(&entry))
    {
      json[name] = nlohmann::json::object();
      for (const auto& [key, value] : *table)
      {
        json[name][key] = convert(value);
      }
    }
    else
    {
      json[name] = convert(std::get<ReportValue>(entry));
    }
  }
  return json.dump(2) + "\n";
}

long long PeakMemory()
{
  rusage usage = {};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<long long>(usage.ru_maxrss) * 1024;
}

}
