// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// A window that draws a scene plainly, with our pass or with VTK's own.
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
  /// The size of the benchmark's pictures.
  static constexpr int Size[2] = { 1024, 768 };

  explicit OcclusionWindow(vtkRenderer* renderer, int width = Size[0], int height = Size[1]);
  ~OcclusionWindow();

  /// Shows occlusion by our pass; a radius in world units.
  vtkPenumbraTemporalSSAOPass* UsePenumbraPass(double radius);

  /// Shows occlusion by vtkSSAOPass with so many samples, blurred.
  void UseVTKSSAOPass(double radius, unsigned int samples);

  /// Shows none.
  void UseNone();

  /// CPU seconds of one frame.
  double Draw();

  /// An array of our pass's last frame.
  std::vector<float> Array(const std::string& name);

  /// 1 - brightness of the last frame: the occlusion, of white unlit scenes.
  std::vector<float> OcclusionFromBrightness();

  vtkPenumbraTemporalSSAOPass* Ours = nullptr;

private:
  vtkRenderer* Renderer;
  vtkNew<vtkRenderWindow> Window;
};

/// A picture of one array of the benchmark's size, white for 0, black for `black`.
void WritePicture(const std::string& path, const std::vector<float>& values, double black = 1.0);

}
#endif
