// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Each row of the table of VTK's rendering features that is approximated or refused has one warning,
// which names the prop and a remedy.
#include "WarningScenes.h"

#include "vtkActor.h"
#include "vtkCallbackCommand.h"
#include "vtkNew.h"
#include "vtkPenumbraRayCaster.h"
#include "vtkPolyDataMapper.h"
#include "vtkRenderWindow.h"
#include "vtkRenderer.h"
#include "vtkSelection.h"
#include "vtkSphereSource.h"

#include <gtest/gtest.h>

#include <set>
#include <string>
#include <vector>

using penumbra::Feature;
using penumbra::FeatureRow;

namespace
{

const FeatureRow& Row(Feature feature)
{
  return penumbra::GetFeatureTable()[static_cast<std::size_t>(feature)];
}

/// Renders twice, and returns all warnings.
std::vector<std::string> CollectWarnings(const WarningScene& scene)
{
  vtkNew<vtkRenderWindow> window;
  window->SetOffScreenRendering(1);
  window->SetSize(8, 8);
  vtkNew<vtkRenderer> renderer;
  window->AddRenderer(renderer);
  scene.Build(renderer);
  vtkNew<vtkPenumbraRayCaster> caster;
  caster->SetRenderer(renderer);
  caster->SetResolution(8, 8);
  caster->SetTolerance(1.0);
  std::vector<std::string> warnings;
  vtkNew<vtkCallbackCommand> observer;
  observer->SetClientData(&warnings);
  observer->SetCallback([](vtkObject*, unsigned long, void* data, void* text) {
    static_cast<std::vector<std::string>*>(data)->emplace_back(static_cast<const char*>(text));
  });
  caster->AddObserver(vtkCommand::WarningEvent, observer);
  caster->Update();
  caster->Modified();
  caster->Update();
  return warnings;
}

class WarningRows : public testing::TestWithParam<std::size_t>
{
};

}

TEST_P(WarningRows, WarnOnceWithPropAndRemedy)
{
  const WarningScene scene = MakeWarningScenes()[GetParam()];
  const FeatureRow& row = Row(scene.Key);
  const std::string prefix = scene.Prop.empty() ? "" : scene.Prop + ": ";
  const std::vector<std::string> warnings = CollectWarnings(scene);
  ASSERT_EQ(warnings.size(), 1) << row.Name << (warnings.empty() ? "" : ": " + warnings.back());
  EXPECT_NE(warnings[0].find(prefix + row.Difference + " " + row.Remedy), std::string::npos)
    << warnings[0];
}

INSTANTIATE_TEST_SUITE_P(Features, WarningRows,
  testing::Range<std::size_t>(0, MakeWarningScenes().size()),
  [](const testing::TestParamInfo<std::size_t>& row) {
    return std::to_string(static_cast<int>(MakeWarningScenes()[row.param].Key));
  });

TEST(WarningScenes, DoNotWarnOfEmptySelections)
{
  const WarningScene scene = { Feature::Selection, "", [](vtkRenderer* renderer) {
                                vtkNew<vtkSphereSource> sphere;
                                vtkNew<vtkPolyDataMapper> mapper;
                                mapper->SetInputConnection(sphere->GetOutputPort());
                                mapper->SetSelection(vtkNew<vtkSelection>());
                                vtkNew<vtkActor> actor;
                                actor->SetMapper(mapper);
                                renderer->AddActor(actor);
                              } };
  EXPECT_TRUE(CollectWarnings(scene).empty());
}

TEST(WarningScenes, CoverExactlyTheRowsThatAreNotDrawn)
{
  std::set<Feature> features;
  for (const WarningScene& scene : MakeWarningScenes())
  {
    EXPECT_NE(Row(scene.Key).Level, FeatureRow::Levels::Drawn) << Row(scene.Key).Name;
    features.insert(scene.Key);
  }
  for (const FeatureRow& row : penumbra::GetFeatureTable())
  {
    EXPECT_EQ(features.count(row.Key) == 1, row.Level != FeatureRow::Levels::Drawn) << row.Name;
  }
}
