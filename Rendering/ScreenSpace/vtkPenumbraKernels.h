// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkPenumbraKernels
 * @brief   Table of the kernels that estimate ambient occlusion from the depth buffer.
 *
 * To add a kernel, add a GLSL file and a row to the table; see Documentation/methods/Kernels.md.
 */
#ifndef vtkPenumbraKernels_h
#define vtkPenumbraKernels_h

#include "vtkObject.h"
#include "vtkPenumbraRenderingScreenSpaceModule.h" // for export macro

class VTKPENUMBRARENDERINGSCREENSPACE_EXPORT vtkPenumbraKernels : public vtkObject
{
public:
  static vtkPenumbraKernels* New();
  vtkTypeMacro(vtkPenumbraKernels, vtkObject);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /** Number of kernels. */
  static int GetNumberOfKernels();

  /** Name of a kernel, as on the command line; null if the index is out of range. */
  static const char* GetName(int kernel);

  /** Index of a kernel by name; -1 if there is none. */
  static int Find(const char* name);

  /** Citation of the kernel; null if the index is out of range. */
  static const char* GetSource(int kernel);

  /**
   * Formula of the falloff D(t) [TSSAO eq. 1] whose occlusion the kernel estimates, t in radii.
   * Empty if the kernel matches no falloff; it is then compared with the reference up to a factor.
   */
  static const char* GetFalloff(int kernel);

  /**
   * Error that remains with any number of samples: RMSE against ray tracing in the worst scene of
   * the benchmark ambient-occlusion.
   */
  static double GetBias(int kernel);

  /** Number of depth fetches per point of the sample sequence. Each fetch counts as one sample. */
  static int GetFetchesPerPoint(int kernel);

  /** GLSL of the kernel: a function `float occlusionAt(SurfacePoint, int pointCount)`. */
  static const char* GetShader(int kernel);

protected:
  vtkPenumbraKernels() = default;
  ~vtkPenumbraKernels() override = default;

private:
  vtkPenumbraKernels(const vtkPenumbraKernels&) = delete;
  void operator=(const vtkPenumbraKernels&) = delete;
};

#endif
