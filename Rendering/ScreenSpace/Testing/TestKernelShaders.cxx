// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Functions of the horizon and march kernels against closed forms: cliffs and slopes in a parallel view.
#include "ShaderEvaluation.h"

#include <cmath>

namespace
{

constexpr double Pi = 3.14159265358979;

/// A cliff of height 0.4 at a distance of 0.3 on the right side of the center.
double CliffOnTheRight(int x, int)
{
  return x >= 19 ? 0.4 : 0.0;
}

double CliffsOnBothSides(int x, int)
{
  return x >= 19 || x <= 13 ? 0.4 : 0.0;
}

/// The same on a slope along the cliff, whose normal has 0.8 of its length in the slice across.
double CliffOnASlope(int x, int y)
{
  return CliffOnTheRight(x, y) + 0.75 * 0.1 * (y - 16);
}

class KernelShaders : public ShadersOverAPlane
{
protected:
  /// Evaluates an expression of the kernel over surfaces of these heights.
  double Evaluate(const std::string& kernel, const Heights& heights, const std::string& expression,
    double thickness = 1.0)
  {
    const vtkSmartPointer<vtkTextureObject> depths = this->MakeDepths(heights);
    const auto setInputs = [&](vtkShaderProgram* program, penumbra::Stage& stage) {
      SetView(program);
      float samples[64][4] = {};
      samples[0][1] = 0.2f; // shift of the steps
      samples[0][2] = 0.5f; // shift of the rays
      program->SetUniform4fv("samples", 64, samples);
      program->SetUniformf("pixelRotation", 0.f);
      program->SetUniformf("thickness", static_cast<float>(thickness));
      stage.BindTexture("eyeDepths", depths);
    };
    return this->Run(AssembleEstimate(kernel) + Sides,
      "gl_FragData[0] = vec4(float(" + expression + "));", setInputs)[0];
  }

  /// A side of a slice of the march kernel whose second sampled point is given, in a parallel view.
  /// The others are on the plane.
  std::string Sides;

  void UseSides()
  {
    this->Sides = "SliceSide sideWith(vec2 first, vec2 second)\n{\n  SliceSide side;\n"
                  "  side.normal = vec2(0.0, 1.0);\n"
                  "  side.sampled = vec2[4](first, second, vec2(0.8, 0.0), vec2(0.9, 0.0));\n"
                  "  side.viewDirection = vec2[4](vec2(0.0, -1.0), vec2(0.0, -1.0), "
                  "vec2(0.0, -1.0), vec2(0.0, -1.0));\n  connectPoints(side);\n  return side;\n}\n"
                  "float sideTilted(SliceSide side, float angle)\n{\n"
                  "  side.normal = vec2(sin(angle), cos(angle));\n"
                  "  return sideOcclusion(side, angle, 0.5);\n}\n";
  }

  /// Returns the probability that the ray between the plane and the view direction is blocked.
  double BlockedAt45Degrees(const std::string& second, double thickness)
  {
    this->UseSides();
    return this->Evaluate(
      "March", [](int, int) { return 0.0; },
      "blockedProbability(sideWith(vec2(0.1, 0.0), " + second + "), vec2(sqrt(0.5)))", thickness);
  }
};

TEST_F(KernelShaders, FindTheHorizonWithinTheRadius)
{
  const auto horizon = [&](const Heights& heights, const char* step, const char* component) {
    return this->Evaluate("Horizon", heights,
      "horizon(" CENTER ", vec3(0.0, 0.0, 1.0), vec3(1.0, 0.0, 0.0), vec2(" + std::string(step) +
        ", 0.0), 0.0)." + component);
  };
  // The tangent of the angle from the normal is 0.3 / 0.4.
  EXPECT_NEAR(horizon(CliffOnTheRight, "1.0", "x"), 0.8, 1e-5);
  EXPECT_NEAR(horizon(CliffOnTheRight, "1.0", "y"), 0.6, 1e-5);
  // The samples are 4, 8 and 12 pixels away. The last one is outside of the radius.
  const auto far = [](int x, int) { return x >= 28 ? 0.4 : 0.0; };
  EXPECT_NEAR(horizon(far, "4.0", "x"), 0.0, 1e-6);
  // The highest of several.
  const auto stairs = [](int x, int) { return x >= 25 ? 0.4 : x >= 22 ? 0.3 : 0.0; };
  EXPECT_NEAR(horizon(stairs, "3.0", "x"), 0.3 / std::hypot(0.3, 0.6), 1e-5);
  EXPECT_NEAR(
    horizon([](int x, int) { return -0.1 * (x - 16); }, "1.0", "x"), 0.0, 1e-6); // below the plane
}

TEST_F(KernelShaders, HorizonsMatchTheClosedForm)
{
  const auto slice = [&](const Heights& heights, const char* azimuth) {
    return this->Evaluate("Horizon", heights,
      "sliceOcclusion(" CENTER ", vec3(0.0, 0.0, 1.0), " + std::string(azimuth) + ", 0.2)");
  };
  // Half the squared cosine of the angle between normal and horizon, per side.
  EXPECT_NEAR(slice(CliffOnTheRight, "0.0"), 0.5 * 0.64, 2e-3);
  EXPECT_NEAR(slice(CliffsOnBothSides, "0.0"), 0.64, 2e-3);
  EXPECT_NEAR(slice(CliffOnASlope, "0.0"), 0.8 * 0.5 * 0.64, 2e-3);
  EXPECT_NEAR(slice(CliffOnTheRight, "0.5 * pi"), 0.0, 1e-4); // along the cliff
  // A slope has no occlusion in any slice, whatever its tilt.
  for (const double tilt : { 0.2, -0.5, 1.5 })
  {
    const auto slope = [&](int x, int y) { return tilt * DistanceOf(x) + 0.3 * DistanceOf(y); };
    EXPECT_NEAR(slice(slope, "0.0"), 0.0, 2e-3) << tilt;
    EXPECT_NEAR(slice(slope, "0.7"), 0.0, 2e-3) << tilt;
  }
  EXPECT_NEAR(
    this->Evaluate("Horizon", CliffsOnBothSides, "occlusionAt(" CENTER ", 1)"), 0.64, 2e-3);
}

TEST_F(KernelShaders, MarchBlocksRaysBehindSurfacesByTheirThickness)
{
  // At the distance 0.3 the ray passes 0.7 behind the sampled point, which a slope cannot reach.
  EXPECT_NEAR(this->BlockedAt45Degrees("vec2(0.3, 1.0)", 1.0), std::exp(-0.7), 1e-5);
  EXPECT_NEAR(this->BlockedAt45Degrees("vec2(0.3, 1.0)", 0.1), std::exp(-7.0), 1e-5);
  // It crosses the slope from the first to the second point, however thin.
  EXPECT_NEAR(this->BlockedAt45Degrees("vec2(0.3, 0.5)", 0.01), 1.0, 1e-5);
  // It passes in front.
  EXPECT_NEAR(this->BlockedAt45Degrees("vec2(0.3, 0.2)", 1.0), 0.0, 1e-6);
  // It passes behind at a distance of 1.13.
  EXPECT_NEAR(this->BlockedAt45Degrees("vec2(0.8, 3.0)", 1.0), 0.0, 1e-6);
}

TEST_F(KernelShaders, MarchIntegratesTheCosineOverASide)
{
  this->UseSides();
  // A wall next to the point blocks all rays of a side: from the view direction to the tangent
  // plane, whose normal is tilted by n: (2 cos n + (2 n + pi) sin n) / 4.
  for (const double n : { 0.0, 0.4, -0.6 })
  {
    std::string side = "sideWith(vec2(0.001, 0.5), vec2(0.3, 0.0))";
    const std::string tilt = std::to_string(n);
    const double blocked = this->Evaluate(
      "March", [](int, int) { return 0.0; }, "sideTilted(" + side + ", " + tilt + ")", 1e3);
    EXPECT_NEAR(
      blocked, 0.25 * (2.0 * std::cos(n) + (2.0 * n + Pi) * std::sin(n)), 5e-3 * std::exp(n))
      << n;
  }
}

TEST_F(KernelShaders, MarchCountsRaysBelowTheHorizon)
{
  const auto slice = [&](const Heights& heights, double thickness) {
    return this->Evaluate("March", heights,
      "sliceOcclusion(" CENTER ", vec3(0.0, 0.0, 1.0), vec4(0.0, 0.2, 0.5, 0.0))", thickness);
  };
  // Eight rays in the middle of equal angles.
  double below = 0.0;
  for (int i = 0; i < 8; ++i)
  {
    const double angle = (i + 0.5) * Pi / 16.0;
    below += std::tan(angle) > 0.3 / 0.4 ? std::sin(angle) * std::cos(angle) * Pi / 16.0 : 0.0;
  }
  EXPECT_NEAR(slice(CliffOnTheRight, 1e3), below, 5e-4);
  EXPECT_NEAR(slice(CliffOnASlope, 1e3), 0.8 * below, 5e-4);
  EXPECT_NEAR(slice(CliffsOnBothSides, 1e3), 2.0 * below, 5e-4);
  EXPECT_NEAR(this->Evaluate("March", CliffsOnBothSides, "occlusionAt(" CENTER ", 1)", 1e3),
    2.0 * below, 5e-4);
  for (const double tilt : { 0.2, -0.5, 1.5 })
  {
    const auto slope = [&](int x, int y) { return tilt * DistanceOf(x) + 0.3 * DistanceOf(y); };
    EXPECT_NEAR(slice(slope, 1.0), 0.0, 1e-3) << tilt;
  }
}

}
