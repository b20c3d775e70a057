// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Images with depth, as sort-last parallel rendering produces them: read from windows, composited
// by depth, and displayed by a pass that has no access to the scene.
#ifndef penumbra_occlusion_DepthImage_h
#define penumbra_occlusion_DepthImage_h

#include "Frame/Stage.h"

#include "vtkRenderPass.h"

#include <vector>

class vtkRenderWindow;

namespace penumbra
{

/// Colors (RGBA, in [0, 1]) and depths (in [0, 1]), row by row.
struct DepthImage
{
  std::vector<float> Colors;
  std::vector<float> Depths;
};

/// Reads color and depth of the last frame of a window.
DepthImage CaptureDepthImage(vtkRenderWindow* window);

/// Copies the pixels of another image of the same size that are nearer.
void DepthComposite(DepthImage& whole, const DepthImage& part);

/// Displays a given image of the window's size.
class ShowDepthImagePass : public vtkRenderPass
{
public:
  static ShowDepthImagePass* New();
  vtkTypeMacro(ShowDepthImagePass, vtkRenderPass);

  void Render(const vtkRenderState* state) override;
  void ReleaseGraphicsResources(vtkWindow* window) override;

  DepthImage Shown;

protected:
  ShowDepthImagePass() = default;
  ~ShowDepthImagePass() override = default;

private:
  ShowDepthImagePass(const ShowDepthImagePass&) = delete;
  void operator=(const ShowDepthImagePass&) = delete;

  Stage Draw;
  vtkSmartPointer<vtkTextureObject> Colors;
  vtkSmartPointer<vtkTextureObject> Depths;
};

}
#endif
