// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Compares each drawn row of the table of VTK's rendering features with the image of VTK's
// rasterizer, and the page of the table with the table. With PENUMBRA_FEATURE_SHEET=FOLDER, the
// images are written side by side: VTK, ray caster, pixels that differ.
#include "FeatureScenes.h"

#include "vtkCallbackCommand.h"
#include "vtkDataArray.h"
#include "vtkImageData.h"
#include "vtkMapper.h"
#include "vtkNew.h"
#include "vtkPNGWriter.h"
#include "vtkPenumbraRayCaster.h"
#include "vtkPointData.h"
#include "vtkUnsignedCharArray.h"
#include "vtkVersionMacros.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>
#include <string>

using penumbra::Feature;
using penumbra::FeatureRow;

namespace
{

#ifdef __SANITIZE_ADDRESS__ // which checks the code, not numbers
constexpr int Size = 40;
constexpr bool ComparesImages = false;
#else
constexpr int Size = 160;
constexpr bool ComparesImages = true;
#endif
/// Differences below this value, in units of 1/255, are rounding and interpolation.
constexpr double Threshold = 8.0;

struct Images
{
  vtkNew<vtkUnsignedCharArray> Raster;
  std::vector<double> Rays; ///< 3 components in [0, 255]
  std::vector<bool> Different;
  double Fraction = 0.0;
};

const FeatureRow& Row(Feature feature)
{
  return penumbra::GetFeatureTable()[static_cast<std::size_t>(feature)];
}

/// Marks pixels that lie outside of the range of VTK's pixel and its neighbors: antialiased edges
/// lie within.
void Compare(Images& images)
{
  images.Different.resize(Size * Size);
  int different = 0;
  for (int j = 0; j < Size; ++j)
  {
    for (int i = 0; i < Size; ++i)
    {
      double excess = 0.0;
      for (int k = 0; k < 3; ++k)
      {
        double low = 255.0;
        double high = 0.0;
        for (int n = 0; n < 9; ++n)
        {
          const int x = std::clamp(i + n % 3 - 1, 0, Size - 1);
          const int y = std::clamp(j + n / 3 - 1, 0, Size - 1);
          low = std::min(low, images.Raster->GetComponent(y * Size + x, k));
          high = std::max(high, images.Raster->GetComponent(y * Size + x, k));
        }
        const double value = images.Rays[3 * (j * Size + i) + k];
        excess = std::max({ excess, low - value, value - high });
      }
      images.Different[j * Size + i] = excess > Threshold;
      different += excess > Threshold;
    }
  }
  images.Fraction = static_cast<double>(different) / (Size * Size);
}

/// Writes a file of the sheet, and its folder. Returns whether it exists.
bool Write(const Images& images, const std::filesystem::path& path)
{
  vtkNew<vtkImageData> sheet;
  sheet->SetDimensions(3 * Size, Size, 1);
  sheet->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
  for (int p = 0; p < Size * Size; ++p)
  {
    for (int k = 0; k < 3; ++k)
    {
      const auto set = [&](int column, double value) {
        sheet->SetScalarComponentFromDouble(column * Size + p % Size, p / Size, 0, k, value);
      };
      set(0, images.Raster->GetComponent(p, k));
      set(1, std::round(images.Rays[3 * p + k]));
      set(2, images.Different[p] ? 255.0 : 0.0);
    }
  }
  std::error_code error;
  std::filesystem::create_directories(path.parent_path(), error);
  if (!std::filesystem::is_directory(path.parent_path(), error))
  {
    return false; // vtkPNGWriter loses memory if it cannot open the file.
  }
  vtkNew<vtkPNGWriter> writer;
  writer->SetInputData(sheet);
  writer->SetFileName(path.c_str());
  writer->Write();
  return writer->GetErrorCode() == 0 && std::filesystem::exists(path);
}

void Render(const FeatureScene& scene, Images& images)
{
  vtkNew<vtkRenderWindow> window;
  window->SetOffScreenRendering(1);
  window->SetMultiSamples(0);
  window->SetAlphaBitPlanes(1);
  window->SetSize(Size, Size);
  vtkNew<vtkRenderer> renderer;
  renderer->SetBackground(0.2, 0.3, 0.4);
  window->AddRenderer(renderer);
  scene.Build(renderer, window);
  // VTK changes objects of the scene when it renders; these rows do not need that. Others, such as
  // 2-D actors, are complete after the first rendering.
  const std::set<Feature> castFirst = { Feature::BackgroundImage, Feature::AxesActors,
    Feature::CubeAxes, Feature::BillboardText, Feature::Text3D, Feature::Textures,
    Feature::VisiblePoints, Feature::ImageBasedLighting };
  if (!castFirst.count(scene.Key))
  {
    window->Render();
  }
  vtkNew<vtkPenumbraRayCaster> caster;
  caster->SetRenderer(renderer);
  caster->SetResolution(Size, Size);
  std::string warnings;
  vtkNew<vtkCallbackCommand> observer;
  observer->SetClientData(&warnings);
  observer->SetCallback([](vtkObject*, unsigned long, void* data, void* text) {
    // Small highlights may miss the tolerance; the table does not cover that.
    const std::string warning = static_cast<const char*>(text);
    *static_cast<std::string*>(data) +=
      warning.find("The tolerance of") == std::string::npos ? warning : "";
  });
  caster->AddObserver(vtkCommand::WarningEvent, observer);
  caster->Update();
  if (Row(scene.Key).Level == FeatureRow::Levels::Drawn)
  {
    EXPECT_EQ(warnings, "");
  }
  else
  {
    EXPECT_NE(warnings.find(Row(scene.Key).Difference), std::string::npos) << warnings;
  }
  vtkDataArray* color = caster->GetOutput()->GetPointData()->GetArray("Color");
  for (vtkIdType p = 0; p < Size * Size; ++p)
  {
    for (int k = 0; k < 3; ++k)
    {
      images.Rays.push_back(255.0 * std::clamp(color->GetComponent(p, k), 0.0, 1.0));
    }
  }
  window->Render();
  if (ComparesImages)
  {
    window->Render(); // VTK places labels only in windows that have rendered
    window->GetPixelData(0, 0, Size - 1, Size - 1, 0, images.Raster);
    Compare(images);
  }
}

/// The settings of coincident topology that all mappers share are those of VTK after each scene.
void ResetCoincidentTopology()
{
  vtkMapper::SetResolveCoincidentTopologyToOff();
  vtkMapper::SetResolveCoincidentTopologyPolygonOffsetParameters(0.0, 0.0);
  vtkMapper::SetResolveCoincidentTopologyZShift(0.01);
}

/// Returns the features that have scenes.
std::set<Feature> FeaturesWithScenes()
{
  std::set<Feature> features;
  for (const FeatureScene& scene : MakeFeatureScenes())
  {
    features.insert(scene.Key);
  }
  return features;
}

class FeatureTable : public testing::TestWithParam<Feature>
{
};

std::string LevelName(FeatureRow::Levels level)
{
  switch (level)
  {
    case FeatureRow::Levels::Drawn:
      return "drawn";
    case FeatureRow::Levels::Approximated:
      return "approximated";
    case FeatureRow::Levels::Refused:
      break;
  }
  return "refused";
}

/// True for rows with scenes that the linked VTK draws differently from VTK 9.7, which the ray caster
/// follows: VTK 9.2 turns skyboxes of the sphere projection by another angle, shades physically based
/// materials differently under a single headlight, and draws concave polygons in 2-D as fans.
bool DiffersBetweenVersions([[maybe_unused]] Feature feature)
{
#if VTK_VERSION_NUMBER < VTK_VERSION_CHECK(9, 3, 0)
  return feature == Feature::Skyboxes || feature == Feature::NormalTexture ||
    feature == Feature::MaterialTexture || feature == Feature::Anisotropy ||
    feature == Feature::Actors2D || feature == Feature::ImageBasedLighting;
#else
  return false;
#endif
}

}

// All scenes of a feature in one test, because each process that opens a window takes a tenth of a second.
TEST_P(FeatureTable, AgreesWithVTK)
{
  const std::vector<FeatureScene> scenes = MakeFeatureScenes();
  for (std::size_t i = 0; i < scenes.size(); ++i)
  {
    const FeatureScene& scene = scenes[i];
    if (scene.Key != GetParam())
    {
      continue;
    }
    SCOPED_TRACE("scene " + std::to_string(i));
    Images images;
    Render(scene, images);
    ResetCoincidentTopology();
    const char* folder = std::getenv("PENUMBRA_FEATURE_SHEET");
    if (ComparesImages && folder)
    {
      std::ostringstream path;
      path << folder << "/" << 100 + i << ".png";
      ASSERT_TRUE(Write(images, path.str())) << "cannot write " << path.str();
      std::cout << path.str() << " " << Row(scene.Key).Name << " " << images.Fraction << "\n";
    }
    if (ComparesImages && Row(scene.Key).Level == FeatureRow::Levels::Drawn &&
      !DiffersBetweenVersions(scene.Key))
    {
      EXPECT_LE(images.Fraction, scene.MaximumDifferent) << Row(scene.Key).Name;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Features, FeatureTable, testing::ValuesIn(FeaturesWithScenes()),
  [](const testing::TestParamInfo<Feature>& feature) {
    std::string name;
    for (const char character : std::string(Row(feature.param).Name))
    {
      name += std::isalnum(static_cast<unsigned char>(character)) ? std::string(1, character) : "";
    }
    return name;
  });

TEST(FeatureSheet, IsWrittenToNewFoldersOrFails)
{
  Images images;
  images.Raster->SetNumberOfComponents(3);
  images.Raster->SetNumberOfTuples(Size * Size);
  images.Raster->FillValue(0);
  images.Rays.resize(3 * Size * Size);
  images.Different.resize(Size * Size);
  const std::filesystem::path folder =
    std::filesystem::path(testing::TempDir()) / "penumbra-feature-sheet";
  std::filesystem::remove_all(folder);
  EXPECT_TRUE(Write(images, folder / "new" / "100.png"));
  EXPECT_FALSE(Write(images, folder / "new" / "100.png" / "101.png"));
  std::filesystem::remove_all(folder);
}

TEST(FeatureRows, FollowTheOrderOfTheFeatures)
{
  const std::vector<FeatureRow>& table = penumbra::GetFeatureTable();
  ASSERT_EQ(table.size(), static_cast<std::size_t>(Feature::NumberOfFeatures));
  for (std::size_t i = 0; i < table.size(); ++i)
  {
    EXPECT_EQ(static_cast<std::size_t>(table[i].Key), i) << table[i].Name;
    if (table[i].Level != FeatureRow::Levels::Drawn)
    {
      EXPECT_NE(std::string(table[i].Difference), "") << table[i].Name;
      EXPECT_NE(std::string(table[i].Remedy), "") << table[i].Name;
    }
  }
}

TEST(FeatureRows, HaveASceneIfTheyAreDrawn)
{
  std::set<Feature> features = { Feature::BackgroundAlpha }; // the window shows no alpha
#if VTK_VERSION_NUMBER < VTK_VERSION_CHECK(9, 3, 0)
  features.insert(Feature::BlockTextures); // newer
#endif
#if VTK_VERSION_NUMBER < VTK_VERSION_CHECK(9, 7, 0)
  features.insert(Feature::PhysicalCoordinates);
  features.insert(Feature::CoordinateSystems);
#endif
#if !__has_include("vtkOpenGLSphereMapper.h") || !__has_include("vtkOpenGLStickMapper.h")
  features.insert(Feature::Imposters); // see TestImposters
#endif
  features.merge(FeaturesWithScenes());
  for (const FeatureRow& row : penumbra::GetFeatureTable())
  {
    EXPECT_TRUE(row.Level != FeatureRow::Levels::Drawn || features.count(row.Key)) << row.Name;
  }
}

/// Returns the page of the table.
std::string MakePage()
{
  const std::vector<FeatureRow>& table = penumbra::GetFeatureTable();
  std::ostringstream page;
  page
    << "# VTK features in ray-cast images\n\n"
    << "How `vtkPenumbraRayCaster` handles the rendering features of VTK. This page is generated "
       "from the table in\n"
    << "`Filters/Scene/Features/SceneFeatures.cxx`, which also holds the warnings. "
       "`Testing/Features` compares each drawn row\nwith the image of VTK's "
       "rasterizer, and tests the warning of each other row.\n\n"
    << "- *drawn*: as VTK draws it, away from antialiased edges\n"
    << "- *approximated*: drawn differently; one warning names the props\n"
    << "- *refused*: skipped or ignored; one warning names the props\n\n"
    << "| feature | ray caster | difference | remedy |\n|---|---|---|---|\n";
  for (const FeatureRow& row : table)
  {
    std::string difference = row.Difference;
    if (!difference.empty())
    {
      difference[0] = static_cast<char>(std::toupper(difference[0]));
    }
    page << "| " << row.Name << " | " << LevelName(row.Level) << " | " << difference << " | "
         << row.Remedy << " |\n";
  }
  return page.str();
}

TEST(FeatureRows, AreDocumented)
{
  const std::string path = PENUMBRA_SOURCE_DIR "/Documentation/reference/VTKFeatures.md";
  if (std::getenv("PENUMBRA_UPDATE_PAGES"))
  {
    std::ofstream(path) << MakePage();
  }
  std::stringstream text;
  text << std::ifstream(path).rdbuf();
  EXPECT_EQ(text.str(), MakePage()) << "Run this test with PENUMBRA_UPDATE_PAGES=1.";
}
