// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// The measured rows of a chart, stored in a CSV file. The complete file is rewritten after each
// row, so that an interrupted run can continue.
#ifndef penumbra_ChartTable_h
#define penumbra_ChartTable_h

#include <string>
#include <vector>

namespace penumbra
{

struct ChartRow
{
  std::string Scene;
  std::string Method;
  std::string Setting;
  double RequestedTolerance = 0.0; ///< 0: the method has no tolerance
  double Error = 0.0;
  double Seconds = 0.0; ///< CPU
  double Count = 0.0;   ///< rays or samples per pixel
};

class ChartTable
{
public:
  /// Reads the rows of an earlier run at `path`. `subject`: identifies the measurement; `remarks`:
  /// machine, date. Throws Failure if the file belongs to another subject, is not a chart, or
  /// cannot be written.
  ChartTable(
    const std::string& path, const std::string& subject, const std::vector<std::string>& remarks);

  bool Has(const std::string& scene, const std::string& method, const std::string& setting) const;

  /// Adds a row and writes the file.
  void Add(const ChartRow& row);

  const std::vector<ChartRow>& GetRows() const { return this->Rows; }

private:
  void Read(const std::string& subject);
  void Write() const;

  std::string Path;
  std::string Head; ///< subject and remarks
  std::vector<ChartRow> Rows;
};

/// Distance of a row from the front of all rows of its scene; 0 and 1 if the row is on the front.
struct ParetoDistance
{
  double Off = 0.0; ///< largest fraction by which another row is better in both error and cost
  std::string Than; ///< that row: method and setting
  double TimesCost = 1.0;  ///< cost relative to the cheapest row with at most this error
  double TimesError = 1.0; ///< error relative to the best row with at most this cost
};

ParetoDistance DistanceToFront(
  const std::vector<ChartRow>& rows, const ChartRow& row, double ChartRow::*cost);

/// Rows that no other row beats in both error and `cost`, by decreasing error.
std::vector<ChartRow> ParetoFront(std::vector<ChartRow> rows, double ChartRow::*cost);

}
#endif
