// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// The depth buffer as distances along the view axis, of this picture and of the one before, and
// whether anything changed between them.
#ifndef penumbra_EyeDepth_h
#define penumbra_EyeDepth_h

#include "DelegateImage.h"
#include "Stage.h"

namespace penumbra
{

class VTKPENUMBRARENDERINGSCREENSPACE_EXPORT EyeDepth
{
public:
  /// What became of the picture since the last call.
  enum class Change
  {
    None,  ///< same view, same depth
    Moved, ///< the eye or something in view moved: GetPrevious() and GetPreviousView() are valid
    Reset, ///< another projection or window: there is no previous picture
    Failed ///< OpenGL refuses
  };

  /// `view`: that of the image, with the unit of length that the depths shall have.
  /// `moved`: something that depth does not show is known to have changed.
  Change Update(vtkOpenGLRenderWindow* window, const DelegateImage& image,
    const ScreenTransform& view, bool moved = false);

  vtkTextureObject* GetCurrent() const { return this->Textures[this->Current]; }
  vtkTextureObject* GetPrevious() const { return this->Textures[1 - this->Current]; }
  const ScreenTransform& GetView() const { return this->Views[this->Current]; }
  const ScreenTransform& GetPreviousView() const { return this->Views[1 - this->Current]; }

  /// Another number whenever the current depths are others, and other depths never have the same one.
  long long GetVersion() const { return this->Version; }

  /// The next Update() says All.
  void Invalidate() { this->Filled = false; }

  void ReleaseGraphicsResources(vtkWindow* window);

private:
  bool IsUnchanged(vtkOpenGLRenderWindow* window, const DelegateImage& image);
  bool Fill(vtkOpenGLRenderWindow* window, const DelegateImage& image);

  vtkSmartPointer<vtkTextureObject> Textures[2];
  ScreenTransform Views[2];
  int Current = 0;
  long long Version = 0;
  bool Filled = false;
  Stage Linearize;
  Stage Compare;
};

}
#endif
