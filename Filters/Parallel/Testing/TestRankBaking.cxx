// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Values that several ranks bake together, compared with those of one rank that has the data of all. All are
// computed in separate processes, see ForkedRanks.h.
#include "ForkedRanks.h"
#include "RankImages.h"

#include "vtkAppendPolyData.h"
#include "vtkCallbackCommand.h"
#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkCommand.h"
#include "vtkDataArray.h"
#include "vtkDataSet.h"
#include "vtkDataSetAttributes.h"
#include "vtkDoubleArray.h"
#include "vtkExecutive.h"
#include "vtkFieldData.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkNew.h"
#include "vtkPenumbraDistributedIrradianceFilter.h"
#include "vtkPlaneSource.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkSphereSource.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>
#include <limits>
#include <string>
#include <vector>

namespace
{

using namespace penumbra;

using Filter = vtkPenumbraIrradianceFilter;
using FilterSettings = std::function<void(Filter*)>;
using MakeMesh = std::function<vtkSmartPointer<vtkPolyData>(int rank, int ranks)>;

/// Returns the baked values and the statistics by name; "Error" and "Warning" are messages.
Image Bake(Filter* filter, vtkDataObject* data, const FilterSettings& settings)
{
  Image result;
  vtkNew<vtkCallbackCommand> keep;
  keep->SetClientData(&result);
  keep->SetCallback([](vtkObject*, unsigned long event, void* to, void* text) {
    auto& kept = *static_cast<Image*>(to);
    kept[event == vtkCommand::ErrorEvent ? "Error" : "Warning"] += static_cast<const char*>(text);
  });
  filter->AddObserver(vtkCommand::ErrorEvent, keep);
  filter->AddObserver(vtkCommand::WarningEvent, keep);
  filter->GetExecutive()->AddObserver(vtkCommand::ErrorEvent, vtkNew<vtkCallbackCommand>());
  filter->SetMethodToBruteForce();
  filter->SetTolerance(0.1);
  settings(filter);
  filter->SetInputDataObject(0, data);
  filter->Update();
  const auto write = [](vtkDataArray* array) {
    const char* bytes = static_cast<const char*>(array->GetVoidPointer(0));
    return std::string(bytes, array->GetNumberOfValues() * array->GetDataTypeSize());
  };
  std::vector<vtkDataObject*> parts = { filter->GetOutputDataObject(0) };
  if (auto* blocks = vtkMultiBlockDataSet::SafeDownCast(parts[0]))
  {
    parts = { blocks->GetBlock(0), blocks->GetBlock(1) };
  }
  for (vtkDataObject* part : parts)
  {
    auto* const set = vtkDataSet::SafeDownCast(part);
    vtkDataSetAttributes* const attributes = filter->GetOnCells()
      ? static_cast<vtkDataSetAttributes*>(set->GetCellData())
      : static_cast<vtkDataSetAttributes*>(set->GetPointData());
    vtkDataArray* values = attributes->GetArray(filter->GetQuantityAsString());
    result["Values"] += values ? write(values) : "";
  }
  vtkFieldData* const statistics = filter->GetStatistics();
  for (int i = 0; i < statistics->GetNumberOfArrays(); ++i)
  {
    result[std::string("Statistics/") + statistics->GetArrayName(i)] =
      write(statistics->GetArray(i));
  }
  return result;
}

std::vector<Image> BakeOnRanks(int ranks, const MakeMesh& make, const FilterSettings& settings)
{
  std::vector<Image> results;
  for (const RankResult& result : RunRanks(ranks, [&](int rank) {
         vtkNew<vtkPenumbraDistributedIrradianceFilter> filter;
         filter->SetNumberOfThreads(1 + rank % 2);
         return Pack(Bake(filter, make(rank, ranks), settings));
       }))
  {
    EXPECT_TRUE(result.HasReturned);
    results.push_back(Unpack(result.Value));
  }
  return results;
}

Image BakeOnOne(int ranks, const MakeMesh& make, const FilterSettings& settings)
{
  const RankResult result = RunRanks(1, [&](int) {
    vtkNew<vtkAppendPolyData> append;
    for (int rank = 0; rank < ranks; ++rank)
    {
      append->AddInputData(make(rank, ranks));
    }
    append->Update();
    return Pack(Bake(vtkNew<Filter>(), append->GetOutput(), settings));
  })[0];
  EXPECT_TRUE(result.HasReturned);
  return Unpack(result.Value);
}

std::vector<float> GetValues(const Image& baked)
{
  const std::string& bytes = baked.at("Values");
  std::vector<float> values(bytes.size() / sizeof(float));
  if (!values.empty())
  {
    std::memcpy(values.data(), bytes.data(), bytes.size());
  }
  return values;
}

/// Returns the values of several ranks, which equal those of one rank with the data of all in every bit.
std::vector<float> ExpectSameValues(int ranks, const MakeMesh& make, const FilterSettings& settings)
{
  const Image expected = BakeOnOne(ranks, make, settings);
  EXPECT_EQ(expected.count("Error"), 0u);
  const std::vector<Image> parts = BakeOnRanks(ranks, make, settings);
  for (const Image& part : parts)
  {
    EXPECT_EQ(part.count("Error"), 0u);
  }
  EXPECT_FALSE(expected.at("Values").empty());
  const std::vector<float> values = GetValues(expected);
  std::vector<float> joined;
  for (const Image& part : parts)
  {
    const std::vector<float> own = GetValues(part);
    joined.insert(joined.end(), own.begin(), own.end());
  }
  EXPECT_EQ(joined.size(), values.size());
  std::size_t differences = 0;
  float largest = 0.f;
  for (std::size_t i = 0; i < std::min(joined.size(), values.size()); ++i)
  {
    differences += joined[i] != values[i];
    largest = std::max(largest, std::abs(joined[i] - values[i]));
  }
  EXPECT_EQ(differences, 0u) << "of " << values.size() << ", by up to " << largest;
  return values;
}

double ComputeMean(const std::vector<float>& values)
{
  double sum = 0.0;
  for (const float value : values)
  {
    sum += value;
  }
  return sum / static_cast<double>(values.size());
}

/// Returns some of the strips of the surfaces of MakePiece(), with an opacity that differs between ranks.
vtkSmartPointer<vtkPolyData> MakeMeshPiece(int rank, int ranks)
{
  vtkSmartPointer<vtkPolyData> piece = MakePiece(rank, ranks, 16);
  vtkNew<vtkDoubleArray> opacity;
  opacity->SetName("Opacity");
  for (vtkIdType i = 0; i < piece->GetNumberOfPoints(); ++i)
  {
    opacity->InsertNextValue(rank % 2 == 0 ? 0.4 : 0.8);
  }
  piece->GetPointData()->AddArray(opacity);
  return piece;
}

/// Adds vertices and lines between the surfaces to a piece.
vtkSmartPointer<vtkPolyData> MakePieceWithRoundShapes(int rank, int ranks)
{
  const vtkSmartPointer<vtkPolyData> mesh = MakeMeshPiece(rank, ranks);
  auto piece = vtkSmartPointer<vtkPolyData>::New();
  piece->DeepCopy(mesh);
  constexpr int count = 12;
  AddVerticesAndLines(piece, rank, count, -1.0);
  auto* opacity = vtkDoubleArray::SafeDownCast(piece->GetPointData()->GetArray("Opacity"));
  for (int i = 0; i < count; ++i)
  {
    opacity->InsertNextValue(1.0);
  }
  return piece;
}

/// Blocks side by side along x.
vtkSmartPointer<vtkPolyData> MakeBlock(int rank, int)
{
  vtkNew<vtkAppendPolyData> append;
  for (int i = 0; i < 2; ++i)
  {
    vtkNew<vtkPlaneSource> plane;
    plane->SetOrigin(rank, 0.0, 0.5 * i);
    plane->SetPoint1(rank + 1.0, 0.0, 0.5 * i);
    plane->SetPoint2(rank, 1.0 - 0.5 * i, 0.5 * i);
    plane->SetResolution(20, 20);
    plane->Update();
    append->AddInputData(plane->GetOutput());
  }
  append->Update();
  return append->GetOutput();
}

void UseFilterDefaults(Filter*) {}

void UseOpacityAndRadii(Filter* filter)
{
  filter->SetOpacityArray("Opacity");
  filter->SetPointRadius(0.1);
  filter->SetLineRadius(0.05);
}

}

TEST(vtkPenumbraDistributedIrradianceFilter, MatchesItsSuperclassOnOneRank)
{
  const Image expected = BakeOnOne(1, MakeMeshPiece, UseFilterDefaults);
  ASSERT_FALSE(expected.at("Values").empty());
  EXPECT_EQ(BakeOnRanks(1, MakeMeshPiece, UseFilterDefaults)[0], expected);
}

TEST(vtkPenumbraDistributedIrradianceFilter, MatchesOneRank)
{
  for (const int ranks : { 2, 3, 4, 8 })
  {
    SCOPED_TRACE(ranks);
    const std::vector<float> values = ExpectSameValues(ranks, MakeMeshPiece, UseFilterDefaults);
    EXPECT_GT(ComputeMean(values), 0.02);
  }
}

TEST(vtkPenumbraDistributedIrradianceFilter, KeepsOpacity)
{
  const auto bake = [](const char* array) {
    return ComputeMean(ExpectSameValues(3, MakeMeshPiece, [array](Filter* filter) {
      filter->SetOpacityArray(array);
      filter->SetRadius(1.0);
    }));
  };
  EXPECT_LT(bake("Opacity"), 0.8 * bake(nullptr));
}

TEST(vtkPenumbraDistributedIrradianceFilter, KeepsSpheresAndTubes)
{
  const auto bake = [](double radius) {
    return ComputeMean(ExpectSameValues(3, MakePieceWithRoundShapes, [radius](Filter* filter) {
      filter->SetPointRadius(2.0 * radius);
      filter->SetLineRadius(radius);
      filter->SetRadius(1.0);
    }));
  };
  EXPECT_GT(bake(0.1), 1.05 * bake(0.0));
  ExpectSameValues(4, MakePieceWithRoundShapes, UseOpacityAndRadii);
}

TEST(vtkPenumbraDistributedIrradianceFilter, MatchesOneRankForAllRadii)
{
  for (const double radius : { 0.01, 0.3, 100.0, std::numeric_limits<double>::infinity() })
  {
    SCOPED_TRACE(radius);
    ExpectSameValues(4, MakePieceWithRoundShapes, [radius](Filter* filter) {
      UseOpacityAndRadii(filter);
      filter->SetRadius(radius);
    });
  }
}

TEST(vtkPenumbraDistributedIrradianceFilter, MatchesOneRankWithIrradiance)
{
  for (const bool isTranslucent : { false, true })
  {
    ExpectSameValues(3, MakePieceWithRoundShapes, [=](Filter* filter) {
      filter->SetQuantityToIrradiance();
      filter->SetEnvironmentColor(1.0, 0.5, 0.2);
      filter->SetPointRadius(0.1);
      filter->SetOpacityArray(isTranslucent ? "Opacity" : nullptr);
    });
  }
}

TEST(vtkPenumbraDistributedIrradianceFilter, MatchesOneRankWithDirectLight)
{
  for (const double w : { 0.0, 1.0 })
  {
    for (const double size : { 0.0, 0.2, 5.0 })
    {
      SCOPED_TRACE(testing::Message() << w << " " << size);
      ExpectSameValues(4, MakePieceWithRoundShapes, [=](Filter* filter) {
        UseOpacityAndRadii(filter);
        filter->SetQuantityToDirectLight();
        filter->AddLight(3.0, 1.0, 2.0, w);
        filter->AddLight(-1.0, 4.0, 0.1, w);
        filter->SetLightRadius(size);
        filter->SetLightAngle(20.0 * size);
      });
    }
  }
}

TEST(vtkPenumbraDistributedIrradianceFilter, MatchesOneRankOnCells)
{
  ExpectSameValues(3, MakeMeshPiece, [](Filter* filter) { filter->ComputeNormalsOn(); });
  ExpectSameValues(3, MakeMeshPiece, [](Filter* filter) { filter->OnCellsOn(); });
}

TEST(vtkPenumbraDistributedIrradianceFilter, MeetsTheToleranceWithRecords)
{
  const auto bake = [](Filter* filter) {
    filter->SetMethodToAutomatic();
    filter->SetTolerance(0.02);
  };
  const MakeMesh make = [](int rank, int ranks) { return MakePiece(rank, ranks, 60); };
  std::vector<float> values;
  for (const Image& part : BakeOnRanks(3, make, bake))
  {
    const std::vector<float> own = GetValues(part);
    values.insert(values.end(), own.begin(), own.end());
  }
  const std::vector<float> expected =
    GetValues(BakeOnOne(3, make, [](Filter* filter) { filter->SetTolerance(0.005); }));
  ASSERT_EQ(values.size(), expected.size());
  double square = 0.0;
  for (std::size_t i = 0; i < values.size(); ++i)
  {
    square += std::pow(values[i] - expected[i], 2.0);
  }
  EXPECT_LT(std::sqrt(square / static_cast<double>(values.size())), 0.02 + 0.005);
}

TEST(vtkPenumbraDistributedIrradianceFilter, BakesWithRanksWithoutData)
{
  const MakeMesh make = [](int rank, int ranks) {
    return rank == 1 ? vtkSmartPointer<vtkPolyData>::New() : MakePieceWithRoundShapes(rank, ranks);
  };
  const MakeMesh first = [](int rank, int ranks) {
    return rank == 0 ? vtkSmartPointer<vtkPolyData>::New() : MakePieceWithRoundShapes(rank, ranks);
  };
  // Appending drops the opacity, which the empty piece lacks.
  ExpectSameValues(3, make, [](Filter* filter) { filter->SetLineRadius(0.1); });
  ExpectSameValues(3, first, [](Filter* filter) { filter->SetLineRadius(0.1); });
  for (const Image& part : BakeOnRanks(3, make, UseOpacityAndRadii))
  {
    EXPECT_EQ(part.count("Error"), 0u);
  }
  const MakeMesh none = [](int, int) { return vtkSmartPointer<vtkPolyData>::New(); };
  for (const Image& part : BakeOnRanks(2, none, UseFilterDefaults))
  {
    EXPECT_EQ(part.count("Error"), 0u) << part.at("Error");
  }
}

TEST(vtkPenumbraDistributedIrradianceFilter, MatchesOneRankWithPoints)
{
  // The second rank has points alone, which are disks unless the other one has polygons.
  for (const bool hasPolygons : { false, true })
  {
    const MakeMesh make = [=](int rank, int) {
      vtkNew<vtkSphereSource> sphere;
      sphere->SetCenter(0.4 * rank, 0.0, 0.0);
      sphere->Update();
      auto piece = vtkSmartPointer<vtkPolyData>::New();
      piece->DeepCopy(sphere->GetOutput());
      if (rank == 1 || !hasPolygons)
      {
        piece->SetPolys(vtkNew<vtkCellArray>());
        vtkNew<vtkCellArray> vertices;
        for (vtkIdType i = 0; i < piece->GetNumberOfPoints(); ++i)
        {
          vertices->InsertNextCell(1, &i);
        }
        piece->SetVerts(vertices);
      }
      return piece;
    };
    const std::vector<float> values = ExpectSameValues(2, make, [](Filter* filter) {
      filter->SetPointRadius(0.1);
      filter->SetRadius(1.0);
    });
    EXPECT_GT(ComputeMean(values), 0.02);
  }
}

TEST(vtkPenumbraDistributedIrradianceFilter, BakesBlocks)
{
  std::string values;
  for (const RankResult& result : RunRanks(2, [](int rank) {
         vtkNew<vtkMultiBlockDataSet> blocks;
         blocks->SetBlock(0, MakeMeshPiece(2 * rank, 4));
         blocks->SetBlock(1, MakeMeshPiece(2 * rank + 1, 4));
         return Pack(
           Bake(vtkNew<vtkPenumbraDistributedIrradianceFilter>(), blocks, UseFilterDefaults));
       }))
  {
    values += Unpack(result.Value)["Values"];
  }
  EXPECT_TRUE(values == BakeOnOne(4, MakeMeshPiece, UseFilterDefaults).at("Values"));
}

TEST(vtkPenumbraDistributedIrradianceFilter, DividesSurroundings)
{
  const auto bake = [](Filter* filter, int first, int last) {
    vtkNew<vtkAppendPolyData> meshes;
    vtkNew<vtkAppendPolyData> around;
    for (int rank = first; rank < last; ++rank)
    {
      meshes->AddInputData(MakeBlock(rank, 3));
      vtkNew<vtkSphereSource> sphere;
      sphere->SetCenter(0.5 + rank, 0.7, 0.2);
      sphere->SetRadius(0.15 * (1 + rank % 2));
      sphere->Update();
      around->AddInputData(sphere->GetOutput());
    }
    meshes->Update();
    around->Update();
    return Bake(filter, meshes->GetOutput(), [&](Filter* each) {
      if (first != 1) // the second of three ranks has no surroundings
      {
        each->SetInputData(1, around->GetOutput());
      }
      each->SetRadius(0.6);
    });
  };
  const MakeMesh make = [](int rank, int) { return MakeBlock(rank, 3); };
  std::string values;
  for (const RankResult& result : RunRanks(3, [&](int rank) {
         return Pack(bake(vtkNew<vtkPenumbraDistributedIrradianceFilter>(), rank, rank + 1));
       }))
  {
    values += Unpack(result.Value)["Values"];
  }
  const Image expected = Unpack(RunRanks(1,
    [&](int) {
      vtkNew<vtkAppendPolyData> around;
      vtkNew<vtkAppendPolyData> meshes;
      for (int rank = 0; rank < 3; ++rank)
      {
        meshes->AddInputData(MakeBlock(rank, 3));
        vtkNew<vtkSphereSource> sphere;
        sphere->SetCenter(0.5 + rank, 0.7, 0.2);
        sphere->SetRadius(0.15 * (1 + rank % 2));
        sphere->Update();
        if (rank != 1)
        {
          around->AddInputData(sphere->GetOutput());
        }
      }
      meshes->Update();
      around->Update();
      return Pack(Bake(vtkNew<Filter>(), meshes->GetOutput(), [&](Filter* each) {
        each->SetInputData(1, around->GetOutput());
        each->SetRadius(0.6);
      }));
    })[0]
                                  .Value);
  EXPECT_TRUE(values == expected.at("Values"));
  EXPECT_FALSE(
    values == BakeOnOne(3, make, [](Filter* each) { each->SetRadius(0.6); }).at("Values"));
}

TEST(vtkPenumbraDistributedIrradianceFilter, ReceivesWhatRaysMayMeet)
{
  const auto receive = [](const FilterSettings& settings) {
    double most = 0.0;
    for (const Image& part : BakeOnRanks(4, MakeBlock, settings))
    {
      EXPECT_EQ(GetNumber(part, "Statistics/Exchange/WholePrimitives"), 4.0 * 1600.0);
      EXPECT_EQ(part.count("Warning"), 0u);
      most = std::max(most,
        GetNumber(part, "Statistics/Exchange/SceneBytes") /
          GetNumber(part, "Statistics/Exchange/WholeBytes"));
    }
    return most;
  };
  EXPECT_LT(receive([](Filter* filter) { filter->SetRadius(0.1); }), 0.12);
  EXPECT_LT(receive([](Filter* filter) {
    filter->SetQuantityToDirectLight();
    filter->AddLight(0.0, 0.0, 1.0, 0.0);
  }),
    0.12);
  EXPECT_LT(receive([](Filter* filter) {
    filter->SetQuantityToDirectLight();
    filter->AddLight(0.0, 0.0, 1.0, 0.0);
    filter->SetLightAngle(10.0);
  }),
    0.2);
}

TEST(vtkPenumbraDistributedIrradianceFilter, GathersWithoutRadiusWithOneWarning)
{
  for (const double radius : { 0.0, 1e3, std::numeric_limits<double>::max() })
  {
    const std::vector<Image> parts = BakeOnRanks(3, MakeBlock, [=](Filter* filter) {
      filter->SetRadius(radius);
      filter->SetQuantity(radius > 0.0 ? Filter::AMBIENT_OCCLUSION : Filter::IRRADIANCE);
    });
    ASSERT_EQ(parts[0].count("Warning"), 1u);
    EXPECT_NE(parts[0].at("Warning").find("bytes"), std::string::npos);
    EXPECT_EQ(parts[1].count("Warning"), 0u);
    EXPECT_EQ(GetNumber(parts[1], "Statistics/Exchange/Primitives"),
      GetNumber(parts[1], "Statistics/Exchange/WholePrimitives"));
  }
}

TEST(vtkPenumbraDistributedIrradianceFilter, WarnsOnceOfWhatAllRanksHave)
{
  // Two points without a cell on each rank, and a light in the polygons of the last one.
  const MakeMesh make = [](int rank, int) {
    vtkSmartPointer<vtkPolyData> block = MakeBlock(rank, 3);
    block->GetPoints()->InsertNextPoint(0.5 + rank, 0.5, 0.1);
    block->GetPoints()->InsertNextPoint(0.5 + rank, 0.5, 0.2);
    return block;
  };
  const FilterSettings settings = [](Filter* filter) {
    filter->SetQuantityToDirectLight();
    filter->AddLight(2.5, 0.5, 0.5, 1.0);
    filter->SetLightRadius(0.1);
  };
  const std::vector<Image> parts = BakeOnRanks(3, make, settings);
  const std::string& warning = parts[0].at("Warning");
  EXPECT_NE(warning.find("6 points do not belong to a surface"), std::string::npos) << warning;
  const std::size_t found = warning.find("The light at (2.5, 0.5, 0.5)");
  EXPECT_NE(found, std::string::npos) << warning;
  EXPECT_EQ(warning.find("The light at", found + 1), std::string::npos) << warning;
  EXPECT_EQ(parts[1].count("Warning") + parts[2].count("Warning"), 0u);

  // The points of one rank are in a box of the other one, which is open.
  const MakeMesh nested = [](int rank, int) {
    vtkNew<vtkSphereSource> sphere;
    sphere->SetRadius(rank == 0 ? 1.0 : 0.5);
    sphere->SetThetaResolution(20);
    sphere->SetPhiResolution(20);
    sphere->Update();
    return vtkSmartPointer<vtkPolyData>(sphere->GetOutput());
  };
  for (const Image& part : BakeOnRanks(
         2, nested, [](Filter* filter) { filter->SetRadius(std::numeric_limits<double>::max()); }))
  {
    EXPECT_TRUE(
      part.count("Warning") == 0 || part.at("Warning").find("occluded") == std::string::npos)
      << part.at("Warning");
  }
}

TEST(vtkPenumbraDistributedIrradianceFilter, NamesASettingThatRanksDisagreeAbout)
{
  const auto disagree = [](const char* name, const std::function<void(Filter*, int)>& set) {
    SCOPED_TRACE(name);
    for (const RankResult& result : RunRanks(3, [&](int rank) {
           return Pack(Bake(vtkNew<vtkPenumbraDistributedIrradianceFilter>(),
             MakeMeshPiece(rank, 3), [&](Filter* filter) { set(filter, rank); }));
         }))
    {
      EXPECT_TRUE(result.HasReturned);
      const Image baked = Unpack(result.Value);
      ASSERT_EQ(baked.count("Error"), 1u);
      const std::string expected = std::string("The ranks 0 and 2 disagree about ") + name + ".";
      EXPECT_NE(baked.at("Error").find(expected), std::string::npos) << baked.at("Error");
      EXPECT_TRUE(baked.at("Values").empty());
    }
  };
  disagree("Tolerance", [](Filter* f, int rank) { f->SetTolerance(rank == 2 ? 0.1 : 0.01); });
  disagree("Quantity", [](Filter* f, int rank) { f->SetQuantity(rank == 2 ? 1 : 0); });
  disagree("OpacityArray",
    [](Filter* f, int rank) { f->SetOpacityArray(rank == 2 ? "Opacity" : nullptr); });
  disagree("a light", [](Filter* f, int rank) {
    f->SetQuantityToDirectLight();
    f->AddLight(0.0, 0.0, rank == 2 ? 2.0 : 1.0, 0.0);
  });
}

TEST(vtkPenumbraDistributedIrradianceFilter, EndsOnAllRanksIfOneFails)
{
  const auto fail = [](const char* message, const MakeMesh& make,
                      const std::function<void(Filter*, int)>& set) {
    SCOPED_TRACE(message);
    for (const RankResult& result : RunRanks(3, [&](int rank) {
           return Pack(Bake(vtkNew<vtkPenumbraDistributedIrradianceFilter>(), make(rank, 3),
             [&](Filter* filter) { set(filter, rank); }));
         }))
    {
      EXPECT_TRUE(result.HasReturned);
      const Image baked = Unpack(result.Value);
      ASSERT_EQ(baked.count("Error"), 1u);
      EXPECT_NE(baked.at("Error").find(message), std::string::npos) << baked.at("Error");
      EXPECT_TRUE(baked.at("Values").empty());
    }
  };
  fail("Rank 1: Tolerance", MakeMeshPiece,
    [](Filter* filter, int rank) { filter->SetTolerance(rank == 1 ? std::nan("") : 0.1); });
  const MakeMesh make = [](int rank, int ranks) {
    return rank == 2 ? MakePiece(rank, ranks, 16) : MakeMeshPiece(rank, ranks);
  };
  fail(
    "Rank 2: OpacityArray", make, [](Filter* filter, int) { filter->SetOpacityArray("Opacity"); });
  // In the middle of the baking.
  fail("Rank 1: The execution was aborted.", MakeMeshPiece, [](Filter* filter, int rank) {
    vtkNew<vtkCallbackCommand> abort;
    abort->SetCallback([](vtkObject* caller, unsigned long, void*, void*) {
      auto* const self = static_cast<Filter*>(caller);
      if (self->GetProgress() > 0.3)
      {
        self->SetAbortExecute(1);
      }
    });
    filter->SetTolerance(0.003);
    if (rank == 1)
    {
      filter->AddObserver(vtkCommand::ProgressEvent, abort);
    }
  });
}
