// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Lit shares as the paper finds them: a picture of what glows, and its mean on the way to the light,
// in one loop or in chained passes [Shafts eq. 3 and 4, 13.5, 13.8].
#ifndef penumbra_ShaftRadialBlur_h
#define penumbra_ShaftRadialBlur_h

#include "Frame/DelegateImage.h"
#include "Frame/Stage.h"
#include "ShaftLights.h"

namespace penumbra
{

/// See vtkPenumbraLightShaftPass.
struct RadialBlurSettings
{
  int Steps = 64;
  int Passes = 1;
  bool Geometric = false;
  double Weight = 1.0;
  double Decay = 1.0;
  double Density = 1.0;
  double SurfaceEmission = 0.0; ///< 0: occluders are black
  bool SkyIsPicture = false;    ///< else white, or black where emitters are chosen
  int Block = 1;                ///< pixels a side of the blocks for which lit shares are found
  bool DelegateDrawsBackground = true;

  /// What glows depends on more than depth.
  bool DependsOnColor() const { return this->SkyIsPicture || this->SurfaceEmission > 0.0; }

  bool operator==(const RadialBlurSettings& other) const;
};

class ShaftRadialBlur
{
public:
  /// Finds out what glows in the delegate's picture; before anything is drawn over the picture behind
  /// it. `coarse` is the view of the blocks. `emitters`: their picture, null: there are none.
  bool DrawEmission(vtkOpenGLRenderWindow* window, const DelegateImage& image,
    const ScreenTransform& coarse, vtkTextureObject* emitters, const RadialBlurSettings& settings);

  /// rgb: lit share, a: eye depth, of each block into `target`.
  bool Find(vtkOpenGLRenderWindow* window, const DelegateImage& image,
    const ScreenTransform& coarse, vtkTextureObject* eyeDepths, const ShaftLight& light,
    const RadialBlurSettings& settings, vtkTextureObject* target);

  void ReleaseGraphicsResources(vtkWindow* window);

private:
  bool CopyBehind(vtkOpenGLRenderWindow* window, const DelegateImage& image);

  Stage EmissionStage;
  Stage Mean;
  vtkSmartPointer<vtkTextureObject> Behind;
  vtkSmartPointer<vtkTextureObject> Emission;
  vtkSmartPointer<vtkTextureObject> Between[2]; ///< of chained passes
  vtkSmartPointer<vtkOpenGLFramebufferObject> Copy;
};

}
#endif
