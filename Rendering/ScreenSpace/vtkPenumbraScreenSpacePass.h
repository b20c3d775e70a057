// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkPenumbraScreenSpacePass
 * @brief   What passes share that change a picture by what its depths tell.
 *
 * The delegate draws the scene; a subclass draws it with its effect. Where that cannot be (hardware
 * selection, stereo, what OpenGL refuses) the plain scene is drawn, and a warning says why, once.
 */
#ifndef vtkPenumbraScreenSpacePass_h
#define vtkPenumbraScreenSpacePass_h

#include "vtkImageProcessingPass.h"
#include "vtkPenumbraRenderingScreenSpaceModule.h" // for export macro

#include <memory> // for std::unique_ptr
#include <string> // for std::string

class vtkGenericOpenGLResourceFreeCallback;
class vtkOpenGLRenderWindow;
class vtkRenderer;

class VTKPENUMBRARENDERINGSCREENSPACE_EXPORT vtkPenumbraScreenSpacePass
  : public vtkImageProcessingPass
{
public:
  vtkAbstractTypeMacro(vtkPenumbraScreenSpacePass, vtkImageProcessingPass);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The delegate draws opaque props and nothing else: they may be drawn with a margin and are laid
   * over what is there. Off: the delegate draws the whole picture, background included. Default: off.
   */
  vtkSetMacro(OpaqueOnly, bool);
  vtkGetMacro(OpaqueOnly, bool);
  vtkBooleanMacro(OpaqueOnly, bool);
  ///@}

  void Render(const vtkRenderState* state) override;
  void ReleaseGraphicsResources(vtkWindow* window) override;

protected:
  vtkPenumbraScreenSpacePass();
  ~vtkPenumbraScreenSpacePass() override;

  /** Draws the scene with the effect and sets NumberOfRenderedProps. False: nothing was drawn. */
  virtual bool RenderEffect(const vtkRenderState* state) = 0;

  /** What the effect is called in warnings: "light shafts". */
  virtual const char* GetEffectName() = 0;

  /**
   * The renderer's window, once what was made for another one is released; null, with a warning, where
   * positions do not follow from depths.
   */
  vtkOpenGLRenderWindow* EnterWindow(vtkRenderer* renderer);

  /** The window of the last frame; null if there is none, or if it has released its resources. */
  vtkOpenGLRenderWindow* GetWindow() { return this->Window; }

  /** Warns unless the last warning said the same. */
  void WarnOnce(const std::string& warning);

  bool OpaqueOnly = false;

private:
  vtkPenumbraScreenSpacePass(const vtkPenumbraScreenSpacePass&) = delete;
  void operator=(const vtkPenumbraScreenSpacePass&) = delete;

  vtkOpenGLRenderWindow* Window = nullptr;
  /// Releases the resources of this pass when Window does, even if the pass has left its renderer.
  std::unique_ptr<vtkGenericOpenGLResourceFreeCallback> EndOfWindow;
  std::string Warned;
};

#endif
