// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkPenumbraKernelEstimator.h"

#include "Frame/EyeDepth.h"
#include "Frame/ScreenSpaceConstants.h"
#include "Frame/Stage.h"
#include "Occlusion/Thickness.h"
#include "vtkPenumbraEstimateFS.h"
#include "vtkPenumbraEstimateLib.h"
#include "vtkPenumbraHemisphereLib.h"
#include "vtkPenumbraHistoryLengthLib.h"
#include "vtkPenumbraKernels.h"
#include "vtkPenumbraMotionQualityLib.h"
#include "vtkPenumbraStaticQualityLib.h"
#include "vtkPenumbraSurfaceLib.h"
#include "vtkPenumbraViewLib.h"

#include "vtkObjectFactory.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkPixelBufferObject.h"
#include "vtkShaderProgram.h"
#include "vtkSmartPointer.h"
#include "vtkTextureObject.h"

#include <algorithm>
#include <map>

vtkStandardNewMacro(vtkPenumbraKernelEstimator);

namespace
{

/// Maximum number of points of the sequence per draw: the size of the array in
/// vtkPenumbraEstimateFS.glsl.
constexpr int MaximumPoints = 64;

/// Indices at which the additional points for pixels with a short history and the points for pixels
/// with a settled one start; other indices are smaller (see SequenceLength in
/// OcclusionViewState.cxx).
constexpr long long ExtraSection = 1LL << 20;
constexpr long long SettledSection = 1LL << 28;

/// Mirrors the digits of a number at the radix point (Halton sequence) [TSSAO].
double RadicalInverse(int base, long long number)
{
  double inverse = 0.0;
  double digit = 1.0 / base;
  for (; number > 0; number /= base, digit /= base)
  {
    inverse += static_cast<double>(number % base) * digit;
  }
  return inverse;
}

/// Points of the sequence for a frame.
struct Points
{
  long long First;        ///< number of points of earlier frames
  int Count;              ///< per pixel
  int ShortHistoryCount;  ///< the same at pixels with a short history, at least Count
  long long SettledFirst; ///< number of earlier points of a pixel with a settled history
  int SettledCount;       ///< number of points for such pixels; 0: they use the same as others
};

/// Sets the points. Additional points for a short history are taken from another section, so that
/// the next frame does not repeat them. Points for a settled history follow in the array.
void SetPoints(vtkShaderProgram* program, const Points& points)
{
  constexpr int bases[4] = { 2, 3, 5, 7 };
  const long long firstExtra =
    ExtraSection + points.First / points.Count * (points.ShortHistoryCount - points.Count);
  float values[MaximumPoints][4] = {};
  for (int i = 0; i < points.ShortHistoryCount + points.SettledCount; ++i)
  {
    long long index = i < points.Count ? points.First + i : firstExtra + i - points.Count;
    if (i >= points.ShortHistoryCount)
    {
      index = SettledSection + points.SettledFirst + i - points.ShortHistoryCount;
    }
    for (int axis = 0; axis < 4; ++axis)
    {
      values[i][axis] = static_cast<float>(RadicalInverse(bases[axis], index + 1));
    }
  }
  program->SetUniform4fv("samples", MaximumPoints, values);
  program->SetUniformi("sampleCount", points.Count);
  program->SetUniformi("shortHistoryPointCount", points.ShortHistoryCount);
  program->SetUniformi("settledFirstPoint", points.SettledCount > 0 ? points.ShortHistoryCount : 0);
}

}

struct vtkPenumbraKernelEstimator::Internals
{
  /// Estimates of a view that rests, and of one that turns fast.
  struct Quality
  {
    penumbra::Stage Stage;
    std::string Source;
  };
  Quality Static;
  Quality Motion;
  struct Measurement
  {
    penumbra::GradualThickness Thickness;
    long long Version = -1;                        ///< of the depths of the last request
    bool IsExact = false;                          ///< these depths were measured
    int Frames = 0;                                ///< since the measurement
    vtkSmartPointer<vtkPixelBufferObject> Pending; ///< depths on their way from the graphics card
    penumbra::ScreenTransform PendingView;
  };

  static double ThicknessOf(const std::vector<float>& depths, const penumbra::ScreenTransform& view)
  {
    const double width = penumbra::MedianWidth(depths, view);
    return width > 0.0 ? std::clamp(penumbra::ThicknessToWidthRatio * width,
                           penumbra::MinimumThickness, penumbra::MaximumThickness)
                       : 1.0;
  }
  std::map<const penumbra::EyeDepth*, Measurement> Thicknesses;
};

vtkPenumbraKernelEstimator::vtkPenumbraKernelEstimator()
  : Implementation(std::make_unique<Internals>())
{
}

vtkPenumbraKernelEstimator::~vtkPenumbraKernelEstimator() = default;

void vtkPenumbraKernelEstimator::SetKernel(int kernel)
{
  if (!vtkPenumbraKernels::GetName(kernel))
  {
    vtkErrorMacro("Kernel index " << kernel << " is invalid; it must be in [0, "
                                  << vtkPenumbraKernels::GetNumberOfKernels() - 1 << "].");
  }
  else if (kernel != this->Kernel)
  {
    this->Kernel = kernel;
    this->Implementation->Static.Source.clear();
    this->Implementation->Motion.Source.clear();
    this->Modified();
  }
}

double vtkPenumbraKernelEstimator::GetBias()
{
  return vtkPenumbraKernels::GetBias(this->Kernel);
}

double vtkPenumbraKernelEstimator::ComputeThickness(const Request& request)
{
  if (this->Thickness > 0.0)
  {
    return this->Thickness;
  }
  const penumbra::EyeDepth& depth = *request.Depth;
  Internals::Measurement& state = this->Implementation->Thicknesses[&depth];
  // Neither the limit of a static view nor a frame without history depends on the motion before it.
  const bool isExact = !request.Moving || request.FirstSample == 0;
  if (state.Version == depth.GetVersion() && (state.IsExact || !isExact))
  {
    return state.Thickness.Get();
  }
  state.IsExact = isExact || state.Version < 0;
  state.Version = depth.GetVersion();
  ++state.Frames;
  state.Thickness.Advance();
  if (state.IsExact)
  {
    state.Thickness.Set(
      Internals::ThicknessOf(penumbra::ReadBack(depth.GetCurrent()), depth.GetView()));
    state.Pending = nullptr;
    state.Frames = 0;
  }
  else if (state.Pending && state.Frames >= penumbra::FramesUntilThickness)
  {
    unsigned int size[2] = { static_cast<unsigned int>(state.PendingView.Width),
      static_cast<unsigned int>(state.PendingView.Height) };
    std::vector<float> depths(static_cast<std::size_t>(size[0]) * size[1]);
    vtkIdType increments[2] = { 0, 0 };
    state.Pending->Download2D(VTK_FLOAT, depths.data(), size, 1, increments);
    state.Pending = nullptr;
    state.Thickness.Approach(Internals::ThicknessOf(depths, state.PendingView));
  }
  else if (!state.Pending && state.Frames >= penumbra::FramesPerThickness)
  {
    state.Pending.TakeReference(depth.GetCurrent()->Download());
    state.PendingView = depth.GetView();
    state.Frames = 0;
  }
  return state.Thickness.Get();
}

std::string vtkPenumbraKernelEstimator::GetShader()
{
  return penumbra::Assemble(vtkPenumbraEstimateLib,
    { { "Kernel", vtkPenumbraKernels::GetShader(this->Kernel) },
      { "HemisphereLib", vtkPenumbraHemisphereLib },
      { "HistoryLengthLib", vtkPenumbraHistoryLengthLib } });
}

int vtkPenumbraKernelEstimator::SetUniforms(const Request& request, vtkShaderProgram* program)
{
  const int fetches = vtkPenumbraKernels::GetFetchesPerPoint(this->Kernel);
  const bool takesTurns = request.Turns > 1;
  const int maximum = takesTurns ? MaximumPoints / 2 : MaximumPoints;
  const int points = std::clamp(request.Samples / fetches, 1, maximum);
  const int settledPoints = takesTurns ? points : 0;
  const int shortHistoryPoints =
    std::clamp(request.ShortHistorySamples / fetches, points, MaximumPoints - settledPoints);
  SetPoints(program,
    { request.FirstSample / fetches, points, shortHistoryPoints,
      request.SettledFirstSample / fetches, settledPoints });
  program->SetUniformf("turns", static_cast<float>(request.Turns));
  program->SetUniformf("turn", static_cast<float>(request.Turn));
  program->SetUniformf("samplesPerPoint", static_cast<float>(fetches));
  program->SetUniformf("pixelRotation", request.RotatePerPixel ? 1.f : 0.f);
  if (program->IsUniformUsed("thickness"))
  {
    program->SetUniformf("thickness", static_cast<float>(this->ComputeThickness(request)));
  }
  return points * fetches;
}

int vtkPenumbraKernelEstimator::Estimate(const Request& request, vtkTextureObject* target)
{
  Internals::Quality& state =
    request.Moving ? this->Implementation->Motion : this->Implementation->Static;
  if (state.Source.empty())
  {
    state.Source = penumbra::Assemble(vtkPenumbraEstimateFS,
      { { "ViewLib", vtkPenumbraViewLib }, { "SurfaceLib", vtkPenumbraSurfaceLib },
        { "EstimateLib", this->GetShader() },
        { "QualityLib",
          request.Moving ? vtkPenumbraMotionQualityLib : vtkPenumbraStaticQualityLib } });
  }
  vtkShaderProgram* program = state.Stage.Ready(request.Window, state.Source);
  const penumbra::ScopedRenderTarget renderTarget(
    request.Window, request.Image->GetFramebuffer(), { target }, request.Image->GetDepth());
  if (!program || !renderTarget.IsComplete())
  {
    return 0;
  }
  request.Depth->GetView().SetUniforms(program);
  const int samples = this->SetUniforms(request, program);
  state.Stage.BindTexture("eyeDepths", request.Depth->GetCurrent());
  if (request.Parts)
  {
    state.Stage.Draw(*request.Parts);
  }
  else
  {
    state.Stage.Draw();
  }
  return samples;
}

void vtkPenumbraKernelEstimator::ReleaseGraphicsResources(vtkWindow* window)
{
  this->Implementation->Thicknesses.clear();
  this->Implementation->Static.Stage.ReleaseGraphicsResources(window);
  this->Implementation->Motion.Stage.ReleaseGraphicsResources(window);
}

void vtkPenumbraKernelEstimator::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Kernel: " << vtkPenumbraKernels::GetName(this->Kernel) << "\n";
  os << indent << "Thickness: " << this->Thickness << "\n";
}
