// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "SceneShader.h"

#include "vtkPenumbraSceneSampleLib.h"
#include "vtkPenumbraSceneSamplesLib.h"
#include "vtkPenumbraViewLib.h"

namespace penumbra
{

SceneShader::SceneShader(
  const char* source, std::vector<std::pair<std::string, std::string>> pieces)
{
  pieces.emplace_back("ViewLib", vtkPenumbraViewLib);
  pieces.emplace_back("SceneSample", vtkPenumbraSceneSampleLib);
  this->OneSample = Assemble(source, pieces);
  pieces.back().second = vtkPenumbraSceneSamplesLib;
  this->ManySamples = Assemble(source, pieces);
}

vtkShaderProgram* SceneShader::Ready(
  Stage& stage, vtkOpenGLRenderWindow* window, const DelegateImage& image) const
{
  return stage.Ready(window, image.GetSamples() > 1 ? this->ManySamples : this->OneSample);
}

void SceneShader::Draw(Stage& stage, vtkShaderProgram* program, const DelegateImage& image,
  const EyeDepth& depth, vtkTextureObject* colors)
{
  stage.BindTexture("colors", colors);
  if (image.GetSamples() <= 1)
  {
    stage.BindTexture("depthBuffer", image.GetSampleDepth());
    stage.Draw();
    return;
  }
  stage.BindTexture("depthSamples", image.GetSampleDepth());
  stage.BindTexture("eyeDepths", depth.GetCurrent());
  stage.DrawSamples(program);
}

}
