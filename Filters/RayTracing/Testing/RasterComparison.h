// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Compares ray-traced shading with the image of VTK's rasterizer, at the centers of pixels inside
// one cell.
#ifndef RasterComparison_h
#define RasterComparison_h

#include "Scene.h"
#include "Surface.h"

#include "vtkNew.h"
#include "vtkRenderWindow.h"
#include "vtkRenderer.h"

#include <vector>

/// A renderer in a small offscreen window without multisampling.
class RasterComparison
{
public:
  RasterComparison();

  /// Difference between the two images.
  struct Result
  {
    int Pixels = 0;          ///< compared pixels: they and their eight neighbors show the same cell
    int Different = 0;       ///< compared pixels that differ by more than 2/255
    double Largest = 0.0;    ///< largest difference, in units of 1/255
    int Where[2] = { 0, 0 }; ///< pixel of the largest difference
    penumbra::Scene Scene;
  };

  Result Compare();

  vtkNew<vtkRenderer> Renderer;
  vtkNew<vtkRenderWindow> Window;
  static constexpr int Size = 96;
};

#endif
