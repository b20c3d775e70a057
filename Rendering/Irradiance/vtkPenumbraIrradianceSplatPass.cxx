// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkPenumbraIrradianceSplatPass.h"

#include "Chain/PassSlots.h"
#include "Frame/Composite.h"
#include "Frame/EyeDepth.h"
#include "Frame/PassStatistics.h"
#include "Records/RecordPolyData.h"
#include "Scene.h"
#include "Splats/RecordSplatter.h"

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

/// [IC]'s, degrees.
constexpr double UsualNormalAngle = 9.0;

/// Eye depths beyond this are empty pixels: vtkPenumbraViewLib.glsl.
constexpr float FarAway = 1e17f;

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
  bool OfLight = false;
  double NormalAngle = UsualNormalAngle;

  DelegateImage Image;
  EyeDepth Depth;
  RecordSplatter Splats;
  Stage Resolve;
  penumbra::Composite Composite;
  vtkSmartPointer<vtkTextureObject> Means;
  vtkSmartPointer<vtkTextureObject> Result; ///< occlusion, or the colour that light gives
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
  if (!renderer)
  {
    vtkGenericWarningMacro("There is no renderer to add the pass to.");
    return nullptr;
  }
  if (Pass* present = FindPassOf<Pass>(FindPassSlots(renderer)))
  {
    return present;
  }
  const PassSlot place = EnsurePassSlots(renderer).back();
  vtkNew<Pass> pass;
  pass->SetDelegatePass(place.Pass);
  pass->SetOpaqueOnly(place.OpaqueOnly);
  place.Set(pass);
  return pass;
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
  Internals& own = *this->Implementation;
  if (!own.Records)
  {
    return false;
  }
  if (own.ReadTime != own.Records->GetMTime())
  {
    own.ReadTime = own.Records->GetMTime();
    own.OfLight = HasRecords(own.Records, Quantities::Irradiance);
    Scene frame; // that the records are read into: world units, near its origin
    double center[3] = { 0.0, 0.0, 0.0 };
    if (own.Records->GetNumberOfPoints() > 0)
    {
      own.Records->GetCenter(center);
    }
    frame.Origin = { center[0], center[1], center[2] };
    frame.Scale = 1.0;
    std::string problem;
    own.Splats.SetRecords(
      FromPolyData(
        own.Records, own.OfLight ? Quantities::Irradiance : Quantities::Occlusion, frame, problem),
      frame.Origin, own.OfLight ? 3 : 1);
    if (!problem.empty())
    {
      vtkWarningMacro("Records are not drawn: " << problem << ".");
    }
    vtkDataArray* angle = own.Records->GetFieldData()->GetArray("NormalAngle");
    const double told = angle && angle->GetNumberOfTuples() == 1 ? angle->GetComponent(0, 0) : 0.0;
    own.NormalAngle = told > 0.0 && told <= 90.0 ? told : UsualNormalAngle;
  }
  return own.Splats.GetNumberOfRecords() > 0;
}

bool vtkPenumbraIrradianceSplatPass::RenderEffect(const vtkRenderState* state)
{
  this->Implementation->Drawn = this->ReadRecords() && this->RenderSplats(state);
  return this->Implementation->Drawn;
}

bool vtkPenumbraIrradianceSplatPass::RenderSplats(const vtkRenderState* state)
{
  Internals& own = *this->Implementation;
  vtkOpenGLRenderWindow* window = this->EnterWindow(state->GetRenderer());
  const int margin[2] = { 0, 0 };
  const int props = window ? own.Image.Draw(state, this->DelegatePass, margin, own.OfLight) : -1;
  if (props < 0 ||
    own.Depth.Update(window, own.Image, own.Image.GetView()) == EyeDepth::Change::Failed)
  {
    return false;
  }
  const ScreenTransform& view = own.Image.GetView();
  Allocate(own.Means, window, view.Width, view.Height, 4);
  Allocate(own.Result, window, view.Width, view.Height, 4);
  const double angle = this->NormalAngle > 0.0 ? this->NormalAngle : own.NormalAngle;
  if (!own.Splats.Draw(window, own.Image, own.Depth.GetCurrent(),
        static_cast<float>(vtkMath::RadiansFromDegrees(angle)), own.Means))
  {
    return false;
  }
  {
    vtkShaderProgram* program = own.Resolve.Ready(window, vtkPenumbraSplatResolveFS);
    const ScopedRenderTarget into(window, own.Image.GetFramebuffer(), { own.Result });
    if (!program || !into.IsComplete())
    {
      return false;
    }
    const float pixelSize[2] = { 1.f / static_cast<float>(view.Width),
      1.f / static_cast<float>(view.Height) };
    program->SetUniform2f("pixelSize", pixelSize);
    program->SetUniformf("light", own.OfLight ? 1.f : 0.f);
    program->SetUniformf("strength", static_cast<float>(this->Strength));
    own.Resolve.BindTexture("means", own.Means);
    own.Resolve.BindTexture("colors", own.OfLight ? own.Image.GetColor() : own.Means.Get());
    own.Resolve.Draw();
  }
  this->NumberOfRenderedProps = props;
  return own.Composite.Draw(window, own.Image, own.Depth,
    own.OfLight ? own.Result.Get() : own.Image.GetColor(), own.OfLight ? nullptr : own.Result.Get(),
    { own.OfLight ? 0.0 : this->Strength, 0.0 }, !this->OpaqueOnly);
}

void vtkPenumbraIrradianceSplatPass::CopyResult(vtkImageData* image)
{
  Internals& own = *this->Implementation;
  if (!image)
  {
    vtkErrorMacro("There is no image to copy to.");
    return;
  }
  image->Initialize();
  if (!own.Drawn)
  {
    return;
  }
  this->GetWindow()->MakeCurrent();
  const std::vector<float> means = ReadBack(own.Means);
  const std::size_t pixels = means.size() / 4;
  const ScreenTransform& view = own.Image.GetView();
  image->SetDimensions(view.Width, view.Height, 1);
  const int channels = own.OfLight ? 3 : 1;
  const float unit = own.OfLight ? static_cast<float>(vtkMath::Pi()) : 1.f;
  const auto values = NewArray(own.OfLight ? "Irradiance" : "AmbientOcclusion", channels, pixels);
  const auto weights = NewArray("Weight", 1, pixels);
  for (std::size_t i = 0; i < pixels; ++i)
  {
    for (int c = 0; c < channels; ++c)
    {
      const float value = means[4 * i + c];
      values->SetTypedComponent(
        static_cast<vtkIdType>(i), c, own.OfLight ? unit * value : std::min(value, 1.f));
    }
    weights->SetValue(static_cast<vtkIdType>(i), means[4 * i + 3]);
  }
  image->GetPointData()->AddArray(values);
  image->GetPointData()->AddArray(weights);
}

vtkFieldData* vtkPenumbraIrradianceSplatPass::GetStatistics()
{
  Internals& own = *this->Implementation;
  own.Statistics->Initialize();
  if (own.Drawn)
  {
    this->GetWindow()->MakeCurrent();
    const std::vector<float> means = ReadBack(own.Means);
    const std::vector<float> depths = ReadBack(own.Depth.GetCurrent());
    double surface = 0.0;
    double served = 0.0;
    for (std::size_t i = 0; i < depths.size(); ++i)
    {
      surface += depths[i] < FarAway ? 1.0 : 0.0;
      served += means[4 * i + 3] > 0.f ? 1.0 : 0.0;
    }
    AddStatistic(
      own.Statistics, "Cache/Records", static_cast<double>(own.Splats.GetNumberOfRecords()));
    AddStatistic(own.Statistics, "Pixels/Interpolated", served / std::max(surface, 1.0));
  }
  return own.Statistics;
}

void vtkPenumbraIrradianceSplatPass::ReleaseGraphicsResources(vtkWindow* window)
{
  this->Superclass::ReleaseGraphicsResources(window);
  Internals& own = *this->Implementation;
  own.Image.ReleaseGraphicsResources(window);
  own.Depth.ReleaseGraphicsResources(window);
  own.Splats.ReleaseGraphicsResources(window);
  own.Resolve.ReleaseGraphicsResources(window);
  own.Composite.ReleaseGraphicsResources(window);
  for (vtkSmartPointer<vtkTextureObject>* texture : { &own.Means, &own.Result })
  {
    if (*texture)
    {
      (*texture)->ReleaseGraphicsResources(window);
      *texture = nullptr;
    }
  }
  own.Drawn = false;
}

void vtkPenumbraIrradianceSplatPass::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Records: " << this->GetRecords() << "\n";
  os << indent << "NormalAngle: " << this->NormalAngle << "\n";
  os << indent << "Strength: " << this->Strength << "\n";
}
