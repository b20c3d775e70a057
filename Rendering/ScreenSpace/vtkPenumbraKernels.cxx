// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkPenumbraKernels.h"

#include "vtkObjectFactory.h"
#include "vtkPenumbraEstimateDepthDifferenceFS.h"
#include "vtkPenumbraEstimateHorizonFS.h"
#include "vtkPenumbraEstimateMarchFS.h"
#include "vtkPenumbraEstimatePatchFS.h"
#include "vtkPenumbraEstimateVolumetricFS.h"

#include <cstring>
#include <iterator>

vtkStandardNewMacro(vtkPenumbraKernels);

namespace
{

struct Kernel
{
  const char* Name;
  const char* Source;
  const char* Falloff;
  double Bias;
  int FetchesPerPoint;
  const char* Shader;
};

const Kernel KernelTable[] = {
  { "volumetric", "[TSSAO eq. 3, 14]", "1 - t", 0.25, 1, vtkPenumbraEstimateVolumetricFS },
  { "patch", "[TSSAO eq. 12-13]", "", 0.26, 1, vtkPenumbraEstimatePatchFS },
  { "depth-difference", "[ISAO eq. 2]", "", 0.15, 1, vtkPenumbraEstimateDepthDifferenceFS },
  { "horizon", "[GTAO eq. 7]; [TSSAO eq. 1]", "1", 0.13, 8, vtkPenumbraEstimateHorizonFS },
  { "march", "[TSSAO eq. 1], rays through one layer", "1", 0.085, 8, vtkPenumbraEstimateMarchFS },
};

const Kernel* FindKernel(int kernel)
{
  return kernel >= 0 && kernel < vtkPenumbraKernels::GetNumberOfKernels() ? KernelTable + kernel
                                                                          : nullptr;
}

}

int vtkPenumbraKernels::GetNumberOfKernels()
{
  return static_cast<int>(std::size(KernelTable));
}

const char* vtkPenumbraKernels::GetName(int kernel)
{
  return FindKernel(kernel) ? FindKernel(kernel)->Name : nullptr;
}

int vtkPenumbraKernels::Find(const char* name)
{
  for (int kernel = 0; kernel < GetNumberOfKernels(); ++kernel)
  {
    if (name && std::strcmp(name, KernelTable[kernel].Name) == 0)
    {
      return kernel;
    }
  }
  return -1;
}

const char* vtkPenumbraKernels::GetSource(int kernel)
{
  return FindKernel(kernel) ? FindKernel(kernel)->Source : nullptr;
}

const char* vtkPenumbraKernels::GetFalloff(int kernel)
{
  return FindKernel(kernel) ? FindKernel(kernel)->Falloff : nullptr;
}

double vtkPenumbraKernels::GetBias(int kernel)
{
  return FindKernel(kernel) ? FindKernel(kernel)->Bias : 0.0;
}

int vtkPenumbraKernels::GetFetchesPerPoint(int kernel)
{
  return FindKernel(kernel) ? FindKernel(kernel)->FetchesPerPoint : 0;
}

const char* vtkPenumbraKernels::GetShader(int kernel)
{
  return FindKernel(kernel) ? FindKernel(kernel)->Shader : nullptr;
}

void vtkPenumbraKernels::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  for (const Kernel& kernel : KernelTable)
  {
    os << indent << kernel.Name << ": " << kernel.Source << "\n";
  }
}
