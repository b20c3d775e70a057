// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// GLSL functions with known values: each expression is rendered into a texture and read back.
#include "ShaderEvaluation.h"

#include <cmath>
#include <sstream>

namespace
{

class Shaders : public ShaderEvaluation
{
protected:
  void SetUp() override
  {
    ShaderEvaluation::SetUp();
    this->Depths = this->MakeTexture(4, 4, 1, [](int, int) { return std::array<float, 4>{}; });
  }

  /// Evaluates a GLSL expression after the declarations of the estimation stage.
  double Evaluate(const std::string& expression, const std::string& kernel = "Horizon")
  {
    const std::string declarations = AssembleEstimate(kernel) +
      ReadShader("Frame/glsl/vtkPenumbraApplyOcclusionLib.glsl") +
      ReadShader("Occlusion/glsl/vtkPenumbraBilateralLib.glsl") +
      "vec2 phase(vec2 s) { return vec2(cos(6.2831853 * (s.x - s.y)), sin(6.2831853 * (s.x - "
      "s.y))); }\n";
    const auto setInputs = [this](vtkShaderProgram* program, penumbra::Stage& stage) {
      const float pixelToEye[4] = { 0.5f, 0.5f, -1.f, -1.f };
      const float pixelSize[2] = { 0.25f, 0.25f };
      const float depthToEye[2] = { 0.1f, 0.9f };
      program->SetUniform4f("pixelToEye", pixelToEye);
      program->SetUniform2f("pixelSize", pixelSize);
      program->SetUniform2f("depthToEye", depthToEye);
      program->SetUniformf("perspective", this->Parallel ? 0.f : 1.f);
      program->SetUniformf("thickness", 1.f);
      program->SetUniformf("strength", 0.8f);
      program->SetUniformf("lightAwareness", 0.5f);
      program->SetUniformf("pixelRotation", 1.f);
      program->SetUniformf("distanceInPixels", 4.f);
      stage.BindTexture("eyeDepths", this->Depths);
    };
    return this->Run(
      declarations, "gl_FragData[0] = vec4(float(" + expression + "));", setInputs)[0];
  }

  vtkSmartPointer<vtkTextureObject> Depths;
  bool Parallel = false;
};

TEST_F(Shaders, ConvertDepthToEyeDepth)
{
  // 1 / (0.1 + 0.9 (1 - z)): from 1 at the near plane to 10 at the far plane.
  EXPECT_NEAR(this->Evaluate("eyeDepthOfBuffer(0.0)"), 1.0, 1e-6);
  EXPECT_NEAR(this->Evaluate("eyeDepthOfBuffer(0.5)"), 1.0 / 0.55, 1e-6);
  EXPECT_GT(this->Evaluate("eyeDepthOfBuffer(1.0)"), 1e17);
  this->Parallel = true;
  EXPECT_NEAR(this->Evaluate("eyeDepthOfBuffer(0.5)"), 0.55, 1e-6);
}

TEST_F(Shaders, ConvertPixelsToPositionsAndBack)
{
  EXPECT_NEAR(this->Evaluate("eyePosition(vec2(3.0, 1.0), 4.0).x"), 2.0, 1e-6);
  EXPECT_NEAR(this->Evaluate("eyePosition(vec2(3.0, 1.0), 4.0).y"), -2.0, 1e-6);
  EXPECT_NEAR(this->Evaluate("eyePosition(vec2(3.0, 1.0), 4.0).z"), -4.0, 1e-6);
  EXPECT_NEAR(this->Evaluate("pixelOfPosition(eyePosition(vec2(3.3, 1.7), 4.0)).x"), 3.3, 1e-5);
  EXPECT_NEAR(this->Evaluate("towardEye(vec3(3.0, 0.0, -4.0)).x"), -0.6, 1e-6);
  this->Parallel = true;
  EXPECT_NEAR(this->Evaluate("eyePosition(vec2(3.0, 1.0), 4.0).x"), 0.5, 1e-6);
  EXPECT_NEAR(this->Evaluate("towardEye(vec3(3.0, 0.0, -4.0)).z"), 1.0, 1e-6);
}

TEST_F(Shaders, IntegrateTheCosineOverASlice)
{
  const auto arc = [&](double angle, double tilt) {
    std::ostringstream call;
    call << "integrateArcCosWeight(" << angle << ", " << std::cos(2.0 * angle - tilt) << ", "
         << std::cos(tilt) << ", " << std::sin(tilt) << ")";
    return this->Evaluate(call.str());
  };
  // The integral over a slice with the normal angle t is cos t + t sin t. For t = 0, the integral
  // up to an angle is half its squared sine.
  for (const double tilt : { 0.0, 0.3, -1.1 })
  {
    const double quarter = 0.5 * 3.14159265;
    EXPECT_NEAR(arc(tilt + quarter, tilt) - arc(tilt - quarter, tilt),
      std::cos(tilt) + tilt * std::sin(tilt), 1e-5)
      << tilt;
  }
  EXPECT_NEAR(arc(0.7, 0.0), std::sin(0.7) * std::sin(0.7) / 2.0, 1e-5);
  EXPECT_NEAR(arc(-0.7, 0.0), -std::sin(0.7) * std::sin(0.7) / 2.0, 1e-5);
  // Drivers approximate the arc cosine by polynomials.
  EXPECT_NEAR(this->Evaluate("signedAngle(vec2(0.5, sqrt(0.75)))"), std::acos(0.5), 2e-4);
  EXPECT_NEAR(this->Evaluate("signedAngle(vec2(0.5, -sqrt(0.75)))"), -std::acos(0.5), 2e-4);
}

TEST_F(Shaders, BuildOrthonormalTangentFrames)
{
  const std::string frame = "tangentFrame(normalize(vec3(1.0, 2.0, 2.0)))";
  EXPECT_NEAR(this->Evaluate(frame + "[2].x", "Volumetric"), 1.0 / 3.0, 1e-6);
  EXPECT_NEAR(this->Evaluate("dot(" + frame + "[0], " + frame + "[2])", "Volumetric"), 0.0, 1e-6);
  EXPECT_NEAR(this->Evaluate(
                "dot(cross(" + frame + "[0], " + frame + "[1]), " + frame + "[2])", "Volumetric"),
    1.0, 1e-6);
}

TEST_F(Shaders, ApplyOcclusionByBrightness)
{
  // The factor is 1 - 0.8 * 0.5 * (1 - 0.5 * 0.4).
  EXPECT_NEAR(Evaluate("applyOcclusion(vec3(0.4, 0.2, 0.1), 0.5).r"), 0.4 * 0.68, 1e-6);
  EXPECT_NEAR(Evaluate("applyOcclusion(vec3(0.4, 0.2, 0.1), 0.5).b"), 0.1 * 0.68, 1e-6);
  EXPECT_NEAR(Evaluate("applyOcclusion(vec3(3., 0., 0.), 1.).r"), 3.0 * 0.6, 1e-6);
  EXPECT_NEAR(Evaluate("applyOcclusion(vec3(0.7), 0.).g"), 0.7, 1e-6);
}

TEST_F(Shaders, WeightNeighborsByDistanceAndTangentPlane)
{
  // Pixels are 0.5 wide. In the tangent plane, the weight is 1/e at 12 pixels for one sample, at 6
  // pixels for 4 samples, and never below 4 pixels.
  const auto along = [&](const char* delta, const char* inPlane, const char* samples) {
    return this->Evaluate("neighborWeight(vec3(" + std::string(delta) + ", 0.0, 0.0), vec3(" +
      inPlane + ", 0.0, 0.0), " + samples + ", 0.5)");
  };
  EXPECT_NEAR(along("6.0", "6.0", "1.0"), std::exp(-1.0), 1e-5);
  EXPECT_NEAR(along("3.0", "3.0", "4.0"), std::exp(-1.0), 1e-5);
  EXPECT_NEAR(along("2.0", "2.0", "100.0"), std::exp(-1.0), 1e-5);
  // At a distance of one pixel from the tangent plane the weight is 1/e of that.
  EXPECT_NEAR(along("6.0", "5.5", "1.0"), std::exp(-2.0), 1e-5);
}

TEST_F(Shaders, KeepPixelNoiseInTheUnitInterval)
{
  for (const char* pixel : { "vec2(0.0, 0.0)", "vec2(12.0, 7.0)", "vec2(1023.0, 767.0)" })
  {
    const double noise = this->Evaluate(std::string("pixelNoise(") + pixel + ")");
    EXPECT_GE(noise, 0.0);
    EXPECT_LT(noise, 1.0);
  }
}

TEST_F(Shaders, ShiftTheDimensionsOfAPixelIndependently)
{
  // The shifts of two dimensions differ by a phase per pixel. The mean of independent phases is
  // about 1 / sqrt(64) long, that of a constant phase has length 1.
  for (const char* dimensions : { "xy", "xz", "xw", "yz", "yw", "zw" })
  {
    std::string sum;
    for (int i = 0; i < 64; ++i)
    {
      const std::string shift = "pixelSample(0, vec2(" + std::to_string(i % 8) + ".0, " +
        std::to_string(i / 8) + ".0))." + dimensions;
      sum += std::string(i ? " + " : "") + "phase(" + shift + ")";
    }
    EXPECT_LT(this->Evaluate("length(" + sum + ") / 64.0"), 0.35) << dimensions;
  }
}

TEST_F(ShaderEvaluation, StagesPassUniformsOfAllTypes)
{
  // More than fit into the inputs of a fragment shader: 4 matrices have 64 components.
  const std::string declarations =
    "//VTK::System::Dec\n//VTK::Output::Dec\n"
    "uniform mat4 first;\nuniform mat4 second;\nuniform mat4 third;\nuniform mat4 fourth;\n"
    "uniform vec4 four;\nuniform vec3 three;\nuniform vec2 two;\nuniform float one;\n"
    "uniform int number;\n";
  const auto setInputs = [](vtkShaderProgram* program, penumbra::Stage&) {
    float matrix[16];
    for (int k = 0; k < 4; ++k)
    {
      for (int i = 0; i < 16; ++i)
      {
        matrix[i] = static_cast<float>(100 * k + i);
      }
      const char* names[] = { "first", "second", "third", "fourth" };
      program->SetUniformMatrix4x4(names[k], matrix);
    }
    const float values[] = { 0.1f, 0.2f, 0.3f, 0.4f };
    program->SetUniform4f("four", values);
    program->SetUniform3f("three", values);
    program->SetUniform2f("two", values);
    program->SetUniformf("one", 7.f);
    program->SetUniformi("number", 5);
  };
  const std::array<double, 4> small = this->Run(declarations,
    "gl_FragData[0] = vec4(four.w + 10.0 * three.z, two.x + 10.0 * two.y, one, float(number));",
    setInputs);
  const std::array<double, 4> matrices = this->Run(declarations,
    "gl_FragData[0] = vec4(first[3][1], second[0][2], third[2][0], fourth[1][3]) + vec4(four.x);",
    setInputs);
  const std::array<double, 4> expected = { 3.4, 2.1, 7.0, 5.0 };
  const std::array<double, 4> entries = { 13.1, 102.1, 208.1, 307.1 };
  for (int i = 0; i < 4; ++i)
  {
    EXPECT_NEAR(small[i], expected[i], 1e-6);
    EXPECT_NEAR(matrices[i], entries[i], 1e-4);
  }
}

}
