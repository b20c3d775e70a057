// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Functions of the reprojected history and its validation by neighbors, with known values.
#include "ShaderEvaluation.h"

#include <cmath>
#include <limits>

namespace
{

double Plane(int, int)
{
  return 0.0;
}

/// The reprojection of constant estimates. `Now` and `Before` are the surfaces of this frame and the
/// previous one.
class HistoryShaders : public ShadersOverAPlane
{
protected:
  /// Assembles the shader with its main function as reproject(). `validation`: name of the library
  /// that limits the weight.
  std::string AssembleReprojection(const std::string& validation)
  {
    std::string text = penumbra::Assemble(ReadShader("Occlusion/glsl/vtkPenumbraReprojectFS.glsl"),
      { { "ViewLib", ReadShader("Frame/glsl/vtkPenumbraViewLib.glsl") },
        { "SurfaceLib", ReadShader("Occlusion/glsl/vtkPenumbraSurfaceLib.glsl") },
        { "EstimateLib",
          ReadShader("Occlusion/glsl/vtkPenumbraHistoryLengthLib.glsl") +
            "uniform float estimate;\n"
            "float estimateAt(SurfacePoint point, int historyLength) { return estimate; }\n"
            "float newSamplesAt(SurfacePoint point, int historyLength)\n"
            "{ return historyLength == shortHistory ? 8.0 : historyLength == growingHistory ? 2.0 "
            ": 0.0; }\n" },
        { "FiniteValuesLib", ReadShader("Occlusion/glsl/vtkPenumbraFiniteValuesLib.glsl") },
        { "ActorMotionLib",
          ReadShader("Occlusion/glsl/vtkPenumbra" + this->MotionLib + "Lib.glsl") },
        { "SampleValidationLib",
          ReadShader("Occlusion/glsl/vtkPenumbra" + validation + "Lib.glsl") } });
    const std::string name = "void main()";
    return text.replace(text.rfind(name), name.size(), "void reproject()");
  }

  std::array<double, 4> Evaluate(
    const std::string& statements, const std::string& validation = "NoSampleValidation")
  {
    const vtkSmartPointer<vtkTextureObject> depths = this->MakeDepths(this->Now);
    const vtkSmartPointer<vtkTextureObject> previous = this->MakeDepths(this->Before);
    const vtkSmartPointer<vtkTextureObject> texels =
      this->MakeTexture(Side, Side, 2, this->History);
    const vtkSmartPointer<vtkTextureObject> actors = this->MakeTexture(Side, Side, 4, this->Actors);
    const vtkSmartPointer<vtkTextureObject> motions = this->MakeTexture(4, 1, 4, [](int x, int) {
      // The columns of a translation by (0, 0, 0.3).
      return std::array<float, 4>{ x == 0 ? 1.f : 0.f, x == 1 ? 1.f : 0.f,
        x == 2     ? 1.f
          : x == 3 ? 0.3f
                   : 0.f,
        x == 3 ? 1.f : 0.f };
    });
    const auto setInputs = [&](vtkShaderProgram* program, penumbra::Stage& stage) {
      SetView(program);
      const std::array<float, 3>& scale = this->Motion;
      const float motion[16] = { scale[0], 0, 0, 0, 0, scale[1], 0, 0, 0, 0, scale[2], 0, 0, 0, 0,
        1 };
      const float pixelToEye[4] = { this->PixelBefore, this->PixelBefore,
        -16.5f * this->PixelBefore, -16.5f * this->PixelBefore };
      const float pixelSize[2] = { 1.f / Side, 1.f / Side };
      program->SetUniformMatrix4x4("toPreviousEye", const_cast<float*>(motion));
      program->SetUniform4f("previousPixelToEye", pixelToEye);
      program->SetUniform2f("previousPixelSize", pixelSize);
      program->SetUniformf("estimate", this->Estimate);
      program->SetUniformf("growingHistoryWeight", 4.f);
      program->SetUniformf("settledHistoryWeight", this->SettledWeight);
      program->SetUniformf("maximumWeight", 16.f);
      program->SetUniformf("weightCap", this->WeightCap);
      program->SetUniformf("depthTolerance", 0.02f);
      program->SetUniformf("propsChanged", this->PropsChanged ? 1.f : 0.f);
      program->SetUniformf("invalidationWeight", 3.f);
      stage.BindTexture("eyeDepths", depths);
      stage.BindTexture("previousEyeDepths", previous);
      stage.BindTexture("history", texels);
      if (this->MotionLib == "ActorMotion")
      {
        stage.BindTexture("movedActors", actors);
        stage.BindTexture("actorMotions", motions);
      }
    };
    return this->Run(AssembleReprojection(validation), statements, setInputs);
  }

  /// Samples the history of the surface that the previous frame showed at a pixel of row 16.
  std::array<double, 4> SampleAt(double x)
  {
    return this->Evaluate("vec3 at = eyePosition(vec2(" + std::to_string(x) +
      ", 16.5), 10.0);\n"
      "gl_FragData[0] = vec4(sampleHistory(at, vec3(0.0, 0.0, 1.0)), 0.0, 0.0);");
  }

  /// Runs the whole stage in a scene whose pixels are all equal and returns sum and number of samples.
  std::array<double, 4> Reproject(const std::string& validation = "NoSampleValidation")
  {
    return this->Evaluate("reproject();", validation);
  }

  Heights Now = Plane;
  Heights Before = Plane;
  Values History = [](int, int) { return std::array<float, 4>{ 3.f, 6.f }; };
  Values Actors = [](int, int) { return std::array<float, 4>{}; };
  std::string MotionLib = "CameraMotion";
  std::array<float, 3> Motion = { 1.f, 1.f,
    1.f };                  ///< scale of lengths from this frame to the last one
  float PixelBefore = 0.1f; ///< width of a pixel of the last frame, in radii
  float Estimate = 0.25f;
  float WeightCap = 1000.f;
  float SettledWeight = 1000.f;
  bool PropsChanged = false;
};

TEST_F(HistoryShaders, InterpolateLinearly)
{
  this->History = [](int x, int) { return std::array<float, 4>{ x < 16 ? 1.f : 3.f, 4.f }; };
  EXPECT_NEAR(this->SampleAt(15.5)[0], 1.0, 1e-4);
  EXPECT_NEAR(this->SampleAt(16.0)[0], 2.0, 1e-4);
  EXPECT_NEAR(this->SampleAt(16.25)[0], 2.5, 1e-4);
  EXPECT_NEAR(this->SampleAt(16.25)[1], 4.0, 1e-4);
}

TEST_F(HistoryShaders, RejectTexelsOffTheTangentPlane)
{
  this->History = [](int x, int) { return std::array<float, 4>{ x < 16 ? 1.f : 3.f, 4.f }; };
  this->Before = [](int x, int) { return x < 16 ? 0.0 : 0.1; }; // the limit is 0.08
  EXPECT_NEAR(this->SampleAt(16.25)[0], 1.0, 1e-4);
  this->Before = [](int x, int) { return x < 16 ? 0.0 : 0.05; };
  EXPECT_NEAR(this->SampleAt(16.25)[0], 2.5, 1e-4);
  this->Before = [](int, int) { return -0.1; }; // a hidden surface has appeared
  EXPECT_EQ(this->SampleAt(16.25)[1], 0.0);
}

TEST_F(HistoryShaders, FollowTheTangentPlaneOfSlopes)
{
  this->History = [](int x, int) { return std::array<float, 4>{ x < 18 ? 1.f : 3.f, 4.f }; };
  this->Before = [](int x, int) { return 2.0 * DistanceOf(x); };
  const auto sample = [this](const std::string& normal) {
    return this->Evaluate("vec3 at = eyePosition(vec2(18.25, 16.5), 10.0 - 2.0 * 0.175);\n"
                          "gl_FragData[0] = vec4(sampleHistory(at, normalize(" +
      normal + ")), 0.0, 0.0);")[0];
  };
  EXPECT_NEAR(sample("vec3(-2.0, 0.0, 1.0)"), 2.5, 1e-4);
  // The left texels are 0.15 below a horizontal plane.
  EXPECT_NEAR(sample("vec3(0.0, 0.0, 1.0)"), 3.0, 1e-4);
}

TEST_F(HistoryShaders, EndAtTheEdgeOfTheImage)
{
  EXPECT_NEAR(this->SampleAt(31.9)[1], 6.0, 1e-4);
  EXPECT_EQ(this->SampleAt(32.1)[1], 0.0);
  EXPECT_EQ(this->SampleAt(-0.1)[1], 0.0);
  EXPECT_EQ(this->SampleAt(1000.0)[1], 0.0);
}

TEST_F(HistoryShaders, KeepNoNaNAndNoInfinity)
{
  for (const float bad :
    { std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(), -1.f, 2e9f })
  {
    this->History = [bad](int x, int) { return std::array<float, 4>{ x < 16 ? bad : 3.f, 6.f }; };
    EXPECT_NEAR(this->SampleAt(16.25)[0], 3.0, 1e-4) << bad;
    this->History = [bad](int, int) { return std::array<float, 4>{ 3.f, bad }; };
    EXPECT_EQ(this->SampleAt(16.25)[0], 0.0) << bad;
  }
  this->History = [](int, int) { return std::array<float, 4>{ 3.f, 6.f }; };
  this->Estimate = std::numeric_limits<float>::quiet_NaN();
  EXPECT_NEAR(this->Reproject()[0], 3.0, 1e-4);
  EXPECT_NEAR(this->Reproject()[1], 6.0, 1e-4);
}

TEST_F(HistoryShaders, AddNewSamplesUpToTheMaximumWeight)
{
  // 6 samples of 0.5, and 2 new ones of 0.25.
  EXPECT_NEAR(this->Reproject()[0], 6.0 * 0.5 + 2.0 * 0.25, 1e-4);
  EXPECT_NEAR(this->Reproject()[1], 8.0, 1e-4);
  // 14 of 20 samples remain below the maximum of 16.
  this->History = [](int, int) { return std::array<float, 4>{ 10.f, 20.f }; };
  EXPECT_NEAR(this->Reproject()[0], 14.0 * 0.5 + 2.0 * 0.25, 1e-4);
  EXPECT_NEAR(this->Reproject()[1], 16.0, 1e-4);
  // A limit of this frame.
  this->WeightCap = 5.f;
  EXPECT_NEAR(this->Reproject()[0], 5.0 * 0.5 + 2.0 * 0.25, 1e-4);
  EXPECT_NEAR(this->Reproject()[1], 7.0, 1e-4);
  // Pixels with less than 4 samples take 8 new ones.
  this->WeightCap = 3.f;
  EXPECT_NEAR(this->Reproject()[0], 3.0 * 0.5 + 8.0 * 0.25, 1e-4);
  EXPECT_NEAR(this->Reproject()[1], 11.0, 1e-4);
}

TEST_F(HistoryShaders, KeepAllSamplesOfSettledPixelsWithoutNewOnes)
{
  this->SettledWeight = 11.f;
  EXPECT_NEAR(this->Reproject()[1], 8.0, 1e-4); // 6 and 2 new ones
  this->History = [](int, int) { return std::array<float, 4>{ 6.f, 12.f }; };
  EXPECT_NEAR(this->Reproject()[0], 6.0, 1e-4);
  EXPECT_NEAR(this->Reproject()[1], 12.0, 1e-4);
  this->History = [](int, int) { return std::array<float, 4>{ 10.f, 20.f }; };
  EXPECT_NEAR(this->Reproject()[0], 8.0, 1e-4);
  EXPECT_NEAR(this->Reproject()[1], 16.0, 1e-4);
}

TEST_F(HistoryShaders, KeepTheirWeightIfNeighborsDoNotMove)
{
  this->Now = this->Before = [](int x, int y) { return 0.3 * std::sin(x) * std::cos(1.7 * y); };
  const std::array<double, 4> change =
    this->Evaluate("SurfacePoint point = " CENTER ";\n"
                   "gl_FragData[0] = vec4(neighborOffsetChange(point, point.position), "
                   "historyWeightLimit(point, point.position), 0.0, 0.0);",
      "SampleValidation");
  EXPECT_NEAR(change[0], 0.0, 1e-5);
  EXPECT_NEAR(change[1], 16.0, 1e-4);
}

TEST_F(HistoryShaders, LoseTheirWeightIfNeighborsMove)
{
  const std::string statements =
    "SurfacePoint point = " CENTER ";\n"
    "gl_FragData[0] = vec4(neighborOffsetChange(point, point.position), "
    "historyWeightLimit(point, point.position), 0.0, 0.0);";
  // All neighbors were 0.3 higher.
  this->Before = [](int, int) { return 0.3; };
  std::array<double, 4> change = this->Evaluate(statements, "SampleValidation");
  EXPECT_NEAR(change[0], 0.3, 1e-4);
  EXPECT_NEAR(change[1], 3.0, 1e-4);
  // If props were added or removed, the neighbor itself was replaced at a distance of 0.3.
  this->PropsChanged = true;
  change = this->Evaluate(statements, "SampleValidation");
  EXPECT_NEAR(change[0], 0.3, 1e-4);
  // Surfaces outside of the radius do not count.
  this->PropsChanged = false;
  this->Before = [](int x, int y) {
    return std::hypot(DistanceOf(x), DistanceOf(y)) > 1.2 ? 0.3 : 0.0;
  };
  change = this->Evaluate(statements, "SampleValidation");
  EXPECT_NEAR(change[0], 0.0, 1e-5);
}

TEST_F(HistoryShaders, LimitTheirWeightBetweenBothBounds)
{
  const double rise = 0.04; // of all neighbors
  double last = 17.0;
  for (const double part : { 0.1, 0.4, 0.6, 1.0 })
  {
    this->Before = [=](int, int) { return part * rise; };
    const double limit =
      this->Evaluate("SurfacePoint point = " CENTER ";\n"
                     "gl_FragData[0] = vec4(historyWeightLimit(point, point.position));",
        "SampleValidation")[0];
    const double change =
      this->Evaluate("SurfacePoint point = " CENTER ";\n"
                     "gl_FragData[0] = vec4(neighborOffsetChange(point, point.position));",
        "SampleValidation")[0];
    const double t = std::fmin(std::fmax((change - 0.005) / 0.025, 0.0), 1.0);
    EXPECT_NEAR(limit, 16.0 - 13.0 * t * t * (3.0 - 2.0 * t), 1e-3) << part;
    EXPECT_LE(limit, last) << part;
    last = limit;
  }
}

TEST_F(HistoryShaders, ShareTheSamplesOfATexelByTheArea)
{
  // The radius was 1 / 1.5 of the present one: pixels show the same areas of the surface.
  this->Motion = { 1.5f, 1.5f, 1.5f };
  this->PixelBefore = 0.15f;
  this->Before = [](int, int) { return 10.0 - 1.5 * 10.0; };
  EXPECT_NEAR(this->Reproject()[1], 6.0 + 2.0, 1e-4);
  // Four pixels share a texel.
  this->PixelBefore = 0.3f;
  EXPECT_NEAR(this->Reproject()[1], 6.0 / 4.0 + 8.0, 1e-4);
  // The surface has been stretched to twice its length along one axis. Two pixels share a texel.
  this->Motion = { 0.5f, 1.f, 1.f };
  this->PixelBefore = 0.1f;
  this->Before = Plane;
  EXPECT_NEAR(this->Reproject()[1], 6.0 / 2.0 + 8.0, 1e-4);
  // A mirrored surface.
  this->Motion = { -1.f, 1.f, 1.f };
  EXPECT_NEAR(this->Reproject()[1], 6.0 + 2.0, 1e-4);
}

TEST_F(HistoryShaders, FollowRigidActors)
{
  // All surfaces belong to actor 1, which was 0.3 closer to the eye in the previous frame.
  this->MotionLib = "ActorMotion";
  this->Actors = [](int, int) { return std::array<float, 4>{ 0.f, 0.f, 0.f, 1.f / 255.f }; };
  this->Before = [](int, int) { return 0.3; };
  EXPECT_NEAR(this->Reproject("SampleValidation")[0], 3.0 + 2.0 * 0.25, 1e-4);
  // Without the motion, the history is that of another surface: there are 8 new samples only.
  this->Actors = [](int, int) { return std::array<float, 4>{}; };
  EXPECT_NEAR(this->Reproject("SampleValidation")[0], 8.0 * 0.25, 1e-4);
}

}
