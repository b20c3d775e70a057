// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "CollectionItems.h"
#include "Engine.h"

#include "Files/ImageFiles.h"
#include "MediumSetup.h"
#include "Options/RenderOptions.h"
#include "Processes/Clock.h"
#include "Processes/CommandConstants.h"
#include "Processes/CommandError.h"
#include "Processes/MessageLog.h"
#include "Processes/OptionNames.h"

#include "vtkDataArray.h"
#include "vtkFieldData.h"
#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkLight.h"
#include "vtkLightCollection.h"
#include "vtkNew.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkPenumbraLightShaftPass.h"
#include "vtkPenumbraOcclusionConstants.h"
#include "vtkPenumbraTemporalSSAOPass.h"
#include "vtkPenumbraTracedEstimator.h"
#include "vtkPointData.h"
#include "vtkRenderWindow.h"
#include "vtkRenderer.h"
#include "vtkSMPTools.h"
#include "vtkTextureObject.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <utility>

namespace penumbra
{

namespace
{

// Converts bytes with premultiplied alpha, the result of blending, to floats with straight alpha.
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

/// The passes add light effects only. The rest of an image has no error that can be chosen.
double GetPassTolerance(const RenderOptions& options)
{
  return options.LightTolerance > 0.0 ? options.LightTolerance : options.Tolerance;
}

/// Returns the number of steps of samples in a frame: of rays, those that trace each tile once.
int CountStepsOfFrame(const RenderOptions& options)
{
  constexpr int TileSize = 16;
  const std::string& kernel = options.AmbientOcclusionKernel;
  const auto count = [](int pixels) { return (pixels + TileSize - 1) / TileSize; };
  return kernel == "traced" || kernel == "automatic"
    ? count(options.Resolution[0]) * count(options.Resolution[1])
    : 1;
}

vtkPenumbraTemporalSSAOPass* AddOcclusion(vtkRenderer* renderer, const RenderOptions& options)
{
  vtkPenumbraTracedEstimator::Register();
  vtkPenumbraTemporalSSAOPass* pass = vtkPenumbraTemporalSSAOPass::AddTo(renderer);
  pass->SetKernelName(options.AmbientOcclusionKernel.c_str());
  pass->SetConvergeInOneRender(
    options.Frames > 0 ? vtkPenumbraTemporalSSAOPass::NEVER : vtkPenumbraTemporalSSAOPass::ALWAYS);
  // A number of frames that is given makes an image that does not depend on the speed of the machine.
  pass->GetConstants().StepsPerFrame = options.Frames > 0 ? CountStepsOfFrame(options) : 0;
  pass->SetStrength(!std::isnan(options.AmbientOcclusionStrength)
      ? options.AmbientOcclusionStrength
      : (options.Coloring.Enabled ? StrengthOnData : 1.0));
  pass->SetLightAwareness(options.AmbientOcclusionLightAwareness);
  if (options.HasTolerance || options.LightTolerance > 0.0)
  {
    pass->SetTolerance(GetPassTolerance(options));
  }
  if (options.AmbientOcclusionRadius > 0.0)
  {
    pass->SetRadiusUnit(vtkPenumbraTemporalSSAOPass::WORLD);
    pass->SetRadius(options.AmbientOcclusionRadius);
  }
  return pass;
}

bool HasSceneLight(vtkRenderer* renderer)
{
  for (vtkLight* light : GetItems<vtkLight>(renderer->GetLights()))
  {
    if (!light->LightTypeIsHeadlight())
    {
      return true;
    }
  }
  return false;
}

void AddShafts(
  vtkRenderer* renderer, const RenderOptions& options, std::vector<std::string>& warnings)
{
  if (!HasSceneLight(renderer))
  {
    warnings.emplace_back("--light-shafts: no light casts shafts (headlights do not), so none are "
                          "rendered; give --light-position");
    return;
  }
  const ShaftOptions& shafts = options.Shafts;
  vtkPenumbraLightShaftPass* pass = vtkPenumbraLightShaftPass::AddTo(renderer);
  SetUpMedium(shafts, renderer, pass->GetMedium());
  pass->SetTolerance(GetPassTolerance(options));
  pass->SetEstimator(shafts.Estimator == "shadow-map" ? vtkPenumbraLightShaftPass::SHADOW_MAP
                                                      : vtkPenumbraLightShaftPass::DEPTH);
}

/// Adds the statistics of the last frame of `pass` to `result`, and its arrays if `arrays` is on.
void AddPassStatistics(vtkPenumbraTemporalSSAOPass* pass, bool arrays, RenderResult& result)
{
  vtkFieldData* statistics = pass->GetStatistics();
  for (int i = 0; i < statistics->GetNumberOfArrays(); ++i)
  {
    if (vtkDataArray* array = statistics->GetArray(i))
    {
      result.Statistics[array->GetName()] = array->GetComponent(0, 0);
    }
  }
  result.Statistics["Occlusion/Kernel"] = pass->GetActiveKernelName();
  result.Tolerance = pass->GetTolerance();
  result.LightTolerance = pass->GetTolerance();
  if (pass->GetEstimatedError() <= 1.0)
  {
    result.EstimatedError = pass->GetEstimatedError();
    result.EstimatedLightError = pass->GetEstimatedError();
  }
  if (arrays)
  {
    vtkNew<vtkImageData> occlusion;
    pass->CopyOcclusion(occlusion);
    for (const char* name : { "AmbientOcclusion", "Depth" })
    {
      result.Image->GetPointData()->AddArray(occlusion->GetPointData()->GetArray(name));
    }
  }
}

/// Throws CommandError if the image exceeds the textures of OpenGL. VTK would print the state of a framebuffer to
/// standard output, and render nothing.
void RequireTextures(const std::array<int, 2>& resolution)
{
  constexpr int UsualSize = 8192; // of all implementations
  const int side = std::max(resolution[0], resolution[1]);
  if (side <= UsualSize)
  {
    return;
  }
  vtkNew<vtkRenderWindow> window;
  window->SetOffScreenRendering(1);
  window->SetShowWindow(false);
  window->SetSize(8, 8);
  window->AddRenderer(vtkNew<vtkRenderer>());
  window->Render();
  auto* context = vtkOpenGLRenderWindow::SafeDownCast(window);
  const int largest = context ? vtkTextureObject::GetMaximumTextureSize(context) : -1;
  if (largest > 0 && side > largest)
  {
    throw CommandError(Unavailable,
      "--resolution: OpenGL renders at most " + std::to_string(largest) +
        " pixels per side; choose a smaller one, or use --engine ray");
  }
}

// A window that contains a renderer, and its passes.
class RasterRenderer
{
public:
  RasterRenderer(vtkRenderer* renderer, const RenderOptions& options);
  ~RasterRenderer();
  RasterRenderer(const RasterRenderer&) = delete;
  void operator=(const RasterRenderer&) = delete;

  RenderResult Render(const ProgressListener& progress);

private:
  vtkSmartPointer<vtkRenderer> Renderer;
  const RenderOptions Options;
  vtkNew<vtkRenderWindow> Window;
  vtkPenumbraTemporalSSAOPass* Occlusion = nullptr;
  std::vector<std::string> Warnings;
};

RasterRenderer::RasterRenderer(vtkRenderer* renderer, const RenderOptions& options)
  : Renderer(renderer),
    Options(options)
{
  RequireTextures(options.Resolution);
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

RasterRenderer::~RasterRenderer()
{
  if (this->Occlusion)
  {
    vtkPenumbraTemporalSSAOPass::RemoveFrom(this->Renderer);
  }
}

RenderResult RasterRenderer::Render(const ProgressListener& progress)
{
  const Clock::time_point start = Clock::now();
  const int width = this->Options.Resolution[0];
  const int height = this->Options.Resolution[1];
  TakeErrors();
  TakeWarnings();
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
      "--engine raster: OpenGL cannot render this image: " +
        (errors.empty() ? "it exceeds the largest window; choose a smaller --resolution"
                        : errors.front()));
  }
  progress(1.0);

  RenderResult result;
  result.Warnings = this->Warnings;
  for (std::string& warning : TakeWarnings())
  {
    result.Warnings.push_back(NameOptions(std::move(warning)));
  }
  result.Image = ToFloats(bytes, width, height, this->Options.Background);
  result.Statistics = { { "Samples/PerPixel", this->Window->GetMultiSamples() } };
  result.Tolerance = this->Options.Tolerance;
  result.LightTolerance = GetPassTolerance(this->Options);
  result.EstimatedError = Unset;
  result.EstimatedLightError = Unset;
  if (this->Occlusion)
  {
    AddPassStatistics(this->Occlusion, HoldsArrays(this->Options.Output), result);
  }
  result.Threads =
    this->Options.Threads > 0 ? this->Options.Threads : vtkSMPTools::GetEstimatedNumberOfThreads();
  result.RenderSeconds = SecondsSince(start);
  return result;
}

}

std::function<RenderResult(const ProgressListener& progress)> PrepareRaster(
  vtkRenderer* renderer, const RenderOptions& options)
{
  const auto engine = std::make_shared<RasterRenderer>(renderer, options);
  return [engine](const ProgressListener& progress) { return engine->Render(progress); };
}

}
