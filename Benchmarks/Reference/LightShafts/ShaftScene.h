// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Black solids in a homogeneous medium, rendered by the light shaft pass and by the ray caster's
// marched reference. Both images contain only in-scattered light.
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
  /// Adds the square of half side `size` in the plane z = 0.
  vtkSmartPointer<vtkActor> AddFloor(double size);
  /// Adds one actor with a row of posts in the plane y = 0 on a slab.
  vtkSmartPointer<vtkActor> AddComb(int posts);
  /// Adds boxes and spheres above a floor, at positions of a pseudorandom sequence with the given
  /// seed.
  void AddSolids(int count, unsigned int seed);

  vtkSmartPointer<vtkLight> AddSun(const Vector& toward);
  vtkSmartPointer<vtkLight> AddLamp(const Vector& place);
  void Look(const Vector& from, const Vector& at, double angle = 40.0);

  /// Sets the same medium for the pass and for the reference.
  void SetMedium(double scattering, double extinction);

  /// Light added to each pixel (red channel only), row by row from the bottom.
  std::vector<double> RenderWithPass();
  std::vector<double> RenderWithRayCaster(int steps = 256, long long* shadowRays = nullptr);
  /// Transmittance of each pixel as computed by the pass; valid after RenderWithPass().
  std::vector<double> Transmittance();
  /// Pixels within `reach` pixels of a depth discontinuity; valid after RenderWithPass().
  std::vector<bool> NearEdges(int reach);

  const int Width;
  const int Height;
  vtkNew<vtkRenderer> Renderer;
  vtkNew<vtkRenderWindow> Window;
  vtkPenumbraLightShaftPass* Pass = nullptr;
};

#endif
