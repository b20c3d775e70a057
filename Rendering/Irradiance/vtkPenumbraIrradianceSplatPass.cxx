// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkPenumbraIrradianceSplatPass.h"

#include "Chain/PassSlots.h"
#include "Frame/BackgroundDepth.h"
#include "Frame/Composite.h"
#include "Frame/EyeDepth.h"
#include "Frame/Uniforms.h"
#include "Records/RecordPolyData.h"
#include "SceneCoordinates.h"
#include "Splats/RecordSplatter.h"
#include "Statistics/Statistics.h"

#include "vtkDataArray.h"
#include "vtkFieldData.h"
#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkMath.h"
#include "vtkObjectFactory.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkPenumbraSplatResolveFS.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkRenderState.h"
#include "vtkRenderer.h"
#include "vtkShaderProgram.h"

vtkStandardNewMacro(vtkPenumbraIrradianceSplatPass);

namespace
{

using namespace penumbra;
using Pass = vtkPenumbraIrradianceSplatPass;

/// Maximum angle between the normals of a record and of a surface that uses it, degrees [IC].
constexpr double DefaultNormalAngle = 9.0;

vtkSmartPointer<vtkFloatArray> NewArray(const char* name, int components, std::size_t count)
{
  auto array = vtkSmartPointer<vtkFloatArray>::New();
  array->SetName(name);
  array->SetNumberOfComponents(components);
  array->SetNumberOfTuples(static_cast<vtkIdType>(count));
  return array;
}

}

struct vtkPenumbraIrradianceSplatPass::Internals
{
  vtkSmartPointer<vtkPolyData> Records;
  vtkMTimeType ReadTime = 0;
  bool HasIrradiance = false;
  double NormalAngle = DefaultNormalAngle;

  DelegateImage Image;
  EyeDepth Depth;
  RecordSplatter Splats;
  Stage Resolve;
  penumbra::Composite Composite;
  vtkSmartPointer<vtkTextureObject> Means;
  vtkSmartPointer<vtkTextureObject> Result; ///< occlusion, or the lit color
  vtkNew<vtkFieldData> Statistics;
  bool Drawn = false;
};

vtkPenumbraIrradianceSplatPass::vtkPenumbraIrradianceSplatPass()
  : Implementation(std::make_unique<Internals>())
{
}

vtkPenumbraIrradianceSplatPass::~vtkPenumbraIrradianceSplatPass() = default;

Pass* vtkPenumbraIrradianceSplatPass::AddTo(vtkRenderer* renderer)
{
  return AddPass<Pass>(renderer, [](const std::vector<PassSlot>& slots) { return slots.back(); });
}

void vtkPenumbraIrradianceSplatPass::RemoveFrom(vtkRenderer* renderer)
{
  if (Pass* pass = FindPassOf<Pass>(FindPassSlots(renderer)))
  {
    RemovePass(renderer, pass);
  }
}

void vtkPenumbraIrradianceSplatPass::SetRecords(vtkPolyData* records)
{
  if (this->Implementation->Records != records)
  {
    this->Implementation->Records = records;
    this->Implementation->ReadTime = 0;
    this->Modified();
  }
}

vtkPolyData* vtkPenumbraIrradianceSplatPass::GetRecords()
{
  return this->Implementation->Records;
}

bool vtkPenumbraIrradianceSplatPass::ReadRecords()
{
  Internals& internals = *this->Implementation;
  if (!internals.Records)
  {
    return false;
  }
  if (internals.ReadTime != internals.Records->GetMTime())
  {
    internals.ReadTime = internals.Records->GetMTime();
    internals.HasIrradiance = HasRecords(internals.Records, Quantities::Irradiance);
    SceneCoordinates frame; // world units, with the origin at the center of the records
    double center[3] = { 0.0, 0.0, 0.0 };
    if (internals.Records->GetNumberOfPoints() > 0)
    {
      internals.Records->GetCenter(center);
    }
    frame.Origin = { center[0], center[1], center[2] };
    std::string problem;
    internals.Splats.SetRecords(
      FromPolyData(internals.Records,
        internals.HasIrradiance ? Quantities::Irradiance : Quantities::Occlusion, frame, problem),
      frame.Origin, internals.HasIrradiance ? 3 : 1);
    if (!problem.empty())
    {
      vtkWarningMacro("The irradiance records are not rendered: " << problem << ".");
    }
    vtkDataArray* angle = internals.Records->GetFieldData()->GetArray("NormalAngle");
    const double stored =
      angle && angle->GetNumberOfTuples() == 1 ? angle->GetComponent(0, 0) : 0.0;
    internals.NormalAngle = stored > 0.0 && stored <= 90.0 ? stored : DefaultNormalAngle;
  }
  return internals.Splats.GetNumberOfRecords() > 0;
}

bool vtkPenumbraIrradianceSplatPass::RenderEffect(const vtkRenderState* state)
{
  this->Implementation->Drawn = this->ReadRecords() && this->RenderSplats(state);
  return this->Implementation->Drawn;
}

bool vtkPenumbraIrradianceSplatPass::RenderSplats(const vtkRenderState* state)
{
  Internals& internals = *this->Implementation;
  vtkOpenGLRenderWindow* window = this->EnterWindow(state->GetRenderer());
  const int margin[2] = { 0, 0 };
  const int props =
    window ? internals.Image.Draw(state, this->DelegatePass, margin, internals.HasIrradiance) : -1;
  if (props < 0 ||
    internals.Depth.Update(window, internals.Image, internals.Image.GetView()) ==
      EyeDepth::Change::Failed)
  {
    return false;
  }
  const ScreenTransform& view = internals.Image.GetView();
  Allocate(internals.Means, window, view.Width, view.Height, 4);
  Allocate(internals.Result, window, view.Width, view.Height, 4);
  const double angle = this->NormalAngle > 0.0 ? this->NormalAngle : internals.NormalAngle;
  if (!internals.Splats.Draw(window, internals.Image, internals.Depth.GetCurrent(),
        static_cast<float>(vtkMath::RadiansFromDegrees(angle)), internals.Means))
  {
    return false;
  }
  {
    vtkShaderProgram* program = internals.Resolve.Ready(window, vtkPenumbraSplatResolveFS);
    const ScopedRenderTarget target(window, internals.Image.GetFramebuffer(), { internals.Result });
    if (!program || !target.IsComplete())
    {
      return false;
    }
    SetPixelSize(program, "pixelSize", view.Width, view.Height);
    program->SetUniformf("light", internals.HasIrradiance ? 1.f : 0.f);
    program->SetUniformf("strength", static_cast<float>(this->Strength));
    internals.Resolve.BindTexture("means", internals.Means);
    internals.Resolve.BindTexture(
      "colors", internals.HasIrradiance ? internals.Image.GetColor() : internals.Means.Get());
    internals.Resolve.Draw();
  }
  this->NumberOfRenderedProps = props;
  return internals.Composite.Draw(window, internals.Image, internals.Depth,
    internals.HasIrradiance ? internals.Result.Get() : internals.Image.GetColor(),
    internals.HasIrradiance ? nullptr : internals.Result.Get(),
    { internals.HasIrradiance ? 0.0 : this->Strength, 0.0 }, !this->OpaqueOnly);
}

void vtkPenumbraIrradianceSplatPass::CopyResult(vtkImageData* image)
{
  Internals& internals = *this->Implementation;
  if (!image)
  {
    vtkErrorMacro("CopyResult() needs an image, got null.");
    return;
  }
  image->Initialize();
  if (!internals.Drawn)
  {
    return;
  }
  this->GetWindow()->MakeCurrent();
  const std::vector<float> means = ReadBack(internals.Means);
  const std::size_t pixels = means.size() / 4;
  const ScreenTransform& view = internals.Image.GetView();
  image->SetDimensions(view.Width, view.Height, 1);
  const int channels = internals.HasIrradiance ? 3 : 1;
  const float factor = internals.HasIrradiance ? static_cast<float>(vtkMath::Pi()) : 1.f;
  const auto values =
    NewArray(internals.HasIrradiance ? "Irradiance" : "AmbientOcclusion", channels, pixels);
  const auto weights = NewArray("Weight", 1, pixels);
  for (std::size_t i = 0; i < pixels; ++i)
  {
    for (int c = 0; c < channels; ++c)
    {
      const float value = means[4 * i + c];
      values->SetTypedComponent(static_cast<vtkIdType>(i), c,
        internals.HasIrradiance ? factor * value : std::min(value, 1.f));
    }
    weights->SetValue(static_cast<vtkIdType>(i), means[4 * i + 3]);
  }
  image->GetPointData()->AddArray(values);
  image->GetPointData()->AddArray(weights);
}

vtkFieldData* vtkPenumbraIrradianceSplatPass::GetStatistics()
{
  Internals& internals = *this->Implementation;
  internals.Statistics->Initialize();
  if (internals.Drawn)
  {
    this->GetWindow()->MakeCurrent();
    const std::vector<float> means = ReadBack(internals.Means);
    const std::vector<float> depths = ReadBack(internals.Depth.GetCurrent());
    double surface = 0.0;
    double covered = 0.0;
    for (std::size_t i = 0; i < depths.size(); ++i)
    {
      surface += depths[i] < BackgroundDepth ? 1.0 : 0.0;
      covered += means[4 * i + 3] > 0.f ? 1.0 : 0.0;
    }
    AddStatistic(internals.Statistics, "Cache/Records",
      static_cast<double>(internals.Splats.GetNumberOfRecords()));
    AddStatistic(internals.Statistics, "Pixels/Interpolated", covered / std::max(surface, 1.0));
    const auto invalid =
      static_cast<double>(internals.Splats.CountInvalidPixels(internals.Image.GetView()));
    AddStatistic(internals.Statistics, "Pixels/Invalid", invalid / std::max(surface, 1.0));
  }
  return internals.Statistics;
}

void vtkPenumbraIrradianceSplatPass::ReleaseGraphicsResources(vtkWindow* window)
{
  this->Superclass::ReleaseGraphicsResources(window);
  Internals& internals = *this->Implementation;
  internals.Image.ReleaseGraphicsResources(window);
  internals.Depth.ReleaseGraphicsResources(window);
  internals.Splats.ReleaseGraphicsResources(window);
  internals.Resolve.ReleaseGraphicsResources(window);
  internals.Composite.ReleaseGraphicsResources(window);
  Release(window, internals.Means, internals.Result);
  internals.Drawn = false;
}

void vtkPenumbraIrradianceSplatPass::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Records: " << this->GetRecords() << "\n";
  os << indent << "NormalAngle: " << this->NormalAngle << "\n";
  os << indent << "Strength: " << this->Strength << "\n";
}
