// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Surfaces as triangles in figures of vtkPenumbraVectorExporter, against the ray-cast image, and outlines
// of spheres and tubes, against closed forms.
#include "RasterizedFigure.h"
#include "RoundScene.h"
#include "vtkPenumbraIrradianceProvider.h"

#include "vtkActor.h"
#include "vtkCamera.h"
#include "vtkFieldData.h"
#include "vtkLight.h"
#include "vtkLineSource.h"
#include "vtkObjectFactory.h"
#include "vtkPlaneSource.h"
#include "vtkPolyDataMapper.h"
#include "vtkProperty.h"
#include "vtkRenderer.h"
#include "vtkSphereSource.h"
#include "vtkTrivialProducer.h"
#include "vtkUnsignedCharArray.h"

#include <glm/gtc/constants.hpp>

#include <atomic>
#include <cmath>

namespace
{
using namespace penumbra_testing;

/// Counts the points whose irradiance is computed.
class CountedIrradiance : public vtkPenumbraIrradianceProvider
{
public:
  static CountedIrradiance* New();
  vtkTypeMacro(CountedIrradiance, vtkPenumbraIrradianceProvider);

  bool Begin(const penumbra::RayScene&, const Occluders&, double, const Progress&) override
  {
    return true;
  }
  Estimate Occlusion(const double*, const double*, const double*) const override { return {}; }
  bool BeginIrradiance(const penumbra::Illumination&, double, const Progress&) override
  {
    return true;
  }
  Light Irradiance(const double*, const double*, double, const double*) const override
  {
    ++this->Points;
    return {};
  }

  mutable std::atomic<int> Points{ 0 };
};
vtkStandardNewMacro(CountedIrradiance);

constexpr double Precision = 1.0 / 255.0;
// Where triangles are as small as pixels, several share a pixel and its colors are blended in turn.
constexpr double PrecisionOfSmallTriangles = 2.0 / 255.0;
// Lines have one color for pieces of 16 pixels, and those that meet are drawn over each other.
constexpr double PrecisionOfStrokes = 3.0 / 255.0;

class VectorFaces : public testing::Test
{
protected:
  VectorFaces()
  {
    this->Renderer->SetBackground(0.1, 0.2, 0.5);
    this->Renderer->GetActiveCamera()->SetPosition(2.0, -9.0, 5.0);
    this->Renderer->GetActiveCamera()->SetViewUp(0.0, 0.0, 1.0);
    this->Renderer->GetActiveCamera()->SetClippingRange(0.1, 100.0);
    this->Caster->SetRenderer(this->Renderer);
    this->Caster->SetResolution(300, 220);
    this->Exporter->SetRayCaster(this->Caster);
  }

  vtkSmartPointer<vtkActor> Add(vtkPolyDataAlgorithm* source)
  {
    vtkNew<vtkPolyDataMapper> mapper;
    mapper->SetInputConnection(source->GetOutputPort());
    vtkNew<vtkActor> actor;
    actor->SetMapper(mapper);
    this->Renderer->AddActor(actor);
    return actor;
  }

  vtkSmartPointer<vtkActor> AddSphere(double x, double y, double z, double radius, int resolution)
  {
    vtkNew<vtkSphereSource> sphere;
    sphere->SetCenter(x, y, z);
    sphere->SetRadius(radius);
    sphere->SetThetaResolution(2 * resolution);
    sphere->SetPhiResolution(resolution);
    vtkSmartPointer<vtkActor> actor = this->Add(sphere);
    actor->GetProperty()->SetColor(0.9, 0.8, 0.4);
    return actor;
  }

  /// Adds a square of side 6 around (0, 0, z) whose plane is turned around the y axis.
  vtkSmartPointer<vtkActor> AddSquare(double z, double turn)
  {
    vtkNew<vtkPlaneSource> plane;
    vtkSmartPointer<vtkActor> actor = this->Add(plane);
    actor->SetScale(6.0);
    actor->RotateY(turn);
    actor->SetPosition(0.0, 0.0, z);
    actor->GetProperty()->LightingOff();
    return actor;
  }

  double GetStatistic(const char* name)
  {
    vtkDataArray* array = this->Exporter->GetStatistics()->GetArray(name);
    return array ? array->GetComponent(0, 0) : -1.0;
  }

  void ExpectFaces(double precision = Precision)
  {
    for (const char* format : { "svg", "pdf" })
    {
      const auto figure = Rasterize(this->Exporter, this->Folder, format);
      EXPECT_LE(ComputeError(figure, this->Caster), precision) << format;
      EXPECT_EQ(this->Exporter->GetImageReason(), "");
      EXPECT_EQ(this->GetStatistic("Vector/Images"), 0.0);
      EXPECT_GT(this->GetStatistic("Vector/Faces"), 1.0);
    }
  }

  void ExpectImage(const std::string& reason)
  {
    const auto figure = Rasterize(this->Exporter, this->Folder, "svg");
    EXPECT_LE(ComputeError(figure, this->Caster), Precision) << reason;
    EXPECT_NE(this->Exporter->GetImageReason().find(reason), std::string::npos)
      << this->Exporter->GetImageReason();
    EXPECT_EQ(this->GetStatistic("Vector/Images"), 1.0);
    EXPECT_EQ(this->GetStatistic("Vector/Faces"), 0.0);
  }

  TemporaryFolder Folder;
  vtkNew<vtkRenderer> Renderer;
  vtkNew<vtkPenumbraRayCaster> Caster;
  vtkNew<vtkPenumbraVectorExporter> Exporter;
};

TEST_F(VectorFaces, EqualTheImageOfAFlatShadedSphere)
{
  this->AddSphere(0.0, 0.0, 0.0, 2.0, 12)->GetProperty()->SetInterpolationToFlat();
  this->ExpectFaces();
  // Half of the 480 triangles is hidden.
  EXPECT_LT(this->GetStatistic("Vector/Faces"), 300.0);
}

TEST_F(VectorFaces, EqualTheImageOfASmoothSphere)
{
  this->AddSphere(0.0, 0.0, 0.0, 2.0, 24);
  this->ExpectFaces();
}

TEST_F(VectorFaces, OfTwelveThousandTrianglesAreASmallFile)
{
  this->Caster->SetResolution(1000, 600);
  this->AddSphere(0.0, 0.0, 0.0, 2.2, 56)->GetProperty()->SetColor(0.5, 0.7, 1.0);
  const auto figure = Rasterize(this->Exporter, this->Folder, "svg");
  EXPECT_LE(ComputeError(figure, this->Caster), Precision);
  EXPECT_EQ(this->Exporter->GetImageReason(), "");
  EXPECT_GT(this->GetStatistic("Vector/Faces"), 4000.0);
  EXPECT_LE(std::filesystem::file_size(this->Folder.File("figure.svg")), 2000000u);
}

TEST_F(VectorFaces, EqualTheImageInParallelProjection)
{
  this->Renderer->GetActiveCamera()->ParallelProjectionOn();
  this->Renderer->GetActiveCamera()->SetParallelScale(3.0);
  this->AddSphere(0.5, 0.0, 0.0, 1.5, 24);
  this->AddSquare(-1.0, 20.0)->GetProperty()->SetColor(0.2, 0.9, 0.3);
  this->ExpectFaces(PrecisionOfSmallTriangles);
}

TEST_F(VectorFaces, CoverFartherFaces)
{
  this->AddSquare(-1.0, 0.0)->GetProperty()->SetColor(0.2, 0.9, 0.3);
  this->AddSphere(0.0, 0.0, 0.0, 0.8, 16)->GetProperty()->SetInterpolationToFlat();
  this->AddSphere(0.8, -1.5, 0.5, 0.6, 12)->GetProperty()->SetColor(1.0, 0.0, 0.0);
  this->ExpectFaces(PrecisionOfSmallTriangles);
}

// A wave whose ridges hide the valleys behind them: thin visible parts of these, which no sample of the
// colors hits, were holes that showed the background.
TEST_F(VectorFaces, HaveNoHolesBehindRidges)
{
  vtkNew<vtkPlaneSource> plane;
  plane->SetResolution(60, 60);
  plane->Update();
  vtkPolyData* wave = plane->GetOutput();
  for (vtkIdType i = 0; i < wave->GetNumberOfPoints(); ++i)
  {
    double x[3];
    wave->GetPoint(i, x);
    wave->GetPoints()->SetPoint(i, x[0], x[1], 0.06 * std::sin(25.0 * x[1] + 6.0 * x[0]));
  }
  vtkNew<vtkTrivialProducer> producer;
  producer->SetOutput(wave);
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(producer->GetOutputPort());
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  actor->SetScale(8.0);
  actor->GetProperty()->LightingOff();
  this->Renderer->AddActor(actor);
  this->Renderer->GetActiveCamera()->SetPosition(0.0, -9.0, 2.0);
  this->Renderer->SetBackground(1.0, 0.0, 0.0); // white surfaces hide it
  for (const char* format : { "svg", "pdf" })
  {
    const auto figure = Rasterize(this->Exporter, this->Folder, format);
    EXPECT_EQ(this->Exporter->GetImageReason(), "");
    // Pixels that the surface covers with all their neighbors.
    this->Caster->UpdateWholeExtent();
    vtkDataArray* expected = this->Caster->GetOutput()->GetPointData()->GetArray("Color");
    int covered = 0;
    double largest = 0.0;
    for (int y = 1; y < 219; ++y)
    {
      for (int x = 1; x < 299; ++x)
      {
        double least = 1.0;
        for (int n = 0; n < 9; ++n)
        {
          least = std::min(least, expected->GetComponent((y + n / 3 - 1) * 300 + x + n % 3 - 1, 1));
        }
        if (least > 0.999)
        {
          ++covered;
          largest = std::max(largest, 1.0 - figure->GetScalarComponentAsDouble(x, y, 0, 1) / 255.0);
        }
      }
    }
    EXPECT_GT(covered, 5000);
    // They were 0.3 and 0.4; pdftocairo shows fine seams.
    EXPECT_LE(largest, format == std::string("svg") ? 0.05 : 0.2) << format;
  }
}

TEST_F(VectorFaces, AreSplitWhereTheyIntersect)
{
  this->AddSquare(0.0, 30.0)->GetProperty()->SetColor(0.2, 0.9, 0.3);
  this->AddSquare(0.0, -30.0)->GetProperty()->SetColor(0.9, 0.2, 0.3);
  this->AddSphere(0.0, 0.0, 0.0, 1.0, 10)->GetProperty()->SetInterpolationToFlat();
  this->ExpectFaces(PrecisionOfSmallTriangles);
  EXPECT_GT(this->GetStatistic("Vector/Faces"), 1.0 + 4.0);
}

TEST_F(VectorFaces, EqualTheImageNextToTheCamera)
{
  this->Renderer->GetActiveCamera()->SetPosition(0.0, -1.0, 0.3);
  this->AddSquare(0.0, 0.0)->GetProperty()->SetColor(0.2, 0.9, 0.3);
  this->ExpectFaces(PrecisionOfSmallTriangles);
}

TEST_F(VectorFaces, MayBePointsThatHideThoseBehindThemPartly)
{
  vtkSmartPointer<vtkActor> sphere = this->AddSphere(0.0, 0.0, 0.0, 2.0, 16);
  for (const bool wireframe : { false, true })
  {
    sphere->GetProperty()->SetRepresentation(wireframe ? VTK_WIREFRAME : VTK_POINTS);
    sphere->GetProperty()->SetPointSize(9.0);
    sphere->GetProperty()->SetLineWidth(3.0);
    for (const char* format : { "svg", "pdf" })
    {
      const auto figure = Rasterize(this->Exporter, this->Folder, format);
      EXPECT_LE(ComputeError(figure, this->Caster), PrecisionOfStrokes) << format << wireframe;
    }
    EXPECT_EQ(this->GetStatistic("Vector/Images"), 0.0);
  }
}

// A square hides a line of 12 pixels from 2 pixels above its axis on, over half of its length.
TEST_F(VectorFaces, CutTheWidthOfLines)
{
  vtkCamera* camera = this->Renderer->GetActiveCamera();
  camera->ParallelProjectionOn();
  camera->SetParallelScale(11.0); // 10 pixels per unit
  camera->SetPosition(0.0, 0.0, 50.0);
  camera->SetViewUp(0.0, 1.0, 0.0);
  this->Renderer->SetBackground(0.0, 0.0, 0.0);
  vtkNew<vtkLineSource> line;
  line->SetPoint1(-8.0, 0.02, 0.0);
  line->SetPoint2(8.0, 0.02, 0.0);
  vtkSmartPointer<vtkActor> red = this->Add(line);
  red->GetProperty()->SetColor(1.0, 0.0, 0.0);
  red->GetProperty()->LightingOff();
  red->GetProperty()->SetLineWidth(12.0);
  vtkSmartPointer<vtkActor> square = this->AddSquare(0.0, 0.0);
  square->GetProperty()->SetColor(0.0, 0.0, 0.0);
  square->SetScale(10.0);
  square->SetPosition(5.0, 5.22, 5.0);
  for (const char* format : { "svg", "pdf" })
  {
    const auto figure = Rasterize(this->Exporter, this->Folder, format);
    double area = 0.0; // pixels
    for (int i = 0; i < 300 * 220; ++i)
    {
      area += figure->GetScalarComponentAsDouble(i % 300, i / 300, 0, 0) / 255.0;
    }
    EXPECT_NEAR(area, 80.0 * 12.0 + 80.0 * 8.0, 2.0) << format;
  }
  EXPECT_GT(this->GetStatistic("Vector/Lines"), 0.0);
}

// A line of 6 pixels, translucent or with colors of points, first behind a sphere obliquely to its
// outline. Where it was cut in halves and pieces, seams showed the background.
TEST_F(VectorFaces, HaveNoSeamsInLines)
{
  this->Caster->BackgroundOff();
  vtkSmartPointer<vtkActor> sphere = this->AddSphere(0.0, 0.0, 0.0, 2.0, 24);
  sphere->GetProperty()->SetColor(0.2, 0.2, 0.2);
  vtkNew<vtkLineSource> source;
  source->SetPoint1(-6.0, 3.0, -0.3);
  source->SetPoint2(0.0, 3.0, 1.2);
  source->Update();
  vtkNew<vtkUnsignedCharArray> colors;
  colors->SetNumberOfComponents(3);
  colors->InsertNextTuple3(255.0, 255.0, 200.0);
  colors->InsertNextTuple3(255.0, 215.0, 160.0);
  source->GetOutput()->GetPointData()->SetScalars(colors);
  vtkNew<vtkTrivialProducer> producer;
  producer->SetOutput(source->GetOutput());
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(producer->GetOutputPort());
  vtkNew<vtkActor> line;
  line->SetMapper(mapper);
  line->GetProperty()->LightingOff();
  line->GetProperty()->SetLineWidth(6.0);
  this->Renderer->AddActor(line);
  for (int i = 0; i < 4; ++i)
  {
    const bool hidden = i < 2;
    const double opacity = i % 2 == 0 ? 0.5 : 1.0;
    sphere->SetVisibility(hidden);
    line->GetProperty()->SetOpacity(opacity);
    mapper->SetScalarVisibility(opacity == 1.0);
    for (const char* format : { "svg", "pdf" })
    {
      const auto figure = Rasterize(this->Exporter, this->Folder, format);
      EXPECT_LE(ComputeError(figure, this->Caster), PrecisionOfStrokes) << format << i;
      ASSERT_EQ(figure->GetNumberOfScalarComponents(), 4);
      // Red of pixels of the line with neighbors of nearly the same color.
      vtkDataArray* expected = this->Caster->GetOutput()->GetPointData()->GetArray("Color");
      vtkDataArray* actual = figure->GetPointData()->GetScalars();
      const auto getRed = [](vtkDataArray* image, vtkIdType index) {
        return image->GetComponent(index, 0) * image->GetComponent(index, 3);
      };
      int inside = 0;
      double largest = 0.0;
      for (vtkIdType pixel = 301; pixel < 219 * 300 - 1; ++pixel)
      {
        double least = 1.0;
        for (int n = 0; n < 9; ++n)
        {
          least = std::min(least, getRed(expected, pixel + (n / 3 - 1) * 300 + n % 3 - 1));
        }
        if (least > 0.9 * opacity)
        {
          ++inside;
          const double red = getRed(actual, pixel) / (255.0 * 255.0);
          largest = std::max(largest, std::abs(red - getRed(expected, pixel)));
        }
      }
      EXPECT_GT(inside, 300) << i;
      EXPECT_LE(largest, 0.01) << format << i;
    }
    EXPECT_EQ(this->GetStatistic("Vector/Images"), 0.0);
  }
}

TEST_F(VectorFaces, HaveLinesOfOneWidthAndColorInOneElement)
{
  vtkSmartPointer<vtkActor> sphere = this->AddSphere(0.0, 0.0, 0.0, 2.0, 16);
  sphere->GetProperty()->SetRepresentationToWireframe();
  sphere->GetProperty()->LightingOff();
  const std::string svg = this->Exporter->Encode(vtkPenumbraVectorExporter::SVG);
  const std::size_t first = svg.find("stroke-width");
  ASSERT_NE(first, std::string::npos);
  EXPECT_EQ(svg.find("stroke-width", first + 1), std::string::npos);
}

TEST_F(VectorFaces, AreReplacedByAnImageIfTheyCannotShowTheScene)
{
  vtkSmartPointer<vtkActor> sphere = this->AddSphere(0.0, 0.0, 0.5, 1.0, 8);
  this->Exporter->SetMaximumPaths(20);
  this->ExpectImage("maximum number of paths");
  this->Exporter->SetMaximumPaths(0);
  this->ExpectImage("MaximumPaths is 0");
  this->Exporter->SetMaximumPaths(50000);
  sphere->GetProperty()->SetOpacity(0.5);
  this->ExpectImage("translucent");
  sphere->GetProperty()->SetOpacity(1.0);
  sphere->GetProperty()->SetRepresentationToPoints();
  sphere->GetProperty()->RenderPointsAsSpheresOn();
  sphere->GetProperty()->SetPointSize(9.0);
  this->ExpectImage("spheres");
  sphere->GetProperty()->SetRepresentationToSurface();
  this->Renderer->SetGradientBackground(true);
  this->ExpectFaces();

  this->AddSquare(-1.0, 0.0)->GetProperty()->LightingOn();
  vtkNew<vtkLight> light;
  light->SetLightTypeToSceneLight();
  light->SetPosition(1.0, 1.0, 9.0);
  light->SetFocalPoint(0.0, 0.0, 0.0);
  this->Renderer->AddLight(light);
  this->Caster->ShadowsOn();
  this->ExpectImage("colors change inside triangles");

  // Few samples show that shadows need an image, before light is computed at four points per pixel.
  vtkNew<CountedIrradiance> provider;
  this->Caster->SetIrradianceProvider(provider);
  this->Caster->IndirectLightOn();
  this->Caster->Update();
  const int image = provider->Points;
  EXPECT_FALSE(this->Exporter->Encode(vtkPenumbraVectorExporter::SVG).empty());
  EXPECT_NE(this->Exporter->GetImageReason(), "");
  EXPECT_LE(provider->Points, 2 * image + 300 * 220 / 4);
}

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
