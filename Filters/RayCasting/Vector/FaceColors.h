// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Colors of the visible triangles of an image as linear functions of the image coordinates, fitted
// to samples by least squares.
#ifndef penumbra_FaceColors_h
#define penumbra_FaceColors_h

#include "Sampling/CameraRayTracer.h"
#include "VectorFigure.h"

#include <vector>

namespace penumbra
{

/// Sums over the samples of one triangle.
class FaceColor
{
public:
  /// Number of samples that show the triangle; 0: it is hidden.
  int GetCount() const { return this->Count; }

  void Add(glm::dvec2 p, glm::dvec3 color);

  /// Sets the color or the gradient of `path`, whose points are set. Returns the sum of the squared
  /// differences from the samples over the three channels.
  double Paint(FigurePath& path) const;

  /// Returns the sum of the squared differences of the samples from their linear fit, 0 if they do not
  /// determine one.
  double GetResidual() const;

private:
  /// Sum over the channels of the squared differences from the mean.
  double GetVariance() const;

  /// Computes the derivatives of the channels by x and y. Returns false if the samples do not
  /// determine them, which are then 0.
  bool Fit(glm::dvec3& byX, glm::dvec3& byY) const;

  int Count = 0;
  glm::dvec2 Origin{ 0.0 }; ///< the first sample; the sums are relative to it
  glm::dvec2 Sum{ 0.0 };
  double SumXX = 0.0;
  double SumXY = 0.0;
  double SumYY = 0.0;
  glm::dvec3 Colors{ 0.0 };
  glm::dvec3 ColorsX{ 0.0 };
  glm::dvec3 ColorsY{ 0.0 };
  glm::dvec3 Squares{ 0.0 };
};

/// Samples the image on a regular grid, of which every `step`-th row and column is used, and returns the
/// colors of the triangles of all surfaces in order. The scene must be opaque.
std::vector<FaceColor> SampleFaceColors(const CameraRayTracer& tracer, int step = 1);

/// If true, linear functions of the triangles cannot show the image within `tolerance`, an RMSE. Found
/// from few samples, before light is computed at all of them; false does not mean that they can.
bool ExceedTolerance(const CameraRayTracer& tracer, double tolerance);

/// Number of samples per side of a pixel in SampleFaceColors().
constexpr int FaceSamplesPerPixelSide = 2;

}
#endif
