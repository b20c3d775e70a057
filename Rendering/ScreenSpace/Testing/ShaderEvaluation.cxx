// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ShaderEvaluation.h"

#include <fstream>
#include <sstream>
#include <vector>

void ShaderEvaluation::SetUp()
{
  this->Window->SetOffScreenRendering(1);
  this->Window->SetSize(8, 8);
  this->Window->AddRenderer(this->Renderer);
  this->Window->Render();
  this->Context = vtkOpenGLRenderWindow::SafeDownCast(this->Window);
  ASSERT_TRUE(this->Context);
  this->Framebuffer->SetContext(this->Context);
  penumbra::Allocate(this->Target, this->Context, 4, 4, 4);
}

std::string ShaderEvaluation::ReadShader(const std::string& name)
{
  std::stringstream text;
  text << std::ifstream(PENUMBRA_SHADERS "/" + name).rdbuf();
  return text.str();
}

std::string ShaderEvaluation::AssembleEstimate(const std::string& kernel)
{
  const std::string text = penumbra::Assemble(ReadShader("glsl/vtkPenumbraEstimateFS.glsl"),
    { { "ViewLib", ReadShader("Frame/glsl/vtkPenumbraViewLib.glsl") },
      { "SurfaceLib", ReadShader("Occlusion/glsl/vtkPenumbraSurfaceLib.glsl") },
      { "EstimateLib", ReadShader("glsl/vtkPenumbraEstimateLib.glsl") },
      { "QualityLib", ReadShader("glsl/vtkPenumbraStaticQualityLib.glsl") },
      { "Kernel", ReadShader("glsl/vtkPenumbraEstimate" + kernel + "FS.glsl") },
      { "HemisphereLib", ReadShader("glsl/vtkPenumbraHemisphereLib.glsl") },
      { "HistoryLengthLib", ReadShader("Occlusion/glsl/vtkPenumbraHistoryLengthLib.glsl") } });
  return text.substr(0, text.rfind("void main()"));
}

vtkSmartPointer<vtkTextureObject> ShaderEvaluation::MakeTexture(
  int width, int height, int components, const Values& values)
{
  std::vector<float> texels;
  for (int y = 0; y < height; ++y)
  {
    for (int x = 0; x < width; ++x)
    {
      const std::array<float, 4> value = values(x, y);
      texels.insert(texels.end(), value.begin(), value.begin() + components);
    }
  }
  auto texture = vtkSmartPointer<vtkTextureObject>::New();
  texture->SetContext(this->Context);
  texture->SetWrapS(vtkTextureObject::ClampToEdge);
  texture->SetWrapT(vtkTextureObject::ClampToEdge);
  texture->Create2DFromRaw(width, height, components, VTK_FLOAT, texels.data());
  return texture;
}

std::array<double, 4> ShaderEvaluation::Run(
  const std::string& declarations, const std::string& statements, const Inputs& inputs)
{
  penumbra::Stage stage;
  vtkShaderProgram* program =
    stage.Ready(this->Context, declarations + "void main()\n{\n" + statements + "\n}\n");
  if (!program)
  {
    ADD_FAILURE() << "The shader does not compile: " << statements;
    return {};
  }
  inputs(program, stage);
  {
    const penumbra::ScopedRenderTarget target(this->Context, this->Framebuffer, { this->Target });
    stage.Draw();
  }
  stage.ReleaseGraphicsResources(this->Window);
  const std::vector<float> texels = penumbra::ReadBack(this->Target);
  return { texels[0], texels[1], texels[2], texels[3] };
}

vtkSmartPointer<vtkTextureObject> ShadersOverAPlane::MakeDepths(const Heights& heights)
{
  return this->MakeTexture(Side, Side, 1,
    [&](int x, int y) { return std::array<float, 4>{ static_cast<float>(10.0 - heights(x, y)) }; });
}

void ShadersOverAPlane::SetView(vtkShaderProgram* program)
{
  const float pixelToEye[4] = { 0.1f, 0.1f, -1.65f, -1.65f };
  const float pixelSize[2] = { 1.f / Side, 1.f / Side };
  program->SetUniform4f("pixelToEye", pixelToEye);
  program->SetUniform2f("pixelSize", pixelSize);
  program->SetUniformf("perspective", 0.f);
}
