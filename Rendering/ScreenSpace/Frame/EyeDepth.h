// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Linear eye depth (distance along the view axis) of the current and the previous image, and
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
  /// Change of the image since the last call of Update().
  enum class Change
  {
    None,  ///< same view and same depth
    Moved, ///< the camera or a visible object moved; GetPrevious() and GetPreviousView() are valid
    Reset, ///< another projection or window; there is no previous image
    Failed ///< OpenGL reports an error
  };

  /// How Update() finds out whether the depths of an unchanged view have changed.
  enum class Comparison
  {
    Wait,  ///< compares them and waits for the graphics card
    Later, ///< treats them as changed and compares them for ChooseComparison() in a later frame
    Skip   ///< treats them as changed
  };

  /// Returns the comparison of the next Update(), which is called once per frame. `moving`: the scene
  /// was modified and the last image differed, so that this one most likely differs, too. While that
  /// holds, no frame waits: in one of FramesPerDepthComparison frames the depths are compared, and the
  /// result is read FramesUntilComparison frames later. If they did not change, the next image is
  /// compared with Comparison::Wait.
  Comparison ChooseComparison(bool moving);

  /// Computes the depths of `image`. `view` is the view of the image with the unit of the depths.
  Change Update(vtkOpenGLRenderWindow* window, const DelegateImage& image,
    const ScreenTransform& view, Comparison comparison = Comparison::Wait);

  vtkTextureObject* GetCurrent() const { return this->Textures[this->Current]; }
  vtkTextureObject* GetPrevious() const { return this->Textures[1 - this->Current]; }
  const ScreenTransform& GetView() const { return this->Views[this->Current]; }
  const ScreenTransform& GetPreviousView() const { return this->Views[1 - this->Current]; }

  /// Version of the current depths, unique in this process; it changes when the depths do.
  long long GetVersion() const { return this->Version; }

  /// Discards the depths, so that the next Update() returns Change::Reset.
  void Invalidate() { this->Filled = false; }

  void ReleaseGraphicsResources(vtkWindow* window);

private:
  /// Counts the pixels whose depths differ, in this->Differences. Returns false if OpenGL reports an
  /// error.
  bool CountDifferences(
    vtkOpenGLRenderWindow* window, const DelegateImage& image, const ScreenTransform& view);
  bool Fill(vtkOpenGLRenderWindow* window, const DelegateImage& image);

  vtkSmartPointer<vtkTextureObject> Textures[2];
  ScreenTransform Views[2];
  int Current = 0;
  long long Version = 0;
  bool Filled = false;
  PendingCount Differences;
  bool HasDifferences = false; ///< Differences are of a comparison for a later frame
  int UncomparedFrames = 0;
  Stage Linearize;
  Stage Compare;
};

}
#endif
