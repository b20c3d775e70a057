// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Sets the options of the medium, for both engines.
#ifndef penumbra_MediumSetup_h
#define penumbra_MediumSetup_h

#include "Options/ShaftOptions.h"
#include "vtkPenumbraMedium.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

class vtkRenderer;

namespace penumbra
{

/// Coefficients of three channels as a number and the factors of the channels.
struct CoefficientSetting
{
  double Value = -1.0; ///< negative: the default
  std::array<double, 3> Color{ 1.0, 1.0, 1.0 };

  explicit CoefficientSetting(const std::vector<double>& coefficients)
  {
    if (coefficients.empty())
    {
      return;
    }
    this->Value = *std::max_element(coefficients.begin(), coefficients.end());
    for (std::size_t i = 0; i < 3 && coefficients.size() == 3 && this->Value > 0.0; ++i)
    {
      this->Color[i] = coefficients[i] / this->Value;
    }
  }
};

inline void SetUpMedium(
  const ShaftOptions& shafts, vtkRenderer* renderer, vtkPenumbraMedium* medium)
{
  const CoefficientSetting scattering(shafts.Scattering);
  const CoefficientSetting extinction(shafts.Extinction);
  medium->SetScattering(scattering.Value);
  medium->SetExtinction(extinction.Value);
  medium->SetScatteringColor(scattering.Color[0], scattering.Color[1], scattering.Color[2]);
  medium->SetExtinctionColor(extinction.Color[0], extinction.Color[1], extinction.Color[2]);
  medium->SetRayleighScattering(shafts.Rayleigh);
  medium->SetPhase(shafts.Phase == "rayleigh" ? vtkPenumbraMedium::RAYLEIGH
      : shafts.Phase == "hg"                  ? vtkPenumbraMedium::HENYEY_GREENSTEIN
                                              : vtkPenumbraMedium::ISOTROPIC);
  medium->SetAsymmetry(shafts.Asymmetry);
  const Vector3 up = shafts.Up.value_or(Vector3{ 0, 1, 0 });
  medium->SetScaleHeight(shafts.ScaleHeight);
  medium->SetUp(up[0], up[1], up[2]);
  if (shafts.ScaleHeight > 0.0)
  {
    medium->SetBaseHeight(
      std::isnan(shafts.BaseHeight) ? FindLowestHeight(renderer, up) : shafts.BaseHeight);
  }
}

}
#endif
