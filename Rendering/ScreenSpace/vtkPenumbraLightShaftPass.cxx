// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkPenumbraLightShaftPass.h"

#include "Chain/PassSlots.h"
#include "Frame/RendererMap.h"
#include "Frame/ScreenSpaceConstants.h"
#include "Medium/MediumCoefficients.h"
#include "Shafts/ShaftViewState.h"
#include "Statistics/Statistics.h"
#include "vtkPenumbraMedium.h"
#include "vtkPenumbraShaftConstants.h"
#include "vtkPenumbraTemporalSSAOPass.h"

#include "vtkBoundingBox.h"
#include "vtkCamera.h"
#include "vtkFieldData.h"
#include "vtkImageData.h"
#include "vtkLight.h"
#include "vtkMath.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkProp.h"
#include "vtkRenderState.h"
#include "vtkRenderer.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <string>
#include <vector>

vtkStandardNewMacro(vtkPenumbraLightShaftPass);

namespace
{

using Pass = vtkPenumbraLightShaftPass;

/// Computes the pixels per side of the blocks that share a lit fraction.
int ComputeBlockSize(double tolerance)
{
  const double halvings = std::ceil(std::log2(penumbra::LargestBlockTolerance / tolerance));
  return penumbra::LargestBlock -
    static_cast<int>(std::clamp(halvings, 0.0, penumbra::LargestBlock - 1.0));
}

/// Computes the number of depth fetches per ray. `blocks`: number along the larger image side.
int ComputeSteps(double tolerance, int blocks)
{
  const int steps = static_cast<int>(std::ceil(penumbra::StepsTimesTolerance / tolerance));
  return std::max(
    std::min({ steps, blocks / penumbra::BlocksPerStep, penumbra::MaximumShaftSteps }),
    penumbra::MinimumShaftSteps);
}

/// Computes the number of comparisons with the shadow map per ray.
int ComputeMapSteps(double tolerance)
{
  const double steps = std::ceil(penumbra::MapStepsTimesRoot / std::sqrt(tolerance));
  return static_cast<int>(
    std::clamp<double>(steps, penumbra::MinimumShaftSteps, penumbra::MaximumShaftSteps));
}

/// Computes the mean of the smallest extents of props that are not flat.
double ComputeMeanThickness(const vtkRenderState* state, double diagonal)
{
  double sum = 0.0;
  int count = 0;
  for (int i = 0; i < state->GetPropArrayCount(); ++i)
  {
    const double* bounds = state->GetPropArray()[i]->GetBounds();
    if (bounds && vtkMath::AreBoundsInitialized(bounds))
    {
      const double extent =
        std::min({ bounds[1] - bounds[0], bounds[3] - bounds[2], bounds[5] - bounds[4] });
      if (extent > penumbra::FlatPropFraction * diagonal)
      {
        sum += extent;
        ++count;
      }
    }
  }
  return count > 0 ? sum / count : penumbra::DefaultThicknessFraction * diagonal;
}

}

struct vtkPenumbraLightShaftPass::Internals
{
  penumbra::RendererMap<penumbra::ShaftViewState> Views;
  penumbra::ShaftViewState* Last = nullptr;
  std::vector<vtkSmartPointer<vtkLight>> Lights;
  std::vector<vtkSmartPointer<vtkProp>> Emitters;
  vtkNew<vtkFieldData> Statistics;
  int Steps = 0;
  int MapSize = 0;

  vtkSmartPointer<vtkPenumbraMedium> Medium = vtkSmartPointer<vtkPenumbraMedium>::New();
  penumbra::ShaftConstants Constants;

  /// Returns a warning if the settings do not describe a medium, else nothing.
  std::string FindInvalidSetting(const Pass* self) const;

  penumbra::ShaftSettings MakeSettings(
    const Pass* self, const vtkRenderState* state, const vtkBoundingBox& box) const;
};

vtkPenumbraLightShaftPass::vtkPenumbraLightShaftPass()
  : Implementation(std::make_unique<Internals>())
{
}

vtkPenumbraLightShaftPass::~vtkPenumbraLightShaftPass() = default;

Pass* vtkPenumbraLightShaftPass::FindIn(vtkRenderer* renderer)
{
  return penumbra::FindPassOf<Pass>(penumbra::FindPassSlots(renderer));
}

Pass* vtkPenumbraLightShaftPass::AddTo(vtkRenderer* renderer)
{
  return penumbra::AddPass<Pass>(renderer, [](const std::vector<penumbra::PassSlot>& slots) {
    const penumbra::PassSlot* occlusion = penumbra::FindPass(slots, [](vtkRenderPass* pass) {
      return vtkPenumbraTemporalSSAOPass::SafeDownCast(pass) != nullptr;
    });
    return occlusion ? *occlusion : slots.back();
  });
}

void vtkPenumbraLightShaftPass::RemoveFrom(vtkRenderer* renderer)
{
  if (Pass* pass = FindIn(renderer))
  {
    penumbra::RemovePass(renderer, pass);
  }
}

void vtkPenumbraLightShaftPass::AddLight(vtkLight* light)
{
  this->Implementation->Lights.emplace_back(light);
  this->Modified();
}

void vtkPenumbraLightShaftPass::RemoveAllLights()
{
  this->Implementation->Lights.clear();
  this->Modified();
}

void vtkPenumbraLightShaftPass::AddEmitter(vtkProp* prop)
{
  this->Implementation->Emitters.emplace_back(prop);
  this->Modified();
}

void vtkPenumbraLightShaftPass::RemoveAllEmitters()
{
  this->Implementation->Emitters.clear();
  this->Modified();
}

void vtkPenumbraLightShaftPass::SetMedium(vtkPenumbraMedium* medium)
{
  if (this->Implementation->Medium != medium)
  {
    this->Implementation->Medium = medium ? vtkSmartPointer<vtkPenumbraMedium>(medium)
                                          : vtkSmartPointer<vtkPenumbraMedium>::New();
    this->Modified();
  }
}

vtkPenumbraMedium* vtkPenumbraLightShaftPass::GetMedium()
{
  return this->Implementation->Medium;
}

penumbra::ShaftConstants& vtkPenumbraLightShaftPass::GetConstants()
{
  return this->Implementation->Constants;
}

std::string vtkPenumbraLightShaftPass::Internals::FindInvalidSetting(const Pass* self) const
{
  if (!std::isfinite(self->Exposure) || !std::isfinite(self->Thickness) ||
    !std::isfinite(self->Tolerance))
  {
    return "Exposure, Thickness and Tolerance must be finite; light shafts are not rendered.";
  }
  if (!std::isfinite(this->Medium->GetAsymmetry()))
  {
    return "Asymmetry must be finite; light shafts are not rendered.";
  }
  if (const char* reason =
        penumbra::FindInvalidMediumSetting(penumbra::MediumSettings(this->Medium)))
  {
    return std::string(reason) + "; light shafts are not rendered.";
  }
  const double* bounds = this->Medium->GetBounds();
  for (int axis = 0; axis < 3; ++axis)
  {
    if (!(bounds[2 * axis] < bounds[2 * axis + 1]))
    {
      return "The lower Bounds of the medium must be below the upper ones; light shafts are not "
             "rendered.";
    }
  }
  return std::string();
}

penumbra::ShaftSettings vtkPenumbraLightShaftPass::Internals::MakeSettings(
  const Pass* self, const vtkRenderState* state, const vtkBoundingBox& box) const
{
  vtkRenderer* renderer = state->GetRenderer();
  const int* size = renderer->GetSize();
  const double diagonal = box.GetDiagonalLength() > 0.0 ? box.GetDiagonalLength() : 1.0;
  double center[3];
  box.GetCenter(center);
  double eye[3];
  renderer->GetActiveCamera()->GetPosition(eye);

  penumbra::ShaftSettings settings;
  settings.Unit = diagonal;
  settings.Range = std::sqrt(vtkMath::Distance2BetweenPoints(eye, center)) + diagonal;
  const penumbra::ShaftConstants& constants = this->Constants;
  const penumbra::MediumSettings medium(this->Medium);
  settings.Channels = penumbra::ResolveMediumCoefficients(medium, diagonal);
  for (penumbra::MediumCoefficients& channel : settings.Channels)
  {
    if (!(channel.Scattering + channel.Rayleigh > 0.0) || medium.HasFalloff() ||
      !penumbra::AreEqual(settings.Channels))
    {
      channel.Extinction = std::max(channel.Extinction, penumbra::MinimumOpticalDepth / diagonal);
    }
  }
  settings.Falloff = medium.HasFalloff();
  settings.ScaleHeight = medium.ScaleHeight;
  settings.BaseHeight = medium.BaseHeight;
  settings.Up = medium.Up;
  vtkMath::Normalize(settings.Up.data());
  settings.Phase = this->Medium->GetPhase();
  settings.Asymmetry = this->Medium->GetAsymmetry();
  settings.Exposure = self->Exposure;
  settings.Radial = self->Estimator == RADIAL;
  settings.MapSize = self->Estimator == SHADOW_MAP ? penumbra::ShadowMapSize : 0;
  settings.Thickness =
    self->Thickness > 0.0 ? self->Thickness : ComputeMeanThickness(state, diagonal);
  settings.Block = ComputeBlockSize(self->Tolerance);
  const int blocks = std::max(size[0], size[1]) / settings.Block;
  settings.Steps = constants.Steps > 0 ? constants.Steps : ComputeSteps(self->Tolerance, blocks);
  settings.MapSteps = constants.Steps > 0 ? constants.Steps : ComputeMapSteps(self->Tolerance);
  settings.DelegateDrawsBackground = !self->OpaqueOnly;
  settings.Prepass = constants.Occlusion == penumbra::ShaftOcclusions::Prepass;
  settings.Emitters.assign(this->Emitters.begin(), this->Emitters.end());
  const double* bounds = this->Medium->GetBounds();
  settings.Bounded =
    std::any_of(bounds, bounds + 6, [](double bound) { return std::isfinite(bound); });
  std::copy_n(bounds, 6, settings.Bounds.begin());
  settings.AutomaticTone = self->AutomaticTone;
  renderer->GetBackground(settings.Background.data());

  penumbra::RadialBlurSettings& radial = settings.RadialBlur;
  radial.Steps = settings.Steps;
  radial.Passes = constants.Passes;
  radial.Geometric = constants.Spacing == penumbra::ShaftSpacings::Geometric;
  radial.Weight = constants.Weight;
  radial.Decay = constants.Decay;
  radial.PathRatio = constants.PathRatio;
  radial.SurfaceEmission =
    constants.Occlusion == penumbra::ShaftOcclusions::Contrast ? constants.SurfaceEmission : 0.0;
  radial.SkyIsImage = constants.Sky == penumbra::ShaftSkies::Image;
  radial.Block = settings.Block;
  radial.DelegateDrawsBackground = settings.DelegateDrawsBackground;
  return settings;
}

bool vtkPenumbraLightShaftPass::RenderEffect(const vtkRenderState* state)
{
  Internals& internals = *this->Implementation;
  vtkRenderer* renderer = state->GetRenderer();
  vtkOpenGLRenderWindow* window = this->EnterWindow(renderer);
  double bounds[6];
  renderer->ComputeVisiblePropBounds(bounds);
  const int* size = renderer->GetSize();
  if (!window || !vtkMath::AreBoundsInitialized(bounds) || size[0] < 1 || size[1] < 1)
  {
    return false;
  }
  const std::string warning = internals.FindInvalidSetting(this);
  if (!warning.empty())
  {
    this->WarnOnce(warning);
    return false;
  }
  if (internals.Medium->GetDensity())
  {
    this->WarnOnce(
      "The density image of the medium has no effect on the light shafts of this pass; "
      "only the ray caster renders it.");
  }
  penumbra::ShaftSettings settings = internals.MakeSettings(this, state, vtkBoundingBox(bounds));
  const int noMargin[2] = { 0, 0 };
  penumbra::ScreenTransform view =
    penumbra::ScreenTransform::FromRenderer(renderer, size, noMargin);
  view.Unit = settings.Unit;
  const std::vector<vtkLight*> chosen(internals.Lights.begin(), internals.Lights.end());
  std::vector<penumbra::ShaftLight> lights = penumbra::FindShaftLights(renderer, chosen, view);
  if (lights.empty())
  {
    this->WarnOnce(
      "No light casts light shafts, because headlights and black lights do not. Add a light to the "
      "renderer, or pass one to AddLight().");
    return false;
  }
  if (settings.MapSize > 0 && !penumbra::AssignShadowMaps(lights, bounds))
  {
    this->WarnOnce("A positional light inside the bounds of the scene or close to them has no "
                   "shadow map; its light shafts are estimated from depth. Set a cone angle of at "
                   "most 80 degrees, or move the light away from the props.");
  }
  if (this->OpaqueOnly)
  {
    const bool outside = std::any_of(lights.begin(), lights.end(),
      [](const penumbra::ShaftLight& light) { return !light.InImage && !light.HasShadowMap; });
    const double percent = internals.Constants.Margin >= 0.0 ? internals.Constants.Margin
      : outside                                              ? penumbra::DefaultShaftMargin
                                                             : 0.0;
    settings.Margin[0] = settings.Margin[1] = this->LimitMargin(
      window, size, static_cast<int>(std::ceil(percent / 100.0 * std::max(size[0], size[1]))));
  }
  internals.Last = &internals.Views.Get(renderer);
  const bool mapped = std::any_of(lights.begin(), lights.end(),
    [](const penumbra::ShaftLight& light) { return light.HasShadowMap; });
  internals.Steps = mapped ? settings.MapSteps : settings.Steps;
  internals.MapSize = settings.MapSize;
  if (!internals.Last->Render(state, this->DelegatePass, lights, settings))
  {
    this->WarnOnce(
      "OpenGL cannot render light shafts in this window; the scene is rendered without them.");
    return false;
  }
  this->NumberOfRenderedProps = internals.Last->GetNumberOfRenderedProps();
  return true;
}

void vtkPenumbraLightShaftPass::ReleaseGraphicsResources(vtkWindow* window)
{
  this->Superclass::ReleaseGraphicsResources(window);
  Internals& internals = *this->Implementation;
  internals.Views.VisitAll(
    [&](penumbra::ShaftViewState& view) { view.ReleaseGraphicsResources(window); });
  internals.Views.Clear();
  internals.Last = nullptr;
}

vtkFieldData* vtkPenumbraLightShaftPass::GetStatistics()
{
  Internals& internals = *this->Implementation;
  internals.Statistics->Initialize();
  if (internals.Last)
  {
    penumbra::AddStatistic(
      internals.Statistics, "Lights/Shaft", internals.Last->GetNumberOfLights());
    penumbra::AddStatistic(internals.Statistics, "LitFractions/Computed",
      static_cast<double>(internals.Last->GetNewLitFractions()));
    penumbra::AddStatistic(internals.Statistics, "Samples/PerLitFraction", internals.Steps);
    penumbra::AddStatistic(internals.Statistics, "ShadowMaps/Size", internals.MapSize);
    penumbra::AddStatistic(
      internals.Statistics, "ShadowMaps/Rendered", internals.Last->GetNewShadowMaps());
    penumbra::AddStatistic(internals.Statistics, "Light/Gain", internals.Last->GetGain());
  }
  return internals.Statistics;
}

void vtkPenumbraLightShaftPass::CopyShafts(vtkImageData* image)
{
  if (!image)
  {
    vtkErrorMacro("The image is null; pass a vtkImageData to CopyShafts().");
    return;
  }
  image->Initialize();
  if (this->Implementation->Last)
  {
    this->GetWindow()->MakeCurrent();
    this->Implementation->Last->CopyTo(image);
  }
}

const char* vtkPenumbraLightShaftPass::GetEstimatorAsString() const
{
  static const char* const names[] = { "Depth", "Radial", "ShadowMap" };
  return names[this->Estimator];
}

void vtkPenumbraLightShaftPass::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Tolerance: " << this->Tolerance << "\n";
  os << indent << "Medium: " << this->Implementation->Medium.Get() << "\n";
  os << indent << "Exposure: " << this->Exposure << "\n";
  os << indent << "AutomaticTone: " << this->AutomaticTone << "\n";
  os << indent << "Estimator: " << this->GetEstimatorAsString() << "\n";
  os << indent << "Thickness: " << this->Thickness << "\n";
  os << indent << "Lights: " << this->Implementation->Lights.size() << "\n";
  os << indent << "Emitters: " << this->Implementation->Emitters.size() << "\n";
}
