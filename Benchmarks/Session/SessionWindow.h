// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// A window with an interactor that shows spheres, posts and a box on a floor with one of the methods for windows.
#ifndef penumbra_SessionWindow_h
#define penumbra_SessionWindow_h

#include "ManualInteractor.h"

#include "vtkNew.h"
#include "vtkRenderWindow.h"
#include "vtkRenderer.h"
#include "vtkSmartPointer.h"

#include <functional>
#include <string>
#include <vector>

class vtkActor;
class vtkAlgorithm;
class vtkUnsignedCharArray;

namespace penumbra
{

class SessionWindow
{
public:
  /// Names of the methods.
  static const std::vector<std::string>& GetMethods();

  /// If `isStill`, every frame is the final image of its view; else it is what a person sees.
  SessionWindow(const std::string& method, bool isStill);

  /// Takes over the size, camera, actors and stereo mode of another window.
  void CopyView(SessionWindow& other);

  /// Renders frames until the image is final, at most 200.
  void Settle();

  /// Renders one frame.
  void Draw() { this->Window->Render(); }

  /// Sends an event of the mouse at a pixel.
  void Send(unsigned long event, int x, int y);

  /// Returns the pixels of the last frame, RGB.
  vtkSmartPointer<vtkUnsignedCharArray> GetPixels();

  vtkNew<vtkRenderer> Renderer;
  vtkNew<vtkRenderWindow> Window;
  vtkSmartPointer<vtkActor> Hidden; ///< a small sphere in front of the others
  vtkSmartPointer<vtkActor> Slid;   ///< another one

private:
  vtkSmartPointer<vtkActor> Add(vtkAlgorithm* source, const double (&color)[3]);
  vtkSmartPointer<vtkActor> AddSphere(const double (&center)[3], double radius);
  void AddScene();
  void AddLight(const double (&position)[3]);
  void UseOcclusion(const char* kernel, bool isStill);
  void UseShafts(bool maps);
  void UseRayCaster(bool isStill);

  vtkNew<ManualInteractor> Interactor;
  std::function<bool()> IsFinal;
};

}
#endif
