// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Test fixture that evaluates GLSL expressions: each one is rendered into a texture and read back.
#ifndef ShaderEvaluation_h
#define ShaderEvaluation_h

#include "Frame/Stage.h"

#include "vtkNew.h"
#include "vtkOpenGLFramebufferObject.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkRenderWindow.h"
#include "vtkRenderer.h"
#include "vtkShaderProgram.h"
#include "vtkSmartPointer.h"
#include "vtkTextureObject.h"

#include <gtest/gtest.h>

#include <array>
#include <functional>
#include <string>

class ShaderEvaluation : public testing::Test
{
protected:
  void SetUp() override;

  /// Returns the text of a shader of Rendering/ScreenSpace, e.g. "Frame/glsl/vtkPenumbraViewLib.glsl".
  static std::string ReadShader(const std::string& name);

  /// Assembles the libraries of the estimation stage without its main function.
  static std::string AssembleEstimate(const std::string& kernel);

  using Values = std::function<std::array<float, 4>(int x, int y)>;
  /// Returns a texture of floats; only the first `components` of the values are used.
  vtkSmartPointer<vtkTextureObject> MakeTexture(
    int width, int height, int components, const Values& values);

  /// Sets the uniforms and textures of a stage.
  using Inputs = std::function<void(vtkShaderProgram* program, penumbra::Stage& stage)>;
  /// Evaluates the statements of a main function, which write gl_FragData[0], after `declarations`.
  /// Returns the result at the pixel (0, 0), or zeros with a failure if it does not compile.
  std::array<double, 4> Run(
    const std::string& declarations, const std::string& statements, const Inputs& inputs);

  vtkNew<vtkRenderer> Renderer;
  vtkNew<vtkRenderWindow> Window;
  vtkOpenGLRenderWindow* Context = nullptr;

private:
  vtkNew<vtkOpenGLFramebufferObject> Framebuffer;
  vtkSmartPointer<vtkTextureObject> Target;
};

/// Surfaces in a parallel view from above, for closed forms: 32 x 32 pixels, the radius is 10
/// pixels, the eye depth of the plane is 10 radii. Declarations of subclasses find the surface at
/// the center of the image as CENTER.
class ShadersOverAPlane : public ShaderEvaluation
{
protected:
  static constexpr int Side = 32;
  /// Distance of pixel `x` from the center, in radii. It can be an x- or a y-coordinate.
  static double DistanceOf(int x) { return 0.1 * (x - 16); }

  using Heights = std::function<double(int x, int y)>;
  /// Returns the eye depths of surfaces with these heights above the plane, in radii.
  vtkSmartPointer<vtkTextureObject> MakeDepths(const Heights& heights);
  static void SetView(vtkShaderProgram* program);
};

#define CENTER "surfaceAt(vec2(16.5))"

#endif
