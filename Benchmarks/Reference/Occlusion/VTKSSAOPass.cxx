// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "VTKSSAOPass.h"

#include "vtkCameraPass.h"
#include "vtkLightsPass.h"
#include "vtkNew.h"
#include "vtkOpaquePass.h"
#include "vtkRenderPassCollection.h"
#include "vtkSSAOPass.h"
#include "vtkSequencePass.h"

namespace penumbra
{

vtkSmartPointer<vtkSSAOPass> NewVTKSSAOPass(double radius, unsigned int samples)
{
  vtkNew<vtkLightsPass> lights;
  vtkNew<vtkOpaquePass> opaque;
  vtkNew<vtkRenderPassCollection> passes;
  passes->AddItem(lights);
  passes->AddItem(opaque);
  vtkNew<vtkSequencePass> sequence;
  sequence->SetPasses(passes);
  vtkNew<vtkCameraPass> camera;
  camera->SetDelegatePass(sequence);
  auto pass = vtkSmartPointer<vtkSSAOPass>::New();
  pass->SetDelegatePass(camera);
  pass->SetRadius(radius);
  pass->SetBias(0.01 * radius);
  pass->SetKernelSize(samples);
  pass->BlurOn();
  return pass;
}

}
