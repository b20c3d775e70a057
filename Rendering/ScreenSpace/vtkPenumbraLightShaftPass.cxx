// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkPenumbraLightShaftPass.h"

#include "Chain/PassSlots.h"
#include "Frame/PassStatistics.h"
#include "Shafts/ShaftViewState.h"
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
#include <map>
#include <string>
#include <vector>

vtkStandardNewMacro(vtkPenumbraLightShaftPass);

namespace
{

using Pass = vtkPenumbraLightShaftPass;

/// Lost and scattered over the scene's diagonal, where nothing is given; as the ray caster has it.
constexpr double DefaultOpticalDepth = 0.25;
/// Of a medium that scatters nothing: it must lose something.
constexpr double LeastOpticalDepth = 1e-12;
/// Steps times tolerance. Measured, as all of these: `./penumbra benchmark light-shafts`.
constexpr double StepsTimesTolerance = 0.375;
constexpr int FewestSteps = 16;
constexpr int MostSteps = 1024;
/// More than one for every so many blocks of the picture's larger side make nothing better.
constexpr int BlocksPerStep = 2;
/// Lit shares are found for blocks of 4x4 pixels from this tolerance on; at half of it the side is 1 less.
constexpr int LargestBlock = 4;
constexpr double LargestBlockTolerance = 1.0 / 128.0;
/// Per cent of the picture's larger side, while a light is outside of it.
constexpr double DefaultMargin = 20.0;
/// Bounds of what is thin, and thickness where everything is, as shares of the diagonal.
constexpr double ThinnestShare = 0.002;
constexpr double ThicknessOfThin = 0.02;

/// Pixels a side of the blocks for which lit shares are found.
int BlockFor(double tolerance)
{
  const double halvings = std::ceil(std::log2(LargestBlockTolerance / tolerance));
  return LargestBlock - static_cast<int>(std::clamp(halvings, 0.0, LargestBlock - 1.0));
}

/// The mean of the smallest extents of props that are not flat.
double MeanThickness(const vtkRenderState* state, double diagonal)
{
  double sum = 0.0;
  int count = 0;
  for (int i = 0; i < state->GetPropArrayCount(); ++i)
  {
    const double* bounds = state->GetPropArray()[i]->GetBounds();
    if (bounds && vtkMath::AreBoundsInitialized(bounds))
    {
      const double least =
        std::min({ bounds[1] - bounds[0], bounds[3] - bounds[2], bounds[5] - bounds[4] });
      if (least > ThinnestShare * diagonal)
      {
        sum += least;
        ++count;
      }
    }
  }
  return count > 0 ? sum / count : ThicknessOfThin * diagonal;
}

}

struct vtkPenumbraLightShaftPass::Internals
{
  std::map<vtkRenderer*, penumbra::ShaftViewState> Views;
  penumbra::ShaftViewState* Last = nullptr;
  std::vector<vtkSmartPointer<vtkLight>> Lights;
  std::vector<vtkSmartPointer<vtkProp>> Emitters;
  vtkNew<vtkFieldData> Statistics;
  int Steps = 0;
  /// Null where the numbers are a medium.
  static const char* WhyNoMedium(const Pass* self);

  penumbra::ShaftSettings MakeSettings(
    const Pass* self, const vtkRenderState* state, const vtkBoundingBox& box) const;
};

vtkPenumbraLightShaftPass::vtkPenumbraLightShaftPass()
  : Implementation(std::make_unique<Internals>())
{
}

vtkPenumbraLightShaftPass::~vtkPenumbraLightShaftPass() = default;

Pass* vtkPenumbraLightShaftPass::AddTo(vtkRenderer* renderer)
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
  const std::vector<penumbra::PassSlot> places = penumbra::EnsurePassSlots(renderer);
  const penumbra::PassSlot* occlusion = penumbra::FindPass(places,
    [](vtkRenderPass* pass) { return vtkPenumbraTemporalSSAOPass::SafeDownCast(pass) != nullptr; });
  const penumbra::PassSlot& place = occlusion ? *occlusion : places.back();
  vtkNew<Pass> pass;
  pass->SetDelegatePass(place.Pass);
  pass->SetOpaqueOnly(place.OpaqueOnly);
  place.Set(pass);
  return pass;
}

void vtkPenumbraLightShaftPass::RemoveFrom(vtkRenderer* renderer)
{
  if (Pass* pass = penumbra::FindPassOf<Pass>(penumbra::FindPassSlots(renderer)))
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

const char* vtkPenumbraLightShaftPass::Internals::WhyNoMedium(const Pass* self)
{
  const double numbers[] = { self->Scattering, self->Extinction, self->Asymmetry, self->Exposure,
    self->Thickness, self->Tolerance };
  if (!std::all_of(
        std::begin(numbers), std::end(numbers), [](double n) { return std::isfinite(n); }))
  {
    return "The medium's numbers are no medium; the scene is drawn without.";
  }
  for (int axis = 0; axis < 3; ++axis)
  {
    if (!(self->Bounds[2 * axis] < self->Bounds[2 * axis + 1]))
    {
      return "The medium's bounds hold nothing; the scene is drawn without.";
    }
  }
  return nullptr;
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
  settings.Scattering = self->Scattering >= 0.0 ? self->Scattering : DefaultOpticalDepth / diagonal;
  settings.Extinction = std::max(self->Extinction, settings.Scattering);
  if (!(settings.Scattering > 0.0))
  {
    settings.Extinction = std::max(settings.Extinction, LeastOpticalDepth / diagonal);
  }
  settings.Phase = self->Phase;
  settings.Asymmetry = self->Asymmetry;
  settings.Exposure = self->Exposure;
  settings.Radial = self->Estimator == RADIAL;
  settings.Thickness = self->Thickness > 0.0 ? self->Thickness : MeanThickness(state, diagonal);
  settings.Block = BlockFor(self->Tolerance);
  const int most = std::max(size[0], size[1]) / (BlocksPerStep * settings.Block);
  const int steps = static_cast<int>(std::ceil(StepsTimesTolerance / self->Tolerance));
  settings.Steps =
    self->Steps > 0 ? self->Steps : std::max(std::min({ steps, most, MostSteps }), FewestSteps);
  settings.DelegateDrawsBackground = !self->OpaqueOnly;
  settings.Prepass = self->Occlusion == PREPASS;
  settings.Emitters.assign(this->Emitters.begin(), this->Emitters.end());
  settings.Bounded =
    std::any_of(self->Bounds, self->Bounds + 6, [](double bound) { return std::isfinite(bound); });
  std::copy_n(self->Bounds, 6, settings.Bounds.begin());
  settings.AutomaticTone = self->AutomaticTone;
  renderer->GetBackground(settings.Background.data());

  penumbra::RadialBlurSettings& paper = settings.Paper;
  paper.Steps = settings.Steps;
  paper.Passes = self->Passes;
  paper.Geometric = self->Spacing == GEOMETRIC;
  paper.Weight = self->Weight;
  paper.Decay = self->Decay;
  paper.Density = self->Density;
  paper.SurfaceEmission = self->Occlusion == CONTRAST ? self->SurfaceEmission : 0.0;
  paper.SkyIsPicture = self->Sky == PICTURE;
  paper.Block = settings.Block;
  paper.DelegateDrawsBackground = settings.DelegateDrawsBackground;
  return settings;
}

bool vtkPenumbraLightShaftPass::RenderEffect(const vtkRenderState* state)
{
  Internals& own = *this->Implementation;
  vtkRenderer* renderer = state->GetRenderer();
  vtkOpenGLRenderWindow* window = this->EnterWindow(renderer);
  double bounds[6];
  renderer->ComputeVisiblePropBounds(bounds);
  const int* size = renderer->GetSize();
  if (!window || !vtkMath::AreBoundsInitialized(bounds) || size[0] < 1 || size[1] < 1)
  {
    return false;
  }
  if (const char* why = Internals::WhyNoMedium(this))
  {
    this->WarnOnce(why);
    return false;
  }
  penumbra::ShaftSettings settings = own.MakeSettings(this, state, vtkBoundingBox(bounds));
  const int none[2] = { 0, 0 };
  penumbra::ScreenTransform view = penumbra::ScreenTransform::FromRenderer(renderer, size, none);
  view.Unit = settings.Unit;
  const std::vector<vtkLight*> chosen(own.Lights.begin(), own.Lights.end());
  const std::vector<penumbra::ShaftLight> lights =
    penumbra::FindShaftLights(renderer, chosen, view);
  if (lights.empty())
  {
    this->WarnOnce("No light makes shafts (headlights and black lights make none).");
    return false;
  }
  if (this->OpaqueOnly)
  {
    const bool outside = std::any_of(lights.begin(), lights.end(),
      [](const penumbra::ShaftLight& light) { return !light.InPicture; });
    const double share = this->Margin >= 0.0 ? this->Margin : outside ? DefaultMargin : 0.0;
    settings.Margin[0] = settings.Margin[1] =
      static_cast<int>(std::ceil(share / 100.0 * std::max(size[0], size[1])));
  }
  own.Last = &own.Views[renderer];
  own.Steps = settings.Steps;
  if (!own.Last->Render(state, this->DelegatePass, lights, settings))
  {
    this->WarnOnce("OpenGL cannot do light shafts here; the scene is drawn without.");
    return false;
  }
  this->NumberOfRenderedProps = own.Last->GetNumberOfRenderedProps();
  return true;
}

void vtkPenumbraLightShaftPass::ReleaseGraphicsResources(vtkWindow* window)
{
  this->Superclass::ReleaseGraphicsResources(window);
  Internals& own = *this->Implementation;
  for (auto& [renderer, view] : own.Views)
  {
    view.ReleaseGraphicsResources(window);
  }
  own.Views.clear();
  own.Last = nullptr;
}

vtkFieldData* vtkPenumbraLightShaftPass::GetStatistics()
{
  Internals& own = *this->Implementation;
  own.Statistics->Initialize();
  if (own.Last)
  {
    penumbra::AddStatistic(own.Statistics, "Lights/Shaft", own.Last->GetNumberOfLights());
    penumbra::AddStatistic(
      own.Statistics, "LitFractions/Computed", static_cast<double>(own.Last->GetNewShares()));
    penumbra::AddStatistic(own.Statistics, "Samples/PerLitFraction", own.Steps);
    penumbra::AddStatistic(own.Statistics, "Light/Gain", own.Last->GetGain());
  }
  return own.Statistics;
}

void vtkPenumbraLightShaftPass::CopyShafts(vtkImageData* image)
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

void vtkPenumbraLightShaftPass::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Tolerance: " << this->Tolerance << "\n";
  os << indent << "Steps: " << this->Steps << "\n";
  os << indent << "Scattering: " << this->Scattering << "\n";
  os << indent << "Extinction: " << this->Extinction << "\n";
  os << indent << "Phase: " << this->Phase << "\n";
  os << indent << "Asymmetry: " << this->Asymmetry << "\n";
  os << indent << "Exposure: " << this->Exposure << "\n";
  os << indent << "AutomaticTone: " << this->AutomaticTone << "\n";
  os << indent << "Bounds:";
  for (const double bound : this->Bounds)
  {
    os << " " << bound;
  }
  os << "\n" << indent << "Estimator: " << this->Estimator << "\n";
  os << indent << "Thickness: " << this->Thickness << "\n";
  os << indent << "Weight: " << this->Weight << "\n";
  os << indent << "Decay: " << this->Decay << "\n";
  os << indent << "Density: " << this->Density << "\n";
  os << indent << "Spacing: " << this->Spacing << "\n";
  os << indent << "Passes: " << this->Passes << "\n";
  os << indent << "Occlusion: " << this->Occlusion << "\n";
  os << indent << "Sky: " << this->Sky << "\n";
  os << indent << "SurfaceEmission: " << this->SurfaceEmission << "\n";
  os << indent << "Lights: " << this->Implementation->Lights.size() << "\n";
  os << indent << "Emitters: " << this->Implementation->Emitters.size() << "\n";
  os << indent << "Margin: " << this->Margin << "\n";
}
