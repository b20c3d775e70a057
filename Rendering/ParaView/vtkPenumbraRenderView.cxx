// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkPenumbraRenderView.h"
#include "vtkPenumbraOcclusionConstants.h"
#include "vtkPenumbraRayCasterConstants.h"
#include "vtkPenumbraShaftConstants.h"

#include "RenderViewPass.h"

#include "vtkActor.h"
#include "vtkActorCollection.h"
#include "vtkCollectionRange.h"
#include "vtkCommand.h"
#include "vtkCommunicator.h"
#include "vtkLight.h"
#include "vtkLightCollection.h"
#include "vtkMath.h"
#include "vtkMultiProcessController.h"
#include "vtkObjectFactory.h"
#include "vtkPVSession.h"
#include "vtkPVSynchronizedRenderer.h"
#include "vtkPenumbraKernels.h"
#include "vtkPenumbraMedium.h"
#include "vtkProcessModule.h"
#include "vtkRenderer.h"
#include "vtkVolume.h"
#include "vtkVolumeCollection.h"

#include <algorithm>
#include <set>
#include <string>

vtkStandardNewMacro(vtkPenumbraRenderView);

struct vtkPenumbraRenderView::Internals
{
  vtkNew<penumbra::RenderViewPass> Pass;
  vtkNew<vtkLight> Sun;
  vtkNew<vtkPenumbraMedium> Medium;
  std::set<std::string> IssuedWarnings;
  unsigned long StartObserver = 0;
};

namespace
{

/// Returns whether a volume is visible. Representations that support volumes always have a visible
/// one, which is empty while they show a surface.
bool HasVisibleVolumes(vtkRenderer* renderer)
{
  for (vtkVolume* volume : vtk::Range(renderer->GetVolumes()))
  {
    const double* bounds = volume->GetVisibility() ? volume->GetBounds() : nullptr;
    if (bounds && vtkMath::AreBoundsInitialized(bounds))
    {
      return true;
    }
  }
  return false;
}

bool HasVisibleTranslucentActors(vtkRenderer* renderer)
{
  for (vtkActor* actor : vtk::Range(renderer->GetActors()))
  {
    if (actor->GetVisibility() && actor->HasTranslucentPolygonalGeometry())
    {
      return true;
    }
  }
  return false;
}

/// Returns a message of VTK without its source.
std::string RemoveSource(const std::string& message)
{
  const std::size_t source = message.find("): ");
  std::string text = source == std::string::npos ? message : message.substr(source + 3);
  text.erase(text.find_last_not_of('\n') + 1);
  return text;
}

}

vtkPenumbraRenderView::vtkPenumbraRenderView()
  : Implementation(std::make_unique<Internals>())
{
  this->Implementation->Sun->SetLightTypeToSceneLight();
  // After the observers that give all ranks the camera and the size of the first one.
  constexpr float last = -1.f;
  this->Implementation->StartObserver = this->GetRenderer()->AddObserver(
    vtkCommand::StartEvent, this, &vtkPenumbraRenderView::CastDistributedRays, last);
  this->Implementation->Pass->Caster->AddObserver(
    vtkCommand::WarningEvent, this, &vtkPenumbraRenderView::ReportWarning);
}

vtkPenumbraRenderView::~vtkPenumbraRenderView()
{
  // The renderers of the superclass outlive the members of this object.
  this->GetRenderer()->RemoveObserver(this->Implementation->StartObserver);
  if (this->SynchronizedRenderers->GetImageProcessingPass() == this->Implementation->Pass)
  {
    this->SynchronizedRenderers->SetImageProcessingPass(nullptr);
  }
}

void vtkPenumbraRenderView::SetOcclusionKernel(const char* name)
{
  const std::string kernel = name ? name : "";
  if (vtkPenumbraKernels::Find(kernel.c_str()) < 0)
  {
    vtkErrorMacro("OcclusionKernel: unknown kernel '" << kernel << "'; " << this->OcclusionKernel
                                                      << " remains selected.");
  }
  else if (kernel != this->OcclusionKernel)
  {
    this->OcclusionKernel = kernel;
    this->Modified();
  }
}

void vtkPenumbraRenderView::SetUseToneMapping(bool use)
{
  if (this->SynchronizedRenderers->GetImageProcessingPass() == this->Implementation->Pass)
  {
    // The superclass ignores tone mapping if there is another pass.
    this->SynchronizedRenderers->SetImageProcessingPass(nullptr);
  }
  this->Superclass::SetUseToneMapping(use);
}

void vtkPenumbraRenderView::UpdateSunLight()
{
  vtkLight* sun = this->Implementation->Sun;
  vtkRenderer* renderer = this->GetRenderer();
  const bool enabled = this->LightShafts && this->SunIntensity > 0.0;
  if (enabled != static_cast<bool>(renderer->GetLights()->IsItemPresent(sun)))
  {
    enabled ? renderer->AddLight(sun) : renderer->RemoveLight(sun);
  }
  double center[3] = { 0.0, 0.0, 0.0 };
  if (this->GeometryBounds.IsValid())
  {
    this->GeometryBounds.GetCenter(center);
  }
  sun->SetFocalPoint(center);
  sun->SetPosition(center[0] + this->SunDirection[0], center[1] + this->SunDirection[1],
    center[2] + this->SunDirection[2]);
  sun->SetIntensity(this->SunIntensity);
}

void vtkPenumbraRenderView::ConfigureMedium(vtkPenumbraMedium* medium)
{
  const double diagonal = this->GeometryBounds.GetDiagonalLength();
  medium->SetScattering(this->ShaftDensity / diagonal);
  medium->SetRayleighScattering(this->ShaftRayleigh / diagonal);
  medium->SetPhase(this->ShaftAsymmetry != 0.0 ? vtkPenumbraMedium::HENYEY_GREENSTEIN
                                               : vtkPenumbraMedium::ISOTROPIC);
  medium->SetAsymmetry(this->ShaftAsymmetry);
  medium->SetScaleHeight(this->ShaftScaleHeight * diagonal);
  double up[3] = { this->ShaftUp[0], this->ShaftUp[1], this->ShaftUp[2] };
  if (vtkMath::Normalize(up) > 0.0)
  {
    double lowest = 0.0;
    for (int axis = 0; axis < 3; ++axis)
    {
      lowest += std::min(up[axis] * this->GeometryBounds.GetBound(2 * axis),
        up[axis] * this->GeometryBounds.GetBound(2 * axis + 1));
    }
    medium->SetUp(up);
    medium->SetBaseHeight(lowest);
  }
}

void vtkPenumbraRenderView::Configure(bool interactive)
{
  penumbra::RenderViewPass* pass = this->Implementation->Pass;
  const double diagonal =
    this->GeometryBounds.IsValid() ? this->GeometryBounds.GetDiagonalLength() : 0.0;
  pass->UseOcclusion = this->AmbientOcclusion && diagonal > 0.0;
  pass->UseShafts = this->LightShafts && diagonal > 0.0;
  // A client shows what the server has rendered.
  const bool isClient = vtkProcessModule::GetProcessType() == vtkProcessModule::PROCESS_CLIENT;
  const bool isComposited = this->SynchronizedRenderers->GetEnabled();
  pass->UseRays = this->StillByRays && !interactive && !(isClient && isComposited);
  if (pass->UseRays && isClient && this->GetSession() &&
    this->GetSession()->GetController(vtkPVSession::DATA_SERVER_ROOT))
  {
    this->WarnOnce(
      "The client has received all data from the server and casts the rays of this still "
      "render. Set Remote Render Threshold to 0 to cast them on the server, which needs "
      "a display.");
  }
  pass->HasDistributedRays = pass->UseRays && this->HasSeveralRanks();
  if (!pass->UseOcclusion && !pass->UseShafts && !pass->UseRays)
  {
    return;
  }
  int volumes = HasVisibleVolumes(this->GetRenderer());
  if (pass->HasDistributedRays)
  {
    const int own = volumes;
    vtkMultiProcessController::GetGlobalController()->AllReduce(
      &own, &volumes, 1, vtkCommunicator::MAX_OP);
  }
  pass->HasNonOpaqueProps = volumes != 0 || HasVisibleTranslucentActors(this->GetRenderer());
  if (pass->UseRays && volumes != 0)
  {
    this->WarnOnce("Ray casting does not support volumes: the still render is rasterized. Hide the "
                   "volumes, or turn "
                   "off Still By Rays.");
    pass->UseRays = pass->HasDistributedRays = false;
  }
  if (diagonal <= 0.0)
  {
    return;
  }

  vtkPenumbraTemporalSSAOPass* occlusion = pass->Occlusion;
  occlusion->SetTolerance(this->PenumbraTolerance);
  occlusion->SetRadiusUnit(vtkPenumbraTemporalSSAOPass::WORLD);
  occlusion->SetRadius(this->OcclusionRadius * diagonal);
  occlusion->GetConstants().Margin = 0.0; // Composited images have no margin either.
  occlusion->SetStrength(this->OcclusionStrength);
  occlusion->SetKernelName(this->OcclusionKernel.c_str());
  occlusion->SetConvergeInOneRender(
    interactive ? vtkPenumbraTemporalSSAOPass::NEVER : vtkPenumbraTemporalSSAOPass::ALWAYS);
  occlusion->SetRefineStaticView(false); // ParaView renders a still frame after each interaction.

  vtkPenumbraLightShaftPass* shafts = pass->Shafts;
  shafts->SetTolerance(this->PenumbraTolerance);
  shafts->GetConstants().Margin = 0.0;
  this->ConfigureMedium(shafts->GetMedium());
  // A shadow map contains the data of its process only.
  shafts->SetEstimator(this->SynchronizedRenderers->GetEnabled() ? vtkPenumbraLightShaftPass::DEPTH
                                                                 : this->ShaftEstimator);
  shafts->SetExposure(this->ShaftExposure);
  shafts->SetThickness(this->ShaftThickness * diagonal);
  shafts->RemoveAllLights();
  // Always added: without lights, the pass would use headlights and camera lights.
  shafts->AddLight(this->Implementation->Sun);
  for (vtkLight* light : vtk::Range(this->GetRenderer()->GetLights()))
  {
    if (light->LightTypeIsSceneLight())
    {
      shafts->AddLight(light);
    }
  }

  vtkPenumbraRayCaster* caster = pass->Caster;
  caster->SetTolerance(std::min(1.0 / 256.0, this->PenumbraTolerance));
  caster->SetLightTolerance(this->PenumbraTolerance);
  caster->GetConstants().ToleranceProperty = "Tolerance";
  caster->GetConstants().ToleranceValue = this->PenumbraTolerance;
  caster->SetAmbientOcclusion(this->AmbientOcclusion);
  caster->SetAmbientOcclusionRadius(this->OcclusionRadius * diagonal);
  caster->SetAmbientOcclusionStrength(this->OcclusionStrength);
  this->ConfigureMedium(this->Implementation->Medium.Get());
  caster->SetMedium(this->LightShafts ? this->Implementation->Medium.Get() : nullptr);
  caster->SetShadows(this->LightShafts);
  caster->GetConstants().CameraLightShafts = false; // as in frames that are not ray cast
  caster->SetLightAngle(this->SunAngle);
}

/// Returns true if the images of several ranks are composited.
bool vtkPenumbraRenderView::HasSeveralRanks()
{
  auto* controller = vtkMultiProcessController::GetGlobalController();
  return this->SynchronizedRenderers->GetEnabled() && controller &&
    controller->GetNumberOfProcesses() > 1;
}

/// Makes all ranks cast rays if it is possible on the first one, where the image is shown.
void vtkPenumbraRenderView::AgreeOnRays(bool isPossible)
{
  penumbra::RenderViewPass* pass = this->Implementation->Pass;
  int casts = pass->UseRays && isPossible;
  vtkMultiProcessController::GetGlobalController()->Broadcast(&casts, 1, 0);
  pass->UseRays = pass->HasDistributedRays = casts != 0;
}

void vtkPenumbraRenderView::CastDistributedRays()
{
  penumbra::RenderViewPass* pass = this->Implementation->Pass;
  if (pass->HasDistributedRays)
  {
    pass->CastRays(this->GetRenderer());
  }
}

bool vtkPenumbraRenderView::UsesOrderedCompositing()
{
  if (!this->HasSeveralRanks() || !this->GetUseOrderedCompositing())
  {
    return false;
  }
  this->WarnOnce("Ordered compositing of volumes or translucent surfaces from several ranks does "
                 "not provide depths: "
                 "ambient occlusion and light shafts are not rendered.");
  return true;
}

void vtkPenumbraRenderView::WarnOnce(const char* text)
{
  if (this->Implementation->IssuedWarnings.insert(text).second)
  {
    vtkWarningMacro(<< text);
  }
}

void vtkPenumbraRenderView::ReportWarning(vtkObject*, unsigned long, void* message)
{
  vtkWarningMacro(<< RemoveSource(static_cast<const char*>(message)));
}

void vtkPenumbraRenderView::AboutToRenderOnLocalProcess(bool interactive)
{
  this->Superclass::AboutToRenderOnLocalProcess(interactive);
  this->UpdateSunLight();
  this->Configure(interactive);
  penumbra::RenderViewPass* pass = this->Implementation->Pass;
  pass->DistributedBackground.emplace(this->GetRenderer());
  vtkImageProcessingPass* present = this->SynchronizedRenderers->GetImageProcessingPass();
  const bool hasWork = pass->UseOcclusion || pass->UseShafts || pass->UseRays;
  const bool isToneMapped = present && present != pass;
  if (pass->HasDistributedRays)
  {
    this->AgreeOnRays(!isToneMapped && !this->GetMakingSelection());
  }
  if (isToneMapped)
  {
    if (hasWork)
    {
      this->WarnOnce("The effects and rays of this view are not rendered while tone mapping is on. "
                     "Turn off tone mapping to render them.");
    }
    this->SynchronizedRenderers->SetUseDepthBuffer(false);
    return;
  }
  // The composited image is only available on the first rank.
  auto* controller = vtkMultiProcessController::GetGlobalController();
  const bool hasImage = !controller || controller->GetLocalProcessId() == 0;
  const bool active = hasWork && hasImage && !this->GetMakingSelection() &&
    (pass->HasDistributedRays || !this->UsesOrderedCompositing());
  if (active && !this->SynchronizedRenderers->GetEnabled())
  {
    // ParaView applies FXAA once after this pass, as it does after compositing.
    this->GetRenderer()->SetUseFXAA(false);
  }
  this->SynchronizedRenderers->SetUseDepthBuffer(active);
  this->SynchronizedRenderers->SetImageProcessingPass(active ? pass : nullptr);
}

void vtkPenumbraRenderView::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "PenumbraTolerance: " << this->PenumbraTolerance << "\n";
  os << indent << "AmbientOcclusion: " << this->AmbientOcclusion << "\n";
  os << indent << "OcclusionRadius: " << this->OcclusionRadius << "\n";
  os << indent << "OcclusionStrength: " << this->OcclusionStrength << "\n";
  os << indent << "OcclusionKernel: " << this->OcclusionKernel << "\n";
  os << indent << "LightShafts: " << this->LightShafts << "\n";
  os << indent << "ShaftDensity: " << this->ShaftDensity << "\n";
  os << indent << "ShaftRayleigh: " << this->ShaftRayleigh << "\n";
  os << indent << "ShaftAsymmetry: " << this->ShaftAsymmetry << "\n";
  os << indent << "ShaftScaleHeight: " << this->ShaftScaleHeight << "\n";
  os << indent << "ShaftUp: " << this->ShaftUp[0] << ", " << this->ShaftUp[1] << ", "
     << this->ShaftUp[2] << "\n";
  os << indent << "ShaftEstimator: " << this->ShaftEstimator << "\n";
  os << indent << "ShaftExposure: " << this->ShaftExposure << "\n";
  os << indent << "ShaftThickness: " << this->ShaftThickness << "\n";
  os << indent << "SunDirection: " << this->SunDirection[0] << ", " << this->SunDirection[1] << ", "
     << this->SunDirection[2] << "\n";
  os << indent << "SunIntensity: " << this->SunIntensity << "\n";
  os << indent << "SunAngle: " << this->SunAngle << "\n";
  os << indent << "StillByRays: " << this->StillByRays << "\n";
}
