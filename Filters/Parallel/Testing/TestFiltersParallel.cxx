// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// All images are rendered in processes of their own, see ForkedRanks.h.
#include "ForkedRanks.h"

#include "vtkActor.h"
#include "vtkAppendPolyData.h"
#include "vtkCallbackCommand.h"
#include "vtkCamera.h"
#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkFieldData.h"
#include "vtkImageData.h"
#include "vtkLight.h"
#include "vtkLightCollection.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkNew.h"
#include "vtkPenumbraDistributedIrradianceFilter.h"
#include "vtkPenumbraDistributedRayCaster.h"
#include "vtkPenumbraRayCasterConstants.h"
#include "vtkPlaneSource.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkPolyDataMapper.h"
#include "vtkProperty.h"
#include "vtkRenderer.h"
#include "vtkSphereSource.h"
#include "vtkUnsignedCharArray.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <functional>
#include <map>
#include <string>
#include <vector>

namespace
{

using penumbra::RankResult;
using penumbra::RunRanks;

using Caster = vtkPenumbraRayCaster;
using Settings = std::function<void(Caster*)>;

constexpr int Width = 150;
constexpr int Height = 110;

/// Returns the strip `part` of `parts` of a bumpy sphere with the center (x, 0, 3 x). Points of both sides
/// of a seam are equal.
vtkSmartPointer<vtkPolyData> MakeStrip(int part, int parts, double x, int resolution)
{
  vtkNew<vtkSphereSource> sphere;
  sphere->SetThetaResolution(resolution);
  sphere->SetPhiResolution(resolution);
  sphere->SetStartTheta(360.0 * part / parts + 7.0);
  sphere->SetEndTheta(360.0 * (part + 1) / parts + 7.0);
  sphere->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
  sphere->Update();
  auto strip = vtkSmartPointer<vtkPolyData>::New();
  strip->DeepCopy(sphere->GetOutput());
  for (vtkIdType i = 0; i < strip->GetNumberOfPoints(); ++i)
  {
    double p[3];
    strip->GetPoint(i, p);
    for (double& c : p)
    {
      c = std::round(1e6 * c) / 1e6;
    }
    const double bump = 1.0 + 0.2 * std::sin(9.0 * p[1]) * std::sin(7.0 * p[2]);
    strip->GetPoints()->SetPoint(i, x + bump * p[0], bump * p[1], 3.0 * x + bump * p[2]);
  }
  strip->GetPointData()->Initialize();
  return strip;
}

/// Returns what rank `rank` of `ranks` has: strips of three surfaces that hide each other.
vtkSmartPointer<vtkPolyData> MakePiece(int rank, int ranks, int resolution = 60)
{
  vtkNew<vtkAppendPolyData> append;
  for (const double x : { -0.4, 0.0, 0.5 })
  {
    append->AddInputData(MakeStrip(rank, ranks, x, resolution));
  }
  append->Update();
  return append->GetOutput();
}

/// Describes the pixels and the statistics of an image by name, in every bit.
std::map<std::string, std::string> Describe(vtkImageData* image)
{
  std::map<std::string, std::string> result;
  vtkFieldData* const all[] = { image->GetPointData(), image->GetFieldData() };
  for (vtkFieldData* fields : all)
  {
    const std::string prefix = fields == all[0] ? "" : "Statistics/";
    for (int i = 0; i < fields->GetNumberOfArrays(); ++i)
    {
      vtkDataArray* array = fields->GetArray(i);
      const char* bytes = static_cast<const char*>(array->GetVoidPointer(0));
      result[prefix + array->GetName()] =
        std::string(bytes, bytes + array->GetNumberOfValues() * array->GetDataTypeSize());
    }
  }
  return result;
}

std::string Pack(const std::map<std::string, std::string>& arrays)
{
  std::string bytes;
  for (const auto& [name, value] : arrays)
  {
    bytes += name + '\n' + std::to_string(value.size()) + '\n' + value;
  }
  return bytes;
}

std::map<std::string, std::string> Unpack(const std::string& bytes)
{
  std::map<std::string, std::string> arrays;
  for (std::size_t at = 0; at < bytes.size();)
  {
    const std::size_t name = bytes.find('\n', at);
    const std::size_t size = bytes.find('\n', name + 1);
    const std::size_t length = std::stoul(bytes.substr(name + 1, size - name - 1));
    arrays[bytes.substr(at, name - at)] = bytes.substr(size + 1, length);
    at = size + 1 + length;
  }
  return arrays;
}

/// Renders the data with a ray caster; "Error" and "Warning" are its messages.
std::map<std::string, std::string> Render(
  Caster* caster, const std::vector<vtkDataObject*>& data, const Settings& settings)
{
  std::map<std::string, std::string> messages;
  vtkNew<vtkCallbackCommand> keep;
  keep->SetClientData(&messages);
  keep->SetCallback([](vtkObject*, unsigned long event, void* to, void* text) {
    auto& kept = *static_cast<std::map<std::string, std::string>*>(to);
    kept[event == vtkCommand::ErrorEvent ? "Error" : "Warning"] += static_cast<const char*>(text);
  });
  caster->AddObserver(vtkCommand::ErrorEvent, keep);
  caster->AddObserver(vtkCommand::WarningEvent, keep);
  caster->SetResolution(Width, Height);
  settings(caster);
  for (vtkDataObject* each : data)
  {
    caster->AddInputDataObject(each);
  }
  caster->Update();
  std::map<std::string, std::string> result = Describe(caster->GetOutput());
  result.insert(messages.begin(), messages.end());
  return result;
}

using Image = std::map<std::string, std::string>;
using MakeData = std::function<vtkSmartPointer<vtkDataObject>(int rank, int ranks)>;

/// Renders the data of each of several ranks together.
std::vector<Image> RenderOnRanks(int ranks, const MakeData& make, const Settings& settings)
{
  std::vector<Image> images;
  for (const RankResult& result : RunRanks(ranks, [&](int rank) {
         vtkNew<vtkPenumbraDistributedRayCaster> caster;
         caster->SetNumberOfThreads(1 + rank % 2);
         return Pack(Render(caster, { make(rank, ranks) }, settings));
       }))
  {
    EXPECT_TRUE(result.HasReturned);
    images.push_back(Unpack(result.Value));
  }
  return images;
}

/// Renders the data of all ranks, appended, on one rank.
Image RenderOnOne(int ranks, const MakeData& make, const Settings& settings)
{
  const RankResult result = RunRanks(1, [&](int) {
    vtkNew<vtkAppendPolyData> append;
    for (int rank = 0; rank < ranks; ++rank)
    {
      append->AddInputData(vtkPolyData::SafeDownCast(make(rank, ranks)));
    }
    append->Update();
    vtkNew<vtkPenumbraRayCaster> caster;
    return Pack(Render(caster, { append->GetOutput() }, settings));
  })[0];
  EXPECT_TRUE(result.HasReturned);
  return Unpack(result.Value);
}

double GetNumber(const Image& image, const char* name)
{
  const auto found = image.find(name);
  double value = std::nan("");
  if (found != image.end() && found->second.size() == sizeof value)
  {
    std::memcpy(&value, found->second.data(), sizeof value);
  }
  return value;
}

/// Expects the same arrays and statistics in every bit, except for what depends on the division, and no
/// warnings but where they are expected.
void ExpectSame(const Image& image, const Image& expected)
{
  for (const auto& [name, value] : image)
  {
    EXPECT_TRUE(expected.count(name) != 0 || name.rfind("Statistics/Exchange/", 0) == 0) << name;
  }
  for (const auto& [name, value] : expected)
  {
    if (name == "Warning") // contains an address
    {
      continue;
    }
    const auto found = image.find(name);
    ASSERT_NE(found, image.end()) << name;
    if (name != "Statistics/Rays/Repeated" && name != "CellId" &&
      name.rfind("Statistics/Exchange/", 0) != 0)
    {
      EXPECT_TRUE(found->second == value) << name << ": " << GetNumber(image, name.c_str()) << ", "
                                          << GetNumber(expected, name.c_str());
    }
  }
}

void UseDefaults(Caster*) {}

/// Expects the image of each of several ranks to equal that of one rank with the data of all.
Image ExpectSameOnRanks(int ranks, const MakeData& make, const Settings& settings)
{
  const Image expected = RenderOnOne(ranks, make, settings);
  EXPECT_EQ(expected.at("Color").size(), 16u * Width * Height);
  EXPECT_EQ(expected.count("Error"), 0u);
  for (const Image& image : RenderOnRanks(ranks, make, settings))
  {
    ExpectSame(image, expected);
  }
  return expected;
}

const MakeData MakeCoarse = [](int rank, int ranks) { return MakePiece(rank, ranks, 10); };

/// Returns the pieces with colors of their points or cells.
vtkSmartPointer<vtkPolyData> MakeColored(int rank, int ranks, bool cells, int alpha)
{
  vtkSmartPointer<vtkPolyData> piece = MakePiece(rank, ranks, 10);
  vtkNew<vtkUnsignedCharArray> colors;
  colors->SetName("Colors");
  colors->SetNumberOfComponents(4);
  const vtkIdType count = cells ? piece->GetNumberOfCells() : piece->GetNumberOfPoints();
  for (vtkIdType i = 0; i < count; ++i)
  {
    colors->InsertNextTuple4(i * 37 % 256, i * 11 % 256, 100 + 50 * rank, i % 5 == 0 ? alpha : 255);
  }
  (cells ? static_cast<vtkFieldData*>(piece->GetCellData()) : piece->GetPointData())
    ->AddArray(colors);
  cells ? piece->GetCellData()->SetActiveScalars("Colors")
        : piece->GetPointData()->SetActiveScalars("Colors");
  return piece;
}

/// Returns some of the points or lines of a helix.
vtkSmartPointer<vtkPolyData> MakeHelix(int rank, int ranks, bool lines)
{
  auto piece = vtkSmartPointer<vtkPolyData>::New();
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> cells;
  constexpr int All = 120;
  const int first = rank * All / ranks;
  const int last = (rank + 1) * All / ranks;
  for (int i = first; i <= last; ++i)
  {
    points->InsertNextPoint(std::cos(0.3 * i), 0.02 * i, std::sin(0.3 * i));
  }
  for (vtkIdType i = 0; i < last - first; ++i)
  {
    const vtkIdType ends[2] = { i, i + 1 };
    lines ? cells->InsertNextCell(2, ends) : cells->InsertNextCell(1, ends);
  }
  piece->SetPoints(points);
  lines ? piece->SetLines(cells) : piece->SetVerts(cells);
  return piece;
}

/// Adds an actor that shows the data to a new renderer with a camera that does not depend on it.
vtkSmartPointer<vtkRenderer> MakeRenderer(
  vtkPolyData* data, const std::function<void(vtkActor*)>& change)
{
  auto renderer = vtkSmartPointer<vtkRenderer>::New();
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(data);
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  change(actor);
  renderer->AddActor(actor);
  renderer->SetBackground(0.1, 0.2, 0.3);
  vtkCamera* camera = renderer->GetActiveCamera();
  camera->SetPosition(2.0, 1.5, 6.0);
  camera->SetFocalPoint(0.1, 0.1, 0.1);
  camera->SetClippingRange(0.1, 100.0);
  vtkNew<vtkLight> light;
  light->SetPosition(3.0, 5.0, 4.0);
  renderer->AddLight(light);
  return renderer;
}

/// The same as ExpectSameOnRanks() with a renderer on each rank.
Image ExpectSameViewsOnRanks(int ranks, const MakeData& make,
  const std::function<void(vtkActor*)>& change, const Settings& settings)
{
  const auto view = [&](vtkPolyData* data) {
    return [=](Caster* caster) {
      caster->SetRenderer(MakeRenderer(data, change));
      settings(caster);
    };
  };
  const Image expected = Unpack(RunRanks(1,
    [&](int) {
      vtkNew<vtkAppendPolyData> append;
      for (int rank = 0; rank < ranks; ++rank)
      {
        append->AddInputData(vtkPolyData::SafeDownCast(make(rank, ranks)));
      }
      append->Update();
      vtkNew<vtkPenumbraRayCaster> caster;
      return Pack(Render(caster, {}, view(append->GetOutput())));
    })[0]
                                  .Value);
  EXPECT_EQ(expected.at("Color").size(), 16u * Width * Height);
  for (const RankResult& result : RunRanks(ranks, [&](int rank) {
         vtkNew<vtkPenumbraDistributedRayCaster> caster;
         const vtkSmartPointer<vtkDataObject> piece = make(rank, ranks);
         return Pack(Render(caster, {}, view(vtkPolyData::SafeDownCast(piece))));
       }))
  {
    EXPECT_TRUE(result.HasReturned);
    ExpectSame(Unpack(result.Value), expected);
  }
  return expected;
}

void KeepActor(vtkActor*) {}

}

TEST(vtkPenumbraDistributedRayCaster, MatchesOneRank)
{
  for (const int ranks : { 1, 2, 3, 4, 5, 6, 7, 8 })
  {
    SCOPED_TRACE(ranks);
    const Image image = ExpectSameOnRanks(ranks, MakeCoarse, UseDefaults);
    EXPECT_GT(GetNumber(image, "Statistics/Pixels/SmallObject"), 20.0);
  }
}

TEST(vtkPenumbraDistributedRayCaster, MatchesOneRankWithTrianglesSmallerThanPixels)
{
  const MakeData make = [](int rank, int all) { return MakePiece(rank, all, 60); };
  const Image image = ExpectSameOnRanks(4, make, UseDefaults);
  EXPECT_GT(GetNumber(image, "Statistics/Pixels/Uniform"), 100.0);
}

TEST(vtkPenumbraDistributedRayCaster, MatchesOneRankForAllMethodsAndArrays)
{
  using Methods = penumbra::CoverageMethods;
  for (const Methods method : { Methods::Subdivision, Methods::Uniform })
  {
    ExpectSameOnRanks(
      3, MakeCoarse, [=](Caster* caster) { caster->GetConstants().CoverageMethod = method; });
  }
  const Image image = ExpectSameOnRanks(3, MakeCoarse, [](Caster* caster) {
    caster->GeometryArraysOn();
    caster->GetConstants().OcclusionArray = false;
  });
  EXPECT_EQ(image.at("Depth").size(), 4u * Width * Height);
}

TEST(vtkPenumbraDistributedRayCaster, ExchangesColorsAndOpacity)
{
  for (const bool cells : { false, true })
  {
    for (const int alpha : { 255, 90 })
    {
      SCOPED_TRACE(testing::Message() << cells << " " << alpha);
      const MakeData make = [=](int rank, int ranks) {
        return MakeColored(rank, ranks, cells, alpha);
      };
      ExpectSameViewsOnRanks(3, make, KeepActor, UseDefaults);
    }
  }
  ExpectSameViewsOnRanks(
    8, MakeCoarse, [](vtkActor* actor) { actor->GetProperty()->SetOpacity(0.4); }, UseDefaults);
  ExpectSameViewsOnRanks(
    4, MakeCoarse, [](vtkActor* actor) { actor->GetProperty()->EdgeVisibilityOn(); }, UseDefaults);
}

TEST(vtkPenumbraDistributedRayCaster, ExchangesPointsLinesSpheresAndTubes)
{
  for (const bool lines : { false, true })
  {
    const MakeData make = [=](int rank, int ranks) { return MakeHelix(rank, ranks, lines); };
    for (const double radius : { 0.0, 0.1 })
    {
      SCOPED_TRACE(testing::Message() << lines << " " << radius);
      const Image image = ExpectSameViewsOnRanks(
        3, make, [](vtkActor* actor) { actor->GetProperty()->SetLineWidth(3.0); },
        [=](Caster* caster) {
          caster->SetPointRadius(radius);
          caster->SetLineRadius(radius);
        });
      EXPECT_GT(GetNumber(image, "Statistics/Edges/Projected"), 100.0);
    }
  }
}

TEST(vtkPenumbraDistributedRayCaster, ReceivesWhatCastsHardShadows)
{
  // Spheres in a row along the light, each of which casts a shadow on those behind it.
  const MakeData make = [](int rank, int) {
    vtkNew<vtkSphereSource> sphere;
    sphere->SetCenter(1.5 * rank, 0.3 * (rank % 2), 0.0);
    sphere->SetThetaResolution(70);
    sphere->SetPhiResolution(70);
    sphere->Update();
    return vtkSmartPointer<vtkPolyData>(sphere->GetOutput());
  };
  const auto view = [&](vtkPolyData* data, bool isPositional) {
    const vtkSmartPointer<vtkRenderer> renderer = MakeRenderer(data, KeepActor);
    renderer->GetActiveCamera()->SetPosition(2.2, 1.0, 9.0);
    renderer->GetActiveCamera()->SetFocalPoint(2.2, 0.0, 0.0);
    auto* light = vtkLight::SafeDownCast(renderer->GetLights()->GetItemAsObject(0));
    light->SetPositional(isPositional);
    light->SetPosition(9.0, isPositional ? 0.2 : 1.0, 1.0);
    light->SetConeAngle(180.0);
    return renderer;
  };
  for (const bool isPositional : { false, true })
  {
    SCOPED_TRACE(isPositional);
    const auto render = [&](Caster* caster, vtkPolyData* data, bool hasShadows) {
      return Render(caster, {}, [&](Caster* c) {
        c->SetRenderer(view(data, isPositional));
        c->SetShadows(hasShadows);
      });
    };
    const auto renderAll = [&](bool hasShadows) {
      return Unpack(RunRanks(1,
        [&](int) {
          vtkNew<vtkAppendPolyData> append;
          for (int rank = 0; rank < 4; ++rank)
          {
            append->AddInputData(vtkPolyData::SafeDownCast(make(rank, 4)));
          }
          append->Update();
          return Pack(render(vtkNew<vtkPenumbraRayCaster>(), append->GetOutput(), hasShadows));
        })[0]
                      .Value);
    };
    const Image expected = renderAll(true);
    EXPECT_NE(expected.at("Color"), renderAll(false).at("Color"));
    double received = 0.0;
    for (const RankResult& result : RunRanks(4, [&](int rank) {
           return Pack(render(vtkNew<vtkPenumbraDistributedRayCaster>(),
             vtkPolyData::SafeDownCast(make(rank, 4)), true));
         }))
    {
      const Image image = Unpack(result.Value);
      ExpectSame(image, expected);
      EXPECT_EQ(image.count("Warning"), 0u) << image.at("Warning");
      received += GetNumber(image, "Statistics/Exchange/SceneBytes") /
        GetNumber(image, "Statistics/Exchange/WholeBytes");
    }
    EXPECT_LT(received, 1.2); // all surfaces: 1.6
  }
}

TEST(vtkPenumbraDistributedRayCaster, MatchesOneRankWithHardShadows)
{
  for (const double opacity : { 1.0, 0.4 })
  {
    for (const double z : { 4.0, -1.0 })
    {
      SCOPED_TRACE(testing::Message() << opacity << " " << z);
      ExpectSameViewsOnRanks(
        3, MakeCoarse, [=](vtkActor* actor) { actor->GetProperty()->SetOpacity(opacity); },
        [=](Caster* caster) {
          caster->ShadowsOn();
          vtkLightCollection* const lights = caster->GetRenderer()->GetLights();
          vtkLight::SafeDownCast(lights->GetItemAsObject(0))->SetPosition(3.0, 5.0, z);
        });
    }
  }
}

TEST(vtkPenumbraDistributedRayCaster, EndsWithLightsAtNoFinitePlace)
{
  struct Case
  {
    bool IsPositional;
    double X;
  };
  for (const Case& each : { Case{ false, 1e160 }, Case{ false, 1e39 }, Case{ true, 1e30 },
         Case{ true, 1e39 }, Case{ true, std::nan("") }, Case{ false, std::nan("") } })
  {
    SCOPED_TRACE(testing::Message() << each.IsPositional << " " << each.X);
    ExpectSameViewsOnRanks(2, MakeCoarse, KeepActor, [=](Caster* caster) {
      caster->ShadowsOn();
      vtkLightCollection* const lights = caster->GetRenderer()->GetLights();
      auto* light = vtkLight::SafeDownCast(lights->GetItemAsObject(0));
      light->SetPositional(each.IsPositional);
      light->SetConeAngle(180.0);
      light->SetPosition(each.X, 0.0, 0.0);
      vtkNew<vtkLight> ordinary;
      ordinary->SetPosition(3.0, 5.0, 4.0);
      caster->GetRenderer()->AddLight(ordinary);
    });
  }
}

TEST(vtkPenumbraDistributedRayCaster, ReceivesPartOfTheScene)
{
  // Blocks side by side: a rank needs little more than its own.
  const MakeData make = [](int rank, int) {
    vtkNew<vtkPlaneSource> plane;
    plane->SetOrigin(rank, 0.0, 0.0);
    plane->SetPoint1(rank + 1.0, 0.0, 0.0);
    plane->SetPoint2(rank, 4.0, 0.0);
    plane->SetResolution(100, 400);
    plane->Update();
    return vtkSmartPointer<vtkPolyData>(plane->GetOutput());
  };
  for (const Image& image : RenderOnRanks(4, make, UseDefaults))
  {
    EXPECT_EQ(GetNumber(image, "Statistics/Exchange/WholePrimitives"), 4.0 * 80000.0);
    EXPECT_LT(GetNumber(image, "Statistics/Exchange/Primitives"), 1.5 * 80000.0);
    EXPECT_GT(GetNumber(image, "Statistics/Exchange/WholeBytes"), 320000.0 * 18.0);
    EXPECT_LT(GetNumber(image, "Statistics/Exchange/SceneBytes"),
      0.2 * GetNumber(image, "Statistics/Exchange/WholeBytes"));
  }
}

TEST(vtkPenumbraDistributedRayCaster, RendersWithRanksWithoutData)
{
  const MakeData make = [](int rank, int ranks) {
    return rank == 1 ? vtkSmartPointer<vtkPolyData>::New() : MakePiece(rank, ranks, 10);
  };
  ExpectSameOnRanks(3, make, UseDefaults);
  const MakeData none = [](int, int) { return vtkSmartPointer<vtkPolyData>::New(); };
  ExpectSameOnRanks(2, none, UseDefaults);
}

TEST(vtkPenumbraDistributedRayCaster, RendersBlocksAsOneSurface)
{
  const MakeData blocks = [](int rank, int ranks) {
    auto all = vtkSmartPointer<vtkMultiBlockDataSet>::New();
    all->SetBlock(0, MakePiece(2 * rank, 2 * ranks, 10));
    all->SetBlock(1, MakePiece(2 * rank + 1, 2 * ranks, 10));
    return all;
  };
  const Image expected = RenderOnOne(4, MakeCoarse, UseDefaults);
  for (const Image& image : RenderOnRanks(2, blocks, UseDefaults))
  {
    ExpectSame(image, expected);
  }
}

TEST(vtkPenumbraDistributedRayCaster, GathersForLightWithOneWarning)
{
  const std::vector<Image> images = RenderOnRanks(2, MakeCoarse, [](Caster* caster) {
    caster->AmbientOcclusionOn();
    caster->SetTolerance(0.05);
  });
  EXPECT_NE(images[0].at("Warning").find("bytes"), std::string::npos);
  EXPECT_EQ(images[1].count("Warning"), 0u);
  EXPECT_EQ(GetNumber(images[0], "Statistics/Exchange/Primitives"),
    GetNumber(images[0], "Statistics/Exchange/WholePrimitives"));
}

TEST(vtkPenumbraDistributedRayCaster, NamesASettingThatRanksDisagreeAbout)
{
  const auto disagree = [](const char* name, const std::function<void(Caster*, int)>& set) {
    SCOPED_TRACE(name);
    for (const RankResult& result : RunRanks(3, [&](int rank) {
           vtkNew<vtkPenumbraDistributedRayCaster> caster;
           return Pack(Render(caster, { MakeCoarse(rank, 3) }, [&](Caster* c) { set(c, rank); }));
         }))
    {
      EXPECT_TRUE(result.HasReturned);
      const Image image = Unpack(result.Value);
      ASSERT_EQ(image.count("Error"), 1u);
      const std::string expected = std::string("The ranks 0 and 2 disagree about ") + name + ".";
      EXPECT_NE(image.at("Error").find(expected), std::string::npos) << image.at("Error");
      EXPECT_EQ(image.count("Color"), 0u);
    }
  };
  disagree(
    "Resolution", [](Caster* c, int rank) { c->SetResolution(Width + (rank == 2), Height); });
  disagree("Tolerance", [](Caster* c, int rank) { c->SetTolerance(rank == 2 ? 0.1 : 0.01); });
  disagree("the position of the camera", [](Caster* c, int rank) {
    const vtkSmartPointer<vtkRenderer> renderer = MakeRenderer(MakePiece(rank, 3, 10), KeepActor);
    renderer->GetActiveCamera()->SetPosition(2.0, 1.5, rank == 2 ? 6.1 : 6.0);
    c->SetRenderer(renderer);
  });
}

TEST(vtkPenumbraDistributedRayCaster, EndsOnAllRanksIfOneFails)
{
  for (const RankResult& result : RunRanks(3, [](int rank) {
         vtkNew<vtkPenumbraDistributedRayCaster> caster;
         return Pack(Render(caster, { MakeCoarse(rank, 3) }, [=](Caster* c) {
           if (rank == 1)
           {
             c->SetTolerance(std::nan(""));
           }
         }));
       }))
  {
    EXPECT_TRUE(result.HasReturned);
    const Image image = Unpack(result.Value);
    ASSERT_EQ(image.count("Error"), 1u);
    EXPECT_NE(image.at("Error").find("Rank 1: Tolerance"), std::string::npos) << image.at("Error");
  }
}

TEST(vtkPenumbraDistributedIrradianceFilter, MatchesItsSuperclassOnOneRank)
{
  const auto bake = [](vtkPenumbraIrradianceFilter* filter) {
    vtkNew<vtkSphereSource> sphere;
    filter->SetInputConnection(0, sphere->GetOutputPort());
    filter->Update();
    std::string values;
    vtkDataArray* array = vtkDataSet::SafeDownCast(filter->GetOutputDataObject(0))
                            ->GetPointData()
                            ->GetArray("AmbientOcclusion");
    for (vtkIdType i = 0; array && i < array->GetNumberOfTuples(); ++i)
    {
      values += std::to_string(array->GetComponent(i, 0)) + " ";
    }
    return values;
  };
  const std::string baked =
    RunRanks(1, [&](int) { return bake(vtkNew<vtkPenumbraIrradianceFilter>()); })[0].Value;
  ASSERT_FALSE(baked.empty());
  const auto distributed =
    RunRanks(1, [&](int) { return bake(vtkNew<vtkPenumbraDistributedIrradianceFilter>()); });
  EXPECT_EQ(distributed[0].Value, baked);
}
