// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Settings, counts and result of the integration of pixels.
#ifndef penumbra_IntegrationSettings_h
#define penumbra_IntegrationSettings_h

#include "Execution/WorkLimit.h"
#include "vtkPenumbraRayCasterConstants.h"

#include <glm/glm.hpp>

#include <cmath>

namespace penumbra
{

class SampleLight;

/// Settings of PixelIntegrator; see the properties and constants of vtkPenumbraRayCaster with the same
/// names.
struct IntegrationSettings
{
  CoverageMethods Method = CoverageMethods::Silhouettes;
  double Tolerance = 1.0 / 256.0;
  int MaximumLevel = 3;
  bool FindSmallObjects = true;
  int UniformSamples = 8;
  bool Rasterize = true; ///< if off, samples are always traced
  bool Shadows = false;
  double LightTolerance = 0.0; ///< accepted RMSE that light effects add; 0: there are none
  double Noise = 0.0;          ///< standard error of sampled colors, which refinement cannot reduce
  const SampleLight* Light = nullptr; ///< of pixels that it selects; null: none
  WorkLimit* Limit = nullptr;         ///< ends the refinement of pixels early; null: none

  /// Returns the accepted RMSE of a tile.
  double GetTileTolerance() const
  {
    return this->LightTolerance > 0.0 ? std::hypot(this->Tolerance, this->LightTolerance)
                                      : this->Tolerance;
  }
};

/// Number of pixels by method.
struct PixelCounts
{
  long long Empty = 0;       ///< case 1: only background
  long long Interior = 0;    ///< case 2: mean of the corners or of the texels
  long long Edge = 0;        ///< case 3: exact coverage between edges
  long long SmallObject = 0; ///< case 4: edges between four corners on one surface
  long long Refined = 0;     ///< subdivided because of contrast, or without edges
  long long Uniform = 0;     ///< sampled: too many edges, dense geometry, or Uniform

  PixelCounts& operator+=(const PixelCounts& other)
  {
    this->Empty += other.Empty;
    this->Interior += other.Interior;
    this->Edge += other.Edge;
    this->SmallObject += other.SmallObject;
    this->Refined += other.Refined;
    this->Uniform += other.Uniform;
    return *this;
  }
};

/// Color and estimated error of a pixel.
struct PixelResult
{
  glm::vec4 Color{ 0.f }; ///< premultiplied by alpha
  float Error = 0.f;      ///< estimated RMS error of the three color components
  float LightError = 0.f; ///< part of Error that light effects cause
  float Occlusion = 0.f;  ///< mean of the surfaces in a pixel whose samples are lit
};

}
#endif
