// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Adds and removes effects of an existing renderer, in a window without a GUI toolkit. Key `a`
// toggles ambient occlusion, `l` light shafts. The text shows the statistics of the effects. `q`
// quits.
//
//   VTK_DEFAULT_OPENGL_WINDOW=vtkXOpenGLRenderWindow SwitchEffects
//
// With `--keys al IMAGE.png` the program simulates these keys and saves the resulting image. The
// test uses this mode.
#include "vtkPenumbraLightShaftPass.h"
#include "vtkPenumbraTemporalSSAOPass.h"

#include <vtkActor.h>
#include <vtkCallbackCommand.h>
#include <vtkCamera.h>
#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkLight.h>
#include <vtkNew.h>
#include <vtkPNGWriter.h>
#include <vtkPlaneSource.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderWindow.h>
#include <vtkRenderWindowInteractor.h>
#include <vtkRenderer.h>
#include <vtkSphereSource.h>
#include <vtkTextActor.h>
#include <vtkTextProperty.h>
#include <vtkWindowToImageFilter.h>

#include <cstdlib>
#include <iostream>
#include <sstream>
#include <string>

namespace
{

void Add(vtkRenderer* renderer, vtkAlgorithm* source)
{
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(source->GetOutputPort());
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  actor->GetProperty()->SetAmbient(0.3);
  actor->GetProperty()->SetDiffuse(0.7);
  renderer->AddActor(actor);
}

void AddScene(vtkRenderer* renderer)
{
  for (int i = 0; i < 9; ++i)
  {
    vtkNew<vtkSphereSource> sphere;
    sphere->SetCenter(i % 3 - 1.0, i / 3 - 1.0, 0.5);
    sphere->SetRadius(0.5);
    sphere->SetThetaResolution(48);
    sphere->SetPhiResolution(32);
    Add(renderer, sphere);
  }
  vtkNew<vtkPlaneSource> floor;
  floor->SetOrigin(-2.5, -2.5, 0.0);
  floor->SetPoint1(2.5, -2.5, 0.0);
  floor->SetPoint2(-2.5, 2.5, 0.0);
  Add(renderer, floor);
  vtkNew<vtkLight> light;
  light->SetPosition(-1.5, -1.0, 1.5);
  renderer->AddLight(light);
  renderer->GetActiveCamera()->SetPosition(0.5, -7.0, 3.5);
  renderer->GetActiveCamera()->SetFocalPoint(0.0, 0.0, 0.4);
  renderer->GetActiveCamera()->SetViewUp(0.0, 0.0, 1.0);
  renderer->ResetCameraClippingRange();
}

/// The renderer with its effects and the text of their statistics.
struct Viewer
{
  vtkNew<vtkRenderer> Renderer;
  vtkNew<vtkTextActor> Text;
  vtkPenumbraTemporalSSAOPass* Occlusion = nullptr;
  vtkPenumbraLightShaftPass* Shafts = nullptr;

  void HandleKey(char key);
  void UpdateText();
};

void Viewer::HandleKey(char key)
{
  if (key == 'a' && this->Occlusion)
  {
    vtkPenumbraTemporalSSAOPass::RemoveFrom(this->Renderer);
    this->Occlusion = nullptr;
  }
  else if (key == 'a')
  {
    this->Occlusion = vtkPenumbraTemporalSSAOPass::AddTo(this->Renderer);
  }
  if (key == 'l' && this->Shafts)
  {
    vtkPenumbraLightShaftPass::RemoveFrom(this->Renderer);
    this->Shafts = nullptr;
  }
  else if (key == 'l')
  {
    this->Shafts = vtkPenumbraLightShaftPass::AddTo(this->Renderer);
  }
}

void Append(std::ostream& text, const char* name, vtkFieldData* statistics)
{
  text << name << '\n';
  for (int i = 0; i < statistics->GetNumberOfArrays(); ++i)
  {
    if (vtkDataArray* array = statistics->GetArray(i))
    {
      text << "  " << array->GetName() << ": " << array->GetComponent(0, 0) << '\n';
    }
  }
}

/// Shows the statistics of the last frame.
void Viewer::UpdateText()
{
  std::ostringstream text;
  if (this->Occlusion)
  {
    Append(text, "ambient occlusion", this->Occlusion->GetStatistics());
  }
  if (this->Shafts)
  {
    Append(text, "light shafts", this->Shafts->GetStatistics());
  }
  this->Text->SetInput(
    text.str().empty() ? "a: ambient occlusion, l: light shafts" : text.str().c_str());
}

void OnKey(vtkObject* caller, unsigned long, void* viewer, void*)
{
  auto* interactor = static_cast<vtkRenderWindowInteractor*>(caller);
  auto* self = static_cast<Viewer*>(viewer);
  self->HandleKey(interactor->GetKeyCode());
  interactor->Render();
  self->UpdateText();
  interactor->Render();
}

}

int main(int argc, char* argv[])
{
  Viewer viewer;
  AddScene(viewer.Renderer);
  viewer.Text->GetTextProperty()->SetFontSize(14);
  viewer.Text->SetPosition(8, 8);
  viewer.Renderer->AddViewProp(viewer.Text);
  viewer.UpdateText();
  vtkNew<vtkRenderWindow> window;
  window->SetSize(640, 480);
  window->AddRenderer(viewer.Renderer);
  vtkNew<vtkRenderWindowInteractor> interactor;
  interactor->SetRenderWindow(window);
  vtkNew<vtkCallbackCommand> keys;
  keys->SetCallback(OnKey);
  keys->SetClientData(&viewer);
  interactor->AddObserver(vtkCommand::CharEvent, keys);
  window->Render();
  if (argc < 4 || std::string(argv[1]) != "--keys")
  {
    interactor->Start();
    return EXIT_SUCCESS;
  }

  for (const char* key = argv[2]; *key; ++key)
  {
    interactor->SetKeyCode(*key);
    interactor->InvokeEvent(vtkCommand::CharEvent);
  }
  vtkNew<vtkWindowToImageFilter> image;
  image->SetInput(window);
  image->ReadFrontBufferOff();
  vtkNew<vtkPNGWriter> writer;
  writer->SetInputConnection(image->GetOutputPort());
  writer->SetFileName(argv[3]);
  writer->Write();
  std::cout << viewer.Text->GetInput() << std::endl;
  return writer->GetErrorCode() == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
