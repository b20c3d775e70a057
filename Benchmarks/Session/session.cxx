// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// A window that is used as a person would: each frame is compared with a still image of the same view, and written
// next to it. Run it with `./penumbra benchmark session`.
#include "Program.h"
#include "SessionWindow.h"

#include "vtkActor.h"
#include "vtkCamera.h"
#include "vtkCommand.h"
#include "vtkImageData.h"
#include "vtkPNGWriter.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace
{

using namespace penumbra;

/// Difference of a channel from which on a pixel is off, of 255: 0.1.
constexpr int Off = 26;

/// What a person does in a number of frames, before the window is left alone until its image is final.
struct Motion
{
  std::string Name;
  int Frames;
  std::function<void(SessionWindow&, int)> Step; ///< changes the view and renders a frame
};

void MoveCamera(SessionWindow& window, const double (&position)[3], const double (&focalPoint)[3])
{
  vtkCamera* camera = window.Renderer->GetActiveCamera();
  camera->SetPosition(position);
  camera->SetFocalPoint(focalPoint);
  window.Renderer->ResetCameraClippingRange();
  window.Draw();
}

void Turn(SessionWindow& window, double degrees)
{
  window.Renderer->GetActiveCamera()->Azimuth(degrees);
  window.Renderer->ResetCameraClippingRange();
  window.Draw();
}

void Resize(SessionWindow& window, int width, int height)
{
  window.Window->SetSize(width, height);
  window.Draw();
}

void Drag(SessionWindow& window, int frame)
{
  const unsigned long event = frame == 0 ? vtkCommand::LeftButtonPressEvent
    : frame == 9                         ? vtkCommand::LeftButtonReleaseEvent
                                         : vtkCommand::MouseMoveEvent;
  const int step = std::min(frame, 8);
  window.Send(event, 210 + 8 * step, 160 + 2 * step);
}

void PassClosely(SessionWindow& window, int frame)
{
  const double x = 0.12 * frame - 1.5;
  MoveCamera(window, { x, -2.6, 0.7 }, { x, 0.0, 0.6 });
}

void TurnInStereo(SessionWindow& window, int frame)
{
  window.Window->SetStereoTypeToAnaglyph();
  window.Window->SetStereoRender(frame < 5);
  Turn(window, frame < 2 ? 0.0 : 5.0);
}

std::vector<Motion> GetMotions()
{
  using Window = SessionWindow;
  return {
    { "drag", 10, Drag },
    { "wheel, closer", 6,
      [](Window& w, int) { w.Send(vtkCommand::MouseWheelForwardEvent, 210, 160); } },
    { "wheel, farther", 4,
      [](Window& w, int) { w.Send(vtkCommand::MouseWheelBackwardEvent, 210, 160); } },
    { "hide a sphere", 4, [](Window& w, int) { w.Hidden->VisibilityOff(), w.Draw(); } },
    { "show it again", 3, [](Window& w, int) { w.Hidden->VisibilityOn(), w.Draw(); } },
    { "slide a sphere", 8, [](Window& w, int) { w.Slid->AddPosition(0.12, 0.0, 0.0), w.Draw(); } },
    { "wider by a third", 3, [](Window& w, int) { Resize(w, 560, 320); } },
    { "taller by a third", 3, [](Window& w, int) { Resize(w, 560, 420); } },
    { "smaller", 3, [](Window& w, int) { Resize(w, 420, 320); } },
    { "wider by 20 pixels per frame", 6, [](Window& w, int i) { Resize(w, 440 + 20 * i, 320); } },
    { "pass closely", 8, PassClosely },
    { "jump back", 3,
      [](Window& w, int) {
        MoveCamera(w, { 0.5, -4.0, 1.9 }, { 0.0, 0.0, 0.4 });
      } },
    { "cut to another side", 3, [](Window& w, int i) { Turn(w, i == 0 ? 110.0 : 0.0); } },
    { "turn in stereo", 7, TurnInStereo },
  };
}

struct Session
{
  Session(const std::string& method, const std::string& folder)
    : Live(method, false),
      Still(method, true),
      Folder(folder)
  {
    std::filesystem::create_directories(folder);
  }

  /// Writes the frame next to the still image of its view. Returns the fraction of pixels that differ.
  double Compare(const std::string& name)
  {
    this->Still.CopyView(this->Live);
    this->Still.Draw();
    const auto live = this->Live.GetPixels();
    const auto still = this->Still.GetPixels();
    const int* size = this->Live.Window->GetSize();
    vtkNew<vtkImageData> image;
    image->SetDimensions(2 * size[0], size[1], 1);
    image->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
    vtkIdType off = 0;
    for (vtkIdType pixel = 0; pixel < live->GetNumberOfTuples(); ++pixel)
    {
      const int x = static_cast<int>(pixel % size[0]);
      const int y = static_cast<int>(pixel / size[0]);
      auto* left = static_cast<unsigned char*>(image->GetScalarPointer(x, y, 0));
      auto* right = static_cast<unsigned char*>(image->GetScalarPointer(size[0] + x, y, 0));
      live->GetTypedTuple(pixel, left);
      still->GetTypedTuple(pixel, right);
      off += std::abs(left[0] - right[0]) >= Off || std::abs(left[1] - right[1]) >= Off ||
        std::abs(left[2] - right[2]) >= Off;
    }
    char number[16];
    std::snprintf(number, sizeof number, "/%03d ", this->Frame++);
    vtkNew<vtkPNGWriter> writer;
    writer->SetFileName((this->Folder + number + name + ".png").c_str());
    writer->SetInputData(image);
    writer->Write();
    return static_cast<double>(off) / static_cast<double>(live->GetNumberOfTuples());
  }

  SessionWindow Live;
  SessionWindow Still;
  std::string Folder;
  int Frame = 0;
};

void Measure(const std::string& method, const std::string& output, ResultTable& results)
{
  Session session(method, output + "/" + method);
  session.Live.Settle();
  double settled = session.Compare("start");
  for (const Motion& motion : GetMotions())
  {
    double worst = 0.0;
    for (int frame = 0; frame < motion.Frames; ++frame)
    {
      motion.Step(session.Live, frame);
      worst = std::max(worst, session.Compare(motion.Name));
    }
    session.Live.Settle();
    settled = std::max(settled, session.Compare(motion.Name + ", settled"));
    results.Add(method, motion.Name + ": worst frame", worst, TargetKind::None);
  }
  results.Add(method, "settled: worst image", settled, TargetKind::AtMost, 0.001);
}

}

int main(int argc, char** argv)
{
  std::string output;
  ResultTable results;
  Program program;
  program.Name = "session";
  program.Title = "A session in a window: fraction of pixels that are off by more than 0.1";
  program.Usage = "--output FOLDER [--only march|rays|shafts|shadow-maps|ray-cast]";
  program.Values = { { "--output", &output, true } };
  for (const std::string& method : SessionWindow::GetMethods())
  {
    program.Parts.push_back({ method, [&] { Measure(method, output, results); } });
  }
  return program.Run(argc, argv, results, output, [] {
    return std::vector<std::string>{ "OSMesa, one thread; 420x320 pixels and more",
      "reference: the final image of the same view, rendered without earlier frames",
      "rows of `rays` and `ray-cast` depend on the time that the machine needs for rays" };
  });
}
