// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "Report.h"

#include "Processes/MessageLog.h"

#include "vtkDataArray.h"
#include "vtkFieldData.h"

#include <cmath>

#include <sys/resource.h>

namespace penumbra
{

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

nlohmann::json ToJson(vtkFieldData* statistics)
{
  nlohmann::json json = nlohmann::json::object();
  for (int i = 0; i < statistics->GetNumberOfArrays(); ++i)
  {
    vtkDataArray* array = statistics->GetArray(i);
    if (array && array->GetName() && array->GetNumberOfTuples() > 0)
    {
      const double value = array->GetComponent(0, 0);
      const bool isCount = value == std::floor(value);
      json[array->GetName()] =
        isCount ? nlohmann::json(static_cast<long long>(value)) : nlohmann::json(value);
    }
  }
  return json;
}

unsigned long long PeakMemory()
{
  rusage usage = {};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<unsigned long long>(usage.ru_maxrss) * 1024;
}

}
