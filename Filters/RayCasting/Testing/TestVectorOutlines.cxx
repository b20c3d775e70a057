// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Outlines of spheres and tubes in figures of vtkPenumbraVectorExporter, against closed forms.
#include "RasterizedFigure.h"
#include "RoundScene.h"

#include "vtkPlaneSource.h"

#include <glm/gtc/constants.hpp>

namespace
{
using namespace penumbra_testing;

constexpr double PenWidth = 2.0; // pixels

/// White shapes on white, seen in parallel projection with 10 pixels per unit: a figure shows only
/// the outlines, which are black.
class VectorOutlines : public testing::Test
{
protected:
  void Show(const std::vector<glm::dvec3>& points, const std::vector<std::vector<vtkIdType>>& lines)
  {
    this->Scene.reset(new RoundScene(MakeCells(points, lines)));
    this->Scene->Renderer->SetBackground(1.0, 1.0, 1.0);
    vtkCamera* camera = this->Scene->Renderer->GetActiveCamera();
    camera->ParallelProjectionOn();
    camera->SetParallelScale(0.5 * Side / 10.0);
    this->Exporter->SetRayCaster(this->Scene->Caster);
    this->Exporter->SetOutlineWidth(PenWidth);
  }

  /// Adds a white rectangle in the plane z = `z`.
  void AddRectangle(double x, double y, double toX, double toY, double z)
  {
    vtkNew<vtkPlaneSource> plane;
    plane->SetOrigin(x, y, z);
    plane->SetPoint1(toX, y, z);
    plane->SetPoint2(x, toY, z);
    plane->Update();
    this->Scene->Add(plane->GetOutput(), false);
  }

  /// Returns the length in pixels of the outlines in the left half of the figure.
  double MeasureLength(const std::string& format)
  {
    const auto figure = Rasterize(this->Exporter, this->Folder, format);
    double dark = 0.0;
    for (int y = 0; y < Side; ++y)
    {
      for (int x = 0; x < Side / 2; ++x)
      {
        dark += 1.0 - figure->GetScalarComponentAsDouble(x, y, 0, 0) / 255.0;
      }
    }
    return dark / PenWidth;
  }

  TemporaryFolder Folder;
  std::unique_ptr<RoundScene> Scene;
  vtkNew<vtkPenumbraVectorExporter> Exporter;
};

TEST_F(VectorOutlines, OfASphereAreACircle)
{
  this->Show({ { -6.4, 0.0, -30.0 } }, {});
  this->Scene->Caster->SetPointRadius(4.0);
  for (const char* format : { "svg", "pdf" })
  {
    EXPECT_NEAR(this->MeasureLength(format), glm::two_pi<double>() * 40.0, 1.0) << format;
  }
  EXPECT_EQ(this->Exporter->GetStatistics()->GetArray("Vector/Outlines")->GetComponent(0, 0), 1.0);
}

TEST_F(VectorOutlines, OfHiddenPartsAreLeftOut)
{
  this->Show({ { -6.4, 0.0, -30.0 } }, {});
  this->Scene->Caster->SetPointRadius(4.0);
  this->AddRectangle(-20.0, 0.0, 20.0, 20.0, -5.0);
  // Half of the circle, and the lower edge of the rectangle.
  EXPECT_NEAR(this->MeasureLength("svg"), glm::pi<double>() * 40.0 + 128.0, 3.0);
}

// Two tubes of length 3 and radius 1 in line.
TEST_F(VectorOutlines, OfTubesHaveNoEdgesAtJoints)
{
  this->Show(
    { { -10.0, 0.0, -30.0 }, { -7.0, 0.0, -30.0 }, { -4.0, 0.0, -30.0 } }, { { 0, 1, 2 } });
  this->Scene->Caster->SetLineRadius(1.0);
  EXPECT_NEAR(this->MeasureLength("svg"), 2.0 * 60.0 + glm::two_pi<double>() * 10.0, 2.0);
}

// The centers of two circles of radius 3 are 3 apart: a third of each is inside the other one.
TEST_F(VectorOutlines, OfSpheresEndAtNearerOnes)
{
  this->Show({ { -8.0, 0.0, -30.0 }, { -5.0, 0.0, -20.0 } }, {});
  this->Scene->Caster->SetPointRadius(3.0);
  const double circle = glm::two_pi<double>() * 30.0;
  // Both ends of the hidden circle overlap the other one, at an angle of 60 degrees.
  const double overlap = PenWidth / std::sin(glm::radians(60.0));
  EXPECT_NEAR(this->MeasureLength("svg"), circle + 2.0 / 3.0 * circle - overlap, 1.0);
}

}
