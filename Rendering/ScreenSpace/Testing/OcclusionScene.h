// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// A small offscreen window with one renderer, walls and spheres to put into it, and what the
// occlusion pass makes of them.
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

  /// A parallelogram with one corner and two sides, unlit white.
  vtkSmartPointer<vtkActor> AddWall(const Vector& corner, const Vector& side, const Vector& other);
  /// The square of the plane z = 0 within +-size.
  vtkSmartPointer<vtkActor> AddFloor(double size = 20.0);
  vtkSmartPointer<vtkActor> AddSphere(const Vector& center, double radius);

  void SetCamera(const Vector& from, const Vector& at, const Vector& up = { 0.0, 0.0, 1.0 });

  /// \c halfHeight of the picture in world units.
  void UseParallelProjection(bool parallel, double halfHeight);

  /// Adds the pass, with a radius in world units.
  vtkPenumbraTemporalSSAOPass* AddOcclusionPass(double radius);

  /// The array of the last frame, row after row from below.
  std::vector<float> Array(const std::string& name);
  /// The picture, RGBA, 0 to 255.
  std::vector<int> Picture();
  /// The value of an array where a world position is seen.
  double At(const std::string& name, const Vector& position);
  /// The pixel where a world position is seen.
  std::array<int, 2> Pixel(const Vector& position);

  /// The point of the plane z = 0 that is seen at a place of the picture, in pixels.
  Vector FloorPointAt(double x, double y);

  vtkNew<vtkRenderer> Renderer;
  vtkNew<vtkRenderWindow> Window;
  int Width;
  int Height;
  vtkPenumbraTemporalSSAOPass* Pass = nullptr;
};

/// Occlusion with reach 1 of a floor at a distance from an endless wall, D = 1.
double BehindWall(double distance);

/// The same with D = 1 - t: the mean of walls of all shorter reaches, since 1 - t counts the reaches between t
/// and 1.
double BehindWallFading(double distance);

/// Adds a floor and a wall on the plane y = 0 to a scene with an occlusion of radius 1, draws it, and
/// compares one column of floor, up to the wall, with the truth; a value a row of pixels.
std::vector<double> ErrorsBeforeAWall(OcclusionScene& scene, double (*truth)(double) = BehindWall);

double RootMeanSquare(const std::vector<double>& values);

/// Of the differences of two arrays; huge where there is nothing to compare.
double Rms(const std::vector<float>& a, const std::vector<float>& b);

#endif
