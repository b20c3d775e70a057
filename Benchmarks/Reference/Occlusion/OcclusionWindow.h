// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// A window that renders a scene without ambient occlusion, with vtkPenumbraTemporalSSAOPass, or
// with vtkSSAOPass.
#ifndef penumbra_occlusion_OcclusionWindow_h
#define penumbra_occlusion_OcclusionWindow_h

#include "vtkNew.h"
#include "vtkPenumbraTemporalSSAOPass.h"
#include "vtkRenderWindow.h"
#include "vtkRenderer.h"

#include <string>
#include <vector>

namespace penumbra
{

class OcclusionWindow
{
public:
  /// Size of the benchmark's images, in pixels.
  static constexpr int Size[2] = { 1024, 768 };

  explicit OcclusionWindow(vtkRenderer* renderer, int width = Size[0], int height = Size[1]);
  ~OcclusionWindow();

  /// Enables vtkPenumbraTemporalSSAOPass; the radius is in world units.
  vtkPenumbraTemporalSSAOPass* UsePenumbraPass(double radius);

  /// Enables vtkSSAOPass with blur and the given number of samples.
  void UseVTKSSAOPass(double radius, unsigned int samples);

  /// Disables ambient occlusion.
  void UseNone();

  /// Renders one frame and returns its time, see FrameClock.h.
  double Draw();

  /// Returns an array of the last frame of vtkPenumbraTemporalSSAOPass.
  std::vector<float> Array(const std::string& name);

  /// Returns 1 - brightness of the last frame, which is the occlusion in white unlit scenes.
  std::vector<float> OcclusionFromBrightness();

  vtkPenumbraTemporalSSAOPass* Ours = nullptr;

private:
  vtkRenderer* Renderer;
  vtkNew<vtkRenderWindow> Window;
};

/// Writes an array of the benchmark's size as a grayscale image: 0 is white, `black` is black.
void WriteImage(const std::string& path, const std::vector<float>& values, double black = 1.0);

}
#endif
