// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Figures of vtkPenumbraVectorExporter against the ray-cast image and closed forms.
#include "RasterizedFigure.h"

#include "vtkActor.h"
#include "vtkActor2D.h"
#include "vtkAxesActor.h"
#include "vtkBoundingBox.h"
#include "vtkCallbackCommand.h"
#include "vtkCamera.h"
#include "vtkCommand.h"
#include "vtkCornerAnnotation.h"
#include "vtkCubeAxesActor.h"
#include "vtkFieldData.h"
#include "vtkImageData.h"
#include "vtkImageMapper.h"
#include "vtkLineSource.h"
#include "vtkLookupTable.h"
#include "vtkPlaneSource.h"
#include "vtkPolyDataMapper.h"
#include "vtkProperty.h"
#include "vtkRenderWindow.h"
#include "vtkRenderer.h"
#include "vtkScalarBarActor.h"
#include "vtkSphereSource.h"
#include "vtkTextActor.h"
#include "vtkTextMapper.h"
#include "vtkTextProperty.h"

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <limits>
#include <sys/resource.h>

namespace
{
using namespace penumbra_testing;

constexpr double Precision = 1.0 / 255.0;

vtkSmartPointer<vtkActor> AddActor(vtkRenderer* renderer, vtkPolyDataAlgorithm* source)
{
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(source->GetOutputPort());
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  renderer->AddActor(actor);
  return actor;
}

/// A renderer, a ray caster of 200 x 150 pixels, and an exporter that records errors.
class VectorExporter : public testing::Test
{
protected:
  VectorExporter()
  {
    this->Renderer->SetBackground(0.2, 0.3, 0.4);
    this->Renderer->GetActiveCamera()->ParallelProjectionOn();
    this->Renderer->GetActiveCamera()->SetParallelScale(7.5); // 10 pixels per unit
    this->Renderer->GetActiveCamera()->SetPosition(0.0, 0.0, 50.0);
    this->Renderer->GetActiveCamera()->SetClippingRange(1.0, 100.0);
    this->Caster->SetRenderer(this->Renderer);
    this->Caster->SetResolution(200, 150);
    this->Exporter->SetRayCaster(this->Caster);
    this->Exporter->SetMaximumPaths(0); // TestVectorShapes tests surfaces as paths
    vtkNew<vtkCallbackCommand> observer;
    observer->SetCallback([](vtkObject*, unsigned long, void* errors, void* message) {
      *static_cast<std::string*>(errors) += static_cast<const char*>(message);
    });
    observer->SetClientData(&this->Errors);
    this->Exporter->AddObserver(vtkCommand::ErrorEvent, observer);
    this->Caster->AddObserver(vtkCommand::ErrorEvent, observer);
  }

  double GetStatistic(const char* name)
  {
    vtkDataArray* array = this->Exporter->GetStatistics()->GetArray(name);
    return array ? array->GetComponent(0, 0) : -1.0;
  }

  void AddLine(double x, double y, double z, double toX, double toY, double toZ, double width)
  {
    vtkNew<vtkLineSource> line;
    line->SetPoint1(x, y, z);
    line->SetPoint2(toX, toY, toZ);
    vtkSmartPointer<vtkActor> actor = AddActor(this->Renderer, line);
    actor->GetProperty()->SetLineWidth(width);
    actor->GetProperty()->SetColor(1.0, 0.0, 0.0);
    actor->GetProperty()->LightingOff();
  }

  /// Adds a rectangle in the plane z = `z`.
  vtkSmartPointer<vtkActor> AddRectangle(double x, double y, double toX, double toY, double z)
  {
    vtkNew<vtkPlaneSource> plane;
    plane->SetOrigin(x, y, z);
    plane->SetPoint1(toX, y, z);
    plane->SetPoint2(x, toY, z);
    return AddActor(this->Renderer, plane);
  }

  vtkSmartPointer<vtkTextActor> AddText(const char* text, int x, int y)
  {
    vtkNew<vtkTextActor> actor;
    actor->SetInput(text);
    actor->SetPosition(x, y);
    actor->GetTextProperty()->SetFontSize(20);
    this->Renderer->AddViewProp(actor);
    return actor;
  }

  TemporaryFolder Folder;
  vtkNew<vtkRenderer> Renderer;
  vtkNew<vtkPenumbraRayCaster> Caster;
  vtkNew<vtkPenumbraVectorExporter> Exporter;
  std::string Errors;
};

TEST_F(VectorExporter, EqualsTheRayCastImage)
{
  vtkNew<vtkSphereSource> sphere;
  sphere->SetRadius(5.0);
  sphere->SetThetaResolution(24);
  sphere->SetPhiResolution(16);
  vtkSmartPointer<vtkActor> actor = AddActor(this->Renderer, sphere);
  actor->GetProperty()->SetColor(0.9, 0.7, 0.3);
  this->AddLine(-9.0, -6.0, 0.0, 9.0, 6.5, 0.0, 2.0);
  this->AddLine(-9.0, 3.0, 8.0, 9.0, -2.0, 8.0, 3.0);
  for (const char* format : { "svg", "pdf" })
  {
    const auto figure = Rasterize(this->Exporter, this->Folder, format);
    EXPECT_LE(ComputeError(figure, this->Caster), Precision) << format;
  }
  EXPECT_EQ(this->GetStatistic("Vector/Lines"), 3.0); // one line is hidden by the sphere
  EXPECT_EQ(this->GetStatistic("Vector/Images"), 1.0);
}

TEST_F(VectorExporter, EqualsTheRayCastImageWithMeshEdgesAndPoints)
{
  vtkNew<vtkSphereSource> sphere;
  sphere->SetRadius(6.0);
  sphere->SetThetaResolution(12);
  sphere->SetPhiResolution(8);
  vtkSmartPointer<vtkActor> actor = AddActor(this->Renderer, sphere);
  actor->GetProperty()->SetInterpolationToFlat();
  actor->GetProperty()->EdgeVisibilityOn();
  actor->GetProperty()->VertexVisibilityOn();
  actor->GetProperty()->SetPointSize(4.0);
  for (const char* format : { "svg", "pdf" })
  {
    // Pixels that hold several edges and points blend them in turn. Finer pixels have less of this error.
    const auto figure = Rasterize(this->Exporter, this->Folder, format);
    EXPECT_LE(ComputeError(figure, this->Caster), 3.2 * Precision) << format;
  }
}

TEST_F(VectorExporter, KeepsATransparentBackground)
{
  this->Caster->BackgroundOff();
  this->AddRectangle(-4.0, -3.0, 4.05, 3.05, 0.0)->GetProperty()->SetOpacity(0.5);
  for (const char* format : { "svg", "pdf" })
  {
    const auto figure = Rasterize(this->Exporter, this->Folder, format);
    ASSERT_EQ(figure->GetNumberOfScalarComponents(), 4);
    EXPECT_LE(ComputeError(figure, this->Caster), Precision) << format;
    EXPECT_EQ(figure->GetScalarComponentAsDouble(2, 2, 0, 3), 0.0);
  }
}

// A rectangle hides the line from x = 107 px to x = 133 px.
TEST_F(VectorExporter, CutsLinesWhereTheyAreHidden)
{
  this->AddRectangle(0.7, -3.0, 3.3, 3.0, 10.0);
  this->AddLine(-5.0, 0.0, 0.0, 8.0, 0.0, 0.0, 2.0);
  const std::string svg = this->Exporter->Encode(vtkPenumbraVectorExporter::SVG);
  EXPECT_NE(svg.find("d=\"M5000 7500l5700 0M13300 7500l4700 0\""), std::string::npos) << svg;
  EXPECT_NE(svg.find("stroke=\"#f00\" fill=\"none\" stroke-width=\"200\""), std::string::npos);
}

// The line enters the rectangle, which is inclined, at x = 100 px.
TEST_F(VectorExporter, CutsLinesWhereTheyPierceASurface)
{
  vtkNew<vtkPlaneSource> plane;
  plane->SetOrigin(-6.0, -6.0, -6.0);
  plane->SetPoint1(6.0, -6.0, 6.0);
  plane->SetPoint2(-6.0, 6.0, -6.0);
  AddActor(this->Renderer, plane);
  this->AddLine(-4.0, 1.0, 0.2, 4.0, 1.0, 0.2, 2.0);
  const std::string svg = this->Exporter->Encode(vtkPenumbraVectorExporter::SVG);
  // The ray caster moves lines by their width toward the camera: 0.2 + 0.2 = x.
  EXPECT_NE(svg.find("d=\"M6000 8500l4400 0\""), std::string::npos) << svg;
}

TEST_F(VectorExporter, DrawsVisibleOutlines)
{
  this->AddRectangle(-4.0, -3.0, 4.0, 3.0, 0.0);
  this->AddRectangle(0.0, -5.0, 6.0, 1.0, 10.0);
  this->Exporter->SetOutlineWidth(0.5);
  this->Exporter->SetOutlineColor(0.0, 0.0, 1.0);
  const std::string svg = this->Exporter->Encode(vtkPenumbraVectorExporter::SVG);
  EXPECT_EQ(this->GetStatistic("Vector/Outlines"), 4.0 + 4.0);
  EXPECT_EQ(this->GetStatistic("Vector/Lines"), 0.0);
  EXPECT_NE(svg.find("stroke=\"#00f\" fill=\"none\" stroke-width=\"50\""), std::string::npos);
  // The lower and the right edge of the farther rectangle end at the nearer one.
  EXPECT_NE(svg.find("6000 4500l4000 0"), std::string::npos) << svg;
  EXPECT_NE(svg.find("l0 2000"), std::string::npos) << svg;
}

TEST_F(VectorExporter, WritesLengthsInPoints)
{
  this->Caster->SetDPI(300);
  this->AddLine(-5.0, 0.0, 0.0, 8.0, 0.0, 0.0, 1.0);
  const std::string svg = this->Exporter->Encode(vtkPenumbraVectorExporter::SVG);
  EXPECT_NE(svg.find("width=\"48pt\" height=\"36pt\" viewBox=\"0 0 200 150\""), std::string::npos);
  EXPECT_NE(svg.find("stroke-width=\"416.7\""), std::string::npos) << svg; // 300 / 72 pixels
  const std::string pdf = this->Exporter->Encode(vtkPenumbraVectorExporter::PDF);
  EXPECT_NE(pdf.find("/MediaBox [0 0 48 36]"), std::string::npos);
}

TEST_F(VectorExporter, WritesTextThatCanBeSelected)
{
  this->AddText("left < right & up\nsecond line", 10, 20);
  vtkSmartPointer<vtkTextActor> turned =
    this->AddText("caf\xc3\xa9 \xe2\x88\x92 5 \xce\xbcm", 150, 20);
  turned->GetTextProperty()->SetOrientation(90.0);
  turned->GetTextProperty()->SetFontFamilyToTimes();
  turned->GetTextProperty()->BoldOn();
  const std::string svg = this->Exporter->Encode(vtkPenumbraVectorExporter::SVG);
  EXPECT_NE(svg.find(">left &lt; right &amp; up</text>"), std::string::npos) << svg;
  EXPECT_NE(svg.find(">second line</text>"), std::string::npos);
  EXPECT_NE(svg.find("font-family=\"Arial, Helvetica"), std::string::npos);
  EXPECT_NE(svg.find("rotate(-90 "), std::string::npos);
  EXPECT_EQ(this->GetStatistic("Vector/Texts"), 3.0);

  const std::string path = this->Folder.File("text.pdf");
  this->Exporter->SetFileName(path.c_str());
  ASSERT_TRUE(this->Exporter->Write());
  EXPECT_EQ(this->GetStatistic("Vector/OutlinedTexts"), 1.0);
  RunCommand("pdftotext " + path + " " + path + ".txt", "poppler-utils");
  const std::string text = ReadText(path + ".txt");
  EXPECT_NE(text.find("left < right & up"), std::string::npos) << text;
  EXPECT_NE(text.find("second line"), std::string::npos) << text;
  EXPECT_NE(text.find("caf\xc3\xa9 \xe2\x88\x92 5 \xce\xbcm"), std::string::npos) << text;
  EXPECT_NE(ReadText(path).find("/BaseFont /Times-Bold"), std::string::npos);
}

// All text is text, also that of props which VTK draws with textures, and over an image.
TEST_F(VectorExporter, WritesTextOfAnnotationsOverTextures)
{
  this->AddText("title", 60, 120);
  vtkNew<vtkTextMapper> mapper;
  mapper->SetInput("mapped");
  vtkNew<vtkActor2D> mapped;
  mapped->SetMapper(mapper);
  mapped->SetPosition(20, 60);
  this->Renderer->AddViewProp(mapped);
  vtkNew<vtkCornerAnnotation> corner;
  corner->SetText(1, "corner");
  this->Renderer->AddViewProp(corner);
  const std::string without = this->Exporter->Encode(vtkPenumbraVectorExporter::SVG);
  vtkNew<vtkImageData> image;
  image->SetDimensions(10, 10, 1);
  image->AllocateScalars(VTK_UNSIGNED_CHAR, 1);
  std::fill_n(static_cast<unsigned char*>(image->GetScalarPointer()), 100, 255);
  vtkNew<vtkImageMapper> pixels;
  pixels->SetInputData(image);
  pixels->SetColorWindow(255.0);
  pixels->SetColorLevel(127.5);
  vtkNew<vtkActor2D> texture;
  texture->SetMapper(pixels);
  texture->SetPosition(100, 20);
  this->Renderer->AddViewProp(texture);
  this->Exporter->SetMaximumPaths(1000);
  const std::string with = this->Exporter->Encode(vtkPenumbraVectorExporter::SVG);
  EXPECT_NE(this->Exporter->GetImageReason().find("texture"), std::string::npos);
  for (const std::string& svg : { without, with })
  {
    for (const char* text : { ">title</text>", ">mapped</text>", ">corner</text>" })
    {
      EXPECT_NE(svg.find(text), std::string::npos) << text;
    }
  }
  EXPECT_EQ(this->GetStatistic("Vector/Texts"), 3.0);
  // The image shows the texture, but no text.
  this->Renderer->SetBackground(0.0, 0.0, 0.0);
  const auto figure = Rasterize(this->Exporter, this->Folder, "svg");
  EXPECT_EQ(figure->GetScalarComponentAsDouble(105, 25, 0, 0), 255.0);
}

// Labels of cube axes are polygons. Text that can be selected lies over them.
TEST_F(VectorExporter, WritesTextOverThePolygonsOfCubeAxes)
{
  this->Renderer->GetActiveCamera()->Elevation(20.0);
  vtkNew<vtkCubeAxesActor> axes;
  axes->SetBounds(-4.0, 4.0, -4.0, 2.0, -4.0, 4.0);
  axes->SetCamera(this->Renderer->GetActiveCamera());
  axes->SetScreenSize(5.0);
  axes->SetYAxisLabelVisibility(0);
  axes->SetZAxisLabelVisibility(0);
  this->Renderer->AddViewProp(axes);
  const auto draw = [&](int labels) {
    axes->SetXAxisLabelVisibility(labels);
    this->Caster->Modified();
    this->Caster->UpdateWholeExtent();
    vtkNew<vtkImageData> image;
    image->DeepCopy(this->Caster->GetOutput());
    return vtkSmartPointer<vtkImageData>(image);
  };
  const vtkSmartPointer<vtkImageData> without = draw(0);
  const vtkSmartPointer<vtkImageData> with = draw(1);
  vtkBoundingBox labels;
  for (vtkIdType i = 0; i < with->GetNumberOfPoints(); ++i)
  {
    const auto get = [i](vtkImageData* image) {
      return image->GetPointData()->GetArray("Color")->GetComponent(i, 0);
    };
    if (std::abs(get(with) - get(without)) > 0.1)
    {
      labels.AddPoint(static_cast<double>(i % 200), static_cast<double>(i / 200), 0.0);
    }
  }
  ASSERT_GT(labels.GetLength(0), 80.0);
  const std::string svg = this->Exporter->Encode(vtkPenumbraVectorExporter::SVG);
  const std::size_t end = svg.find(">-4.0");
  ASSERT_NE(end, std::string::npos) << svg;
  const std::size_t begin = svg.rfind("<text ", end);
  const std::string element = svg.substr(begin, end - begin);
  EXPECT_NE(element.find("fill-opacity=\"0\""), std::string::npos) << element;
  const auto read = [&element](const std::string& name) {
    return std::stod(element.substr(element.find(" " + name + "=\"") + name.size() + 3));
  };
  EXPECT_NEAR(read("x"), labels.GetMinPoint()[0], 2.0) << element;
  EXPECT_NEAR(150.0 - read("y"), labels.GetMinPoint()[1], 2.0) << element;
  EXPECT_NEAR(0.75 * read("font-size"), labels.GetLength(1), 2.0) << element;
}

// A layer makes the figure an image. Text that can be selected lies over it.
TEST_F(VectorExporter, WritesTextOfOtherLayersOverTheImage)
{
  vtkNew<vtkRenderWindow> window;
  window->SetSize(200, 150);
  window->SetNumberOfLayers(2);
  window->AddRenderer(this->Renderer);
  vtkNew<vtkRenderer> layer;
  layer->SetLayer(1);
  layer->SetViewport(0.5, 0.2, 1.0, 1.0);
  window->AddRenderer(layer);
  vtkNew<vtkTextActor> text;
  text->SetInput("layer");
  text->SetPosition(10, 20);
  layer->AddViewProp(text);
  vtkNew<vtkAxesActor> axes; // as in orientation marker widgets
  layer->AddViewProp(axes);
  layer->ResetCamera();
  this->AddRectangle(-3.0, -3.0, 3.0, 3.0, 0.0);
  this->Exporter->SetMaximumPaths(1000);
  const std::string svg = this->Exporter->Encode(vtkPenumbraVectorExporter::SVG);
  EXPECT_NE(this->Exporter->GetImageReason().find("layers"), std::string::npos);
  for (const char* label : { ">X</text>", ">Y</text>", ">Z</text>" })
  {
    EXPECT_NE(svg.find(label), std::string::npos) << label;
  }
  const std::size_t end = svg.find(">layer</text>");
  ASSERT_NE(end, std::string::npos) << svg;
  const std::string element = svg.substr(svg.rfind("<text ", end));
  EXPECT_EQ(element.find("<text x=\"110\" "), 0u) << element;
  EXPECT_NEAR(std::stod(element.substr(element.find(" y=\"") + 4)), 98.0, 2.0) << element;
  EXPECT_NE(element.find("fill-opacity=\"0\""), std::string::npos) << element;
  this->Caster->LayersOff();
  EXPECT_EQ(
    this->Exporter->Encode(vtkPenumbraVectorExporter::SVG).find(">layer<"), std::string::npos);
}

// The fonts of the machine differ from VTK's in the shapes of letters. VTK rounds the distances of letters
// to pixels, so that its lines are up to half a pixel per letter shorter or longer.
TEST_F(VectorExporter, PlacesTextAsTheRayCaster)
{
  this->Renderer->SetBackground(1.0, 1.0, 1.0);
  for (int i = 0; i < 3; ++i)
  {
    vtkSmartPointer<vtkTextActor> text = this->AddText("HHHHHH", i == 1 ? 190 : 10, 15 + 45 * i);
    text->GetTextProperty()->SetColor(0.0, 0.0, 0.0);
    text->GetTextProperty()->SetJustification(i == 1 ? VTK_TEXT_RIGHT : VTK_TEXT_LEFT);
    text->GetTextProperty()->SetOrientation(i == 2 ? 10.0 : 0.0);
  }
  for (const char* format : { "svg", "pdf" })
  {
    const auto figure = Rasterize(this->Exporter, this->Folder, format);
    this->Caster->UpdateWholeExtent();
    vtkDataArray* expected = this->Caster->GetOutput()->GetPointData()->GetArray("Color");
    for (int row = 0; row < 3; ++row)
    {
      // Centers of the dark parts of each text.
      double centers[2][2];
      for (int side = 0; side < 2; ++side)
      {
        double sums[3] = { 0.0, 0.0, 0.0 };
        for (vtkIdType i = 200 * (5 + 45 * row); i < 200 * (50 + 45 * row); ++i)
        {
          const double dark = 1.0 -
            (side ? figure->GetPointData()->GetScalars()->GetComponent(i, 0) / 255.0
                  : expected->GetComponent(i, 0));
          sums[0] += dark;
          sums[1] += dark * (i % 200);
          sums[2] += dark * (i / 200);
        }
        EXPECT_GT(sums[0], 100.0);
        centers[side][0] = sums[1] / sums[0];
        centers[side][1] = sums[2] / sums[0];
      }
      EXPECT_NEAR(centers[0][0], centers[1][0], 2.0) << format << " row " << row;
      EXPECT_NEAR(centers[0][1], centers[1][1], 1.0) << format << " row " << row;
    }
  }
}

// The minus sign is not in the standard fonts of PDF; its outlines are those of the font of the ray caster.
TEST_F(VectorExporter, DrawsCharactersThatStandardFontsLack)
{
  this->Renderer->SetBackground(1.0, 1.0, 1.0);
  vtkSmartPointer<vtkTextActor> text = this->AddText("\xe2\x88\x92"
                                                     "5 \xce\xbcm",
    20, 30);
  text->GetTextProperty()->SetColor(0.0, 0.0, 0.0);
  text->GetTextProperty()->SetFontSize(40);
  text->GetTextProperty()->SetOrientation(20.0);
  const auto figure = Rasterize(this->Exporter, this->Folder, "pdf");
  EXPECT_EQ(this->GetStatistic("Vector/OutlinedTexts"), 1.0);
  // Letters differ by hinting, and the pen by a typical space before the first letter.
  EXPECT_LE(ComputeError(figure, this->Caster), 0.1);
  double dark = 0.0;
  double expected = 0.0;
  vtkDataArray* colors = this->Caster->GetOutput()->GetPointData()->GetArray("Color");
  for (vtkIdType i = 0; i < colors->GetNumberOfTuples(); ++i)
  {
    dark += 1.0 - figure->GetPointData()->GetScalars()->GetComponent(i, 0) / 255.0;
    expected += 1.0 - colors->GetComponent(i, 0);
  }
  EXPECT_NEAR(dark, expected, 0.1 * expected);
}

TEST_F(VectorExporter, NamesCharactersThatNoFontHas)
{
  this->AddText("5 \xe4\xb8\xad", 10, 20);
  EXPECT_TRUE(this->Exporter->Encode(vtkPenumbraVectorExporter::PDF).empty());
  EXPECT_NE(this->Errors.find("Arial lacks the character U+4E2D"), std::string::npos)
    << this->Errors;
  this->Errors.clear();
  EXPECT_FALSE(this->Exporter->Encode(vtkPenumbraVectorExporter::SVG).empty());
  EXPECT_EQ(this->Errors, "");
}

TEST_F(VectorExporter, WritesScalarBarsAsPolygonsAndText)
{
  vtkNew<vtkLookupTable> table;
  table->SetNumberOfTableValues(8);
  table->SetRange(0.0, 7.0);
  table->Build();
  vtkNew<vtkScalarBarActor> bar;
  bar->SetLookupTable(table);
  bar->SetTitle("heat");
  bar->SetNumberOfLabels(3);
  this->Renderer->AddViewProp(bar);
  const std::string svg = this->Exporter->Encode(vtkPenumbraVectorExporter::SVG);
  EXPECT_NE(svg.find(">heat</text>"), std::string::npos) << svg;
  EXPECT_EQ(this->GetStatistic("Vector/Texts"), 4.0);
  EXPECT_GE(this->GetStatistic("Vector/Polygons"), 8.0);
}

// Swatches end between pixels, and are narrower than pixels. Their colors differ by less than 8.
TEST_F(VectorExporter, DrawsNoSeamsBetweenSwatches)
{
  this->Renderer->SetBackground(1.0, 1.0, 1.0);
  for (const int colors : { 64, 256 })
  {
    vtkNew<vtkLookupTable> table;
    table->SetNumberOfTableValues(colors);
    for (int i = 0; i < colors; ++i)
    {
      table->SetTableValue(i, 0.0, 0.5 * i / colors, 0.5);
    }
    vtkNew<vtkScalarBarActor> bar;
    bar->SetLookupTable(table);
    bar->SetMaximumNumberOfColors(colors);
    bar->SetNumberOfLabels(0);
    this->Renderer->AddViewProp(bar);
    for (const char* format : { "svg", "pdf" })
    {
      const auto figure = Rasterize(this->Exporter, this->Folder, format);
      EXPECT_LE(ComputeError(figure, this->Caster), Precision) << format;
      EXPECT_LE(ComputeLargestDifference(figure, this->Caster), 2.0 * Precision) << format;
    }
    EXPECT_GE(this->GetStatistic("Vector/Polygons"), 50.0);
    this->Renderer->RemoveViewProp(bar);
  }
}

TEST_F(VectorExporter, WritesAnEmptyScene)
{
  for (const char* format : { "svg", "pdf" })
  {
    const auto figure = Rasterize(this->Exporter, this->Folder, format);
    EXPECT_LE(ComputeError(figure, this->Caster), Precision) << format;
  }
  EXPECT_EQ(this->GetStatistic("Vector/Lines"), 0.0);
}

TEST_F(VectorExporter, LeavesTheRayCasterAsItWas)
{
  this->AddLine(-5.0, 0.0, 0.0, 8.0, 0.0, 0.0, 2.0);
  this->AddText("text", 10, 20);
  this->Caster->Update();
  vtkNew<vtkImageData> before;
  before->DeepCopy(this->Caster->GetOutput());
  this->Exporter->Encode(vtkPenumbraVectorExporter::SVG);
  this->Caster->Update();
  vtkDataArray* first = before->GetPointData()->GetArray("Color");
  vtkDataArray* second = this->Caster->GetOutput()->GetPointData()->GetArray("Color");
  for (vtkIdType i = 0; i < first->GetNumberOfValues(); ++i)
  {
    ASSERT_EQ(first->GetVariantValue(i).ToFloat(), second->GetVariantValue(i).ToFloat());
  }
}

TEST_F(VectorExporter, ReportsBadInput)
{
  this->Exporter->SetFileName(this->Folder.File("figure.eps").c_str());
  EXPECT_FALSE(this->Exporter->Write());
  EXPECT_NE(this->Errors.find(".svg or .pdf"), std::string::npos) << this->Errors;
  EXPECT_TRUE(this->Exporter->Encode(7).empty());

  this->Errors.clear();
  this->Exporter->SetFileName(this->Folder.File("missing/figure.svg").c_str());
  EXPECT_FALSE(this->Exporter->Write());
  EXPECT_NE(this->Errors.find("No such file or directory"), std::string::npos) << this->Errors;

  this->Errors.clear();
  this->Caster->SetResolution(0, 10);
  EXPECT_TRUE(this->Exporter->Encode(vtkPenumbraVectorExporter::SVG).empty());
  EXPECT_NE(this->Errors.find("Resolution"), std::string::npos) << this->Errors;
  EXPECT_EQ(this->Exporter->GetStatistics()->GetNumberOfArrays(), 0);

  this->Errors.clear();
  this->Exporter->SetRayCaster(nullptr);
  EXPECT_TRUE(this->Exporter->Encode(vtkPenumbraVectorExporter::SVG).empty());
  EXPECT_NE(this->Errors.find("RayCaster is not set"), std::string::npos) << this->Errors;

  this->Exporter->SetOutlineWidth(std::numeric_limits<double>::infinity());
  EXPECT_EQ(this->Exporter->GetOutlineWidth(), 1000.0);
}

// A limit on the size of files stands in for a full disk.
TEST_F(VectorExporter, KeepsTheOldFileIfTheDiskIsFull)
{
  const std::string path = this->Folder.File("figure.pdf");
  std::ofstream(path) << "old";
  rlimit old = {};
  ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &old), 0);
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  const rlimit small{ 100, old.rlim_max };
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &small), 0);
  this->Exporter->SetFileName(path.c_str());
  const bool written = this->Exporter->Write();
  setrlimit(RLIMIT_FSIZE, &old);
  std::signal(SIGXFSZ, handler);
  EXPECT_FALSE(written);
  EXPECT_NE(this->Errors.find("cannot be written"), std::string::npos) << this->Errors;
  EXPECT_EQ(ReadText(path), "old");
  EXPECT_FALSE(std::filesystem::exists(path + ".part"));
}

}
