// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkPenumbraTemporalSSAOPass.h"

#include "Chain/PassSlots.h"
#include "Frame/PassStatistics.h"
#include "Frame/ScopedCamera.h"
#include "Occlusion/OcclusionViewState.h"
#include "vtkPenumbraKernelEstimator.h"
#include "vtkPenumbraKernels.h"
#include "vtkPenumbraOcclusionEstimator.h"

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
#include <map>
#include <sstream>
#include <utility>
#include <vector>

vtkStandardNewMacro(vtkPenumbraTemporalSSAOPass);

namespace
{

using Pass = vtkPenumbraTemporalSSAOPass;

/// The best of the kernels wherever depth is all there is.
constexpr const char* AutomaticKernel = "march";

/// What sees all of the scene.
constexpr const char* TrueRays = "traced";

/// The margin that follows the radius goes no farther than this share of the picture's larger side.
constexpr double LargestMargin = 0.1;

/// An automatic margin that becomes too small grows to this multiple of what is needed.
constexpr double MarginReserve = 1.5;

/// An automatic margin shrinks when less than this fraction of it is needed.
constexpr double LeastUsedMargin = 0.5;

/// Visible props in drawing order, each with the time of its last change.
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

/// Margin in pixels. The last one is kept while it is large enough and not far too large, so that a
/// zoom does not change the size of all textures with every frame.
int ChooseMargin(double needed, double largest, int last)
{
  needed = std::min(needed, largest);
  if (last > 0 && needed > last)
  {
    return static_cast<int>(std::ceil(std::min(MarginReserve * needed, largest)));
  }
  return last > 0 && needed >= LeastUsedMargin * last && last <= std::ceil(largest)
    ? last
    : static_cast<int>(std::ceil(needed));
}

}

struct vtkPenumbraTemporalSSAOPass::Internals
{
  /// What is kept of a renderer.
  struct Known
  {
    penumbra::OcclusionViewState View;
    PropTimes Props;
    std::string Occlusion;       ///< the settings that decide on its value, as text
    vtkMTimeType HiddenTime = 0; ///< the estimator's
    int Margin = 0;              ///< pixels
  };
  std::map<vtkRenderer*, Known> Renderers;
  penumbra::OcclusionViewState* Last = nullptr;
  vtkSmartPointer<vtkPenumbraOcclusionEstimator> Estimator;
  vtkSmartPointer<vtkPenumbraOcclusionEstimator> Named; ///< registered by another module
  std::string NameOfNamed;
  vtkNew<vtkPenumbraKernelEstimator> Kernels;
  vtkNew<vtkFieldData> Statistics;
  std::string ActiveKernel;

  /// Differs between settings whose occlusion differs.
  std::string DescribeOcclusion(const Pass* pass) const;
};

std::string vtkPenumbraTemporalSSAOPass::Internals::DescribeOcclusion(const Pass* pass) const
{
  std::ostringstream text;
  text << std::hexfloat << pass->Radius << ' ' << pass->RadiusUnit << ' ' << pass->KernelName << ' '
       << this->ActiveKernel << ' ' << this->Estimator.Get() << ' '
       << (this->Estimator ? this->Estimator->GetMTime() : 0);
  return text.str();
}

vtkPenumbraTemporalSSAOPass::vtkPenumbraTemporalSSAOPass()
  : Implementation(std::make_unique<Internals>())
{
}

vtkPenumbraTemporalSSAOPass::~vtkPenumbraTemporalSSAOPass() = default;

Pass* vtkPenumbraTemporalSSAOPass::AddTo(vtkRenderer* renderer)
{
  if (!renderer)
  {
    vtkGenericWarningMacro("There is no renderer to add the pass to.");
    return nullptr;
  }
  if (Pass* present = penumbra::FindPassOf<Pass>(penumbra::FindPassSlots(renderer)))
  {
    return present;
  }
  const penumbra::PassSlot place = penumbra::EnsurePassSlots(renderer).back();
  vtkNew<Pass> pass;
  pass->SetDelegatePass(place.Pass);
  pass->SetOpaqueOnly(place.OpaqueOnly);
  place.Set(pass);
  return pass;
}

void vtkPenumbraTemporalSSAOPass::RemoveFrom(vtkRenderer* renderer)
{
  if (Pass* pass = penumbra::FindPassOf<Pass>(penumbra::FindPassSlots(renderer)))
  {
    penumbra::RemovePass(renderer, pass);
  }
}

void vtkPenumbraTemporalSSAOPass::SetRadius(double radius)
{
  if (!std::isfinite(radius) || radius < 0.0)
  {
    vtkErrorMacro("Radius " << radius << " is not a length; " << this->Radius << " stays.");
  }
  else if (radius != this->Radius)
  {
    this->Radius = radius;
    this->Modified();
  }
}

void vtkPenumbraTemporalSSAOPass::SetKernelName(const char* name)
{
  const std::string wanted = name ? name : "";
  if (wanted != "automatic" && vtkPenumbraKernels::Find(name) < 0 &&
    !vtkPenumbraOcclusionEstimator::IsRegistered(name))
  {
    vtkErrorMacro("There is no kernel '" << wanted << "'; " << this->KernelName << " stays.");
  }
  else if (wanted != this->KernelName)
  {
    this->KernelName = wanted;
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
  Internals& own = *this->Implementation;
  vtkRenderer* renderer = state->GetRenderer();
  vtkOpenGLRenderWindow* window = this->EnterWindow(renderer);
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
    return false;
  }
  settings.Darkness = { this->Strength, this->LightAwareness };
  settings.Tolerance = this->Tolerance;
  settings.FirstSamples = this->FirstSamples;
  settings.Samples = this->Samples;
  settings.AdaptiveConvergence = this->AdaptiveConvergence;
  settings.SpatialConvergence = this->SpatialConvergence;
  settings.RotationConvergence = this->RotationConvergence;
  settings.MaximumWeight = this->MaximumWeight;
  settings.InvalidationWeight = this->InvalidationWeight;
  settings.DepthTolerance = this->DepthTolerance;
  settings.Filter = this->Filter;
  settings.InOneRender = this->ConvergeInOneRender == ALWAYS ||
    (this->ConvergeInOneRender == OFFSCREEN &&
      (window->GetOffScreenRendering() || !window->GetShowWindow()));
  settings.DelegateDrawsBackground = !this->OpaqueOnly;
  settings.DelegateOnce = this->DelegateOnce;
  settings.UseActorMotion = this->UseActorMotion && this->OpaqueOnly;
  // After compositing of several ranks the props that moved are not known.
  PropTimes props = FindPropTimes(renderer);
  Internals::Known& known = own.Renderers[renderer];
  settings.SceneChanged = !this->OpaqueOnly || props != known.Props;
  settings.PropsChanged = !HaveSameProps(props, known.Props);
  known.Props = std::move(props);
  vtkPenumbraOcclusionEstimator* estimator =
    this->ChooseEstimator(renderer, settings.InOneRender || !settings.SceneChanged);
  settings.Interpolate = this->KernelName == "automatic" && !own.Estimator;
  std::string occlusion = own.DescribeOcclusion(this);
  settings.Restart = occlusion != known.Occlusion;
  settings.HiddenChanged = estimator->GetSceneMTime(renderer) != known.HiddenTime;
  known.Occlusion = std::move(occlusion);
  if (this->OpaqueOnly)
  {
    settings.Bounds = bounds;
    const double side = std::max(renderer->GetSize()[0], renderer->GetSize()[1]);
    const double needed = estimator->NeedsMargin() ? settings.Radius / pixel : 0.0;
    known.Margin = this->Margin >= 0.0
      ? static_cast<int>(std::ceil(this->Margin / 100.0 * side))
      : ChooseMargin(needed, LargestMargin * side, settings.InOneRender ? 0 : known.Margin);
    settings.Margin[0] = settings.Margin[1] = known.Margin;
  }
  own.Last = &known.View;
  if (!own.Last->Render(state, this->DelegatePass, estimator, settings))
  {
    this->WarnOnce("OpenGL cannot do ambient occlusion here; the scene is drawn without.");
    return false;
  }
  // Only now: whoever draws or traces the scene may bring its pipelines up to date first.
  known.HiddenTime = estimator->GetSceneMTime(renderer);
  this->NumberOfRenderedProps = own.Last->GetNumberOfRenderedProps();
  return true;
}

vtkPenumbraOcclusionEstimator* vtkPenumbraTemporalSSAOPass::ChooseEstimator(
  vtkRenderer* renderer, bool still)
{
  Internals& own = *this->Implementation;
  if (own.Estimator)
  {
    own.ActiveKernel = own.Estimator->GetClassName();
    return own.Estimator;
  }
  const bool automatic = this->KernelName == "automatic";
  const std::string name = automatic ? TrueRays : this->KernelName;
  if (own.NameOfNamed != name)
  {
    own.Named.TakeReference(vtkPenumbraOcclusionEstimator::New(name.c_str()));
    own.NameOfNamed = name;
  }
  const int kernel =
    vtkPenumbraKernels::Find(automatic ? AutomaticKernel : this->KernelName.c_str());
  if (kernel >= 0)
  {
    own.Kernels->SetKernel(kernel);
  }
  // What another pass or another rank has drawn may not be here: only depth is known of it. And what is
  // cheaper and good enough is taken.
  const bool worthwhile = still && this->OpaqueOnly && this->Tolerance < own.Kernels->GetBias();
  if (own.Named && (!automatic || (worthwhile && own.Named->CanEstimate(renderer))))
  {
    own.ActiveKernel = name;
    return own.Named;
  }
  own.ActiveKernel = automatic ? AutomaticKernel : this->KernelName;
  return own.Kernels;
}

void vtkPenumbraTemporalSSAOPass::ReleaseGraphicsResources(vtkWindow* window)
{
  this->Superclass::ReleaseGraphicsResources(window);
  Internals& own = *this->Implementation;
  for (auto& [renderer, known] : own.Renderers)
  {
    known.View.ReleaseGraphicsResources(window);
  }
  own.Renderers.clear();
  own.Last = nullptr;
  own.Kernels->ReleaseGraphicsResources(window);
  for (vtkPenumbraOcclusionEstimator* estimator : { own.Estimator.Get(), own.Named.Get() })
  {
    if (estimator)
    {
      estimator->ReleaseGraphicsResources(window);
    }
  }
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
  Internals& own = *this->Implementation;
  own.Statistics->Initialize();
  if (own.Last)
  {
    this->GetWindow()->MakeCurrent();
    const auto counts = own.Last->CountPixels();
    const double surface = static_cast<double>(std::max(counts.Surface, 1LL));
    vtkNew<vtkStringArray> kernel;
    kernel->SetName("Occlusion/Kernel");
    kernel->InsertNextValue(own.ActiveKernel);
    own.Statistics->AddArray(kernel);
    penumbra::AddStatistic(own.Statistics, "Samples/PerPixel", own.Last->GetNewSamples());
    penumbra::AddStatistic(
      own.Statistics, "Samples/Static", own.Last->GetConvergence().GetSamples());
    penumbra::AddStatistic(
      own.Statistics, "Pixels/Reprojected", static_cast<double>(counts.Kept) / surface);
    penumbra::AddStatistic(
      own.Statistics, "Pixels/ActorMotion", static_cast<double>(counts.Followed) / surface);
    penumbra::AddStatistic(
      own.Statistics, "Pixels/Disoccluded", static_cast<double>(counts.Disoccluded) / surface);
    penumbra::AddStatistic(
      own.Statistics, "Pixels/Invalidated", static_cast<double>(counts.Invalidated) / surface);
    penumbra::AddStatistic(
      own.Statistics, "Pixels/Converged", static_cast<double>(counts.Converged) / surface);
  }
  return own.Statistics;
}

void vtkPenumbraTemporalSSAOPass::CopyOcclusion(vtkImageData* image)
{
  if (!image)
  {
    vtkErrorMacro("There is no image to copy to.");
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
  os << indent << "FirstSamples: " << this->FirstSamples << "\n";
  os << indent << "Samples: " << this->Samples << "\n";
  os << indent << "MaximumWeight: " << this->MaximumWeight << "\n";
  os << indent << "AdaptiveConvergence: " << this->AdaptiveConvergence << "\n";
  os << indent << "SpatialConvergence: " << this->SpatialConvergence << "\n";
  os << indent << "RotationConvergence: " << this->RotationConvergence << "\n";
  os << indent << "InvalidationWeight: " << this->InvalidationWeight << "\n";
  os << indent << "DepthTolerance: " << this->DepthTolerance << "\n";
  os << indent << "Filter: " << this->Filter << "\n";
  os << indent << "Margin: " << this->Margin << "\n";
  os << indent << "DelegateOnce: " << this->DelegateOnce << "\n";
  os << indent << "UseActorMotion: " << this->UseActorMotion << "\n";
  os << indent << "ConvergeInOneRender: " << this->ConvergeInOneRender << "\n";
}
