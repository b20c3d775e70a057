// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ResultTable.h"

#include <cstdio>
#include <fstream>

namespace penumbra
{
namespace
{

std::string Number(double value)
{
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", value);
  return text;
}

std::string Limit(const BenchmarkResult& result)
{
  return result.Direction == TargetKind::None
    ? std::string()
    : (result.Direction == TargetKind::AtMost ? "<= " : ">= ") + Number(result.Limit);
}

std::string Verdict(const BenchmarkResult& result)
{
  return result.Direction == TargetKind::None ? "" : result.IsMet() ? "met" : "**missed**";
}

}

bool BenchmarkResult::IsMet() const
{
  return this->Direction == TargetKind::None ||
    (this->Direction == TargetKind::AtMost ? this->Measured <= this->Limit
                                           : this->Measured >= this->Limit);
}

void ResultTable::Add(const std::string& scene, const std::string& quantity, double measured,
  TargetKind direction, double limit, const std::string& remark)
{
  this->Figures.push_back({ scene, quantity, measured, direction, limit, remark });
  const BenchmarkResult& result = this->Figures.back();
  std::printf("%-34s %-38s %10s  %-10s %-10s %s\n", scene.c_str(), quantity.c_str(),
    Number(measured).c_str(), Limit(result).c_str(), Verdict(result).c_str(), remark.c_str());
  std::fflush(stdout);
}

void ResultTable::Write(const std::string& path, const std::string& title,
  const std::vector<std::string>& circumstances) const
{
  std::ofstream csv(path + ".csv");
  csv << "scene,quantity,measured,bar,met,remark\n";
  std::ofstream markdown(path + ".md");
  markdown << "# " << title << "\n\n";
  for (const std::string& line : circumstances)
  {
    markdown << "- " << line << "\n";
  }
  markdown << "\n| scene | quantity | measured | target | | remark |\n|---|---|---|---|---|---|\n";
  for (const BenchmarkResult& result : this->Figures)
  {
    const bool judged = result.Direction != TargetKind::None;
    csv << '"' << result.Scene << "\",\"" << result.Quantity << "\"," << result.Measured << ",\""
        << Limit(result) << "\"," << (judged ? (result.IsMet() ? "yes" : "no") : "") << ",\""
        << result.Remark << "\"\n";
    markdown << "| " << result.Scene << " | " << result.Quantity << " | " << Number(result.Measured)
             << " | " << Limit(result) << " | " << Verdict(result) << " | " << result.Remark
             << " |\n";
  }
}

std::vector<std::string> ResultTable::GetFailed() const
{
  std::vector<std::string> missed;
  for (const BenchmarkResult& result : this->Figures)
  {
    if (!result.IsMet())
    {
      missed.push_back(result.Scene + ": " + result.Quantity);
    }
  }
  return missed;
}

}
