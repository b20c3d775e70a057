// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "MediumExtraction.h"

#include "Light.h"
#include "Medium/MediumCoefficients.h"
#include "SceneCoordinates.h"
#include "vtkPenumbraMedium.h"

#include "vtkDataArray.h"
#include "vtkImageData.h"
#include "vtkPointData.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace penumbra
{

namespace
{

/// Converts a valid image to scene coordinates.
std::shared_ptr<const DensityImage> ConvertDensity(
  vtkImageData* source, const SceneCoordinates& coordinates)
{
  vtkDataArray* scalars = source->GetPointData()->GetScalars();
  auto image = std::make_shared<DensityImage>();
  const double* bounds = source->GetBounds();
  for (int axis = 0; axis < 3; ++axis)
  {
    image->Size[axis] = source->GetDimensions()[axis];
    image->Spacing[axis] = source->GetSpacing()[axis] * coordinates.Scale;
    image->Low[axis] = (bounds[2 * axis] - coordinates.Origin[axis]) * coordinates.Scale;
  }
  image->Values.resize(static_cast<std::size_t>(scalars->GetNumberOfTuples()));
  for (vtkIdType i = 0; i < scalars->GetNumberOfTuples(); ++i)
  {
    image->Values[static_cast<std::size_t>(i)] = static_cast<float>(scalars->GetComponent(i, 0));
  }
  return image;
}

MediumDensity ConvertDensity(
  vtkPenumbraMedium* source, const MediumSettings& settings, const SceneCoordinates& coordinates)
{
  MediumDensity density;
  if (settings.HasFalloff())
  {
    const glm::dvec3 up =
      glm::normalize(glm::dvec3(settings.Up[0], settings.Up[1], settings.Up[2]));
    density.Up = up;
    density.ScaleHeight = settings.ScaleHeight * coordinates.Scale;
    density.BaseHeight =
      (settings.BaseHeight - glm::dot(up, coordinates.Origin)) * coordinates.Scale;
  }
  if (source->GetDensity())
  {
    const std::string invalid = vtkPenumbraMedium::FindInvalidDensity(source->GetDensity());
    if (!invalid.empty())
    {
      throw std::runtime_error("the density image " + invalid);
    }
    density.Image = ConvertDensity(source->GetDensity(), coordinates);
  }
  return density;
}

}

SpectralMedium ConvertMedium(
  vtkPenumbraMedium* source, const SceneCoordinates& coordinates, double diagonal)
{
  const MediumSettings settings(source);
  if (const char* reason = FindInvalidMediumSetting(settings))
  {
    throw std::runtime_error(reason);
  }
  if (!std::isfinite(source->GetAsymmetry()))
  {
    throw std::runtime_error("Asymmetry must be finite");
  }
  Medium channel;
  channel.Phase = static_cast<Medium::Phases>(source->GetPhase());
  channel.Asymmetry = source->GetAsymmetry();
  channel.Density = ConvertDensity(source, settings, coordinates);
  const double* bounds = source->GetBounds();
  for (int axis = 0; axis < 3; ++axis)
  {
    channel.Low[axis] = (bounds[2 * axis] - coordinates.Origin[axis]) * coordinates.Scale;
    channel.High[axis] = (bounds[2 * axis + 1] - coordinates.Origin[axis]) * coordinates.Scale;
    if (!(channel.Low[axis] < channel.High[axis]))
    {
      throw std::runtime_error("Bounds must not be empty");
    }
    if (channel.Density.Image)
    {
      channel.Low[axis] = std::max(channel.Low[axis], channel.Density.Image->Low[axis]);
      channel.High[axis] = std::min(channel.High[axis], channel.Density.Image->High()[axis]);
    }
  }
  SpectralMedium medium(channel);
  const std::array<MediumCoefficients, 3> coefficients =
    ResolveMediumCoefficients(settings, diagonal);
  for (std::size_t i = 0; i < 3; ++i)
  {
    medium.Channels[i].Scattering = coefficients[i].Scattering / coordinates.Scale;
    medium.Channels[i].Rayleigh = coefficients[i].Rayleigh / coordinates.Scale;
    medium.Channels[i].Extinction = coefficients[i].Extinction / coordinates.Scale;
  }
  const bool plain = medium.IsGray() && channel.Density.IsUniform() && settings.Rayleigh == 0.0;
  medium.AttenuatesSurfaceLight = source->GetSurfaceLight() == vtkPenumbraMedium::ATTENUATED ||
    (source->GetSurfaceLight() == vtkPenumbraMedium::AUTOMATIC && !plain);
  medium.IncludesTranslucentSurfaces = source->GetTranslucentSurfaces();
  return medium;
}

std::optional<LightShafts> MakeLightShafts(vtkPenumbraMedium* source, const Shading& shading,
  double diagonal, LightShafts::MarchQuality quality, std::string& warning)
{
  if (!source)
  {
    return {};
  }
  SpectralMedium medium;
  try
  {
    medium = ConvertMedium(source, shading.GetRays().GetCoordinates(), diagonal);
  }
  catch (const std::runtime_error& error)
  {
    warning =
      std::string("vtkPenumbraMedium: ") + error.what() + ". Light shafts are not rendered.";
    return {};
  }
  std::optional<LightShafts> shafts(std::in_place, shading, medium, quality);
  if (shafts->IsEmpty())
  {
    warning =
      "Light shafts are not rendered: the scene has no light that casts shadows and is not black. "
      "Headlights cast no shadows; add a scene light.";
    return {};
  }
  return shafts;
}

}
