// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Lit fractions by radial blur, the estimator of the paper: an emission image and its mean along
// the screen path to the light, in one loop or in chained passes [Shafts eq. 3 and 4, 13.5, 13.8].
#ifndef penumbra_ShaftRadialBlur_h
#define penumbra_ShaftRadialBlur_h

#include "Frame/DelegateImage.h"
#include "Frame/Stage.h"
#include "ShaftLights.h"

namespace penumbra
{

/// Settings of the radial blur; vtkPenumbraLightShaftPass describes them.
struct RadialBlurSettings
{
  int Steps = 64;
  int Passes = 1;
  bool Geometric = false;
  double Weight = 1.0;
  double Decay = 1.0;
  double PathRatio = 1.0;
  double SurfaceEmission = 0.0; ///< 0: occluders are black
  bool SkyIsImage = false;      ///< else white, or black if there are emitters
  int Block = 1;                ///< pixels per side of a block that shares a lit fraction
  bool DelegateDrawsBackground = true;

  /// The emission image depends on colors, not on depth only.
  bool DependsOnColor() const { return this->SkyIsImage || this->SurfaceEmission > 0.0; }

  bool operator==(const RadialBlurSettings& other) const;
};

class ShaftRadialBlur
{
public:
  /// Renders the emission image. Must be called before anything is drawn over the background of the
  /// target. `coarse` is the view of the blocks; `emitters` is the image of the emitters, or null.
  bool DrawEmission(vtkOpenGLRenderWindow* window, const DelegateImage& image,
    const ScreenTransform& coarse, vtkTextureObject* emitters, const RadialBlurSettings& settings);

  /// Computes one texel per block in `target`: rgb: lit fraction, a: eye depth.
  bool ComputeLitFractions(vtkOpenGLRenderWindow* window, const DelegateImage& image,
    const ScreenTransform& coarse, vtkTextureObject* eyeDepths, const ShaftLight& light,
    const RadialBlurSettings& settings, vtkTextureObject* target);

  void ReleaseGraphicsResources(vtkWindow* window);

private:
  bool CopyBackground(vtkOpenGLRenderWindow* window, const DelegateImage& image);

  Stage EmissionStage;
  Stage BlurStage;
  vtkSmartPointer<vtkTextureObject> Background;
  vtkSmartPointer<vtkTextureObject> Emission;
  vtkSmartPointer<vtkTextureObject> Intermediate[2]; ///< results of chained passes
  vtkSmartPointer<vtkOpenGLFramebufferObject> Copy;
};

}
#endif
