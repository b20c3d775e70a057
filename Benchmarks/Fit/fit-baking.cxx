// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Error and cost of baked occlusion for several values of the fitted constants, on the meshes of the fit
// and on meshes that were not used in it. Run it with `./penumbra benchmark fit-baking`.
#include "BakingCase.h"

#include "BruteForce/ImageErrors.h"
#include "Meshes.h"
#include "Program.h"

#include "vtkCell.h"
#include "vtkCellArray.h"
#include "vtkIdList.h"
#include "vtkNew.h"
#include "vtkPLYReader.h"
#include "vtkPolyData.h"
#include "vtkSTLReader.h"
#include "vtkXMLPolyDataReader.h"

#include <algorithm>
#include <cmath>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <map>
#include <utility>

namespace
{

using namespace penumbra;

struct Constant
{
  const char* Name;
  double OcclusionBakingConstants::*Member;
};

constexpr Constant Constants[] = {
  { "BruteForceErrorFactor", &OcclusionBakingConstants::BruteForceErrorFactor },
  { "LowSampleNoiseFactor", &OcclusionBakingConstants::LowSampleNoiseFactor },
  { "DenoisedErrorFactor", &OcclusionBakingConstants::DenoisedErrorFactor },
  { "RegressionRadius", &OcclusionBakingConstants::RegressionRadius },
};

/// Values that are measured, over the present value.
constexpr double Factors[] = { 0.5, 0.8, 1.0, 1.25, 2.0 };

/// Tolerances over the tolerance for the series of bakes that gives the cost at equal error.
constexpr double LadderFactors[] = { 0.6, 1.0, 1.6 };

/// A case, its results with the present constants at several tolerances, and at the tolerance.
struct Subject
{
  BakingCase Case;
  std::vector<glm::dvec2> Ladder;
  BakingResult Present;
};

/// The cases of one set of meshes.
struct MeshSet
{
  std::string Name;
  std::vector<Subject> Subjects;
};

/// Means over the cases of a set.
struct Summary
{
  double Error = 0.0;        ///< root mean square of RMSE / tolerance
  double LargestError = 0.0; ///< of all RMSE / tolerance
  double Rays = 0.0;         ///< per point
  double Cost =
    0.0; ///< geometric mean of the rays over those of the present constants at equal RMSE
};

/// A value of one constant.
struct Row
{
  double Factor;
  double Value;
  Summary Sets[2];
};

/// Prints to the terminal and to the report.
class Report
{
public:
  explicit Report(const std::string& path)
    : File(path)
  {
  }

  bool IsOpen() const { return this->File.good(); }

  void Print(const char* format, ...)
  {
    char text[1024];
    std::va_list arguments;
    va_start(arguments, format);
    std::vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    std::cout << text << std::flush;
    this->File << text << std::flush;
  }

private:
  std::ofstream File;
};

template <typename Reader>
vtkSmartPointer<vtkPolyData> Read(const std::string& path)
{
  vtkNew<Reader> reader;
  reader->SetFileName(path.c_str());
  reader->Update();
  return reader->GetOutput();
}

/// Divides each triangle into four in its plane. Loop subdivision refuses meshes that are not manifold.
vtkSmartPointer<vtkPolyData> DivideTriangles(vtkPolyData* mesh, int times)
{
  if (times == 0)
  {
    return mesh;
  }
  vtkNew<vtkPoints> points;
  points->DeepCopy(mesh->GetPoints());
  vtkNew<vtkCellArray> triangles;
  std::map<std::pair<vtkIdType, vtkIdType>, vtkIdType> middles;
  const auto divide = [&](vtkIdType a, vtkIdType b) {
    const auto [found, isNew] = middles.try_emplace(std::minmax(a, b), points->GetNumberOfPoints());
    if (isNew)
    {
      double x[3];
      double y[3];
      points->GetPoint(a, x);
      points->GetPoint(b, y);
      points->InsertNextPoint(.5 * (x[0] + y[0]), .5 * (x[1] + y[1]), .5 * (x[2] + y[2]));
    }
    return found->second;
  };
  for (vtkIdType i = 0; i < mesh->GetNumberOfCells(); ++i)
  {
    vtkIdList* corners = mesh->GetCell(i)->GetPointIds();
    vtkIdType middle[3];
    for (int k = 0; k < 3; ++k)
    {
      middle[k] = divide(corners->GetId(k), corners->GetId((k + 1) % 3));
    }
    for (int k = 0; k < 3; ++k)
    {
      const vtkIdType corner[] = { corners->GetId(k), middle[k], middle[(k + 2) % 3] };
      triangles->InsertNextCell(3, corner);
    }
    triangles->InsertNextCell(3, middle);
  }
  auto divided = vtkSmartPointer<vtkPolyData>::New();
  divided->SetPoints(points);
  divided->SetPolys(triangles);
  return DivideTriangles(divided, times - 1);
}

void AddCases(const std::string& name, vtkPolyData* data, double tolerance, MeshSet& set)
{
  const auto mesh = std::make_shared<const BakingMesh>(name, data);
  for (const bool unbounded : { false, true })
  {
    Subject subject{ BakingCase(mesh, unbounded), {}, {} };
    for (const double factor : LadderFactors)
    {
      const BakingResult result = subject.Case.Bake(factor * tolerance, OcclusionBakingConstants());
      subject.Ladder.emplace_back(result.Error, result.Rays);
      subject.Present = factor == 1.0 ? result : subject.Present;
    }
    set.Subjects.push_back(std::move(subject));
  }
}

void PrintPresent(const MeshSet& set, double tolerance, Report& report)
{
  for (const Subject& subject : set.Subjects)
  {
    report.Print("| %s | %s | %zu | %.2f | %.0f | %.0f | %.0f |\n", subject.Case.GetName().c_str(),
      set.Name.c_str(), subject.Case.GetNumberOfPoints(), subject.Present.Error / tolerance,
      subject.Present.Rays, 100.0 * subject.Present.Denoised, 100.0 * subject.Present.Interpolated);
  }
}

Summary Measure(
  const MeshSet& set, double tolerance, const OcclusionBakingConstants& constants, bool isPresent)
{
  Summary summary;
  const auto count = static_cast<double>(set.Subjects.size());
  for (const Subject& subject : set.Subjects)
  {
    const BakingResult result =
      isPresent ? subject.Present : subject.Case.Bake(tolerance, constants);
    const double error = result.Error / tolerance;
    summary.Error += error * error / count;
    summary.LargestError = std::max(summary.LargestError, error);
    summary.Rays += result.Rays / count;
    summary.Cost += std::log(result.Rays / CostAtError(subject.Ladder, result.Error)) / count;
  }
  summary.Error = std::sqrt(summary.Error);
  summary.Cost = std::exp(summary.Cost);
  return summary;
}

/// Returns the row with the fewest rays at equal RMSE. Values are excluded if they raise the largest
/// RMSE above the tolerance or, if the present value exceeds that, further.
const Row& FindBest(const std::vector<Row>& rows, int set)
{
  const auto present =
    std::find_if(rows.begin(), rows.end(), [](const Row& row) { return row.Factor == 1.0; });
  const double limit = std::max(1.0, present->Sets[set].LargestError);
  const Row* best = &*present;
  for (const Row& row : rows)
  {
    const bool isAllowed = row.Sets[set].LargestError <= limit;
    best = isAllowed && row.Sets[set].Cost < best->Sets[set].Cost ? &row : best;
  }
  return *best;
}

std::vector<Row> MeasureConstant(
  const Constant& constant, double tolerance, const MeshSet (&sets)[2], Report& report)
{
  report.Print("\n## %s\n\n", constant.Name);
  report.Print("| value | RMSE, fit | largest | rays | at equal RMSE | RMSE, held out | largest | "
               "rays | at equal RMSE |\n|---|---|---|---|---|---|---|---|---|\n");
  std::vector<Row> rows;
  for (const double factor : Factors)
  {
    OcclusionBakingConstants constants;
    constants.*constant.Member *= factor;
    Row row{ factor, constants.*constant.Member, {} };
    for (const int set : { 0, 1 })
    {
      row.Sets[set] = Measure(sets[set], tolerance, constants, factor == 1.0);
    }
    report.Print(factor == 1.0 ? "| **%g** |" : "| %g |", row.Value);
    for (const Summary& s : row.Sets)
    {
      report.Print(" %.2f | %.2f | %.0f | %.2f |", s.Error, s.LargestError, s.Rays, s.Cost);
    }
    report.Print("\n");
    rows.push_back(row);
  }
  return rows;
}

void PrintHead(Report& report, double tolerance)
{
  report.Print(
    "# Constants of baked occlusion: errors and rays on fitted and on held-out meshes\n\n");
  report.Print("- %s\n- %s; tolerance %g\n", RunLine().c_str(), VersionLine().c_str(), tolerance);
  report.Print(
    "- fit: scans of Debian's libcgal-demo; held out: meshes of Data/; each with the default "
    "radius and without a radius\n");
  report.Print("- reference: %d rays at each of %zu points per mesh\n", BakingCase::ReferenceRays,
    BakingCase::ReferencePoints);
  report.Print(
    "- RMSE: over the tolerance, root mean square over the cases; largest: of all cases; "
    "rays: per point\n");
  report.Print(
    "- at equal RMSE: rays over those of the present constants at the tolerance that gives "
    "the same RMSE, geometric mean; a smaller value is better\n");
  report.Print("- **bold**: the present value\n");
}

void PrintChoice(const std::vector<std::vector<Row>>& measured,
  const std::vector<Constant>& constants, Report& report)
{
  report.Print(
    "\n## Choice\n\nThe best value has the fewest rays at equal RMSE. It may not raise the "
    "largest RMSE of its set above the tolerance, or, if the present value exceeds that, "
    "further.\n\n");
  report.Print(
    "| constant | present | best, fit | best, held out | rays of the present over the best, "
    "held out | present within 20 %% of the best, held out |\n|---|---|---|---|---|---|\n");
  for (std::size_t i = 0; i < constants.size(); ++i)
  {
    const Row& fit = FindBest(measured[i], 0);
    const Row& heldOut = FindBest(measured[i], 1);
    const bool isNear = heldOut.Factor >= 0.8 && heldOut.Factor <= 1.25;
    report.Print("| %s | %g | %g | %g | %.2f | %s |\n", constants[i].Name,
      OcclusionBakingConstants().*constants[i].Member, fit.Value, heldOut.Value,
      1.0 / heldOut.Sets[1].Cost, isNear ? "yes" : "no");
  }
}

/// Prints error and time of meshes with about 100,000 points, without a maximum distance.
void MeasureLargeMeshes(
  const std::string& meshes, const std::string& data, double tolerance, Report& report)
{
  const auto measure = [&](const char* name, vtkPolyData* mesh) {
    const BakingCase subject(std::make_shared<const BakingMesh>(name, mesh), true);
    const BakingResult result = subject.Bake(tolerance, OcclusionBakingConstants());
    report.Print("| %s | %zu | %.2f | %.1f | %.0f | %.0f | %.0f | %.2f |\n", name,
      subject.GetNumberOfPoints(), result.Error / tolerance, 100.0 * result.Outliers, result.Rays,
      100.0 * result.Denoised, 100.0 * result.Interpolated,
      1e5 * result.Seconds / static_cast<double>(subject.GetNumberOfPoints()));
  };
  report.Print("\n## Divided triangles, no radius\n\n");
  report.Print("| mesh | points | RMSE | errors > 3 tolerances, %% | rays | denoised, %% | from "
               "records, %% | CPU s per 100,000 points |\n|---|---|---|---|---|---|---|---|\n");
  measure("armadillo", DivideTriangles(ReadOff(meshes + "/armadillo.off"), 1));
  measure("dragon", DivideTriangles(ReadOff(meshes + "/ChineseDragon-10kv.off"), 2));
  measure("elephant", DivideTriangles(ReadOff(meshes + "/refined_elephant.off"), 1));
  measure("brain", DivideTriangles(Read<vtkXMLPolyDataReader>(data + "/brain.vtp"), 1));
  measure("head", DivideTriangles(Read<vtkPLYReader>(data + "/head.ply"), 2));
  measure("terrain", DivideTriangles(Read<vtkXMLPolyDataReader>(data + "/terrain.vtp"), 1));
  measure("bracket", DivideTriangles(Read<vtkSTLReader>(data + "/bracket.stl"), 3));
}

struct Options
{
  std::string Data;
  std::string Meshes;
  std::string Output;
  std::string Only;
  double Tolerance = 0.01;
};

bool ParseOptions(int count, char** arguments, Options& options)
{
  for (int i = 1; i + 1 < count; i += 2)
  {
    const std::string name = arguments[i];
    const std::string value = arguments[i + 1];
    if (name == "--tolerance")
    {
      options.Tolerance = std::atof(value.c_str());
      continue;
    }
    std::string* text = name == "--data" ? &options.Data
      : name == "--meshes"               ? &options.Meshes
      : name == "--output"               ? &options.Output
      : name == "--only"                 ? &options.Only
                                         : nullptr;
    if (!text)
    {
      return false;
    }
    *text = value;
  }
  return count % 2 == 1 && !options.Data.empty() && !options.Meshes.empty() &&
    !options.Output.empty() && options.Tolerance >= 1e-4 && options.Tolerance <= 1.0;
}

void Fit(const Options& options, Report& report)
{
  const std::string& data = options.Data;
  const double tolerance = options.Tolerance;
  MeshSet sets[2] = { { "fit", {} }, { "held out", {} } };
  PrintHead(report, tolerance);
  MeasureLargeMeshes(options.Meshes, data, tolerance, report);
  if (options.Only == "large")
  {
    return;
  }
  AddCases("armadillo", ReadOff(options.Meshes + "/armadillo.off"), tolerance, sets[0]);
  AddCases("dragon", ReadOff(options.Meshes + "/ChineseDragon-10kv.off"), tolerance, sets[0]);
  AddCases("elephant", ReadOff(options.Meshes + "/refined_elephant.off"), tolerance, sets[0]);
  AddCases("brain", Read<vtkXMLPolyDataReader>(data + "/brain.vtp"), tolerance, sets[1]);
  AddCases("head", Read<vtkPLYReader>(data + "/head.ply"), tolerance, sets[1]);
  AddCases("terrain", Read<vtkXMLPolyDataReader>(data + "/terrain.vtp"), tolerance, sets[1]);
  // The triangles of a CAD part are too large for a value per point.
  AddCases("bracket, subdivided", Subdivide(Read<vtkSTLReader>(data + "/bracket.stl"), 2),
    tolerance, sets[1]);

  report.Print("\n## Present constants\n\n");
  report.Print("| mesh | set | points | RMSE | rays | denoised, %% | from records, %% |\n"
               "|---|---|---|---|---|---|---|\n");
  PrintPresent(sets[0], tolerance, report);
  PrintPresent(sets[1], tolerance, report);
  std::vector<Constant> constants;
  std::vector<std::vector<Row>> measured;
  for (const Constant& constant : Constants)
  {
    if (std::string(constant.Name).find(options.Only) != std::string::npos)
    {
      constants.push_back(constant);
      measured.push_back(MeasureConstant(constant, tolerance, sets, report));
    }
  }
  PrintChoice(measured, constants, report);
}

}

int main(int argc, char** argv)
{
  Options options;
  if (!ParseOptions(argc, argv, options))
  {
    std::cerr
      << "usage: fit-baking [--tolerance X] [--only CONSTANT] --data FOLDER --meshes FOLDER "
         "--output FOLDER\n";
    return 2;
  }
  try
  {
    Report report(options.Output + "/fit-baking.md");
    if (!report.IsOpen())
    {
      throw std::runtime_error("cannot write to " + options.Output);
    }
    Fit(options, report);
  }
  catch (const std::exception& error)
  {
    std::cerr << "fit-baking: " << error.what() << "\n";
    return 2;
  }
  return 0;
}
