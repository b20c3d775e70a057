// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Pictures with depths as sort-last parallel rendering has them: taken from windows, put together by
// depth, shown by a pass that knows nothing of the scene.
#ifndef penumbra_occlusion_ShownPicture_h
#define penumbra_occlusion_ShownPicture_h

#include "Frame/Stage.h"

#include "vtkRenderPass.h"

#include <vector>

class vtkRenderWindow;

namespace penumbra
{

/// Colours (RGBA, 0 to 1) and depths (0 to 1), row after row.
struct DepthPicture
{
  std::vector<float> Colors;
  std::vector<float> Depths;
};

/// What a window has drawn.
DepthPicture TakePicture(vtkRenderWindow* window);

/// Whatever is nearer in another picture of the same size.
void Merge(DepthPicture& whole, const DepthPicture& part);

/// Shows a picture that was made elsewhere, of the window's size.
class ShowPicture : public vtkRenderPass
{
public:
  static ShowPicture* New();
  vtkTypeMacro(ShowPicture, vtkRenderPass);

  void Render(const vtkRenderState* state) override;
  void ReleaseGraphicsResources(vtkWindow* window) override;

  DepthPicture Shown;

protected:
  ShowPicture() = default;
  ~ShowPicture() override = default;

private:
  ShowPicture(const ShowPicture&) = delete;
  void operator=(const ShowPicture&) = delete;

  Stage Draw;
  vtkSmartPointer<vtkTextureObject> Colors;
  vtkSmartPointer<vtkTextureObject> Depths;
};

}
#endif
