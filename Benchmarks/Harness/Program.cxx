// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "Program.h"

#include "vtkVersion.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <exception>

namespace penumbra
{

std::pair<std::string, bool> Program::ReadOptions(int argc, char** argv) const
{
  std::string only;
  std::vector<Value> values = this->Values;
  values.push_back({ "--only", &only });
  for (int i = 1; i < argc; ++i)
  {
    const std::string option = argv[i];
    const auto is = [&](const auto& known) { return known.Option == option; };
    const auto value = std::find_if(values.begin(), values.end(), is);
    const auto alone = std::find_if(this->Switches.begin(), this->Switches.end(), is);
    if (value != values.end() && i + 1 < argc)
    {
      *value->Where = argv[++i];
    }
    else if (alone != this->Switches.end())
    {
      *alone->Where = alone->Set;
    }
    else
    {
      return { only, false };
    }
  }
  const bool complete = std::none_of(values.begin(), values.end(),
    [](const Value& value) { return value.Required && value.Where->empty(); });
  return { only, complete };
}

int Program::Run(int argc, char** argv, ResultTable& results, const std::string& output,
  const std::function<std::vector<std::string>()>& circumstances)
{
  const std::string program = "penumbra-benchmark-" + this->Name;
  const auto [only, understood] = this->ReadOptions(argc, argv);
  if (!understood)
  {
    std::fprintf(stderr, "usage: %s %s\n", program.c_str(), this->Usage.c_str());
    return 2;
  }
  try
  {
    for (const Part& part : this->Parts)
    {
      if (only.empty() || part.Name.empty() || part.Name == only)
      {
        part.Measure();
      }
    }
  }
  catch (const std::exception& problem)
  {
    std::fprintf(stderr, "%s: %s\n", program.c_str(), problem.what());
    return 2;
  }
  std::vector<std::string> head{ RunLine(), VersionLine() };
  const std::vector<std::string> more = circumstances();
  head.insert(head.end(), more.begin(), more.end());
  results.Write(output + "/" + this->Name, this->Title, head);
  return results.GetFailed().empty() ? 0 : 1;
}

std::string RunLine()
{
  if (const char* run = std::getenv("PENUMBRA_RUN"))
  {
    return run;
  }
  char date[16];
  const std::time_t now = std::time(nullptr);
  std::strftime(date, sizeof date, "%Y-%m-%d", std::gmtime(&now));
  return "date: " + std::string(date);
}

std::string VersionLine()
{
  return "VTK " + std::string(vtkVersion::GetVTKVersion()) + ", compiler " __VERSION__;
}

}
