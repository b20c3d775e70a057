// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "WindowReleaseNotifier.h"

#include "vtkObjectFactory.h"
#include "vtkOpenGLRenderWindow.h"

#include <utility>

namespace penumbra
{

vtkStandardNewMacro(WindowReleaseNotifier);

void WindowReleaseNotifier::Watch(
  vtkOpenGLRenderWindow* window, std::function<void(vtkWindow*)> released)
{
  this->SetContext(window);
  this->Released = std::move(released);
}

void WindowReleaseNotifier::Stop(vtkWindow* window)
{
  this->Released = nullptr;
  this->ReleaseGraphicsResources(window);
}

void WindowReleaseNotifier::ReleaseGraphicsResources(vtkWindow* window)
{
  const std::function<void(vtkWindow*)> released = std::exchange(this->Released, nullptr);
  this->Superclass::ReleaseGraphicsResources(window);
  if (released)
  {
    released(window);
  }
}

}
