// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "Engine.h"

#include "Files/ImageFiles.h"
#include "Options/RenderOptions.h"
#include "Processes/CommandError.h"
#include "Processes/MessageLog.h"

#include "vtkDataArray.h"
#include "vtkFieldData.h"
#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPenumbraLightShaftPass.h"
#include "vtkPenumbraTemporalSSAOPass.h"
#include "vtkPenumbraTracedEstimator.h"
#include "vtkPointData.h"
#include "vtkRenderWindow.h"
#include "vtkRenderer.h"
#include "vtkSMPTools.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>

namespace penumbra
{

namespace
{

constexpr int MultiSamples = 8;

// Bytes whose colour is multiplied by alpha, as blending leaves them, to floats with straight alpha.
vtkSmartPointer<vtkImageData> ToFloats(
  vtkUnsignedCharArray* bytes, int width, int height, bool opaque)
{
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(width, height, 1);
  vtkNew<vtkFloatArray> color;
  color->SetName("Color");
  color->SetNumberOfComponents(4);
  color->SetNumberOfTuples(image->GetNumberOfPoints());
  for (vtkIdType i = 0; i < color->GetNumberOfTuples(); ++i)
  {
    const float alpha = opaque ? 1.0f : bytes->GetTypedComponent(i, 3) / 255.0f;
    for (int c = 0; c < 3; ++c)
    {
      const float value = bytes->GetTypedComponent(i, c) / 255.0f;
      color->SetTypedComponent(i, c, alpha > 0.0f ? std::min(value / alpha, 1.0f) : 0.0f);
    }
    color->SetTypedComponent(i, 3, alpha);
  }
  image->GetPointData()->SetScalars(color);
  return image;
}

/// How strongly surfaces coloured by data are darkened, unless told.
constexpr double StrengthOnData = 0.6;

vtkPenumbraTemporalSSAOPass* AddOcclusion(vtkRenderer* renderer, const RenderOptions& options)
{
  vtkPenumbraTracedEstimator::Register();
  vtkPenumbraTemporalSSAOPass* pass = vtkPenumbraTemporalSSAOPass::AddTo(renderer);
  pass->SetKernelName(options.AmbientOcclusionKernel.c_str());
  pass->SetConvergeInOneRender(
    options.Frames > 0 ? vtkPenumbraTemporalSSAOPass::NEVER : vtkPenumbraTemporalSSAOPass::ALWAYS);
  pass->SetStrength(!std::isnan(options.AmbientOcclusionStrength)
      ? options.AmbientOcclusionStrength
      : (options.Coloring.Enabled ? StrengthOnData : 1.0));
  pass->SetLightAwareness(options.AmbientOcclusionLightAwareness);
  if (options.HasTolerance)
  {
    pass->SetTolerance(options.Tolerance);
  }
  if (options.AmbientOcclusionRadius > 0.0)
  {
    pass->SetRadiusUnit(vtkPenumbraTemporalSSAOPass::WORLD);
    pass->SetRadius(options.AmbientOcclusionRadius);
  }
  return pass;
}

void AddShafts(
  vtkRenderer* renderer, const RenderOptions& options, std::vector<std::string>& warnings)
{
  if (options.Lights.empty())
  {
    warnings.emplace_back("No light makes shafts (headlights make none): give --light-position; no "
                          "light shafts are drawn.");
    return;
  }
  const ShaftOptions& shafts = options.Shafts;
  vtkPenumbraLightShaftPass* pass = vtkPenumbraLightShaftPass::AddTo(renderer);
  pass->SetScattering(std::isnan(shafts.Scattering) ? -1.0 : shafts.Scattering);
  pass->SetExtinction(std::isnan(shafts.Extinction) ? -1.0 : shafts.Extinction);
  pass->SetPhase(shafts.Phase == "rayleigh" ? vtkPenumbraLightShaftPass::RAYLEIGH
      : shafts.Phase == "hg"                ? vtkPenumbraLightShaftPass::HENYEY_GREENSTEIN
                                            : vtkPenumbraLightShaftPass::ISOTROPIC);
  pass->SetAsymmetry(shafts.Asymmetry);
}

/// What the pass knows of its last frame.
void AddPassStatistics(vtkPenumbraTemporalSSAOPass* pass, bool arrays, RenderResult& picture)
{
  vtkFieldData* statistics = pass->GetStatistics();
  for (int i = 0; i < statistics->GetNumberOfArrays(); ++i)
  {
    if (vtkDataArray* array = statistics->GetArray(i))
    {
      picture.Statistics[array->GetName()] = array->GetComponent(0, 0);
    }
  }
  picture.Statistics["Occlusion/Kernel"] = pass->GetActiveKernelName();
  picture.Tolerance = pass->GetTolerance();
  if (pass->GetEstimatedError() <= 1.0)
  {
    picture.EstimatedError = pass->GetEstimatedError();
  }
  if (arrays)
  {
    vtkNew<vtkImageData> found;
    pass->CopyOcclusion(found);
    for (const char* name : { "AmbientOcclusion", "Depth" })
    {
      picture.Image->GetPointData()->AddArray(found->GetPointData()->GetArray(name));
    }
  }
}

// The window about a renderer, and its passes.
class RasterDrawing
{
public:
  RasterDrawing(vtkRenderer* renderer, const RenderOptions& options);
  ~RasterDrawing();
  RasterDrawing(const RasterDrawing&) = delete;
  void operator=(const RasterDrawing&) = delete;

  RenderResult Draw(const ProgressListener& progress);

private:
  vtkSmartPointer<vtkRenderer> Renderer;
  const RenderOptions Options;
  vtkNew<vtkRenderWindow> Window;
  vtkPenumbraTemporalSSAOPass* Occlusion = nullptr;
  std::vector<std::string> Warnings;
};

RasterDrawing::RasterDrawing(vtkRenderer* renderer, const RenderOptions& options)
  : Renderer(renderer),
    Options(options)
{
  this->Window->SetOffScreenRendering(1);
  this->Window->SetShowWindow(false);
  this->Window->SetMultiSamples(MultiSamples);
  this->Window->SetAlphaBitPlanes(1);
  this->Window->SetDPI(options.DotsPerInch);
  this->Window->SetSize(options.Resolution[0], options.Resolution[1]);
  this->Window->AddRenderer(renderer);
  if (options.Threads > 0)
  {
    vtkSMPTools::Initialize(options.Threads);
  }
  if (options.AmbientOcclusion)
  {
    this->Occlusion = AddOcclusion(renderer, options);
  }
  if (options.Shafts.Enabled)
  {
    AddShafts(renderer, options, this->Warnings);
  }
}

RasterDrawing::~RasterDrawing()
{
  if (this->Occlusion)
  {
    vtkPenumbraTemporalSSAOPass::RemoveFrom(this->Renderer);
  }
}

RenderResult RasterDrawing::Draw(const ProgressListener& progress)
{
  const auto start = std::chrono::steady_clock::now();
  const int width = this->Options.Resolution[0];
  const int height = this->Options.Resolution[1];
  TakeErrors();
  for (int frame = 0; frame < std::max(this->Options.Frames, 1); ++frame)
  {
    this->Window->Render();
  }
  vtkNew<vtkUnsignedCharArray> bytes;
  this->Window->GetRGBACharPixelData(0, 0, width - 1, height - 1, 0, bytes);
  const std::vector<std::string> errors = TakeErrors();
  const int* size = this->Window->GetActualSize();
  const bool complete = size[0] == width && size[1] == height &&
    bytes->GetNumberOfTuples() == static_cast<vtkIdType>(width) * height;
  if (!errors.empty() || !complete)
  {
    throw CommandError(Unavailable,
      "--engine raster: OpenGL cannot draw this picture: " +
        (errors.empty() ? "it is larger than a window can be; make --resolution smaller"
                        : errors.front()));
  }
  progress(1.0);

  RenderResult picture;
  picture.Warnings = this->Warnings;
  picture.Image = ToFloats(bytes, width, height, this->Options.Background);
  picture.Statistics = { { "Samples/PerPixel", this->Window->GetMultiSamples() } };
  picture.Tolerance = this->Options.Tolerance;
  picture.EstimatedError = Unset;
  if (this->Occlusion)
  {
    AddPassStatistics(this->Occlusion, HoldsArrays(this->Options.Output), picture);
  }
  picture.Threads =
    this->Options.Threads > 0 ? this->Options.Threads : vtkSMPTools::GetEstimatedNumberOfThreads();
  picture.RenderSeconds =
    std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return picture;
}

}

std::function<RenderResult(const ProgressListener& progress)> PrepareRaster(
  vtkRenderer* renderer, const RenderOptions& options)
{
  const auto drawing = std::make_shared<RasterDrawing>(renderer, options);
  return [drawing](const ProgressListener& progress) { return drawing->Draw(progress); };
}

}
