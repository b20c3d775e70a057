// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// The measured steps of a chart, kept in a CSV file that is written anew, whole, after each: an interrupted
// run goes on where it ended.
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
  double RequestedTolerance = 0.0; ///< tolerance; 0: the method takes none
  double Error = 0.0;
  double Seconds = 0.0; ///< CPU
  double Count = 0.0;   ///< rays or samples a pixel
};

class ChartTable
{
public:
  /// Rows that an earlier run left at `path`. `subject`: what is measured; `remarks`: machine, date.
  /// Throws Failure where the file is of another subject or no chart's, or cannot be written.
  ChartTable(
    const std::string& path, const std::string& subject, const std::vector<std::string>& remarks);

  bool Has(const std::string& scene, const std::string& method, const std::string& setting) const;

  /// Writes it at once.
  void Add(const ChartRow& row);

  const std::vector<ChartRow>& GetRows() const { return this->Rows; }

private:
  void Read(const std::string& subject);
  void Write() const;

  std::string Path;
  std::string Head; ///< subject and remarks
  std::vector<ChartRow> Rows;
};

/// How far a row lies off the front of all rows of its scene; 0 and 1 where it lies on it.
struct ParetoDistance
{
  double Off = 0.0;        ///< share by which some other row is better in both, error and cost
  std::string Than;        ///< that row: method and setting
  double TimesCost = 1.0;  ///< cost over the least for which an error as small is had
  double TimesError = 1.0; ///< error over the least that is had for as little
};

ParetoDistance DistanceToFront(
  const std::vector<ChartRow>& rows, const ChartRow& row, double ChartRow::*cost);

/// Rows that no other row beats in error and in `cost`, by falling error.
std::vector<ChartRow> ParetoFront(std::vector<ChartRow> rows, double ChartRow::*cost);

}
#endif
