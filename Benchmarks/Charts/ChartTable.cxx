// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ChartTable.h"

#include "Files/AtomicFile.h"
#include "Processes/CommandError.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace penumbra
{

namespace
{

constexpr const char* Heading = "scene,method,setting,tolerance,error,seconds,count";

std::string TitleOf(const std::string& subject)
{
  return "# penumbra chart: " + subject;
}

/// Parses a row. The name may contain commas, so the fields after it are parsed from the end.
ChartRow RowOf(const std::string& line, const std::string& path)
try
{
  std::vector<std::string> fields;
  std::size_t end = line.size();
  for (int i = 0; i < 6; ++i)
  {
    const std::size_t comma = line.rfind(',', end - 1);
    fields.push_back(line.substr(comma + 1, end - comma - 1));
    end = comma;
  }
  return { line.substr(0, end), fields[5], fields[4], std::stod(fields[3]), std::stod(fields[2]),
    std::stod(fields[1]), std::stod(fields[0]) };
}
catch (const std::logic_error&)
{
  throw CommandError(
    BadInput, "--output: " + path + " contains a line that cannot be parsed: " + line);
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
    throw CommandError(BadInput,
      "--output: " + this->Path +
        " belongs to another chart (other files, or --quick); remove it or use another folder");
  }
  this->Head = line + "\n";
  while (std::getline(file, line))
  {
    if (line.rfind('#', 0) == 0)
    {
      this->Head += line + "\n";
    }
    else if (line != Heading)
    {
      this->Rows.push_back(RowOf(line, this->Path));
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
    text << row.Scene << ',' << row.Method << ',' << row.Setting << ',' << row.RequestedTolerance
         << ',' << row.Error << ',' << row.Seconds << ',' << row.Count << "\n";
  }
  AtomicFile file(this->Path, "--output");
  file.Write(text.str());
  file.Commit();
}

ParetoDistance DistanceToFront(
  const std::vector<ChartRow>& rows, const ChartRow& row, double ChartRow::*cost)
{
  ParetoDistance distance;
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
