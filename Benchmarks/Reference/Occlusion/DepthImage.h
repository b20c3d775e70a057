// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Pictures with depths as sort-last parallel rendering has them: taken from windows, put together by
// depth, shown by a pass that knows nothing of the scene.
#ifndef penumbra_occlusion_DepthImage_h
#define penumbra_occlusion_DepthImage_h

#include "Frame/Stage.h"

#include "vtkRenderPass.h"

#include <vector>

class vtkRenderWindow;

namespace penumbra
{

/// Colours (RGBA, 0 to 1) and depths (0 to 1), row after row.
struct DepthImage
{
  std::vector<float> Colors;
  std::vector<float> Depths;
};

/// What a window has drawn.
DepthImage CaptureDepthImage(vtkRenderWindow* window);

/// Whatever is nearer in another picture of the same size.
void DepthComposite(DepthImage& whole, const DepthImage& part);

/// Shows a picture that was made elsewhere, of the window's size.
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
