// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Lit shares as the paper finds them: a picture of what glows, and its mean on the way to the light,
// in one loop or in chained passes [Shafts eq. 3 and 4, 13.5, 13.8].
#ifndef penumbra_ShaftRadial_h
#define penumbra_ShaftRadial_h

#include "Frame/DelegateImage.h"
#include "Frame/Stage.h"
#include "ShaftLights.h"

namespace penumbra
{

/// See vtkPenumbraLightShaftPass.
struct RadialSettings
{
  int Steps = 64;
  int Passes = 1;
  bool Geometric = false;
  double Weight = 1.0;
  double Decay = 1.0;
  double Density = 1.0;
  double SurfaceGlow = 0.0;  ///< 0: occluders are black
  bool SkyIsPicture = false; ///< else white, or black where emitters are chosen
  int Block = 1;             ///< pixels a side of the blocks for which lit shares are found
  bool DelegateDrawsBackground = true;

  /// What glows depends on more than depth.
  bool ReadsColors() const { return this->SkyIsPicture || this->SurfaceGlow > 0.0; }

  bool operator==(const RadialSettings& other) const;
};

class ShaftRadial
{
public:
  /// Finds out what glows in the delegate's picture; before anything is drawn over the picture behind
  /// it. `coarse` is the view of the blocks. `emitters`: their picture, null: there are none.
  bool FillGlow(vtkOpenGLRenderWindow* window, const DelegateImage& image, const ScreenView& coarse,
    vtkTextureObject* emitters, const RadialSettings& settings);

  /// rgb: lit share, a: eye depth, of each block into `target`.
  bool Find(vtkOpenGLRenderWindow* window, const DelegateImage& image, const ScreenView& coarse,
    vtkTextureObject* eyeDepths, const ShaftLight& light, const RadialSettings& settings,
    vtkTextureObject* target);

  void ReleaseGraphicsResources(vtkWindow* window);

private:
  bool CopyBehind(vtkOpenGLRenderWindow* window, const DelegateImage& image);

  Stage Glow;
  Stage Mean;
  vtkSmartPointer<vtkTextureObject> Behind;
  vtkSmartPointer<vtkTextureObject> Glows;
  vtkSmartPointer<vtkTextureObject> Between[2]; ///< of chained passes
  vtkSmartPointer<vtkOpenGLFramebufferObject> Copy;
};

}
#endif
