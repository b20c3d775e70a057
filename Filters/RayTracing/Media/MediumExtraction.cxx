// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "MediumExtraction.h"

#include "Conventions/MediumCoefficients.h"
#include "vtkPenumbraMedium.h"

#include <cmath>

namespace penumbra
{

std::optional<Medium> ConvertMedium(vtkPenumbraMedium* source, const Scene& scene, double diagonal)
{
  if (!std::isfinite(source->GetScattering()) || !std::isfinite(source->GetExtinction()) ||
    !std::isfinite(source->GetAsymmetry()))
  {
    return {};
  }
  const MediumCoefficients coefficients =
    ResolveMediumCoefficients(source->GetScattering(), source->GetExtinction(), diagonal);

  Medium medium;
  medium.Scattering = coefficients.Scattering / scene.Scale;
  medium.Extinction = coefficients.Extinction / scene.Scale;
  medium.Phase = static_cast<Medium::Phases>(source->GetPhase());
  medium.Asymmetry = source->GetAsymmetry();
  const double* bounds = source->GetBounds();
  for (int axis = 0; axis < 3; ++axis)
  {
    medium.Low[axis] = (bounds[2 * axis] - scene.Origin[axis]) * scene.Scale;
    medium.High[axis] = (bounds[2 * axis + 1] - scene.Origin[axis]) * scene.Scale;
    if (!(medium.Low[axis] < medium.High[axis]))
    {
      return {};
    }
  }
  return medium;
}

std::optional<LightShafts> MakeLightShafts(vtkPenumbraMedium* source, const Shading& shading,
  double diagonal, LightShafts::MarchQuality quality, std::string& warning)
{
  if (!source)
  {
    return {};
  }
  const std::optional<Medium> medium = ConvertMedium(source, shading.GetScene(), diagonal);
  if (!medium)
  {
    warning = "vtkPenumbraMedium: coefficients must be finite and the bounds must not be empty. "
              "Light shafts are not rendered.";
    return {};
  }
  std::optional<LightShafts> shafts(std::in_place, shading, *medium, quality);
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
