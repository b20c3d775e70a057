// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkPenumbraTemporalSSAOPass.h"

#include "Chain/PassSlots.h"
#include "Chain/StaticViewRefiner.h"
#include "Frame/RendererMap.h"
#include "Frame/ScopedCamera.h"
#include "Frame/ScreenSpaceConstants.h"
#include "Occlusion/OcclusionViewState.h"
#include "Statistics/Statistics.h"
#include "vtkPenumbraKernelEstimator.h"
#include "vtkPenumbraKernels.h"
#include "vtkPenumbraOcclusionConstants.h"
#include "vtkPenumbraOcclusionEstimator.h"

#include "vtkCamera.h"
#include "vtkFieldData.h"
#include "vtkImageData.h"
#include "vtkMath.h"
#include "vtkObjectFactory.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkProp.h"
#include "vtkRenderState.h"
#include "vtkRenderer.h"
#include "vtkStringArray.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <utility>
#include <vector>

vtkStandardNewMacro(vtkPenumbraTemporalSSAOPass);

namespace
{

using Pass = vtkPenumbraTemporalSSAOPass;

/// Most accurate kernel (vtkPenumbraKernels::GetBias()), used if only depth is available.
constexpr const char* AutomaticKernel = "march";

/// Registered name of vtkPenumbraTracedEstimator.
constexpr const char* RayTracing = "traced";

/// Visible props in render order, each with its redraw MTime.
using PropTimes = std::vector<std::pair<vtkProp*, vtkMTimeType>>;

PropTimes FindPropTimes(vtkRenderer* renderer)
{
  PropTimes times;
  for (vtkProp* prop : penumbra::VisibleProps(renderer))
  {
    times.emplace_back(prop, prop->GetRedrawMTime());
  }
  return times;
}

bool HaveSameProps(const PropTimes& a, const PropTimes& b)
{
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
    [](const auto& left, const auto& right) { return left.first == right.first; });
}

/// Chooses the margin in pixels. The last one is kept while it is large enough and not much too
/// large, so that zooming does not reallocate all textures in every frame.
int ChooseMargin(double needed, double largest, int last)
{
  needed = std::min(needed, largest);
  if (last > 0 && needed > last)
  {
    return static_cast<int>(std::ceil(std::min(penumbra::MarginReserve * needed, largest)));
  }
  return last > 0 && needed >= penumbra::MinimumUsedMargin * last && last <= std::ceil(largest)
    ? last
    : static_cast<int>(std::ceil(needed));
}

/// Index of an image of a renderer: 0 without stereo, 1 and 2 for the right and the left eye.
int EyeOf(vtkRenderer* renderer)
{
  return renderer->GetRenderWindow()->GetStereoRender()
    ? 1 + renderer->GetActiveCamera()->GetLeftEye()
    : 0;
}

/// Indices of the images that a frame of the window renders of each renderer.
std::vector<int> EyesOf(vtkRenderWindow* window)
{
  if (!window->GetStereoRender())
  {
    return { 0 };
  }
  const int type = window->GetStereoType();
  return type == VTK_STEREO_LEFT ? std::vector<int>{ 2 }
    : type == VTK_STEREO_RIGHT   ? std::vector<int>{ 1 }
                                 : std::vector<int>{ 1, 2 };
}

}

struct vtkPenumbraTemporalSSAOPass::Internals
{
  /// State of a renderer, in stereo of one eye.
  struct RendererState
  {
    penumbra::OcclusionViewState View;
    PropTimes Props;
    double Radius = 0.0;
    int RadiusUnit = FRACTION_OF_BOUNDS;
    std::string Estimator;       ///< kernel or estimator and its settings, as text
    vtkMTimeType HiddenTime = 0; ///< GetSceneMTime() of the estimator
    int Margin = 0;              ///< pixels
    vtkSmartPointer<vtkPenumbraOcclusionEstimator> Used; ///< in the last frame
  };
  penumbra::RendererMap<RendererState> Renderers; ///< one per eye in stereo
  penumbra::OcclusionViewState* Last = nullptr;
  vtkSmartPointer<vtkPenumbraOcclusionEstimator> Estimator;
  vtkSmartPointer<vtkPenumbraOcclusionEstimator> NamedEstimator; ///< registered by another module
  std::string EstimatorName;
  vtkNew<vtkPenumbraKernelEstimator> Kernels;
  penumbra::OcclusionConstants Constants;
  vtkNew<vtkFieldData> Statistics;
  std::string ActiveKernel;
  penumbra::StaticViewRefiner Refiner;

  explicit Internals(vtkPenumbraTemporalSSAOPass* pass)
    : Refiner([this, pass](vtkRenderer* renderer, double share) {
        return this->RefineBetweenFrames(
          renderer, this->Constants.StepsPerFrame > 0 ? 0.0 : share * pass->FrameTime);
      })
  {
  }

  /// Continues the image of a renderer, in stereo of both eyes. Returns true if a frame is needed.
  bool RefineBetweenFrames(vtkRenderer* renderer, double seconds);

  /// Returns whether all images of a renderer have converged, as far as there are any.
  bool IsConverged(vtkRenderer* renderer)
  {
    const std::vector<int> eyes = EyesOf(renderer->GetRenderWindow());
    return std::all_of(eyes.begin(), eyes.end(), [&](int eye) {
      const RendererState* const state = this->Renderers.Find(renderer, eye);
      return !state || state->View.IsConverged();
    });
  }

  /// Returns a text that differs between estimators, and between settings of an estimator.
  std::string DescribeEstimator() const;
};

bool vtkPenumbraTemporalSSAOPass::Internals::RefineBetweenFrames(
  vtkRenderer* renderer, double seconds)
{
  auto* const window = vtkOpenGLRenderWindow::SafeDownCast(renderer->GetRenderWindow());
  if (!window)
  {
    return true;
  }
  std::vector<RendererState*> eyes;
  for (const int eye : EyesOf(window))
  {
    RendererState* const state = this->Renderers.Find(renderer, eye);
    if (state && state->Used && !state->View.IsConverged())
    {
      eyes.push_back(state);
    }
  }
  if (eyes.empty())
  {
    return true;
  }
  if (eyes.front()->Used->CanRefine())
  {
    return eyes.front()->Used->RefineBetweenFrames(renderer, seconds);
  }
  if (seconds <= 0.0)
  {
    return true;
  }
  window->MakeCurrent();
  if (!window->IsCurrent())
  {
    return true;
  }
  bool isNeeded = false;
  for (RendererState* eye : eyes)
  {
    isNeeded =
      eye->View.RefineBetweenFrames(seconds / static_cast<double>(eyes.size())) || isNeeded;
  }
  return isNeeded;
}

std::string vtkPenumbraTemporalSSAOPass::Internals::DescribeEstimator() const
{
  std::ostringstream text;
  text << this->ActiveKernel << ' ' << this->Estimator.Get() << ' '
       << (this->Estimator ? this->Estimator->GetMTime() : 0);
  return text.str();
}

vtkPenumbraTemporalSSAOPass::vtkPenumbraTemporalSSAOPass()
  : Implementation(std::make_unique<Internals>(this))
{
}

vtkPenumbraTemporalSSAOPass::~vtkPenumbraTemporalSSAOPass() = default;

Pass* vtkPenumbraTemporalSSAOPass::FindIn(vtkRenderer* renderer)
{
  return penumbra::FindPassOf<Pass>(penumbra::FindPassSlots(renderer));
}

Pass* vtkPenumbraTemporalSSAOPass::AddTo(vtkRenderer* renderer)
{
  return penumbra::AddPass<Pass>(
    renderer, [](const std::vector<penumbra::PassSlot>& slots) { return slots.back(); });
}

void vtkPenumbraTemporalSSAOPass::RemoveFrom(vtkRenderer* renderer)
{
  if (Pass* pass = FindIn(renderer))
  {
    penumbra::RemovePass(renderer, pass);
  }
}

void vtkPenumbraTemporalSSAOPass::SetRadius(double radius)
{
  if (!std::isfinite(radius) || radius < 0.0)
  {
    vtkErrorMacro("Radius must be finite and not negative, but is " << radius << "; it remains "
                                                                    << this->Radius << ".");
  }
  else if (radius != this->Radius)
  {
    this->Radius = radius;
    this->Modified();
  }
}

void vtkPenumbraTemporalSSAOPass::SetKernelName(const char* name)
{
  const std::string kernelName = name ? name : "";
  if (kernelName != "automatic" && vtkPenumbraKernels::Find(name) < 0 &&
    !vtkPenumbraOcclusionEstimator::IsRegistered(name))
  {
    vtkErrorMacro("Kernel '" << kernelName
                             << "' does not exist (see vtkPenumbraKernels); KernelName remains "
                             << this->KernelName << ".");
  }
  else if (kernelName != this->KernelName)
  {
    this->KernelName = kernelName;
    this->Modified();
  }
}

void vtkPenumbraTemporalSSAOPass::SetEstimator(vtkPenumbraOcclusionEstimator* estimator)
{
  if (this->Implementation->Estimator != estimator)
  {
    this->Implementation->Estimator = estimator;
    this->Modified();
  }
}

vtkPenumbraOcclusionEstimator* vtkPenumbraTemporalSSAOPass::GetEstimator()
{
  return this->Implementation->Estimator;
}

const char* vtkPenumbraTemporalSSAOPass::GetActiveKernelName()
{
  return this->Implementation->ActiveKernel.c_str();
}

bool vtkPenumbraTemporalSSAOPass::RenderEffect(const vtkRenderState* state)
{
  Internals& internals = *this->Implementation;
  vtkRenderer* renderer = state->GetRenderer();
  vtkOpenGLRenderWindow* window = this->EnterWindow(renderer, true);
  double bounds[6];
  renderer->ComputeVisiblePropBounds(bounds);
  const double diagonal = vtkMath::AreBoundsInitialized(bounds)
    ? std::hypot(bounds[1] - bounds[0], bounds[3] - bounds[2], bounds[5] - bounds[4])
    : 0.0;
  const double pixel = penumbra::PixelAtFocus(renderer);
  const double units[3] = { diagonal, 1.0, pixel };
  penumbra::OcclusionSettings settings;
  settings.Radius = this->Radius * units[this->RadiusUnit];
  if (!window || !(settings.Radius > 0.0) || !std::isfinite(settings.Radius))
  {
    internals.Refiner.Stop();
    return false;
  }
  settings.Darkness = { this->Strength, this->LightAwareness };
  settings.Tolerance = this->Tolerance;
  settings.SecondsInMotion = penumbra::MotionTimeFraction * this->FrameTime;
  settings.Seconds = penumbra::IsInteractive(window) ? settings.SecondsInMotion : this->FrameTime;
  const penumbra::OcclusionConstants& constants = internals.Constants;
  settings.Constants = constants;
  settings.InOneRender = this->ConvergeInOneRender == ALWAYS ||
    (this->ConvergeInOneRender == OFFSCREEN && !penumbra::IsInteractive(window) &&
      (window->GetOffScreenRendering() || !window->GetShowWindow()));
  settings.DelegateDrawsBackground = !this->OpaqueOnly;
  settings.UseActorMotion = constants.UseActorMotion && this->OpaqueOnly;
  // After compositing of several ranks it is unknown which props moved.
  const PropTimes props = FindPropTimes(renderer);
  Internals::RendererState& rendererState = internals.Renderers.Get(renderer, EyeOf(renderer));
  settings.SceneChanged = !this->OpaqueOnly || props != rendererState.Props;
  settings.PropsChanged = !HaveSameProps(props, rendererState.Props);
  vtkPenumbraOcclusionEstimator* estimator =
    this->ChooseEstimator(renderer, settings.InOneRender || !settings.SceneChanged);
  settings.Restart =
    this->Radius != rendererState.Radius || this->RadiusUnit != rendererState.RadiusUnit;
  rendererState.Radius = this->Radius;
  rendererState.RadiusUnit = this->RadiusUnit;
  std::string description = internals.DescribeEstimator();
  settings.EstimatorChanged = description != rendererState.Estimator;
  settings.HiddenChanged =
    !settings.EstimatorChanged && estimator->GetSceneMTime(renderer) != rendererState.HiddenTime;
  rendererState.Estimator = std::move(description);
  if (this->OpaqueOnly)
  {
    settings.Bounds = bounds;
    const double side = std::max(renderer->GetSize()[0], renderer->GetSize()[1]);
    const double needed = estimator->NeedsMargin() ? settings.Radius / pixel : 0.0;
    rendererState.Margin = constants.Margin >= 0.0
      ? static_cast<int>(std::ceil(constants.Margin / 100.0 * side))
      : ChooseMargin(
          needed, penumbra::MaximumMargin * side, settings.InOneRender ? 0 : rendererState.Margin);
    rendererState.Margin = this->LimitMargin(window, renderer->GetSize(), rendererState.Margin);
    settings.Margin[0] = settings.Margin[1] = rendererState.Margin;
  }
  rendererState.Used = estimator;
  internals.Last = &rendererState.View;
  if (!internals.Last->Render(state, this->DelegatePass, estimator, settings))
  {
    internals.Refiner.Stop();
    this->WarnOnce(
      "OpenGL cannot render ambient occlusion in this window; the scene is rendered without it.");
    return false;
  }
  // Queried after rendering, because rendering or tracing may update the pipelines of the scene, and
  // rendering moved actors a second time modifies their properties.
  rendererState.HiddenTime = estimator->GetSceneMTime(renderer);
  rendererState.Props = FindPropTimes(renderer);
  this->NumberOfRenderedProps = internals.Last->GetNumberOfRenderedProps();
  const bool unfinished =
    this->RefineStaticView && !settings.InOneRender && !internals.IsConverged(renderer);
  // Another estimator may need another margin, which is no change of the scene.
  const bool changed = internals.Last->HasChanged() && !settings.EstimatorChanged;
  internals.Refiner.RecordFrame(renderer, unfinished, changed);
  return true;
}

vtkPenumbraOcclusionEstimator* vtkPenumbraTemporalSSAOPass::ChooseEstimator(
  vtkRenderer* renderer, bool isStatic)
{
  Internals& internals = *this->Implementation;
  if (internals.Estimator)
  {
    internals.ActiveKernel = internals.Estimator->GetClassName();
    return internals.Estimator;
  }
  const bool automatic = this->KernelName == "automatic";
  const std::string name = automatic ? RayTracing : this->KernelName;
  if (internals.EstimatorName != name)
  {
    internals.NamedEstimator.TakeReference(vtkPenumbraOcclusionEstimator::New(name.c_str()));
    internals.EstimatorName = name;
  }
  const int kernel =
    vtkPenumbraKernels::Find(automatic ? AutomaticKernel : this->KernelName.c_str());
  if (kernel >= 0)
  {
    internals.Kernels->SetKernel(kernel);
  }
  // Without OpaqueOnly, the image may contain geometry of other passes or ranks, of which only the
  // depth is available. The kernel is used if its bias is within the tolerance, because it is
  // cheaper.
  const bool worthwhile =
    isStatic && this->OpaqueOnly && this->Tolerance < internals.Kernels->GetBias();
  if (internals.NamedEstimator &&
    (!automatic || (worthwhile && internals.NamedEstimator->CanEstimate(renderer))))
  {
    internals.ActiveKernel = name;
    return internals.NamedEstimator;
  }
  internals.ActiveKernel = automatic ? AutomaticKernel : this->KernelName;
  return internals.Kernels;
}

void vtkPenumbraTemporalSSAOPass::ReleaseGraphicsResources(vtkWindow* window)
{
  this->Superclass::ReleaseGraphicsResources(window);
  this->Implementation->Refiner.Stop();
  Internals& internals = *this->Implementation;
  internals.Renderers.VisitAll(
    [&](Internals::RendererState& state) { state.View.ReleaseGraphicsResources(window); });
  internals.Renderers.Clear();
  internals.Last = nullptr;
  internals.Kernels->ReleaseGraphicsResources(window);
  for (vtkPenumbraOcclusionEstimator* estimator :
    { internals.Estimator.Get(), internals.NamedEstimator.Get() })
  {
    if (estimator)
    {
      estimator->ReleaseGraphicsResources(window);
    }
  }
}

penumbra::OcclusionConstants& vtkPenumbraTemporalSSAOPass::GetConstants()
{
  return this->Implementation->Constants;
}

bool vtkPenumbraTemporalSSAOPass::IsConverged()
{
  return this->Implementation->Last && this->Implementation->Last->IsConverged();
}

double vtkPenumbraTemporalSSAOPass::GetEstimatedError()
{
  const penumbra::OcclusionViewState* view = this->Implementation->Last;
  return view ? view->GetConvergence().GetLargestError() : VTK_DOUBLE_MAX;
}

vtkFieldData* vtkPenumbraTemporalSSAOPass::GetStatistics()
{
  Internals& internals = *this->Implementation;
  internals.Statistics->Initialize();
  if (internals.Last)
  {
    this->GetWindow()->MakeCurrent();
    const auto counts = internals.Last->CountPixels();
    const double surface = static_cast<double>(std::max(counts.Surface, 1LL));
    vtkNew<vtkStringArray> kernel;
    kernel->SetName("Occlusion/Kernel");
    kernel->InsertNextValue(internals.ActiveKernel);
    internals.Statistics->AddArray(kernel);
    penumbra::AddStatistic(
      internals.Statistics, "Samples/PerPixel", internals.Last->GetNewSamples());
    penumbra::AddStatistic(
      internals.Statistics, "Samples/Static", internals.Last->GetConvergence().GetSamples());
    penumbra::AddStatistic(
      internals.Statistics, "Pixels/Reprojected", static_cast<double>(counts.Kept) / surface);
    penumbra::AddStatistic(internals.Statistics, "Pixels/ActorMotion",
      static_cast<double>(counts.ActorMotion) / surface);
    penumbra::AddStatistic(internals.Statistics, "Pixels/Disoccluded",
      static_cast<double>(counts.Disoccluded) / surface);
    penumbra::AddStatistic(internals.Statistics, "Pixels/Invalidated",
      static_cast<double>(counts.Invalidated) / surface);
    penumbra::AddStatistic(
      internals.Statistics, "Pixels/Converged", static_cast<double>(counts.Converged) / surface);
  }
  return internals.Statistics;
}

void vtkPenumbraTemporalSSAOPass::CopyOcclusion(vtkImageData* image)
{
  if (!image)
  {
    vtkErrorMacro("The image is null; pass a vtkImageData to CopyOcclusion().");
    return;
  }
  image->Initialize();
  if (this->Implementation->Last)
  {
    this->GetWindow()->MakeCurrent();
    this->Implementation->Last->CopyTo(image);
  }
}

void vtkPenumbraTemporalSSAOPass::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Tolerance: " << this->Tolerance << "\n";
  os << indent << "RadiusUnit: " << this->RadiusUnit << "\n";
  os << indent << "Radius: " << this->Radius << "\n";
  os << indent << "Strength: " << this->Strength << "\n";
  os << indent << "LightAwareness: " << this->LightAwareness << "\n";
  os << indent << "KernelName: " << this->KernelName << "\n";
  os << indent << "Estimator: " << this->GetEstimator() << "\n";
  os << indent << "ConvergeInOneRender: " << this->ConvergeInOneRender << "\n";
  os << indent << "FrameTime: " << this->FrameTime << "\n";
  os << indent << "RefineStaticView: " << this->RefineStaticView << "\n";
}
