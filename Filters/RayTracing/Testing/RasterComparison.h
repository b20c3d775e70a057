// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Compares the colours of extraction and shading with VTK's own rasterised picture, at the centres
// of pixels that lie inside one cell.
#ifndef RasterComparison_h
#define RasterComparison_h

#include "Scene.h"

#include "vtkNew.h"
#include "vtkRenderWindow.h"
#include "vtkRenderer.h"

#include <vector>

/// A renderer in a small offscreen window without multisampling.
class RasterComparison
{
public:
  RasterComparison();

  /// How much the two pictures differ.
  struct Result
  {
    int Pixels = 0;          ///< compared: a cell's, and their eight neighbours the same cell's
    int Different = 0;       ///< of them, off by more than 2/255
    double Largest = 0.0;    ///< difference, in units of 1/255
    int Where[2] = { 0, 0 }; ///< the pixel of the largest difference
    penumbra::Scene Scene;
  };

  Result Compare();

  vtkNew<vtkRenderer> Renderer;
  vtkNew<vtkRenderWindow> Window;
  static constexpr int Size = 96;
};

#endif
