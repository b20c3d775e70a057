// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// GLSL functions on the GPU with known values: each expression is drawn into a texture and read back.
#include "Frame/Stage.h"

#include "vtkNew.h"
#include "vtkOpenGLFramebufferObject.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkRenderWindow.h"
#include "vtkRenderer.h"
#include "vtkShaderProgram.h"
#include "vtkTextureObject.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <memory>
#include <sstream>

namespace
{

std::string Shader(const std::string& name)
{
  std::stringstream text;
  text << std::ifstream(PENUMBRA_SHADERS "/" + name).rdbuf();
  return text.str();
}

/// The libraries of the estimating stage, as it joins them, without its main function.
std::string Estimate(const std::string& kernel)
{
  std::string text = penumbra::Assemble(Shader("Occlusion/glsl/vtkPenumbraEstimateFS.glsl"),
    { { "ViewLib", Shader("Frame/glsl/vtkPenumbraViewLib.glsl") },
      { "SurfaceLib", Shader("Occlusion/glsl/vtkPenumbraSurfaceLib.glsl") },
      { "EstimateLib", Shader("Occlusion/glsl/vtkPenumbraEstimateLib.glsl") },
      { "Kernel", Shader("Occlusion/glsl/vtkPenumbraEstimate" + kernel + "FS.glsl") },
      { "HemisphereLib", Shader("Occlusion/glsl/vtkPenumbraHemisphereLib.glsl") } });
  return text.substr(0, text.rfind("void main()")) +
    Shader("Frame/glsl/vtkPenumbraApplyOcclusionLib.glsl") +
    Shader("Occlusion/glsl/vtkPenumbraBilateralLib.glsl");
}

class Shaders : public testing::Test
{
protected:
  void SetUp() override
  {
    this->Window->SetOffScreenRendering(1);
    this->Window->SetSize(8, 8);
    this->Window->AddRenderer(this->Renderer);
    this->Window->Render();
    this->Context = vtkOpenGLRenderWindow::SafeDownCast(this->Window);
    ASSERT_TRUE(this->Context);
    this->Framebuffer->SetContext(this->Context);
    penumbra::Allocate(this->Target, this->Context, 4, 4, 1);
    penumbra::Allocate(this->Depths, this->Context, 4, 4, 1);
  }
  void TearDown() override { this->Parallel = false; }

  /// The value of a GLSL expression after the declarations of the estimating stage.
  double Value(const std::string& expression, const std::string& kernel = "Horizon")
  {
    const std::string source =
      Estimate(kernel) + "void main() { gl_FragData[0] = vec4(float(" + expression + ")); }\n";
    penumbra::Stage stage;
    vtkShaderProgram* program = stage.Ready(this->Context, source);
    if (!program)
    {
      ADD_FAILURE() << "does not compile: " << expression;
      return 0.0;
    }
    const float pixelToEye[4] = { .5f, .5f, -1.f, -1.f };
    const float pixelSize[2] = { .25f, .25f };
    const float depthToEye[2] = { .1f, .9f };
    program->SetUniform4f("pixelToEye", pixelToEye);
    program->SetUniform2f("pixelSize", pixelSize);
    program->SetUniform2f("depthToEye", depthToEye);
    program->SetUniformf("perspective", this->Parallel ? 0.f : 1.f);
    program->SetUniformf("thickness", 1.f);
    program->SetUniformf("strength", .8f);
    program->SetUniformf("lightAwareness", .5f);
    program->SetUniformf("pixelRotation", 1.f);
    program->SetUniformf("distanceInPixels", 4.f);
    {
      const penumbra::ScopedRenderTarget into(this->Context, this->Framebuffer, { this->Target });
      stage.BindTexture("eyeDepths", this->Depths);
      stage.Draw();
    }
    stage.ReleaseGraphicsResources(this->Window);
    return penumbra::ReadBack(this->Target).front();
  }

  vtkNew<vtkRenderer> Renderer;
  vtkNew<vtkRenderWindow> Window;
  vtkOpenGLRenderWindow* Context = nullptr;
  vtkNew<vtkOpenGLFramebufferObject> Framebuffer;
  vtkSmartPointer<vtkTextureObject> Target;
  vtkSmartPointer<vtkTextureObject> Depths;
  bool Parallel = false;
};

TEST_F(Shaders, TurnDepthsIntoDistances)
{
  // 1 / (0.1 + 0.9 (1 - z)): from 1 at the near plane to 10 at the far one.
  EXPECT_NEAR(this->Value("eyeDepthOfBuffer(0.0)"), 1.0, 1e-6);
  EXPECT_NEAR(this->Value("eyeDepthOfBuffer(0.5)"), 1.0 / .55, 1e-6);
  EXPECT_GT(this->Value("eyeDepthOfBuffer(1.0)"), 1e17);
  this->Parallel = true;
  EXPECT_NEAR(this->Value("eyeDepthOfBuffer(0.5)"), .55, 1e-6);
}

TEST_F(Shaders, GoFromPixelsToPositionsAndBack)
{
  EXPECT_NEAR(this->Value("eyePosition(vec2(3.0, 1.0), 4.0).x"), 2.0, 1e-6);
  EXPECT_NEAR(this->Value("eyePosition(vec2(3.0, 1.0), 4.0).y"), -2.0, 1e-6);
  EXPECT_NEAR(this->Value("eyePosition(vec2(3.0, 1.0), 4.0).z"), -4.0, 1e-6);
  EXPECT_NEAR(this->Value("pixelOfPosition(eyePosition(vec2(3.3, 1.7), 4.0)).x"), 3.3, 1e-5);
  EXPECT_NEAR(this->Value("towardsEye(vec3(3.0, 0.0, -4.0)).x"), -.6, 1e-6);
  this->Parallel = true;
  EXPECT_NEAR(this->Value("eyePosition(vec2(3.0, 1.0), 4.0).x"), .5, 1e-6);
  EXPECT_NEAR(this->Value("towardsEye(vec3(3.0, 0.0, -4.0)).z"), 1.0, 1e-6);
}

TEST_F(Shaders, IntegrateTheCosineOverASlice)
{
  const auto arc = [&](double angle, double tilt) {
    std::ostringstream call;
    call << "integrateArcCosWeight(" << angle << ", " << std::cos(2.0 * angle - tilt) << ", " << std::cos(tilt)
         << ", " << std::sin(tilt) << ")";
    return this->Value(call.str());
  };
  // All of a slice whose normal is tilted by t: cos t + t sin t; of t = 0, up to an angle: sin^2 / 2.
  for (const double tilt : { 0.0, .3, -1.1 })
  {
    const double quarter = .5 * 3.14159265;
    EXPECT_NEAR(arc(tilt + quarter, tilt) - arc(tilt - quarter, tilt),
      std::cos(tilt) + tilt * std::sin(tilt), 1e-5)
      << tilt;
  }
  EXPECT_NEAR(arc(.7, 0.0), std::sin(.7) * std::sin(.7) / 2.0, 1e-5);
  EXPECT_NEAR(arc(-.7, 0.0), -std::sin(.7) * std::sin(.7) / 2.0, 1e-5);
  // Drivers take arc cosines from polynomials.
  EXPECT_NEAR(this->Value("signedAngle(vec2(0.5, sqrt(0.75)))"), std::acos(.5), 2e-4);
  EXPECT_NEAR(this->Value("signedAngle(vec2(0.5, -sqrt(0.75)))"), -std::acos(.5), 2e-4);
}

TEST_F(Shaders, MakeFramesOfNormals)
{
  const std::string frame = "tangentFrame(normalize(vec3(1.0, 2.0, 2.0)))";
  EXPECT_NEAR(this->Value(frame + "[2].x", "Volumetric"), 1.0 / 3.0, 1e-6);
  EXPECT_NEAR(this->Value("dot(" + frame + "[0], " + frame + "[2])", "Volumetric"), 0.0, 1e-6);
  EXPECT_NEAR(
    this->Value("dot(cross(" + frame + "[0], " + frame + "[1]), " + frame + "[2])", "Volumetric"),
    1.0, 1e-6);
}

TEST_F(Shaders, DarkenAllColoursByTheirBrightness)
{
  // 1 - .8 * .5 * (1 - .5 * .4)
  EXPECT_NEAR(Value("applyOcclusion(vec3(.4, .2, .1), .5).r"), .4 * .68, 1e-6);
  EXPECT_NEAR(Value("applyOcclusion(vec3(.4, .2, .1), .5).b"), .1 * .68, 1e-6);
  EXPECT_NEAR(Value("applyOcclusion(vec3(3., 0., 0.), 1.).r"), 3.0 * .6, 1e-6);
  EXPECT_NEAR(Value("applyOcclusion(vec3(.7), 0.).g"), .7, 1e-6);
}

TEST_F(Shaders, WeighNeighboursByDistanceAndByPlane)
{
  // Pixels are .5 wide. In the plane 1/e is at 12 pixels after one sample, at 6 after 4, never below 4.
  const auto along = [&](const char* apart, const char* inPlane, const char* samples) {
    return this->Value("neighborWeight(vec3(" + std::string(apart) + ", 0.0, 0.0), vec3(" +
      inPlane + ", 0.0, 0.0), " + samples + ", 0.5)");
  };
  EXPECT_NEAR(along("6.0", "6.0", "1.0"), std::exp(-1.0), 1e-5);
  EXPECT_NEAR(along("3.0", "3.0", "4.0"), std::exp(-1.0), 1e-5);
  EXPECT_NEAR(along("2.0", "2.0", "100.0"), std::exp(-1.0), 1e-5);
  // One pixel off the plane counts 1/e of that.
  EXPECT_NEAR(along("6.0", "5.5", "1.0"), std::exp(-2.0), 1e-5);
}

TEST_F(Shaders, KeepPixelNoiseInTheUnitInterval)
{
  for (const char* pixel : { "vec2(0.0, 0.0)", "vec2(12.0, 7.0)", "vec2(1023.0, 767.0)" })
  {
    const double noise = this->Value(std::string("pixelNoise(") + pixel + ")");
    EXPECT_GE(noise, 0.0);
    EXPECT_LT(noise, 1.0);
  }
}

}
