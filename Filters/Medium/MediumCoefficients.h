// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Description of a medium and its defaults, for light shafts by ray casting and in OpenGL images.
#ifndef penumbra_MediumCoefficients_h
#define penumbra_MediumCoefficients_h

#include "vtkPenumbraMedium.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace penumbra
{

/// Optical depth of the diagonal of the scene if the scattering coefficient is negative. A choice:
/// shafts are visible, and 22 % of the light from the far end is lost.
constexpr double DefaultOpticalDepth = 0.25;

/// Wavelengths of the red, green and blue channel in nanometers: 680, 550, 440 (Bruneton, Neyret:
/// Precomputed Atmospheric Scattering, 2008). Rayleigh scattering is proportional to the power -4
/// of the wavelength; these are its factors relative to green.
constexpr double Power4(double x)
{
  return x * x * x * x;
}
constexpr std::array<double, 3> RayleighFactors{ Power4(550.0 / 680.0), 1.0,
  Power4(550.0 / 440.0) };

/// Coefficients of one color channel, per unit of length [Shafts eq. 1].
struct MediumCoefficients
{
  double Scattering = 0.0; ///< with the phase function of the settings
  double Rayleigh = 0.0;   ///< scattering coefficient with the Rayleigh phase function
  double Extinction = 0.0; ///< absorption + scattering of both kinds

  bool operator==(const MediumCoefficients& other) const
  {
    return this->Scattering == other.Scattering && this->Rayleigh == other.Rayleigh &&
      this->Extinction == other.Extinction;
  }
};

/// The settings of a vtkPenumbraMedium that its coefficients and its density at a height depend on.
struct MediumSettings
{
  double Scattering = -1.0;
  double Extinction = -1.0;
  std::array<double, 3> ScatteringColor{ 1.0, 1.0, 1.0 };
  std::array<double, 3> ExtinctionColor{ 1.0, 1.0, 1.0 };
  double Rayleigh = 0.0;
  double ScaleHeight = 0.0;
  double BaseHeight = 0.0;
  std::array<double, 3> Up{ 0.0, 1.0, 0.0 };

  MediumSettings() = default;
  explicit MediumSettings(vtkPenumbraMedium* medium)
    : Scattering(medium->GetScattering()),
      Extinction(medium->GetExtinction()),
      Rayleigh(medium->GetRayleighScattering()),
      ScaleHeight(medium->GetScaleHeight()),
      BaseHeight(medium->GetBaseHeight())
  {
    std::copy_n(medium->GetScatteringColor(), 3, this->ScatteringColor.begin());
    std::copy_n(medium->GetExtinctionColor(), 3, this->ExtinctionColor.begin());
    std::copy_n(medium->GetUp(), 3, this->Up.begin());
  }

  /// Returns true if the density decreases with the height.
  bool HasFalloff() const { return this->ScaleHeight > 0.0; }
};

/// Returns the coefficients of red, green and blue at relative density 1. Negative scattering is
/// replaced by DefaultOpticalDepth / `diagonal`, where `diagonal` > 0 is that of the scene, and
/// extinction below scattering by scattering; Rayleigh scattering adds to both.
inline std::array<MediumCoefficients, 3> ResolveMediumCoefficients(
  const MediumSettings& settings, double diagonal)
{
  std::array<MediumCoefficients, 3> channels;
  const double resolved =
    settings.Scattering >= 0.0 ? settings.Scattering : DefaultOpticalDepth / diagonal;
  for (std::size_t i = 0; i < 3; ++i)
  {
    const double scattering = resolved * settings.ScatteringColor[i];
    const double rayleigh = settings.Rayleigh * RayleighFactors[i];
    channels[i] = { scattering, rayleigh,
      std::max(settings.Extinction * settings.ExtinctionColor[i], scattering) + rayleigh };
  }
  return channels;
}

/// Returns true if all channels have the same coefficients.
inline bool AreEqual(const std::array<MediumCoefficients, 3>& channels)
{
  return channels[0] == channels[1] && channels[0] == channels[2];
}

/// Returns a sentence about the first invalid setting, or null.
inline const char* FindInvalidMediumSetting(const MediumSettings& settings)
{
  if (!std::isfinite(settings.Scattering) || !std::isfinite(settings.Extinction))
  {
    return "Scattering and Extinction must be finite";
  }
  const auto isFactor = [](double x) { return std::isfinite(x) && x >= 0.0; };
  if (!std::all_of(settings.ScatteringColor.begin(), settings.ScatteringColor.end(), isFactor) ||
    !std::all_of(settings.ExtinctionColor.begin(), settings.ExtinctionColor.end(), isFactor))
  {
    return "ScatteringColor and ExtinctionColor must be finite and not negative";
  }
  if (!isFactor(settings.Rayleigh))
  {
    return "RayleighScattering must be finite and not negative";
  }
  if (!isFactor(settings.ScaleHeight) || !std::isfinite(settings.BaseHeight))
  {
    return "ScaleHeight must be finite and not negative, BaseHeight finite";
  }
  const double length = std::hypot(settings.Up[0], settings.Up[1], settings.Up[2]);
  if (!std::isfinite(length) || !(length > 0.0))
  {
    return "Up must be a finite vector that is not zero";
  }
  return nullptr;
}

}
#endif
