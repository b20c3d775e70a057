// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkPenumbraScreenSpacePass.h"

#include "Chain/PassSlots.h"

#include "vtkCamera.h"
#include "vtkObjectFactory.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkRenderState.h"
#include "vtkRenderer.h"
#include "vtkTextureObject.h"

#include <algorithm>
#include <functional>
#include <utility>

namespace penumbra
{

/// Calls back when a window releases its OpenGL resources. VTK 9.1 and 9.2 do not install the header of their callback
/// class, but every texture object registers one, so this is a texture object without a texture.
class WindowReleaseNotifier : public vtkTextureObject
{
public:
  static WindowReleaseNotifier* New();
  vtkTypeMacro(WindowReleaseNotifier, vtkTextureObject);

  /// Calls `released` once, when `window` releases its resources.
  void Watch(vtkOpenGLRenderWindow* window, std::function<void(vtkWindow*)> released)
  {
    this->SetContext(window);
    this->Released = std::move(released);
  }

  /// Stops watching without a call.
  void Stop(vtkWindow* window)
  {
    this->Released = nullptr;
    this->ReleaseGraphicsResources(window);
  }

  void ReleaseGraphicsResources(vtkWindow* window) override
  {
    const std::function<void(vtkWindow*)> released = std::exchange(this->Released, nullptr);
    this->Superclass::ReleaseGraphicsResources(window);
    if (released)
    {
      released(window);
    }
  }

private:
  std::function<void(vtkWindow*)> Released;
};
vtkStandardNewMacro(WindowReleaseNotifier);

}

namespace
{

/// Copies whether the window renders in stereo to the camera. VTK does so in vtkCamera::Render(),
/// which is not called for renderers with a pass, so that both eyes would see the same image.
void UpdateStereo(vtkRenderer* renderer)
{
  struct CameraAccess : vtkCamera
  {
    static int vtkCamera::*StereoMember() { return &CameraAccess::Stereo; }
  };
  vtkCamera* camera = renderer->GetActiveCamera();
  const int stereo = renderer->GetRenderWindow()->GetStereoRender();
  if (camera->GetStereo() != stereo)
  {
    camera->*CameraAccess::StereoMember() = stereo;
    camera->Modified();
  }
}

}

vtkPenumbraScreenSpacePass::vtkPenumbraScreenSpacePass()
  : ReleaseNotifier(vtkSmartPointer<penumbra::WindowReleaseNotifier>::New())
{
}

vtkPenumbraScreenSpacePass::~vtkPenumbraScreenSpacePass()
{
  this->ReleaseNotifier->Stop(this->Window);
}

void vtkPenumbraScreenSpacePass::Render(const vtkRenderState* state)
{
  this->NumberOfRenderedProps = 0;
  if (!this->DelegatePass)
  {
    vtkWarningMacro("The pass has no delegate, so nothing is rendered. Call SetDelegatePass().");
    return;
  }
  UpdateStereo(state->GetRenderer());
  if (state->GetRenderer()->GetSelector() || !this->RenderEffect(state))
  {
    this->DelegatePass->Render(state);
    this->NumberOfRenderedProps = this->DelegatePass->GetNumberOfRenderedProps();
  }
}

vtkOpenGLRenderWindow* vtkPenumbraScreenSpacePass::EnterWindow(
  vtkRenderer* renderer, bool hasStatePerEye)
{
  auto* window = vtkOpenGLRenderWindow::SafeDownCast(renderer->GetRenderWindow());
  const bool parallel = renderer->GetActiveCamera()->GetParallelProjection() != 0;
  if (window && window->GetStereoRender() && (parallel || !hasStatePerEye))
  {
    const char* mode =
      hasStatePerEye ? "Stereo rendering in parallel projection" : "Stereo rendering";
    const char* remedy =
      hasStatePerEye ? "Use perspective, or turn stereo off." : "Turn stereo off.";
    this->WarnOnce(std::string(mode) + " does not support " + this->GetEffectName() +
      "; the scene is rendered without the effect. " + remedy);
    return nullptr;
  }
  if (window && window != this->Window)
  {
    penumbra::MoveToWindow(this, this->Window, window);
    this->ReleaseNotifier->Watch(
      window, [this](vtkWindow* released) { this->ReleaseGraphicsResources(released); });
  }
  return window;
}

int vtkPenumbraScreenSpacePass::LimitMargin(
  vtkOpenGLRenderWindow* window, const int size[2], int margin)
{
  const int largest = vtkTextureObject::GetMaximumTextureSize(window);
  const int limited = std::clamp((largest - std::max(size[0], size[1])) / 2, 0, margin);
  if (limited < margin)
  {
    // The same text at all sizes, so that a window that is resized warns once.
    this->WarnOnce("Textures of OpenGL have at most " + std::to_string(largest) +
      " pixels on each side. The image leaves too few of them for the objects around it, whose "
      "effect on " +
      this->GetEffectName() + " is missing near its edges. Render a smaller image.");
  }
  return limited;
}

void vtkPenumbraScreenSpacePass::WarnOnce(const std::string& warning)
{
  if (this->Warned.insert(warning).second)
  {
    vtkWarningMacro(<< warning);
  }
}

void vtkPenumbraScreenSpacePass::ReleaseGraphicsResources(vtkWindow* window)
{
  this->Superclass::ReleaseGraphicsResources(window);
  this->ReleaseNotifier->Stop(this->Window);
  this->Window = nullptr;
}

void vtkPenumbraScreenSpacePass::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "OpaqueOnly: " << this->OpaqueOnly << "\n";
}
