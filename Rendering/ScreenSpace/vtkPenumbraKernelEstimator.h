// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkPenumbraKernelEstimator
 * @brief   Estimates ambient occlusion from the depth buffer, with a kernel of vtkPenumbraKernels.
 */
#ifndef vtkPenumbraKernelEstimator_h
#define vtkPenumbraKernelEstimator_h

#include "vtkPenumbraOcclusionEstimator.h"
#include "vtkPenumbraSetNumber.h" // for setters

#include <memory> // for std::unique_ptr
#include <string>

class VTKPENUMBRARENDERINGSCREENSPACE_EXPORT vtkPenumbraKernelEstimator
  : public vtkPenumbraOcclusionEstimator
{
public:
  static vtkPenumbraKernelEstimator* New();
  vtkTypeMacro(vtkPenumbraKernelEstimator, vtkPenumbraOcclusionEstimator);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /** Index of the kernel in vtkPenumbraKernels. Default: 0. */
  virtual void SetKernel(int kernel);
  vtkGetMacro(Kernel, int);
  ///@}

  ///@{
  /**
   * Assumed thickness of visible surfaces, in radii, for kernels that use it. 0: estimated from the
   * width of objects in the image. Range: [0, 1000]. Default: 0.
   */
  vtkPenumbraSetClampedNumberMacro(Thickness, 0.0, 1000.0);
  vtkGetMacro(Thickness, double);
  ///@}

  /** Bias of the kernel, from vtkPenumbraKernels. */
  double GetBias() override;
  int Estimate(const Request& request, vtkTextureObject* target) override;
  std::string GetShader() override;
  int SetUniforms(const Request& request, vtkShaderProgram* program) override;
  void ReleaseGraphicsResources(vtkWindow* window) override;

protected:
  vtkPenumbraKernelEstimator();
  ~vtkPenumbraKernelEstimator() override;

private:
  vtkPenumbraKernelEstimator(const vtkPenumbraKernelEstimator&) = delete;
  void operator=(const vtkPenumbraKernelEstimator&) = delete;

  double ComputeThickness(const Request& request);

  struct Internals;
  std::unique_ptr<Internals> Implementation;

  int Kernel = 0;
  double Thickness = 0.0;
};

#endif
