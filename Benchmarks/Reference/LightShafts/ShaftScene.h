// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Black solids in haze, seen by the light shaft pass and by the ray caster's marched reference: what
// both show is scattered light alone.
#ifndef ShaftScene_h
#define ShaftScene_h

#include "vtkPenumbraLightShaftPass.h"

#include "vtkActor.h"
#include "vtkLight.h"
#include "vtkNew.h"
#include "vtkRenderWindow.h"
#include "vtkRenderer.h"
#include "vtkSmartPointer.h"

#include <array>
#include <vector>

using Vector = std::array<double, 3>;

class ShaftScene
{
public:
  ShaftScene(int width, int height);

  vtkSmartPointer<vtkActor> AddBox(const Vector& center, const Vector& size);
  vtkSmartPointer<vtkActor> AddSphere(const Vector& center, double radius);
  /// The square of half side `size` in the plane z = 0.
  vtkSmartPointer<vtkActor> AddFloor(double size);
  /// Boxes and spheres over a floor, their places from a sequence that `seed` begins.
  void AddSolids(int count, unsigned int seed);

  vtkSmartPointer<vtkLight> AddSun(const Vector& towards);
  vtkSmartPointer<vtkLight> AddLamp(const Vector& place);
  void Look(const Vector& from, const Vector& at, double angle = 40.0);

  /// The same medium for pass and reference.
  void SetMedium(double scattering, double extinction);

  /// What is added to each pixel, red alone, row after row from below.
  std::vector<double> RenderWithPass();
  std::vector<double> RenderWithRayCaster(int steps = 256, long long* shadowRays = nullptr);
  /// What is left of the picture, by the pass, after ByPass().
  std::vector<double> Transmittance();
  /// Pixels within `reach` of a jump of depth, by the pass, after ByPass().
  std::vector<bool> NearEdges(int reach);

  const int Width;
  const int Height;
  vtkNew<vtkRenderer> Renderer;
  vtkNew<vtkRenderWindow> Window;
  vtkPenumbraLightShaftPass* Pass = nullptr;
};

#endif
