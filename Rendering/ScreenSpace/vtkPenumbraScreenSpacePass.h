// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkPenumbraScreenSpacePass
 * @brief   Base class of passes that compute an effect from the depth of their delegate's image.
 *
 * The delegate renders the scene; a subclass renders it with its effect. During hardware selection,
 * in stereo unless the subclass supports it, and if OpenGL reports an error, the scene is rendered
 * without the effect. Except for hardware selection, one warning explains why.
 */
#ifndef vtkPenumbraScreenSpacePass_h
#define vtkPenumbraScreenSpacePass_h

#include "vtkImageProcessingPass.h"
#include "vtkPenumbraRenderingScreenSpaceModule.h" // for export macro
#include "vtkSmartPointer.h"                       // for ReleaseNotifier

#include <set>    // for Warned
#include <string> // for std::string

class vtkOpenGLRenderWindow;
class vtkRenderer;

namespace penumbra
{
class WindowReleaseNotifier;
}

class VTKPENUMBRARENDERINGSCREENSPACE_EXPORT vtkPenumbraScreenSpacePass
  : public vtkImageProcessingPass
{
public:
  vtkAbstractTypeMacro(vtkPenumbraScreenSpacePass, vtkImageProcessingPass);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * If on, the delegate renders opaque props only: they may be rendered with a margin and are
   * composited over the target. If off, the delegate renders the whole image, background included.
   * Default: off.
   */
  vtkSetMacro(OpaqueOnly, bool);
  vtkGetMacro(OpaqueOnly, bool);
  vtkBooleanMacro(OpaqueOnly, bool);
  ///@}

  void Render(const vtkRenderState* state) override;
  void ReleaseGraphicsResources(vtkWindow* w) override;

protected:
  vtkPenumbraScreenSpacePass();
  ~vtkPenumbraScreenSpacePass() override;

  /**
   * Renders the scene with the effect and sets NumberOfRenderedProps. Returns false if nothing was
   * rendered.
   */
  virtual bool RenderEffect(const vtkRenderState* state) = 0;

  /** Name of the effect in warnings, for example "light shafts". */
  virtual const char* GetEffectName() = 0;

  /**
   * Returns the window of the renderer, after releasing the resources of another window. Returns
   * null, with a warning, in stereo, unless the pass has a state per eye; with parallel projection,
   * positions cannot be computed from depths in stereo.
   */
  vtkOpenGLRenderWindow* EnterWindow(vtkRenderer* renderer, bool hasStatePerEye = false);

  /** Window of the last frame; null if there is none or its resources were released. */
  vtkOpenGLRenderWindow* GetWindow() { return this->Window; }

  /**
   * Returns `margin`, in pixels, or less, with a warning, if an image of this size with its margin would
   * exceed the textures of OpenGL.
   */
  int LimitMargin(vtkOpenGLRenderWindow* window, const int size[2], int margin);

  /** Warns unless the pass has given the same warning. */
  void WarnOnce(const std::string& warning);

  bool OpaqueOnly = false;

private:
  vtkPenumbraScreenSpacePass(const vtkPenumbraScreenSpacePass&) = delete;
  void operator=(const vtkPenumbraScreenSpacePass&) = delete;

  vtkOpenGLRenderWindow* Window = nullptr;
  /// Releases the resources of this pass when Window does, even after the pass was removed from its
  /// renderer.
  vtkSmartPointer<penumbra::WindowReleaseNotifier> ReleaseNotifier;
  std::set<std::string> Warned;
};

#endif
