// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// The medium is described twice: by an object for the ray caster and by properties of the pass,
// whose module must not include the other module. Tests that both interpret the same settings
// equally.
#include "vtkPenumbraLightShaftPass.h"
#include "vtkPenumbraMedium.h"

#include "vtkNew.h"

#include <gtest/gtest.h>

#include <limits>

namespace
{

template <typename First, typename Second>
void ExpectTheSame(First* first, Second* second)
{
  EXPECT_EQ(first->GetScattering(), second->GetScattering());
  EXPECT_EQ(first->GetExtinction(), second->GetExtinction());
  EXPECT_EQ(first->GetPhase(), second->GetPhase());
  EXPECT_EQ(first->GetRayleighScattering(), second->GetRayleighScattering());
  EXPECT_EQ(first->GetScaleHeight(), second->GetScaleHeight());
  EXPECT_EQ(first->GetBaseHeight(), second->GetBaseHeight());
  for (int i = 0; i < 3; ++i)
  {
    EXPECT_EQ(first->GetScatteringColor()[i], second->GetScatteringColor()[i]);
    EXPECT_EQ(first->GetExtinctionColor()[i], second->GetExtinctionColor()[i]);
    EXPECT_EQ(first->GetUp()[i], second->GetUp()[i]);
  }
  EXPECT_EQ(first->GetAsymmetry(), second->GetAsymmetry());
  for (int i = 0; i < 6; ++i)
  {
    EXPECT_EQ(first->GetBounds()[i], second->GetBounds()[i]);
  }
}

TEST(MediumOfBoth, DescribesTheSameMediumAsTheRayCaster)
{
  vtkNew<vtkPenumbraMedium> medium;
  vtkNew<vtkPenumbraLightShaftPass> pass;
  ExpectTheSame(medium.Get(), pass.Get());
  EXPECT_EQ(static_cast<int>(vtkPenumbraMedium::RAYLEIGH),
    static_cast<int>(vtkPenumbraLightShaftPass::RAYLEIGH));
  const double endless = std::numeric_limits<double>::max();
  for (const double number : { -endless, -2.0, 0.0, 0.3, 5.0, endless })
  {
    const auto set = [number](auto* object) {
      object->SetScattering(number);
      object->SetExtinction(number);
      object->SetAsymmetry(number);
      object->SetPhase(number < 0.0 ? -7 : 7);
      object->SetRayleighScattering(number);
      object->SetScaleHeight(number);
      object->SetBaseHeight(number);
      object->SetScatteringColor(number, 1.0, 2.0);
      object->SetExtinctionColor(1.0, number, 2.0);
      object->SetUp(0.0, number, 1.0);
      object->SetBounds(0.0, number, 0.0, 1.0, 0.0, 1.0);
    };
    set(medium.Get());
    set(pass.Get());
    ExpectTheSame(medium.Get(), pass.Get());
  }
}

}
