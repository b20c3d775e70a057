// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "MediumExtraction.h"

#include "Shading/RayTracingConstants.h"
#include "vtkPenumbraMedium.h"

#include <algorithm>
#include <cmath>

namespace penumbra
{

namespace
{

}

std::optional<Medium> ConvertMedium(vtkPenumbraMedium* source, const Scene& scene, double diagonal)
{
  double scattering = source->GetScattering();
  double extinction = source->GetExtinction();
  if (!std::isfinite(scattering) || !std::isfinite(extinction) ||
    !std::isfinite(source->GetAsymmetry()))
  {
    return {};
  }
  scattering = scattering >= 0.0 ? scattering : DefaultOpticalDepth / diagonal;
  extinction = std::max(extinction, scattering);

  Medium medium;
  medium.Scattering = scattering / scene.Scale;
  medium.Extinction = extinction / scene.Scale;
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
              "Light shafts are "
              "not rendered.";
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
