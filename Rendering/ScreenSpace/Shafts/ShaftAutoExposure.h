// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Automatic exposure of in-scattered light [Shafts 13.8]: a gain computed from the mean brightness
// of the attenuated scene and the brightness range of the in-scattered light, smoothed over time.
#ifndef penumbra_ShaftAutoExposure_h
#define penumbra_ShaftAutoExposure_h

#include "Frame/DelegateImage.h"
#include "Frame/Stage.h"

#include <deque>
#include <vector>

class vtkPixelBufferObject;

namespace penumbra
{

class ShaftAutoExposure
{
public:
  /// Updates the gain for a new image. The first image determines it, later ones move it by
  /// ExposureAdaptationRate. If the last frame had a new image, too (`moving`), the brightness of the
  /// image FramesUntilExposure before is used: it has arrived, so that no frame waits for the graphics
  /// card. `background` is the color of empty pixels; null if the delegate draws the background.
  /// Returns false if OpenGL reports an error.
  bool Update(vtkOpenGLRenderWindow* window, const DelegateImage& image, vtkTextureObject* shafts,
    const double* background, bool moving);

  double GetGain() const { return this->Gain; }

  /// Discards the gain; the next image determines it.
  void Reset();

  void ReleaseGraphicsResources(vtkWindow* window);

private:
  void AdaptTo(const std::vector<float>& cells);

  Stage Brightness;
  vtkSmartPointer<vtkTextureObject> Cells;
  std::deque<vtkSmartPointer<vtkPixelBufferObject>> Pending; ///< Cells of the last images
  double Gain = 0.0;                                         ///< 0: not computed yet
};

}
#endif
