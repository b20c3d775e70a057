// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkPenumbraKernelEstimator
 * @brief   Ambient occlusion from the depth buffer alone, by one of the kernels of vtkPenumbraKernels.
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
  /** Row of vtkPenumbraKernels. Default: 0. */
  virtual void SetKernel(int kernel);
  vtkGetMacro(Kernel, int);
  ///@}

  ///@{
  /**
   * How far back what is seen is taken to reach, in radii, up to 1000; for kernels that ask. 0: as far
   * as it is wide, by the picture. Default: 0.
   */
  vtkPenumbraSetClampedNumberMacro(Thickness, 0.0, 1000.0);
  vtkGetMacro(Thickness, double);
  ///@}

  /** As vtkPenumbraKernels knows it. */
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

  double ThicknessOf(const Request& request);

  struct Internals;
  std::unique_ptr<Internals> Implementation;

  int Kernel = 0;
  double Thickness = 0.0;
};

#endif
