// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkPenumbraBilateralFilterPass
 * @brief   Smooths what its delegate draws, but never across the edges of surfaces [TSSAO eq. 10].
 *
 * A separable cross-bilateral filter of colours: neighbours count by their distance from the pixel's
 * surface point, along the view axis or in space, and by an optional image of weights. Pixels
 * without a surface, and the depth, stay as they are.
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
  /** Pixels on each side, 0 to 32. Default: 2. */
  vtkSetClampMacro(Reach, int, 0, 32);
  vtkGetMacro(Reach, int);
  ///@}

  ///@{
  /**
   * Distance at which a neighbour counts 1/e, in world units; 0: four pixel widths at the camera's
   * focal point. Default: 0.
   */
  vtkPenumbraSetClampedNumberMacro(Distance, 0.0, VTK_DOUBLE_MAX);
  vtkGetMacro(Distance, double);
  ///@}

  ///@{
  /** Measure distances along the view axis only. Default: off, in space. */
  vtkSetMacro(ByDepth, bool);
  vtkGetMacro(ByDepth, bool);
  vtkBooleanMacro(ByDepth, bool);
  ///@}

  ///@{
  /**
   * Weights of pixels: point scalars of an image of the picture's size, its first component, 0 and
   * more. An image of another size is ignored. Default: none, all count the same.
   */
  virtual void SetWeights(vtkImageData* weights);
  vtkImageData* GetWeights();
  ///@}

  void ReleaseGraphicsResources(vtkWindow* window) override;

protected:
  vtkPenumbraBilateralFilterPass();
  ~vtkPenumbraBilateralFilterPass() override;

  bool RenderEffect(const vtkRenderState* state) override;
  const char* GetEffectName() override { return "its filter"; }

private:
  vtkPenumbraBilateralFilterPass(const vtkPenumbraBilateralFilterPass&) = delete;
  void operator=(const vtkPenumbraBilateralFilterPass&) = delete;

  struct Internals;
  std::unique_ptr<Internals> Implementation;

  int Reach = 2;
  double Distance = 0.0;
  bool ByDepth = false;
};

#endif
