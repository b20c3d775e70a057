// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// The automatic tone balance [Shafts 13.8]: a gain for scattered light, from the mean brightness of
// the picture behind it and the least and largest brightness of its own, steady in time.
#ifndef penumbra_ShaftAutoExposure_h
#define penumbra_ShaftAutoExposure_h

#include "Frame/DelegateImage.h"
#include "Frame/Stage.h"

namespace penumbra
{

class ShaftAutoExposure
{
public:
  /// Looks at a new picture. `behind`: colour of the background, null: the delegate draws it. The
  /// first picture settles the gain, later ones only move it. False when OpenGL refuses.
  bool Update(vtkOpenGLRenderWindow* window, const DelegateImage& image, vtkTextureObject* shafts,
    const double* behind);

  double GetGain() const { return this->Gain; }

  /// The next picture settles the gain.
  void Forget() { this->Gain = 0.0; }

  void ReleaseGraphicsResources(vtkWindow* window);

private:
  Stage Brightness;
  vtkSmartPointer<vtkTextureObject> Cells;
  double Gain = 0.0; ///< 0: none yet
};

}
#endif
