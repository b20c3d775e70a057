// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// A fragment shader that reads the image of the delegate, with one or with several samples per pixel.
#ifndef penumbra_SceneShader_h
#define penumbra_SceneShader_h

#include "EyeDepth.h"
#include "Stage.h"

#include <string>
#include <utility>
#include <vector>

namespace penumbra
{

class SceneShader
{
public:
  /// Assembles the shader `source` from pieces, ViewLib, and SceneSample for either number of samples.
  SceneShader(const char* source, std::vector<std::pair<std::string, std::string>> pieces);

  /// Stage::Ready() for the number of samples of `image`.
  vtkShaderProgram* Ready(
    Stage& stage, vtkOpenGLRenderWindow* window, const DelegateImage& image) const;

  /// Draws the stage that is ready: every sample of `colors` and of the depth of `image` by itself if there are several
  /// per pixel. `depth` has the depth of each pixel.
  static void Draw(Stage& stage, vtkShaderProgram* program, const DelegateImage& image,
    const EyeDepth& depth, vtkTextureObject* colors);

private:
  std::string OneSample;
  std::string ManySamples;
};

}
#endif
