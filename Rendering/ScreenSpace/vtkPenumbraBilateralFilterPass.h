// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkPenumbraBilateralFilterPass
 * @brief   Smooths the image of its delegate without crossing edges of surfaces [TSSAO eq. 10].
 *
 * A separable cross-bilateral filter of colors. Neighbors are weighted by their distance from the
 * surface point of the pixel, along the view axis or in space, and by an optional image of weights.
 * Pixels without a surface and the depth are not modified.
 */
#ifndef vtkPenumbraBilateralFilterPass_h
#define vtkPenumbraBilateralFilterPass_h

#include "vtkPenumbraRenderingScreenSpaceModule.h" // for export macro
#include "vtkPenumbraScreenSpacePass.h"
#include "vtkPenumbraSetNumber.h" // for setters
#include "vtkSmartPointer.h"      // for members

#include <memory> // for std::unique_ptr

class vtkImageData;

class VTKPENUMBRARENDERINGSCREENSPACE_EXPORT vtkPenumbraBilateralFilterPass
  : public vtkPenumbraScreenSpacePass
{
public:
  static vtkPenumbraBilateralFilterPass* New();
  vtkTypeMacro(vtkPenumbraBilateralFilterPass, vtkPenumbraScreenSpacePass);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /** Filter radius in pixels. Range: [0, 32]. Default: 2. */
  vtkSetClampMacro(Radius, int, 0, 32);
  vtkGetMacro(Radius, int);
  ///@}

  ///@{
  /**
   * Distance at which the weight of a neighbor falls to 1/e, in world units. 0: four pixel widths
   * at the focal point of the camera. Range: >= 0. Default: 0.
   */
  vtkPenumbraSetClampedNumberMacro(DistanceSigma, 0.0, VTK_DOUBLE_MAX);
  vtkGetMacro(DistanceSigma, double);
  ///@}

  ///@{
  /** If on, distances are measured along the view axis only, else in space. Default: off. */
  vtkSetMacro(UseDepthDistance, bool);
  vtkGetMacro(UseDepthDistance, bool);
  vtkBooleanMacro(UseDepthDistance, bool);
  ///@}

  ///@{
  /**
   * Weights of pixels: first component of the point scalars of an image of the size of the frame.
   * Range: >= 0. An image of another size is ignored. Default: none, all pixels have the same
   * weight.
   */
  virtual void SetWeights(vtkImageData* weights);
  vtkImageData* GetWeights();
  ///@}

  void ReleaseGraphicsResources(vtkWindow* w) override;

protected:
  vtkPenumbraBilateralFilterPass();
  ~vtkPenumbraBilateralFilterPass() override;

  bool RenderEffect(const vtkRenderState* state) override;
  const char* GetEffectName() override { return "the bilateral filter"; }

private:
  vtkPenumbraBilateralFilterPass(const vtkPenumbraBilateralFilterPass&) = delete;
  void operator=(const vtkPenumbraBilateralFilterPass&) = delete;

  struct Internals;
  std::unique_ptr<Internals> Implementation;

  int Radius = 2;
  double DistanceSigma = 0.0;
  bool UseDepthDistance = false;
};

#endif
