// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Tests that images of the ray caster have the same bits for every instruction set that Embree uses
// and any number of threads.
#include "BaselineScenes.h"
#include "vtkPenumbraRayCaster.h"

#include "vtkDataArray.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkObject.h"
#include "vtkPointData.h"
#include "vtkRenderer.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <cstring>

using namespace penumbra;

namespace
{

constexpr const char* Variable = "PENUMBRA_EMBREE";

/// Empty if the processor lacks the instructions.
vtkSmartPointer<vtkImageData> Draw(const BaselineScene& scene, const std::string& isa, int threads)
{
  setenv(Variable, ("isa=" + isa).c_str(), 1);
  const int warnings = vtkObject::GetGlobalWarningDisplay();
  vtkObject::GlobalWarningDisplayOff();
  vtkNew<vtkPenumbraRayCaster> caster;
  caster->SetRenderer(scene.Make());
  caster->SetResolution(scene.AddsLight ? 24 : 96, scene.AddsLight ? 18 : 72);
  caster->SetShadows(scene.AddsLight);
  caster->SetAmbientOcclusion(scene.AddsLight);
  caster->SetTolerance(scene.AddsLight ? 0.1 : 1.0 / 256.0);
  caster->SetNumberOfThreads(threads);
  caster->GeometryArraysOn();
  caster->Update();
  vtkObject::SetGlobalWarningDisplay(warnings);
  unsetenv(Variable);
  return caster->GetOutput();
}

void ExpectSameBits(vtkImageData* a, vtkImageData* b, const std::string& what)
{
  vtkPointData* arrays = a->GetPointData();
  ASSERT_GT(arrays->GetNumberOfArrays(), 0) << what;
  for (int i = 0; i < arrays->GetNumberOfArrays(); ++i)
  {
    vtkDataArray* one = arrays->GetArray(i);
    vtkDataArray* other = b->GetPointData()->GetArray(one->GetName());
    ASSERT_TRUE(other) << what << ", " << one->GetName();
    const auto bytes = static_cast<std::size_t>(one->GetNumberOfValues()) * one->GetDataTypeSize();
    EXPECT_EQ(std::memcmp(one->GetVoidPointer(0), other->GetVoidPointer(0), bytes), 0)
      << what << ", " << one->GetName();
  }
}

TEST(InstructionSets, GiveTheSameBits)
{
  for (const BaselineScene& scene : Gallery())
  {
    if (!scene.ByRays)
    {
      continue;
    }
    const auto reference = Draw(scene, "sse2", 1);
    for (const char* isa : { "sse4.2", "avx", "avx2", "avx512" })
    {
      const auto image = Draw(scene, isa, 3);
      if (image->GetPointData()->GetNumberOfArrays() > 0)
      {
        ExpectSameBits(image, reference, scene.Name + " by " + isa);
      }
    }
  }
}

}
