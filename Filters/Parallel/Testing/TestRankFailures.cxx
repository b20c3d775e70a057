// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "RankImages.h"

#include "ForkedRanks.h"
#include "vtkCamera.h"
#include "vtkLight.h"
#include "vtkLightCollection.h"
#include "vtkNew.h"
#include "vtkPenumbraDistributedRayCaster.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>

namespace
{

using namespace penumbra;

}

TEST(vtkPenumbraDistributedRayCaster, EndsWithLightsAtNoFinitePlace)
{
  struct Case
  {
    bool IsPositional;
    double X;
  };
  for (const Case& each : { Case{ false, 1e160 }, Case{ false, 1e39 }, Case{ true, 1e30 },
         Case{ true, 1e39 }, Case{ true, std::nan("") }, Case{ false, std::nan("") } })
  {
    SCOPED_TRACE(testing::Message() << each.IsPositional << " " << each.X);
    ExpectSameViewsOnRanks(2, MakeCoarse, KeepActor, [=](Caster* caster) {
      caster->ShadowsOn();
      vtkLightCollection* const lights = caster->GetRenderer()->GetLights();
      auto* light = vtkLight::SafeDownCast(lights->GetItemAsObject(0));
      light->SetPositional(each.IsPositional);
      light->SetConeAngle(180.0);
      light->SetPosition(each.X, 0.0, 0.0);
      vtkNew<vtkLight> ordinary;
      ordinary->SetPosition(3.0, 5.0, 4.0);
      caster->GetRenderer()->AddLight(ordinary);
    });
  }
}

TEST(vtkPenumbraDistributedRayCaster, NamesASettingThatRanksDisagreeAbout)
{
  const auto disagree = [](const char* name, const std::function<void(Caster*, int)>& set) {
    SCOPED_TRACE(name);
    for (const RankResult& result : RunRanks(3, [&](int rank) {
           vtkNew<vtkPenumbraDistributedRayCaster> caster;
           return Pack(Render(caster, { MakeCoarse(rank, 3) }, [&](Caster* c) { set(c, rank); }));
         }))
    {
      EXPECT_TRUE(result.HasReturned);
      const Image image = Unpack(result.Value);
      ASSERT_EQ(image.count("Error"), 1u);
      const std::string expected = std::string("The ranks 0 and 2 disagree about ") + name + ".";
      EXPECT_NE(image.at("Error").find(expected), std::string::npos) << image.at("Error");
      EXPECT_EQ(image.count("Color"), 0u);
    }
  };
  disagree(
    "Resolution", [](Caster* c, int rank) { c->SetResolution(Width + (rank == 2), Height); });
  disagree("Tolerance", [](Caster* c, int rank) { c->SetTolerance(rank == 2 ? 0.1 : 0.01); });
  disagree("the position of the camera", [](Caster* c, int rank) {
    const vtkSmartPointer<vtkRenderer> renderer = MakeRenderer(MakePiece(rank, 3, 10), KeepActor);
    renderer->GetActiveCamera()->SetPosition(2.0, 1.5, rank == 2 ? 6.1 : 6.0);
    c->SetRenderer(renderer);
  });
}

TEST(vtkPenumbraDistributedRayCaster, EndsOnAllRanksIfOneFails)
{
  for (const RankResult& result : RunRanks(3, [](int rank) {
         vtkNew<vtkPenumbraDistributedRayCaster> caster;
         return Pack(Render(caster, { MakeCoarse(rank, 3) }, [=](Caster* c) {
           if (rank == 1)
           {
             c->SetTolerance(std::nan(""));
           }
         }));
       }))
  {
    EXPECT_TRUE(result.HasReturned);
    const Image image = Unpack(result.Value);
    ASSERT_EQ(image.count("Error"), 1u);
    EXPECT_NE(image.at("Error").find("Rank 1: Tolerance"), std::string::npos) << image.at("Error");
  }
}
