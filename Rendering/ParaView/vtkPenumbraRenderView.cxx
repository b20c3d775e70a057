// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkPenumbraRenderView.h"

#include "RenderViewPass.h"

#include "vtkActor.h"
#include "vtkActorCollection.h"
#include "vtkCollectionRange.h"
#include "vtkLight.h"
#include "vtkLightCollection.h"
#include "vtkMath.h"
#include "vtkMultiProcessController.h"
#include "vtkObjectFactory.h"
#include "vtkPVSynchronizedRenderer.h"
#include "vtkPenumbraKernels.h"
#include "vtkPenumbraMedium.h"
#include "vtkRenderer.h"
#include "vtkVolume.h"
#include "vtkVolumeCollection.h"

#include <set>

vtkStandardNewMacro(vtkPenumbraRenderView);

struct vtkPenumbraRenderView::Internals
{
  vtkNew<penumbra::RenderViewPass> Pass;
  vtkNew<vtkLight> Sun;
  vtkNew<vtkPenumbraMedium> Medium;
  std::set<std::string> LastWarning;
};

namespace
{

/// Representations that could show a volume hold a visible one even where they show a surface: empty.
bool ShowsVolumes(vtkRenderer* renderer)
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

bool ShowsTranslucentActors(vtkRenderer* renderer)
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

}

vtkPenumbraRenderView::vtkPenumbraRenderView()
  : Implementation(std::make_unique<Internals>())
{
  this->Implementation->Sun->SetLightTypeToSceneLight();
}

vtkPenumbraRenderView::~vtkPenumbraRenderView()
{
  // The superclass' pass outlives this object's members.
  if (this->SynchronizedRenderers->GetImageProcessingPass() == this->Implementation->Pass)
  {
    this->SynchronizedRenderers->SetImageProcessingPass(nullptr);
  }
}

void vtkPenumbraRenderView::SetOcclusionKernel(const char* name)
{
  const std::string wanted = name ? name : "";
  if (vtkPenumbraKernels::Find(wanted.c_str()) < 0)
  {
    vtkErrorMacro("There is no kernel '" << wanted << "'; " << this->OcclusionKernel << " stays.");
  }
  else if (wanted != this->OcclusionKernel)
  {
    this->OcclusionKernel = wanted;
    this->Modified();
  }
}

void vtkPenumbraRenderView::UpdateSunLight()
{
  vtkLight* sun = this->Implementation->Sun;
  vtkRenderer* renderer = this->GetRenderer();
  const bool shines = this->LightShafts && this->SunIntensity > 0.0;
  if (shines != static_cast<bool>(renderer->GetLights()->IsItemPresent(sun)))
  {
    shines ? renderer->AddLight(sun) : renderer->RemoveLight(sun);
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

void vtkPenumbraRenderView::Configure(bool interactive)
{
  penumbra::RenderViewPass* pass = this->Implementation->Pass;
  const double diagonal =
    this->GeometryBounds.IsValid() ? this->GeometryBounds.GetDiagonalLength() : 0.0;
  pass->UseOcclusion = this->AmbientOcclusion && diagonal > 0.0;
  pass->UseShafts = this->LightShafts && diagonal > 0.0;
  pass->UseRays = this->StillByRays && !interactive && !this->SynchronizedRenderers->GetEnabled();
  if (!pass->UseOcclusion && !pass->UseShafts && !pass->UseRays)
  {
    return;
  }
  const bool volumes = ShowsVolumes(this->GetRenderer());
  pass->ShowsMoreThanOpaque = volumes || ShowsTranslucentActors(this->GetRenderer());
  if (pass->UseRays && volumes)
  {
    this->WarnOnce("Volumes are shown: rays do not draw them, the picture is drawn as usual.");
    pass->UseRays = false;
  }
  if (diagonal <= 0.0)
  {
    return;
  }

  vtkPenumbraTemporalSSAOPass* occlusion = pass->Occlusion;
  occlusion->SetTolerance(this->PenumbraTolerance);
  occlusion->SetRadiusUnit(vtkPenumbraTemporalSSAOPass::WORLD);
  occlusion->SetRadius(this->OcclusionRadius * diagonal);
  occlusion->SetMargin(
    0.0); // What lies beyond the border is not known of composited pictures either.
  occlusion->SetStrength(this->OcclusionStrength);
  occlusion->SetKernelName(this->OcclusionKernel.c_str());
  occlusion->SetConvergeInOneRender(
    interactive ? vtkPenumbraTemporalSSAOPass::NEVER : vtkPenumbraTemporalSSAOPass::ALWAYS);

  vtkPenumbraLightShaftPass* shafts = pass->Shafts;
  shafts->SetTolerance(this->PenumbraTolerance);
  shafts->SetMargin(0.0);
  shafts->SetScattering(this->ShaftDensity / diagonal);
  shafts->SetExposure(this->ShaftExposure);
  shafts->SetThickness(this->ShaftThickness * diagonal);
  shafts->RemoveAllLights();
  shafts->AddLight(
    this->Implementation->Sun); // Without any, lights that follow the camera would do.
  for (vtkLight* light : vtk::Range(this->GetRenderer()->GetLights()))
  {
    if (light->LightTypeIsSceneLight())
    {
      shafts->AddLight(light);
    }
  }

  vtkPenumbraRayCaster* caster = pass->Caster;
  caster->SetAmbientOcclusion(this->AmbientOcclusion);
  caster->SetAmbientOcclusionRadius(this->OcclusionRadius * diagonal);
  caster->SetAmbientOcclusionStrength(this->OcclusionStrength);
  this->Implementation->Medium->SetScattering(this->ShaftDensity / diagonal);
  caster->SetMedium(this->LightShafts ? this->Implementation->Medium.Get() : nullptr);
  caster->SetShadows(this->LightShafts);
}

bool vtkPenumbraRenderView::UsesOrderedCompositing()
{
  auto* controller = vtkMultiProcessController::GetGlobalController();
  const bool composited = this->SynchronizedRenderers->GetEnabled() && controller &&
    controller->GetNumberOfProcesses() > 1;
  if (!composited || !this->GetUseOrderedCompositing())
  {
    return false;
  }
  this->WarnOnce(
    "Volumes or translucent surfaces are put together from several ranks, without depths: "
    "ambient occlusion and light shafts are left out.");
  return true;
}

void vtkPenumbraRenderView::WarnOnce(const char* text)
{
  if (this->Implementation->Told.insert(text).second)
  {
    vtkWarningMacro(<< text);
  }
}

void vtkPenumbraRenderView::AboutToRenderOnLocalProcess(bool interactive)
{
  this->Superclass::AboutToRenderOnLocalProcess(interactive);
  this->UpdateSunLight();
  this->Configure(interactive);
  penumbra::RenderViewPass* pass = this->Implementation->Pass;
  vtkImageProcessingPass* present = this->SynchronizedRenderers->GetImageProcessingPass();
  const bool hasWork = pass->UseOcclusion || pass->UseShafts || pass->UseRays;
  if (hasWork && present && present != pass)
  {
    this->WarnOnce("Tone mapping is on: ambient occlusion and light shafts are left out.");
    return;
  }
  // Where pictures of several ranks are put together, one of them gets the result.
  auto* controller = vtkMultiProcessController::GetGlobalController();
  const bool shows = !controller || controller->GetLocalProcessId() == 0;
  const bool wanted =
    hasWork && shows && !this->UsesOrderedCompositing() && !this->GetMakingSelection();
  if (wanted && !this->SynchronizedRenderers->GetEnabled())
  {
    // Edges are smoothed once, when the pass is done: what ParaView does after putting pictures together.
    this->GetRenderer()->SetUseFXAA(false);
  }
  this->SynchronizedRenderers->SetUseDepthBuffer(wanted);
  this->SynchronizedRenderers->SetImageProcessingPass(wanted ? pass : nullptr);
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
  os << indent << "ShaftExposure: " << this->ShaftExposure << "\n";
  os << indent << "ShaftThickness: " << this->ShaftThickness << "\n";
  os << indent << "SunDirection: " << this->SunDirection[0] << ", " << this->SunDirection[1] << ", "
     << this->SunDirection[2] << "\n";
  os << indent << "SunIntensity: " << this->SunIntensity << "\n";
  os << indent << "StillByRays: " << this->StillByRays << "\n";
}
