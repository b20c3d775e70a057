// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "SceneChecks.h"

#include "vtkCallbackCommand.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPNGWriter.h"
#include "vtkPenumbraRayCaster.h"
#include "vtkPenumbraRayCasterConstants.h"
#include "vtkRenderWindow.h"
#include "vtkRenderer.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <cmath>

namespace penumbra_soak
{
namespace
{

/// Limits of tiles in scenes with effects, whose own error adds to that of the image.
constexpr double EffectsFactor = 2.0;
constexpr int BlockSide = 8;
constexpr double BlockThreshold = 0.06;
/// Differences below are rounding and interpolation.
constexpr double PixelThreshold = 10.0 / 255.0;

void Append(vtkObject*, unsigned long, void* data, void* text)
{
  const std::string warning = static_cast<const char*>(text);
  if (warning.find("The tolerance of") == std::string::npos)
  {
    *static_cast<std::string*>(data) += warning + " ";
  }
}

/// Squared difference of two images with uniform samples, as an estimate of the error of the finer.
penumbra::StratifiedReference DrawUniform(const RandomScene& scene, int quality)
{
  penumbra::StratifiedReference reference;
  std::vector<glm::dvec3> images[2];
  for (int i = 0; i < 2; ++i)
  {
    const penumbra::Answer answer =
      penumbra::Cast(scene.Renderer, ImageSide, ImageSide, [&](vtkPenumbraRayCaster* caster) {
        scene.Choose(caster);
        caster->SetTolerance(scene.Tolerance / 2.0);
        caster->GetConstants().CoverageMethod = penumbra::CoverageMethods::Uniform;
        caster->GetConstants().UniformSamples = (i ? 7 : 5) * quality;
      });
    for (std::size_t p = 0; p < answer.Colors.size(); ++p)
    {
      images[i].push_back(answer.Colors[p] * answer.Alphas[p]);
    }
  }
  for (std::size_t p = 0; p < images[0].size(); ++p)
  {
    const glm::dvec3 difference = images[1][p] - images[0][p];
    reference.SquaredErrors.push_back(glm::dot(difference, difference) / 3.0);
  }
  reference.Colors = images[1];
  return reference;
}

/// How far a pixel lies outside of the range of the same pixel of `other` and its neighbors.
double ComputeExcess(
  const std::vector<glm::dvec3>& image, const std::vector<glm::dvec3>& other, int i, int j)
{
  glm::dvec3 low(1e300);
  glm::dvec3 high(-1e300);
  for (int n = 0; n < 9; ++n)
  {
    const int x = std::clamp(i + n % 3 - 1, 0, ImageSide - 1);
    const int y = std::clamp(j + n / 3 - 1, 0, ImageSide - 1);
    low = glm::min(low, other[y * ImageSide + x]);
    high = glm::max(high, other[y * ImageSide + x]);
  }
  const glm::dvec3 value = image[j * ImageSide + i];
  const glm::dvec3 excess = glm::max(low - value, value - high);
  return std::max({ excess.x, excess.y, excess.z });
}

}

CastImage CastScene(const RandomScene& scene, bool plain, int threads)
{
  CastImage image;
  vtkNew<vtkCallbackCommand> observer;
  observer->SetClientData(&image.Warnings);
  observer->SetCallback(Append);
  image.Values =
    penumbra::Cast(scene.Renderer, ImageSide, ImageSide, [&](vtkPenumbraRayCaster* caster) {
      (plain ? scene.ChoosePlain : scene.Choose)(caster);
      caster->SetNumberOfThreads(threads);
      caster->AddObserver(vtkCommand::WarningEvent, observer);
      caster->AddObserver(vtkCommand::ErrorEvent, observer);
    });
  std::replace(image.Warnings.begin(), image.Warnings.end(), '\n', ' ');
  const auto isFinite = [](const glm::dvec3& c) {
    return std::isfinite(c.x) && std::isfinite(c.y) && std::isfinite(c.z);
  };
  image.Finite = image.Values.Colors.size() == ImageSide * ImageSide &&
    std::all_of(image.Values.Colors.begin(), image.Values.Colors.end(), isFinite) &&
    std::all_of(image.Values.Alphas.begin(), image.Values.Alphas.end(),
      [](double alpha) { return alpha >= 0.0 && alpha <= 1.0 + 1e-5; }) &&
    std::all_of(image.Values.Estimates.begin(), image.Values.Estimates.end(),
      [](double estimate) { return estimate >= 0.0 && std::isfinite(estimate); });
  return image;
}

penumbra::StratifiedReference DrawReference(const RandomScene& scene, int quality)
{
  return scene.Effects || scene.NeedsCaster
    ? DrawUniform(scene, quality)
    : penumbra::DrawStratified(scene.Renderer, ImageSide, ImageSide, 12 * quality, scene.Shadows);
}

double TileLimit(const RandomScene& scene)
{
  return scene.Tolerance * (scene.Effects ? EffectsFactor : 1.0);
}

bool IsMisjudged(const RandomScene& scene, const penumbra::TileAccuracy& tile)
{
  return tile.Error > TileLimit(scene) && tile.Estimate < tile.Error;
}

std::vector<glm::dvec3> DrawWithVTK(const RandomScene& scene)
{
  // If all lights are off, VTK creates one, which it takes for one of the first light's kind until the next image.
  scene.Window->Render();
  scene.Window->Render();
  vtkNew<vtkUnsignedCharArray> pixels;
  scene.Window->GetPixelData(0, 0, ImageSide - 1, ImageSide - 1, 0, pixels);
  std::vector<glm::dvec3> colors;
  for (vtkIdType p = 0; p < pixels->GetNumberOfTuples(); ++p)
  {
    colors.emplace_back(
      pixels->GetComponent(p, 0), pixels->GetComponent(p, 1), pixels->GetComponent(p, 2));
    colors.back() /= 255.0;
  }
  return colors;
}

int CountDifferentBlocks(const std::vector<glm::dvec3>& cast, const std::vector<glm::dvec3>& vtk)
{
  std::vector<glm::dvec3> clamped(cast);
  for (glm::dvec3& color : clamped)
  {
    color = glm::clamp(color, 0.0, 1.0);
  }
  int blocks = 0;
  for (int low = 0; low < ImageSide; low += BlockSide)
  {
    for (int left = 0; left < ImageSide; left += BlockSide)
    {
      glm::dvec3 difference(0.0);
      int different = 0;
      for (int y = low; y < low + BlockSide; ++y)
      {
        for (int x = left; x < left + BlockSide; ++x)
        {
          difference += clamped[y * ImageSide + x] - vtk[y * ImageSide + x];
          different += ComputeExcess(clamped, vtk, x, y) > PixelThreshold;
        }
      }
      difference = glm::abs(difference) / double(BlockSide * BlockSide);
      blocks += std::max({ difference.x, difference.y, difference.z }) > BlockThreshold &&
        3 * different > BlockSide * BlockSide;
    }
  }
  return blocks;
}

void WriteSheet(const std::vector<std::vector<glm::dvec3>>& images, const std::string& path)
{
  vtkNew<vtkImageData> sheet;
  sheet->SetDimensions(static_cast<int>(images.size()) * ImageSide, ImageSide, 1);
  sheet->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
  for (std::size_t i = 0; i < images.size(); ++i)
  {
    for (std::size_t p = 0; p < images[i].size(); ++p)
    {
      for (int c = 0; c < 3; ++c)
      {
        sheet->SetScalarComponentFromDouble(static_cast<int>(i * ImageSide + p % ImageSide),
          static_cast<int>(p / ImageSide), 0, c,
          std::round(255.0 * std::clamp(images[i][p][c], 0.0, 1.0)));
      }
    }
  }
  vtkNew<vtkPNGWriter> writer;
  writer->SetInputData(sheet);
  writer->SetFileName(path.c_str());
  writer->Write();
}

}
