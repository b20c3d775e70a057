// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Automatic exposure of in-scattered light [Shafts 13.8]: a gain computed from the mean brightness
// of the attenuated scene and the brightness range of the in-scattered light, smoothed over time.
#ifndef penumbra_ShaftAutoExposure_h
#define penumbra_ShaftAutoExposure_h

#include "Frame/DelegateImage.h"
#include "Frame/Stage.h"

namespace penumbra
{

class ShaftAutoExposure
{
public:
  /// Updates the gain for a new image. The first image determines it; later ones move it by
  /// AdaptationRate. `background` is the color of empty pixels; null if the delegate draws the
  /// background. Returns false if OpenGL reports an error.
  bool Update(vtkOpenGLRenderWindow* window, const DelegateImage& image, vtkTextureObject* shafts,
    const double* background);

  double GetGain() const { return this->Gain; }

  /// Discards the gain; the next image determines it.
  void Reset() { this->Gain = 0.0; }

  void ReleaseGraphicsResources(vtkWindow* window);

private:
  Stage Brightness;
  vtkSmartPointer<vtkTextureObject> Cells;
  double Gain = 0.0; ///< 0: not computed yet
};

}
#endif
