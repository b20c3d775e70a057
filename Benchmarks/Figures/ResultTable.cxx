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

std::string Limit(const BenchmarkResult& figure)
{
  return figure.Direction == TargetKind::None
    ? std::string()
    : (figure.Direction == TargetKind::AtMost ? "<= " : ">= ") + Number(figure.Limit);
}

std::string Verdict(const BenchmarkResult& figure)
{
  return figure.Direction == TargetKind::None ? "" : figure.IsMet() ? "met" : "**missed**";
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
  const BenchmarkResult& figure = this->Figures.back();
  std::printf("%-34s %-38s %10s  %-10s %-10s %s\n", scene.c_str(), quantity.c_str(),
    Number(measured).c_str(), Limit(figure).c_str(), Verdict(figure).c_str(), remark.c_str());
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
  markdown << "\n| scene | quantity | measured | bar | | remark |\n|---|---|---|---|---|---|\n";
  for (const BenchmarkResult& figure : this->Figures)
  {
    const bool judged = figure.Direction != TargetKind::None;
    csv << '"' << figure.Scene << "\",\"" << figure.Quantity << "\"," << figure.Measured << ",\""
        << Limit(figure) << "\"," << (judged ? (figure.IsMet() ? "yes" : "no") : "") << ",\""
        << figure.Remark << "\"\n";
    markdown << "| " << figure.Scene << " | " << figure.Quantity << " | " << Number(figure.Measured)
             << " | " << Limit(figure) << " | " << Verdict(figure) << " | " << figure.Remark
             << " |\n";
  }
}

std::vector<std::string> ResultTable::GetFailed() const
{
  std::vector<std::string> missed;
  for (const BenchmarkResult& figure : this->Figures)
  {
    if (!figure.IsMet())
    {
      missed.push_back(figure.Scene + ": " + figure.Quantity);
    }
  }
  return missed;
}

}
