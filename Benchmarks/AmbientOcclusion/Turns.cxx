// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "Benchmark.h"
#include "FrameTimes.h"
#include "Reprojection.h"

#include "vtkCamera.h"

#include <cmath>
#include <string>
#include <vector>

namespace penumbra
{

namespace
{

/// Size of the window, in pixels.
constexpr int Size[2] = { 320, 224 };

/// Camera movement per frame, in degrees.
constexpr double Turns[] = { 1.0, 2.0, 4.0, 8.0, 15.0 };

/// Frames until the history of the pixels does not depend on the first one, and frames that are timed and followed.
/// The last of them is compared with its limit.
constexpr int HistoryFrames = 12;
constexpr int Rounds = 9;

/// Tolerance of the image to which the pass converges at a camera.
constexpr double LimitTolerance = 4e-3;

/// A window that shows a scene of its own, and the times of its frames.
struct TurningWindow
{
  explicit TurningWindow(const OcclusionTestScene& scene)
    : Renderer(scene.Renderer),
      View(scene.Renderer, Size[0], Size[1])
  {
  }

  void Turn(double degrees)
  {
    this->Renderer->GetActiveCamera()->Azimuth(degrees);
    this->Renderer->ResetCameraClippingRange();
    this->Seconds.push_back(this->View.Draw());
  }

  vtkSmartPointer<vtkRenderer> Renderer;
  OcclusionWindow View;
  std::vector<double> Seconds; ///< of the frames
};

}

void MeasureTurns(OcclusionBenchmark& benchmark)
{
  using Pass = vtkPenumbraTemporalSSAOPass;
  const std::vector<OcclusionTestScene> scenes[3] = { benchmark.Scenes(), benchmark.Scenes(),
    benchmark.Scenes() };
  for (std::size_t index = 0; index < scenes[0].size(); ++index)
  {
    const OcclusionTestScene& scene = scenes[0][index];
    TurningWindow plain(scene);
    TurningWindow march(scenes[1][index]);
    TurningWindow peer(scenes[2][index]);
    Pass* const pass = march.View.UsePenumbraPass(scene.Radius);
    pass->SetKernelName("march");
    peer.View.UseVTKSSAOPass(scene.Radius, 32);
    for (const double degrees : Turns)
    {
      pass->SetConvergeInOneRender(Pass::NEVER);
      Reprojection followed(Size[0], Size[1]);
      for (int frame = 0; frame < HistoryFrames + Rounds; ++frame)
      {
        for (TurningWindow* window : { &plain, &march, &peer })
        {
          if (frame == HistoryFrames)
          {
            window->Seconds.clear();
          }
          window->Turn(degrees);
        }
        if (frame >= HistoryFrames)
        {
          followed.Add(march.Renderer->GetActiveCamera(), march.View.Array("AmbientOcclusion"),
            march.View.Array("Depth"));
        }
      }
      const std::vector<float> moving = march.View.Array("AmbientOcclusion");
      const double tolerance = pass->GetTolerance();
      pass->SetTolerance(LimitTolerance);
      pass->SetConvergeInOneRender(Pass::ALWAYS);
      march.View.Draw();
      pass->SetTolerance(tolerance);
      const std::vector<float> limit = march.View.Array("AmbientOcclusion");
      const std::vector<float> depth = march.View.Array("Depth");
      double squares = 0.0;
      double pixels = 0.0;
      for (std::size_t i = 0; i < moving.size(); ++i)
      {
        squares += std::isfinite(depth[i]) ? std::pow(moving[i] - limit[i], 2.0) : 0.0;
        pixels += std::isfinite(depth[i]);
      }
      const std::string name =
        scene.Name + ", " + std::to_string(static_cast<int>(degrees)) + " degrees a frame";
      ResultTable& table = benchmark.Results;
      table.Add(
        name, "RMSE of march, against its limit", std::sqrt(squares / pixels), TargetKind::None);
      table.Add(name, "standard deviation at points of the surface", followed.StandardDeviation(),
        TargetKind::None);
      table.Add(name, "march / vtkSSAOPass 32",
        MedianOverhead(march.Seconds, plain.Seconds) / MedianOverhead(peer.Seconds, plain.Seconds),
        TargetKind::None);
    }
  }
}

}
