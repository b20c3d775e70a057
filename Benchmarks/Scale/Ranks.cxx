// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Images of 8 blocks of an isosurface on 1 to 8 ranks: bits, bytes, memory and rays of a rank.
#include "Benchmark.h"
#include "ForkedRanks.h"
#include "Memory.h"

#include "vtkActor.h"
#include "vtkAppendPolyData.h"
#include "vtkCamera.h"
#include "vtkDataArray.h"
#include "vtkDataSet.h"
#include "vtkFieldData.h"
#include "vtkFlyingEdges3D.h"
#include "vtkImageData.h"
#include "vtkLight.h"
#include "vtkNew.h"
#include "vtkPNGWriter.h"
#include "vtkPenumbraDistributedIrradianceFilter.h"
#include "vtkPenumbraDistributedRayCaster.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkPolyDataMapper.h"
#include "vtkProperty.h"
#include "vtkRenderer.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <functional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace
{

using namespace penumbra;

constexpr int Blocks = 8;
constexpr int CellsPerBlock = 256; ///< along each side: about a million triangles
constexpr int CellsOfEffects = 56; ///< about 5 % of them
constexpr int CellsOfBaking = 28;  ///< about 1 % of them

/// Returns a block of 2 x 2 x 2, an isosurface of a function with two periods in each. The positions of
/// samples are exact, so that the points of neighboring blocks coincide.
vtkSmartPointer<vtkPolyData> MakeBlock(int block, int cells)
{
  const double spacing = 1.0 / cells;
  const double low[3] = { (block & 1) - 1.0, (block >> 1 & 1) - 1.0, (block >> 2) - 1.0 };
  vtkNew<vtkImageData> field;
  field->SetDimensions(cells + 1, cells + 1, cells + 1);
  field->SetOrigin(low[0], low[1], low[2]);
  field->SetSpacing(spacing, spacing, spacing);
  field->AllocateScalars(VTK_FLOAT, 1);
  auto* values = static_cast<float*>(field->GetScalarPointer());
  for (vtkIdType i = 0; i < field->GetNumberOfPoints(); ++i)
  {
    double p[3];
    field->GetPoint(i, p);
    for (double& c : p)
    {
      c *= 4.0 * 3.14159265358979324;
    }
    *values++ = static_cast<float>(std::sin(p[0]) * std::cos(p[1]) +
      std::sin(p[1]) * std::cos(p[2]) + std::sin(p[2]) * std::cos(p[0]));
  }
  vtkNew<vtkFlyingEdges3D> contour;
  contour->SetInputData(field);
  contour->SetValue(0, 0.0);
  contour->ComputeNormalsOff();
  contour->ComputeScalarsOff();
  contour->Update();
  return contour->GetOutput();
}

/// Returns the blocks of a rank.
vtkSmartPointer<vtkPolyData> MakePiece(int rank, int ranks, int cells)
{
  vtkNew<vtkAppendPolyData> append;
  for (int block = rank * Blocks / ranks; block < (rank + 1) * Blocks / ranks; ++block)
  {
    append->AddInputData(MakeBlock(block, cells));
  }
  append->Update();
  return append->GetOutput();
}

struct View
{
  const char* Name;
  int Size[2];
  int Cells;
  double Opacity;
  std::function<void(vtkPenumbraRayCaster*)> Set;
};

/// What a rank has to say of an image.
struct Report
{
  double Rays, RankRays, SceneBytes, WholeBytes, Primitives, WholePrimitives;
  double Input; ///< bytes of the data set
  double Peak;  ///< bytes of the process while it rendered, with the data set
};

void WriteImage(vtkImageData* image, const std::string& path)
{
  vtkDataArray* colors = image->GetPointData()->GetArray("Color");
  vtkNew<vtkImageData> bytes;
  bytes->CopyStructure(image);
  bytes->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
  auto* to = static_cast<unsigned char*>(bytes->GetScalarPointer());
  for (vtkIdType i = 0; i < colors->GetNumberOfTuples(); ++i)
  {
    for (int k = 0; k < 3; ++k)
    {
      *to++ = static_cast<unsigned char>(
        std::lround(255.0 * std::clamp(colors->GetComponent(i, k), 0.0, 1.0)));
    }
  }
  vtkNew<vtkPNGWriter> writer;
  writer->SetFileName(path.c_str());
  writer->SetInputData(bytes);
  writer->Write();
}

/// Renders the blocks of a rank together with those of the other ranks. Returns the report and the colors.
std::string Render(const View& view, int rank, int ranks, const std::string& path)
{
  vtkNew<vtkRenderer> renderer;
  Report report{};
  {
    const vtkSmartPointer<vtkPolyData> piece = MakePiece(rank, ranks, view.Cells);
    report.Input = 1024.0 * static_cast<double>(piece->GetActualMemorySize());
    vtkNew<vtkPolyDataMapper> mapper;
    mapper->SetInputData(piece);
    vtkNew<vtkActor> actor;
    actor->SetMapper(mapper);
    actor->GetProperty()->SetOpacity(view.Opacity);
    renderer->AddActor(actor);
  }
  vtkCamera* camera = renderer->GetActiveCamera();
  camera->SetPosition(2.6, 1.9, 4.6);
  camera->SetFocalPoint(0.0, 0.0, 0.0);
  camera->SetClippingRange(0.01, 100.0);
  vtkNew<vtkLight> light;
  light->SetPosition(3.0, 6.0, 4.0);
  light->SetFocalPoint(0.0, 0.0, 0.0);
  renderer->AddLight(light);
  vtkNew<vtkPenumbraDistributedRayCaster> caster;
  caster->SetRenderer(renderer);
  caster->SetResolution(view.Size[0], view.Size[1]);
  caster->SetNumberOfThreads(1);
  view.Set(caster);
  ResetPeakMegabytes();
  caster->Update();
  report.Peak = 1e6 * ReadPeakMegabytes();
  vtkImageData* image = caster->GetOutput();
  vtkDataArray* colors = image->GetPointData()->GetArray("Color");
  if (!colors)
  {
    return {};
  }
  const auto get = [&](const char* name) {
    vtkDataArray* array = caster->GetStatistics()->GetArray(name);
    return array ? array->GetComponent(0, 0) : 0.0;
  };
  report.Rays = get("Rays/Total");
  report.RankRays = get("Exchange/Rays");
  report.SceneBytes = get("Exchange/SceneBytes");
  report.WholeBytes = get("Exchange/WholeBytes");
  report.Primitives = get("Exchange/Primitives");
  report.WholePrimitives = get("Exchange/WholePrimitives");
  if (rank == 0)
  {
    WriteImage(image, path);
  }
  std::string bytes(reinterpret_cast<const char*>(&report), sizeof report);
  return bytes.append(static_cast<const char*>(colors->GetVoidPointer(0)),
    static_cast<std::size_t>(colors->GetNumberOfValues()) * sizeof(float));
}

/// Results of all ranks.
struct Run
{
  std::vector<Report> Reports;
  std::vector<std::string> Colors;

  template <typename Get>
  double Maximum(const Get& get) const
  {
    double maximum = 0.0;
    for (const Report& report : this->Reports)
    {
      maximum = std::max(maximum, get(report));
    }
    return maximum;
  }
};

Run RenderOn(int ranks, const View& view, const std::string& folder)
{
  const std::string path = folder + "/ranks-" + view.Name + "-" + std::to_string(ranks) + ".png";
  Run run;
  for (const RankResult& result : RunRanks(
         ranks, [&](int rank) { return Render(view, rank, ranks, path); }, 1200))
  {
    run.Reports.emplace_back();
    run.Colors.emplace_back();
    if (result.Value.size() > sizeof(Report))
    {
      std::memcpy(&run.Reports.back(), result.Value.data(), sizeof(Report));
      run.Colors.back() = result.Value.substr(sizeof(Report));
    }
  }
  return run;
}

/// How the image of a rank differs from that of one rank.
struct Difference
{
  double Share = 0.0;   ///< of pixels with other bits
  double Maximum = 0.0; ///< of a color component
};

/// Returns the largest differences of the images of all ranks.
Difference CompareBits(const Run& run, const Run& one)
{
  Difference worst;
  const auto* expected = reinterpret_cast<const float*>(one.Colors[0].data());
  const std::size_t values = one.Colors[0].size() / sizeof(float);
  for (const std::string& colors : run.Colors)
  {
    if (colors.size() != one.Colors[0].size() || values == 0)
    {
      return { 1.0, 1.0 };
    }
    const auto* found = reinterpret_cast<const float*>(colors.data());
    std::size_t differ = 0;
    for (std::size_t i = 0; i < values; i += 4)
    {
      differ += std::memcmp(found + i, expected + i, 4 * sizeof(float)) != 0;
      for (std::size_t k = i; k < i + 4; ++k)
      {
        worst.Maximum = std::max<double>(worst.Maximum, std::abs(found[k] - expected[k]));
      }
    }
    worst.Share = std::max(worst.Share, 4.0 * static_cast<double>(differ) / values);
  }
  return worst;
}

/// Adds the comparison of the bits to the results.
void AddComparison(
  const std::string& scene, const Run& run, const Run& one, const char* remark, Options& options)
{
  const Difference difference = CompareBits(run, one);
  char text[200];
  std::snprintf(text, sizeof text, "largest difference %.2g%s", difference.Maximum, remark);
  options.Results.Add(scene, "share of pixels with other bits than on one rank", difference.Share,
    TargetKind::AtMost, 0.0, text);
}

void MeasurePlain(const View& view, Options& options)
{
  const Run one = RenderOn(1, view, options.Output);
  for (const int ranks : { 2, 4, 8 })
  {
    const Run run = RenderOn(ranks, view, options.Output);
    const std::string scene = "plain view, " + std::to_string(ranks) + " ranks";
    const bool isLast = ranks == 8;
    char remark[200];
    AddComparison(scene, run, one, "", options);
    const double bytes = run.Maximum([](const Report& r) { return r.SceneBytes; });
    std::snprintf(remark, sizeof remark,
      "%.1f of %.1f MB; the rank then has %.0f of %.0f triangles", 1e-6 * bytes,
      1e-6 * run.Reports[0].WholeBytes, run.Maximum([](const Report& r) { return r.Primitives; }),
      run.Reports[0].WholePrimitives);
    options.Results.Add(scene, "bytes received by the rank that receives most / of the whole scene",
      bytes / run.Reports[0].WholeBytes, isLast ? TargetKind::AtMost : TargetKind::None, 0.05,
      remark);
    const auto getPeak = [](const Report& r) { return r.Peak; };
    const double peak = run.Maximum(getPeak);
    const double peakOfOne = one.Maximum(getPeak);
    std::snprintf(remark, sizeof remark, "%.0f and %.0f MB, of which the data set %.0f and %.0f MB",
      1e-6 * peak, 1e-6 * peakOfOne, 1e-6 * run.Maximum([](const Report& r) { return r.Input; }),
      1e-6 * one.Reports[0].Input);
    options.Results.Add(scene, "peak memory of a rank / of one rank", peak / peakOfOne,
      isLast ? TargetKind::AtMost : TargetKind::None, 0.25, remark);
    const double rays = run.Maximum([](const Report& r) { return r.RankRays; });
    std::snprintf(remark, sizeof remark, "%.0f of %.0f rays", rays, one.Reports[0].Rays);
    options.Results.Add(scene, "rays of the rank that traces most / of one rank",
      rays / one.Reports[0].Rays, isLast ? TargetKind::AtMost : TargetKind::None, 0.2, remark);
  }
}

/// Bakes the blocks of a rank together with the other ranks. Returns the report and the values.
std::string Bake(const std::function<void(vtkPenumbraIrradianceFilter*)>& set, int rank, int ranks)
{
  vtkNew<vtkPenumbraDistributedIrradianceFilter> filter;
  filter->SetInputData(0, MakePiece(rank, ranks, CellsOfBaking));
  filter->SetMethodToBruteForce();
  filter->SetTolerance(0.1);
  filter->SetNumberOfThreads(1);
  set(filter);
  filter->Update();
  const auto get = [&](const char* name) {
    vtkDataArray* array = filter->GetStatistics()->GetArray(name);
    return array ? array->GetComponent(0, 0) : 0.0;
  };
  Report report{};
  report.SceneBytes = get("Exchange/SceneBytes");
  report.WholeBytes = get("Exchange/WholeBytes");
  report.Primitives = get("Exchange/Primitives");
  report.WholePrimitives = get("Exchange/WholePrimitives");
  std::string bytes(reinterpret_cast<const char*>(&report), sizeof report);
  vtkDataArray* values = vtkDataSet::SafeDownCast(filter->GetOutputDataObject(0))
                           ->GetPointData()
                           ->GetArray(filter->GetQuantityAsString());
  return values ? bytes.append(static_cast<const char*>(values->GetVoidPointer(0)),
                    static_cast<std::size_t>(values->GetNumberOfValues()) * sizeof(float))
                : bytes;
}

void MeasureBaking(
  const char* name, const std::function<void(vtkPenumbraIrradianceFilter*)>& set, Options& options)
{
  std::string expected;
  for (const int ranks : { 1, 2, 4, 8 })
  {
    std::string values;
    double most = 0.0;
    double triangles = 0.0;
    double whole = 0.0;
    Report report{};
    for (const RankResult& result : RunRanks(
           ranks, [&](int rank) { return Bake(set, rank, ranks); }, 1200))
    {
      if (!result.HasReturned || result.Value.size() < sizeof report)
      {
        throw std::runtime_error(std::string("a rank of ") + name + " has failed");
      }
      std::memcpy(&report, result.Value.data(), sizeof report);
      values += result.Value.substr(sizeof report);
      most = std::max(most, report.SceneBytes / report.WholeBytes);
      triangles = std::max(triangles, report.Primitives);
      whole = report.WholePrimitives;
    }
    if (ranks == 1)
    {
      expected = values;
      continue;
    }
    if (values.size() != expected.size() || expected.empty())
    {
      throw std::runtime_error(std::string("ranks of ") + name + " lack values");
    }
    std::size_t differ = 0;
    for (std::size_t i = 0; i < expected.size(); i += sizeof(float))
    {
      differ += values.compare(i, sizeof(float), expected, i, sizeof(float)) != 0;
    }
    const std::string scene = std::string(name) + ", " + std::to_string(ranks) + " ranks";
    char remark[200];
    std::snprintf(remark, sizeof remark, "of %zu values", expected.size() / sizeof(float));
    options.Results.Add(scene, "share of values with other bits than on one rank",
      static_cast<double>(differ * sizeof(float)) / static_cast<double>(expected.size()),
      TargetKind::AtMost, 0.0, remark);
    std::snprintf(
      remark, sizeof remark, "the rank then has %.0f of %.0f triangles", triangles, whole);
    options.Results.Add(scene, "bytes received by the rank that receives most / of the whole scene",
      most, TargetKind::None, 0.0, remark);
  }
}

void MeasureEffect(const View& view, Options& options)
{
  const Run one = RenderOn(1, view, options.Output);
  for (const int ranks : { 2, 4, 8 })
  {
    const Run run = RenderOn(ranks, view, options.Output);
    const std::string scene = std::string(view.Name) + ", " + std::to_string(ranks) + " ranks";
    AddComparison(scene, run, one, "", options);
    const double bytes = run.Maximum([](const Report& r) { return r.SceneBytes; });
    const double rays = run.Maximum([](const Report& r) { return r.RankRays; });
    char remark[200];
    std::snprintf(remark, sizeof remark, "rays of the rank that traces most / of one rank: %.3f",
      rays / one.Reports[0].Rays);
    options.Results.Add(scene, "bytes received by the rank that receives most / of the whole scene",
      bytes / run.Reports[0].WholeBytes, TargetKind::None, 0.0, remark);
  }
}

}

void MeasureRanks(Options& options)
{
  MeasurePlain(
    { "plain", { 1000, 600 }, CellsPerBlock, 1.0, [](vtkPenumbraRayCaster*) {} }, options);
  MeasureEffect(
    { "glass", { 320, 192 }, CellsOfEffects, 0.3, [](vtkPenumbraRayCaster*) {} }, options);
  MeasureEffect({ "shadows", { 320, 192 }, CellsOfEffects, 1.0,
                  [](vtkPenumbraRayCaster* caster) { caster->ShadowsOn(); } },
    options);
  MeasureEffect({ "soft-shadows", { 320, 192 }, CellsOfEffects, 1.0,
                  [](vtkPenumbraRayCaster* caster) {
                    caster->ShadowsOn();
                    caster->SetLightAngle(2.0);
                  } },
    options);
  MeasureEffect({ "occlusion", { 320, 192 }, CellsOfEffects, 1.0,
                  [](vtkPenumbraRayCaster* caster) {
                    caster->AmbientOcclusionOn();
                    caster->SetAmbientOcclusionRadius(0.1);
                  } },
    options);
}

void MeasureBakingOnRanks(Options& options)
{
  MeasureBaking(
    "baked occlusion", [](vtkPenumbraIrradianceFilter* filter) { filter->SetRadius(0.1); },
    options);
  for (const double angle : { 0.0, 0.53 })
  {
    MeasureBaking(
      angle > 0.0 ? "baked light of the sun" : "baked light of a direction",
      [=](vtkPenumbraIrradianceFilter* filter) {
        filter->SetQuantityToDirectLight();
        filter->AddLight(3.0, 6.0, 4.0, 0.0);
        filter->SetLightAngle(angle);
      },
      options);
  }
  MeasureBaking(
    "baked irradiance",
    [](vtkPenumbraIrradianceFilter* filter) {
      filter->SetQuantityToIrradiance();
      filter->SetBounces(2);
      filter->SetTolerance(0.5);
    },
    options);
}
