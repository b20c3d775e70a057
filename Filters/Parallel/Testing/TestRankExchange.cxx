// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "RankImages.h"

#include "ForkedRanks.h"
#include "vtkActor.h"
#include "vtkAppendPolyData.h"
#include "vtkCamera.h"
#include "vtkDataArray.h"
#include "vtkLight.h"
#include "vtkLightCollection.h"
#include "vtkNew.h"
#include "vtkPenumbraDistributedRayCaster.h"
#include "vtkPlaneSource.h"
#include "vtkPointData.h"
#include "vtkProperty.h"
#include "vtkSphereSource.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace
{

using namespace penumbra;

}

TEST(vtkPenumbraDistributedRayCaster, ReceivesWhatCastsHardShadows)
{
  // Spheres in a row along the light, each of which casts a shadow on those behind it.
  const MakeData make = [](int rank, int) {
    vtkNew<vtkSphereSource> sphere;
    sphere->SetCenter(1.5 * rank, 0.3 * (rank % 2), 0.0);
    sphere->SetThetaResolution(70);
    sphere->SetPhiResolution(70);
    sphere->Update();
    return vtkSmartPointer<vtkPolyData>(sphere->GetOutput());
  };
  const auto view = [&](vtkPolyData* data, bool isPositional) {
    const vtkSmartPointer<vtkRenderer> renderer = MakeRenderer(data, KeepActor);
    renderer->GetActiveCamera()->SetPosition(2.2, 1.0, 9.0);
    renderer->GetActiveCamera()->SetFocalPoint(2.2, 0.0, 0.0);
    auto* light = vtkLight::SafeDownCast(renderer->GetLights()->GetItemAsObject(0));
    light->SetPositional(isPositional);
    light->SetPosition(9.0, isPositional ? 0.2 : 1.0, 1.0);
    light->SetConeAngle(180.0);
    return renderer;
  };
  for (const bool isPositional : { false, true })
  {
    SCOPED_TRACE(isPositional);
    const auto render = [&](Caster* caster, vtkPolyData* data, bool hasShadows) {
      return Render(caster, {}, [&](Caster* c) {
        c->SetRenderer(view(data, isPositional));
        c->SetShadows(hasShadows);
      });
    };
    const auto renderAll = [&](bool hasShadows) {
      return Unpack(RunRanks(1,
        [&](int) {
          vtkNew<vtkAppendPolyData> append;
          for (int rank = 0; rank < 4; ++rank)
          {
            append->AddInputData(vtkPolyData::SafeDownCast(make(rank, 4)));
          }
          append->Update();
          return Pack(render(vtkNew<vtkPenumbraRayCaster>(), append->GetOutput(), hasShadows));
        })[0]
                      .Value);
    };
    const Image expected = renderAll(true);
    EXPECT_NE(expected.at("Color"), renderAll(false).at("Color"));
    double received = 0.0;
    for (const RankResult& result : RunRanks(4, [&](int rank) {
           return Pack(render(vtkNew<vtkPenumbraDistributedRayCaster>(),
             vtkPolyData::SafeDownCast(make(rank, 4)), true));
         }))
    {
      const Image image = Unpack(result.Value);
      ExpectSame(image, expected);
      EXPECT_EQ(image.count("Warning"), 0u) << image.at("Warning");
      received += GetNumber(image, "Statistics/Exchange/SceneBytes") /
        GetNumber(image, "Statistics/Exchange/WholeBytes");
    }
    EXPECT_LT(received, 1.2); // all surfaces: 1.6
  }
}

// The normals of a square describe a dome, above which shadow rays start. A sphere, which the image does not show,
// casts a shadow there.
TEST(vtkPenumbraDistributedRayCaster, ReceivesWhatCastsShadowsAboveCoarseMeshes)
{
  const MakeData make = [](int rank, int) {
    if (rank > 0)
    {
      vtkNew<vtkSphereSource> sphere;
      sphere->SetRadius(0.3);
      sphere->SetCenter(3.0, 0.0, 1.5);
      sphere->Update();
      return vtkSmartPointer<vtkDataObject>(sphere->GetOutput());
    }
    vtkNew<vtkPlaneSource> square;
    square->SetOrigin(-2.0, -2.0, 0.0);
    square->SetPoint1(2.0, -2.0, 0.0);
    square->SetPoint2(-2.0, 2.0, 0.0);
    square->Update();
    vtkPolyData* const dome = square->GetOutput();
    for (vtkIdType i = 0; i < dome->GetNumberOfPoints(); ++i)
    {
      const double* p = dome->GetPoint(i);
      dome->GetPointData()->GetNormals()->SetTuple3(i, 0.25 * p[0], 0.25 * p[1], 0.7);
    }
    return vtkSmartPointer<vtkDataObject>(dome);
  };
  const auto render = [](Caster* caster, vtkPolyData* data) {
    return Render(caster, {}, [&](Caster* c) {
      const vtkSmartPointer<vtkRenderer> renderer = MakeRenderer(data, KeepActor);
      renderer->GetActiveCamera()->SetPosition(0.0, -6.0, 6.0);
      renderer->GetActiveCamera()->SetFocalPoint(0.0, 0.0, 0.0);
      renderer->GetActiveCamera()->SetViewAngle(20.0);
      auto* light = vtkLight::SafeDownCast(renderer->GetLights()->GetItemAsObject(0));
      light->SetPositional(false);
      light->SetPosition(9.0, 0.0, 0.4);
      c->SetRenderer(renderer);
      c->ShadowsOn();
    });
  };
  const auto renderParts = [&](int parts) {
    return Unpack(RunRanks(1,
      [&](int) {
        vtkNew<vtkAppendPolyData> append;
        for (int rank = 0; rank < parts; ++rank)
        {
          append->AddInputData(vtkPolyData::SafeDownCast(make(rank, 2)));
        }
        append->Update();
        return Pack(render(vtkNew<vtkPenumbraRayCaster>(), append->GetOutput()));
      })[0]
                    .Value);
  };
  const Image expected = renderParts(2);
  EXPECT_TRUE(expected.at("Color") != renderParts(1).at("Color"));
  for (const RankResult& result : RunRanks(2, [&](int rank) {
         return Pack(render(
           vtkNew<vtkPenumbraDistributedRayCaster>(), vtkPolyData::SafeDownCast(make(rank, 2))));
       }))
  {
    ExpectSame(Unpack(result.Value), expected);
  }
}

TEST(vtkPenumbraDistributedRayCaster, MatchesOneRankWithHardShadows)
{
  for (const double opacity : { 1.0, 0.4 })
  {
    for (const double z : { 4.0, -1.0 })
    {
      SCOPED_TRACE(testing::Message() << opacity << " " << z);
      ExpectSameViewsOnRanks(
        3, MakeCoarse, [=](vtkActor* actor) { actor->GetProperty()->SetOpacity(opacity); },
        [=](Caster* caster) {
          caster->ShadowsOn();
          vtkLightCollection* const lights = caster->GetRenderer()->GetLights();
          vtkLight::SafeDownCast(lights->GetItemAsObject(0))->SetPosition(3.0, 5.0, z);
        });
    }
  }
}

TEST(vtkPenumbraDistributedRayCaster, ReceivesPartOfTheScene)
{
  // Blocks side by side: a rank needs little more than its own.
  const MakeData make = [](int rank, int) {
    vtkNew<vtkPlaneSource> plane;
    plane->SetOrigin(rank, 0.0, 0.0);
    plane->SetPoint1(rank + 1.0, 0.0, 0.0);
    plane->SetPoint2(rank, 4.0, 0.0);
    plane->SetResolution(100, 400);
    plane->Update();
    return vtkSmartPointer<vtkPolyData>(plane->GetOutput());
  };
  for (const Image& image : RenderOnRanks(4, make, UseDefaults))
  {
    EXPECT_EQ(GetNumber(image, "Statistics/Exchange/WholePrimitives"), 4.0 * 80000.0);
    EXPECT_LT(GetNumber(image, "Statistics/Exchange/Primitives"), 1.5 * 80000.0);
    EXPECT_GT(GetNumber(image, "Statistics/Exchange/WholeBytes"), 320000.0 * 18.0);
    EXPECT_LT(GetNumber(image, "Statistics/Exchange/SceneBytes"),
      0.2 * GetNumber(image, "Statistics/Exchange/WholeBytes"));
  }
}

TEST(vtkPenumbraDistributedRayCaster, GathersForLightWithOneWarning)
{
  const std::vector<Image> images = RenderOnRanks(2, MakeCoarse, [](Caster* caster) {
    caster->AmbientOcclusionOn();
    caster->SetTolerance(0.05);
  });
  double bytes = 0.0;
  for (const Image& image : images)
  {
    bytes += GetNumber(image, "Statistics/Exchange/SceneBytes");
  }
  EXPECT_GT(bytes, GetNumber(images[0], "Statistics/Exchange/SceneBytes"));
  EXPECT_NE(images[0].at("Warning").find(
              " received " + std::to_string(static_cast<long long>(bytes)) + " bytes"),
    std::string::npos)
    << images[0].at("Warning");
  EXPECT_EQ(images[1].count("Warning"), 0u);
  EXPECT_EQ(GetNumber(images[0], "Statistics/Exchange/Primitives"),
    GetNumber(images[0], "Statistics/Exchange/WholePrimitives"));
}

TEST(vtkPenumbraDistributedRayCaster, WarnsOnceIfNoLightReachesTheImage)
{
  for (const double z : { 4.0, 1e30, -4.0 })
  {
    SCOPED_TRACE(z);
    const auto render = [z](Caster* caster, int rank, int ranks) {
      return Render(caster, {}, [&](Caster* each) {
        const vtkSmartPointer<vtkRenderer> renderer =
          MakeRenderer(MakePiece(rank, ranks, 10), KeepActor);
        auto* light = vtkLight::SafeDownCast(renderer->GetLights()->GetItemAsObject(0));
        light->SetPositional(true);
        light->SetConeAngle(180.0);
        light->SetPosition(2.0, 1.5, z);
        each->SetRenderer(renderer);
        each->ShadowsOn();
      });
    };
    const Image expected =
      Unpack(RunRanks(1, [&](int) { return Pack(render(vtkNew<vtkPenumbraRayCaster>(), 0, 1)); })[0]
               .Value);
    const auto isWarned = [](const Image& image) {
      return image.count("Warning") != 0 &&
        image.at("Warning").find("no light reaches them") != std::string::npos;
    };
    EXPECT_EQ(isWarned(expected), z == 1e30);
    std::vector<Image> images;
    for (const RankResult& result : RunRanks(3, [&](int rank) {
           return Pack(render(vtkNew<vtkPenumbraDistributedRayCaster>(), rank, 3));
         }))
    {
      images.push_back(Unpack(result.Value));
    }
    EXPECT_EQ(isWarned(images[0]), isWarned(expected));
    EXPECT_FALSE(isWarned(images[1]) || isWarned(images[2]));
  }
}
