// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ChartTable.h"

#include "Failure.h"
#include "PendingFile.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace penumbra
{

namespace
{

constexpr const char* Heading = "scene,method,setting,asked,error,seconds,count";

std::string TitleOf(const std::string& subject)
{
  return "# penumbra chart: " + subject;
}

}

ChartTable::ChartTable(
  const std::string& path, const std::string& subject, const std::vector<std::string>& remarks)
  : Path(path)
{
  if (std::filesystem::exists(path))
  {
    this->Read(subject);
    return;
  }
  this->Head = TitleOf(subject) + "\n";
  for (const std::string& remark : remarks)
  {
    this->Head += "# " + remark + "\n";
  }
  this->Write();
}

void ChartTable::Read(const std::string& subject)
{
  std::ifstream file(this->Path);
  std::string line;
  std::getline(file, line);
  if (line != TitleOf(subject))
  {
    throw Failure(BadInput,
      "--output: " + this->Path +
        " is of another chart (other files, or --quick); remove it or use another folder");
  }
  this->Head = line + "\n";
  while (std::getline(file, line))
  {
    std::istringstream text(line);
    ChartRow row;
    char comma = 0;
    std::getline(text, row.Scene, ',');
    std::getline(text, row.Method, ',');
    std::getline(text, row.Setting, ',');
    text >> row.Asked >> comma >> row.Error >> comma >> row.Seconds >> comma >> row.Count;
    if (line.rfind('#', 0) == 0)
    {
      this->Head += line + "\n";
    }
    else if (line != Heading && text)
    {
      this->Rows.push_back(row);
    }
  }
}

bool ChartTable::Has(
  const std::string& scene, const std::string& method, const std::string& setting) const
{
  return std::any_of(this->Rows.begin(), this->Rows.end(), [&](const ChartRow& row) {
    return row.Scene == scene && row.Method == method && row.Setting == setting;
  });
}

void ChartTable::Add(const ChartRow& row)
{
  this->Rows.push_back(row);
  this->Write();
}

void ChartTable::Write() const
{
  std::ostringstream text;
  text << this->Head << Heading << "\n";
  for (const ChartRow& row : this->Rows)
  {
    text << row.Scene << ',' << row.Method << ',' << row.Setting << ',' << row.Asked << ','
         << row.Error << ',' << row.Seconds << ',' << row.Count << "\n";
  }
  PendingFile file(this->Path, "--output");
  file.Write(text.str());
  file.Commit();
}

FrontDistance DistanceToFront(
  const std::vector<ChartRow>& rows, const ChartRow& row, double ChartRow::*cost)
{
  FrontDistance distance;
  for (const ChartRow& other : rows)
  {
    if (other.Scene != row.Scene)
    {
      continue;
    }
    const double timesError = row.Error / other.Error;
    const double timesCost = row.*cost / other.*cost;
    const double better = std::min(timesError, timesCost) - 1.0;
    if (better > distance.Off)
    {
      distance.Off = better;
      distance.Than = other.Method + " " + other.Setting;
    }
    distance.TimesCost = std::max(distance.TimesCost, timesError >= 1.0 ? timesCost : 1.0);
    distance.TimesError = std::max(distance.TimesError, timesCost >= 1.0 ? timesError : 1.0);
  }
  return distance;
}

std::vector<ChartRow> ParetoFront(std::vector<ChartRow> rows, double ChartRow::*cost)
{
  std::sort(rows.begin(), rows.end(), [cost](const ChartRow& a, const ChartRow& b) {
    return a.*cost != b.*cost ? a.*cost < b.*cost : a.Error < b.Error;
  });
  std::vector<ChartRow> front;
  for (const ChartRow& row : rows)
  {
    if (front.empty() || row.Error < front.back().Error)
    {
      front.push_back(row);
    }
  }
  return front;
}

}
