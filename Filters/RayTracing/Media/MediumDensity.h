// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Relative density of a medium in scene coordinates, and its integral along rays (column): in closed
// form for an exponential fall-off with height, cell by cell for an image.
#ifndef penumbra_MediumDensity_h
#define penumbra_MediumDensity_h

#include <glm/glm.hpp>

#include "vtkPenumbraFiltersRayTracingModule.h" // for export macro, which tests need

#include <limits>
#include <memory>
#include <vector>

namespace penumbra
{

/// Density at the points of a regular grid, x fastest. Trilinear between them, 0 outside.
struct VTKPENUMBRAFILTERSRAYTRACING_EXPORT DensityImage
{
  glm::ivec3 Size{ 0 }; ///< number of points, at least 2 per axis
  glm::dvec3 Low{ 0.0 };
  glm::dvec3 Spacing{ 1.0 }; ///< positive
  std::vector<float> Values;

  double At(glm::dvec3 point) const;
  glm::dvec3 High() const { return this->Low + this->Spacing * glm::dvec3(this->Size - 1); }
};

struct VTKPENUMBRAFILTERSRAYTRACING_EXPORT MediumDensity
{
  glm::dvec3 Up{ 0.0, 1.0, 0.0 };                               ///< unit
  double BaseHeight = 0.0;                                      ///< height of density 1
  double ScaleHeight = std::numeric_limits<double>::infinity(); ///< infinite: no fall-off
  std::shared_ptr<const DensityImage> Image;                    ///< null: 1 everywhere

  bool HasFalloff() const { return this->ScaleHeight < std::numeric_limits<double>::infinity(); }
  bool IsUniform() const { return !this->Image && !this->HasFalloff(); }

  double At(glm::dvec3 point) const;

  /// Returns the relative change of the density with height along `direction`: per unit of length.
  double Decay(glm::dvec3 direction) const;

  /// Returns the integral of the density along a unit direction over [0, length]; `length` and the
  /// result may be infinite.
  double Column(glm::dvec3 point, glm::dvec3 direction, double length) const;

  /// Returns the length at which Column() reaches `column`, infinite if it does not. Without image.
  double LengthOfColumn(glm::dvec3 point, glm::dvec3 direction, double column) const;

private:
  double HeightFactor(glm::dvec3 point) const;
  double MarchCells(glm::dvec3 point, glm::dvec3 direction, double length) const;
};

/// Returns exp(-extinction column); 1 without extinction.
double Attenuate(double extinction, double column);

/// Column along one ray, with intermediate results so that each value costs a few cells only.
class VTKPENUMBRAFILTERSRAYTRACING_EXPORT RayColumn
{
public:
  /// For the lengths [0, length] of the ray; finite if the density has an image.
  RayColumn(const MediumDensity& density, glm::dvec3 origin, glm::dvec3 direction, double length);

  double At(double length) const;

private:
  const MediumDensity& Density;
  glm::dvec3 Origin;
  glm::dvec3 Direction;
  double Step = 0.0;
  std::vector<double> Columns; ///< at multiples of Step
};

}
#endif
