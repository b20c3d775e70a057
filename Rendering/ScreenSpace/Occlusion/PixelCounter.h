// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Counts pixels by the fate of their history. The counts of blocks of pixels are computed by a
// shader, so that only a few numbers are read back instead of whole textures.
#ifndef penumbra_PixelCounter_h
#define penumbra_PixelCounter_h

#include "Frame/DelegateImage.h"
#include "Frame/Stage.h"

namespace penumbra
{

/// Numbers of pixels in the image without its margin.
struct HistoryCounts
{
  long long Surface = 0;
  long long Kept = 0;
  long long ActorMotion = 0; ///< reprojected with the motion of their actor
  long long Disoccluded = 0;
  long long Invalidated = 0;
  long long Converged = 0;
};

class PixelCounter
{
public:
  struct Inputs
  {
    vtkTextureObject* EyeDepths = nullptr;
    vtkTextureObject* History = nullptr;
    vtkTextureObject* MovedActors = nullptr; ///< of ActorMotion, or null if no actor moved
    double NewWeight = 0.0;                  ///< samples per pixel in the last frame
    double InvalidationWeight = 0.0;
    double ConvergedWeight = 0.0; ///< weight from which a pixel counts as converged
  };

  /// Returns zeros if OpenGL reports an error.
  HistoryCounts Count(
    vtkOpenGLRenderWindow* window, const DelegateImage& image, const Inputs& inputs);

  void ReleaseGraphicsResources(vtkWindow* window);

private:
  Stage CountBlocks;
  vtkSmartPointer<vtkTextureObject> Counts[2];
};

}
#endif
