// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkPenumbraKernels
 * @brief   The one table of kernels: every way to estimate ambient occlusion from depth alone.
 *
 * A new kernel is a GLSL file and a row here; see Documentation/methods/Kernels.md.
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

  /** Rows of the table. */
  static int GetNumberOfKernels();

  /** Name of a kernel, as the command line takes it; null outside the table. */
  static const char* GetName(int kernel);

  /** Index of a kernel by name, -1 when there is none. */
  static int Find(const char* name);

  /** Where it comes from. */
  static const char* GetSource(int kernel);

  /**
   * The D(t) of [TSSAO eq. 1] whose occlusion the kernel estimates, t in radii, as a formula; empty:
   * it estimates none and is compared up to a factor.
   */
  static const char* GetFalloff(int kernel);

  /**
   * The error that remains however many samples are taken: RMSE against rays in the worst of the
   * scenes of `./penumbra benchmark ambient-occlusion`.
   */
  static double GetBias(int kernel);

  /** Depths fetched for one point of the sample sequence: what counts as that many samples. */
  static int GetFetchesPerPoint(int kernel);

  /** Its GLSL: a function `float occlusionAt(SurfacePoint)`. */
  static const char* GetShader(int kernel);

protected:
  vtkPenumbraKernels() = default;
  ~vtkPenumbraKernels() override = default;

private:
  vtkPenumbraKernels(const vtkPenumbraKernels&) = delete;
  void operator=(const vtkPenumbraKernels&) = delete;
};

#endif
