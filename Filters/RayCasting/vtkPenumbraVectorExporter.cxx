// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkPenumbraVectorExporter.h"

#include "Overlay.h"
#include "RayCasterInternals.h"
#include "Scene.h"
#include "Surface.h"

#include "Image/LayerCompositing.h"
#include "Import/SceneExtraction.h"
#include "Shading/Shading.h"
#include "Statistics/Statistics.h"
#include "Vector/EdgeVisibility.h"
#include "Vector/InstanceCopies.h"
#include "Vector/PdfEncoder.h"
#include "Vector/PolygonRows.h"
#include "Vector/SvgEncoder.h"
#include "Vector/VectorFaces.h"
#include "Vector/VisibleStrokes.h"

#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtksys/SystemTools.hxx"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <exception>
#include <stdexcept>
#include <utility>

vtkStandardNewMacro(vtkPenumbraVectorExporter);

struct vtkPenumbraVectorExporter::Internals
{
  vtkSmartPointer<vtkPenumbraRayCaster> Caster;
  vtkNew<vtkFieldData> Statistics;
  std::string ImageReason;

  penumbra::VectorFigure MakeFigure(vtkPenumbraVectorExporter* self);
  void AddFaces(vtkPenumbraVectorExporter* self, const penumbra::CameraRayTracer& tracer,
    penumbra::VectorFigure& figure);
  void AddLines(const penumbra::Scene& scene, penumbra::VectorFigure& figure);
  void Report(const penumbra::VectorFigure& figure, std::size_t outlines);
};

namespace
{

/// Moves the text and the scalar bars of a scene to the figure, and its lines and points to `all`,
/// a copy of the scene. `all` stays empty if there are none.
void TakeAnnotations(penumbra::Scene& scene, penumbra::Scene& all, penumbra::VectorFigure& figure)
{
  if (scene.OverlayImage)
  {
    figure.Shapes = scene.OverlayImage->TakeShapes();
  }
  penumbra::ExtendRows(figure.Shapes);
  penumbra::CopyInstances(scene.Surfaces); // each visible triangle becomes a polygon of its own
  const auto first = std::stable_partition(scene.Surfaces.begin(), scene.Surfaces.end(),
    [](const penumbra::Surface& surface) { return !penumbra::HasStrokes(surface); });
  if (first != scene.Surfaces.end())
  {
    all = scene;
    scene.Surfaces.erase(first, scene.Surfaces.end());
  }
}

/// Adds the text of other layers, which only an image shows: invisible, so that it can be selected and found.
void AddTextOfLayers(vtkPenumbraRayCaster* caster, penumbra::VectorFigure& figure)
{
  for (const auto& find : { penumbra::FindLayersBelow, penumbra::FindLayersAbove })
  {
    for (vtkRenderer* layer : find(caster->GetRenderer()))
    {
      const penumbra::LayerRectangle part =
        penumbra::FindLayerRectangle(caster->GetRenderer(), layer, caster->GetResolution());
      if (std::min(part.Size[0], part.Size[1]) < 1)
      {
        continue;
      }
      penumbra::ExtractionOptions options;
      std::copy_n(part.Size, 2, options.Resolution);
      options.DPI = caster->GetDPI();
      for (penumbra::OverlayShape& shape :
        penumbra::ExtractScene(layer, options).OverlayImage->TakeShapes())
      {
        if (!shape.Text.empty())
        {
          shape.Color.a = 0.f;
          shape.Baseline += glm::dvec2(part.Low[0], part.Low[1]);
          figure.Shapes.push_back(std::move(shape));
        }
      }
    }
  }
}

/// Copies the colors of the image as bytes, top row first.
void CopyImage(vtkImageData* image, penumbra::VectorFigure& figure)
{
  auto* colors = vtkFloatArray::SafeDownCast(image->GetPointData()->GetArray("Color"));
  const std::size_t count = static_cast<std::size_t>(figure.Width) * figure.Height;
  if (!colors || static_cast<std::size_t>(colors->GetNumberOfTuples()) != count)
  {
    throw std::runtime_error("The ray caster has no image.");
  }
  figure.Image.resize(count);
  for (int y = 0; y < figure.Height; ++y)
  {
    const float* row =
      colors->GetPointer(4 * static_cast<vtkIdType>(figure.Height - 1 - y) * figure.Width);
    for (int x = 0; x < figure.Width; ++x)
    {
      glm::u8vec4& pixel = figure.Image[static_cast<std::size_t>(y) * figure.Width + x];
      for (int c = 0; c < 4; ++c)
      {
        pixel[c] =
          static_cast<unsigned char>(std::lround(255.f * std::clamp(row[4 * x + c], 0.f, 1.f)));
      }
    }
  }
}

/// Writes a file beside `path` and renames it.
void WriteFile(const std::string& contents, const std::string& path)
{
  const std::string temporary = path + ".part";
  const auto fail = [&](int error) {
    std::remove(temporary.c_str());
    throw std::runtime_error(path + ": cannot be written: " + std::strerror(error));
  };
  std::FILE* file = vtksys::SystemTools::Fopen(temporary, "wb");
  if (!file)
  {
    throw std::runtime_error(path + ": cannot be written: " + std::strerror(errno));
  }
  errno = 0;
  const bool written = std::fwrite(contents.data(), 1, contents.size(), file) == contents.size() &&
    std::fflush(file) == 0;
  const int error = errno;
  const bool closed = std::fclose(file) == 0;
  if (!written || !closed)
  {
    fail(written ? errno : error);
  }
  if (std::rename(temporary.c_str(), path.c_str()) != 0)
  {
    fail(errno);
  }
}

}

vtkPenumbraVectorExporter::vtkPenumbraVectorExporter()
  : Implementation(new Internals)
{
}

vtkPenumbraVectorExporter::~vtkPenumbraVectorExporter()
{
  this->SetFileName(nullptr);
}

void vtkPenumbraVectorExporter::SetRayCaster(vtkPenumbraRayCaster* caster)
{
  if (this->Implementation->Caster != caster)
  {
    this->Implementation->Caster = caster;
    this->Modified();
  }
}

vtkPenumbraRayCaster* vtkPenumbraVectorExporter::GetRayCaster()
{
  return this->Implementation->Caster;
}

vtkFieldData* vtkPenumbraVectorExporter::GetStatistics()
{
  return this->Implementation->Statistics;
}

std::string vtkPenumbraVectorExporter::GetImageReason()
{
  return this->Implementation->ImageReason;
}

void vtkPenumbraVectorExporter::Internals::AddFaces(vtkPenumbraVectorExporter* self,
  const penumbra::CameraRayTracer& tracer, penumbra::VectorFigure& figure)
{
  vtkRenderer* renderer = this->Caster->GetRenderer();
  if (self->MaximumPaths == 0)
  {
    this->ImageReason = "MaximumPaths is 0";
  }
  else if (this->Caster->GetLayers() &&
    !(penumbra::FindLayersAbove(renderer).empty() && penumbra::FindLayersBelow(renderer).empty()))
  {
    this->ImageReason = "the window has renderers in other layers";
  }
  else
  {
    this->ImageReason =
      penumbra::AddVisibleFaces(tracer, static_cast<std::size_t>(self->MaximumPaths),
        this->Caster->Implementation->TileTolerance, figure.Faces);
  }
}

void vtkPenumbraVectorExporter::Internals::AddLines(
  const penumbra::Scene& scene, penumbra::VectorFigure& figure)
{
  const penumbra::RayScene rays(scene, this->Caster->GetNumberOfThreads());
  const penumbra::Shading shading(rays, this->Caster->GetShadows());
  const penumbra::CameraRayTracer tracer(rays, shading, scene.ViewCamera);
  penumbra::AddVisibleLines(tracer, figure.Lines);
}

penumbra::VectorFigure vtkPenumbraVectorExporter::Internals::MakeFigure(
  vtkPenumbraVectorExporter* self)
{
  if (!this->Caster)
  {
    throw std::runtime_error("RayCaster is not set.");
  }
  penumbra::VectorFigure figure;
  figure.Width = this->Caster->GetResolution()[0];
  figure.Height = this->Caster->GetResolution()[1];
  figure.PointsPerPixel = 72.0 / this->Caster->GetDPI();
  penumbra::Scene all;
  std::vector<penumbra::FigurePath> outlines;
  vtkPenumbraRayCaster::Internals& internals = *this->Caster->Implementation;
  internals.ChangeScene = [&](penumbra::Scene& scene) { TakeAnnotations(scene, all, figure); };
  internals.InspectImage = [&](const penumbra::CameraRayTracer& tracer,
                             const penumbra::SceneEdges& edges) {
    this->AddFaces(self, tracer, figure);
    penumbra::FigurePath pen;
    pen.Width = self->OutlineWidth / figure.PointsPerPixel;
    const double* color = self->OutlineColor;
    pen.Color = glm::vec4(color[0], color[1], color[2], 1.f);
    pen.RoundCaps = true;
    if (pen.Width > 0.0)
    {
      penumbra::AddVisibleOutlines(tracer, edges.EdgesBySurface, pen, outlines);
    }
  };
  this->Caster->Modified();
  this->Caster->UpdateWholeExtent();
  internals.ChangeScene = nullptr;
  internals.InspectImage = nullptr;
  this->Caster->Modified();
  CopyImage(this->Caster->GetOutput(), figure);
  if (this->ImageReason.empty())
  {
    figure.Image.clear();
  }
  if (this->Caster->GetLayers())
  {
    AddTextOfLayers(this->Caster, figure);
  }
  figure.Lines = outlines;
  if (!all.Surfaces.empty())
  {
    this->AddLines(all, figure);
  }
  this->Report(figure, outlines.size());
  return figure;
}

void vtkPenumbraVectorExporter::Internals::Report(
  const penumbra::VectorFigure& figure, std::size_t outlines)
{
  const auto texts = std::count_if(figure.Shapes.begin(), figure.Shapes.end(),
    [](const penumbra::OverlayShape& shape) { return !shape.Text.empty(); });
  vtkFieldData* s = this->Statistics;
  const auto add = [s](const char* name, std::size_t value) {
    penumbra::AddStatistic(s, name, static_cast<double>(value));
  };
  add("Vector/Faces", figure.Faces.size());
  add("Vector/Lines", figure.Lines.size() - outlines);
  add("Vector/Outlines", outlines);
  add("Vector/Polygons", figure.Shapes.size() - static_cast<std::size_t>(texts));
  add("Vector/Texts", static_cast<std::size_t>(texts));
  add("Vector/Images", figure.Image.empty() ? 0 : 1);
}

std::string vtkPenumbraVectorExporter::Encode(int format)
{
  Internals& internals = *this->Implementation;
  internals.Statistics->Initialize();
  internals.ImageReason.clear();
  try
  {
    if (format != SVG && format != PDF)
    {
      throw std::runtime_error("The format must be SVG or PDF.");
    }
    const penumbra::VectorFigure figure = internals.MakeFigure(this);
    int outlinedTexts = 0;
    std::string contents =
      format == SVG ? penumbra::EncodeSvg(figure) : penumbra::EncodePdf(figure, outlinedTexts);
    penumbra::AddStatistic(internals.Statistics, "Vector/OutlinedTexts", outlinedTexts);
    return contents;
  }
  catch (const std::bad_alloc&)
  {
    vtkErrorMacro("Out of memory. Reduce Resolution or simplify the scene.");
  }
  catch (const std::exception& error)
  {
    vtkErrorMacro(<< error.what());
  }
  internals.Statistics->Initialize();
  return {};
}

bool vtkPenumbraVectorExporter::Write()
{
  const std::string path = this->FileName ? this->FileName : "";
  const std::string extension =
    vtksys::SystemTools::LowerCase(vtksys::SystemTools::GetFilenameLastExtension(path));
  if (extension != ".svg" && extension != ".pdf")
  {
    vtkErrorMacro("FileName must end in .svg or .pdf: '" << path << "'.");
    return false;
  }
  const std::string contents = this->Encode(extension == ".svg" ? SVG : PDF);
  if (contents.empty())
  {
    return false;
  }
  try
  {
    WriteFile(contents, path);
  }
  catch (const std::exception& error)
  {
    vtkErrorMacro(<< error.what());
    return false;
  }
  return true;
}

void vtkPenumbraVectorExporter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "RayCaster: " << this->Implementation->Caster.Get() << "\n";
  os << indent << "FileName: " << (this->FileName ? this->FileName : "(none)") << "\n";
  os << indent << "MaximumPaths: " << this->MaximumPaths << "\n";
  os << indent << "OutlineWidth: " << this->OutlineWidth << "\n";
  os << indent << "OutlineColor: " << this->OutlineColor[0] << " " << this->OutlineColor[1] << " "
     << this->OutlineColor[2] << "\n";
}
