// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Test fixture: a small offscreen window with one renderer, functions that add walls and spheres,
// and access to the results of the occlusion pass.
#ifndef OcclusionScene_h
#define OcclusionScene_h

#include "vtkPenumbraTemporalSSAOPass.h"

#include "vtkActor.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkRenderWindow.h"
#include "vtkRenderer.h"
#include "vtkSmartPointer.h"

#include <array>
#include <string>
#include <vector>

using Vector = std::array<double, 3>;

class OcclusionScene
{
public:
  OcclusionScene(int width = 160, int height = 120, int multiSamples = 0);

  /// Adds a parallelogram, given by a corner and two sides, in unlit white.
  vtkSmartPointer<vtkActor> AddWall(
    const Vector& corner, const Vector& firstSide, const Vector& secondSide);
  /// Adds the square [-size, size]^2 in the plane z = 0.
  vtkSmartPointer<vtkActor> AddFloor(double size = 20.0);
  vtkSmartPointer<vtkActor> AddSphere(const Vector& center, double radius);

  void SetCamera(const Vector& from, const Vector& at, const Vector& up = { 0.0, 0.0, 1.0 });

  /// \c halfHeight: half the height of the image, in world units.
  void UseParallelProjection(bool parallel, double halfHeight);

  /// Adds the occlusion pass with a radius in world units.
  vtkPenumbraTemporalSSAOPass* AddOcclusionPass(double radius);

  /// Counts the warnings of the pass in `Warnings` from now on.
  void CountWarnings();

  /// Returns an array of the last frame, row by row from the bottom.
  std::vector<float> Array(const std::string& name);
  /// Returns the image, RGBA, each in [0, 255].
  std::vector<int> Image();
  /// Returns the value of an array at the pixel that shows a world position, or -1 outside the
  /// image.
  double At(const std::string& name, const Vector& position);
  /// Returns the pixel that shows a world position.
  std::array<int, 2> Pixel(const Vector& position);

  /// Returns the point of the plane z = 0 at a position in the image, in pixels.
  Vector FloorPointAt(double x, double y);

  vtkNew<vtkRenderer> Renderer;
  vtkNew<vtkRenderWindow> Window;
  int Width;
  int Height;
  vtkPenumbraTemporalSSAOPass* Pass = nullptr;
  int Warnings = 0; ///< of the pass, since CountWarnings()
};

/// Adds a sphere on a floor in front of a wall, in units of `unit` around `at`, and sets the
/// camera.
void AddSphereBeforeWall(OcclusionScene& scene, double unit = 1.0, const Vector& at = { 0, 0, 0 });

/// Returns the occlusion with radius 1 and D = 1 of a floor at a distance from an infinite wall.
double BehindWall(double distance);

/// The same with D = 1 - t: the mean over all radii in [0, 1], because 1 - t is the fraction of
/// radii above t.
double BehindWallFading(double distance);

/// Adds a floor and a wall in the plane y = 0 to a scene whose occlusion has the radius 1, and
/// renders it. Returns the errors in a column of floor pixels up to the wall, one value per row of
/// the image.
std::vector<double> ErrorsBeforeAWall(
  OcclusionScene& scene, double (*reference)(double) = BehindWall);

double RootMeanSquare(const std::vector<double>& values);

/// Returns the RMS difference of two arrays, or 1e9 if they are empty or differ in size.
double Rms(const std::vector<float>& a, const std::vector<float>& b);

#endif
