// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ShaftSettings.h"

#include "Frame/Uniforms.h"

#include "vtkShaderProgram.h"

#include <algorithm>
#include <tuple>

namespace penumbra
{

namespace
{

auto AsTuple(const ShaftSettings& s)
{
  return std::tie(s.Channels, s.Falloff, s.ScaleHeight, s.BaseHeight, s.Up, s.Phase, s.Asymmetry,
    s.Exposure, s.Radial, s.RadialBlur, s.Thickness, s.MapSize, s.MapSteps, s.Steps, s.Block,
    s.Bounded, s.Bounds, s.Prepass, s.Emitters, s.AutomaticTone, s.Unit, s.Range);
}

void SetBox(
  vtkShaderProgram* program, const std::array<double, 6>& bounds, const ScreenTransform& view)
{
  const Matrix& toEye = view.WorldToEye;
  float rotation[16] = {};
  float boxMinimum[3];
  float boxMaximum[3];
  for (int axis = 0; axis < 3; ++axis)
  {
    double eye = 0.0;
    for (int row = 0; row < 3; ++row)
    {
      const double entry = toEye[4 * row + axis];
      eye -= entry * toEye[4 * row + 3];
      rotation[4 * row + axis] = static_cast<float>(row == 2 ? -entry : entry);
    }
    const auto fromEye = [&](double bound) {
      return static_cast<float>(std::clamp((bound - eye) / view.Unit, -1e30, 1e30));
    };
    boxMinimum[axis] = fromEye(bounds[2 * axis]);
    boxMaximum[axis] = fromEye(bounds[2 * axis + 1]);
  }
  rotation[15] = 1.f;
  program->SetUniformMatrix4x4("eyeToWorld", rotation);
  program->SetUniform3f("boxMinimum", boxMinimum);
  program->SetUniform3f("boxMaximum", boxMaximum);
}

/// Sets the height of a point as a linear function of its eye coordinates.
void SetHeight(
  vtkShaderProgram* program, const ShaftSettings& settings, const ScreenTransform& view)
{
  const Matrix& toEye = view.WorldToEye;
  float height[4];
  double constant = -settings.BaseHeight;
  for (int row = 0; row < 3; ++row)
  {
    double up = 0.0;
    for (int axis = 0; axis < 3; ++axis)
    {
      up += toEye[4 * row + axis] * settings.Up[axis];
    }
    constant -= up * toEye[4 * row + 3];
    height[row] = static_cast<float>((row == 2 ? -up : up) * view.Unit / settings.ScaleHeight);
  }
  height[3] = static_cast<float>(constant / settings.ScaleHeight);
  program->SetUniform4f("heightOfPoint", height);
}

}

int ShaftSettings::GetReferenceChannel() const
{
  return static_cast<int>(std::min_element(this->Channels.begin(), this->Channels.end(),
                            [](const MediumCoefficients& a, const MediumCoefficients& b) {
                              return a.Extinction < b.Extinction;
                            }) -
    this->Channels.begin());
}

bool ShaftSettings::operator==(const ShaftSettings& other) const
{
  return AsTuple(*this) == AsTuple(other);
}

void ShaftSettings::SetMedium(vtkShaderProgram* program, const ScreenTransform& view) const
{
  float coefficients[3][3];
  for (std::size_t i = 0; i < 3; ++i)
  {
    const MediumCoefficients& channel = this->Channels[i];
    coefficients[i][0] = static_cast<float>(channel.Scattering * this->Unit);
    coefficients[i][1] = static_cast<float>(channel.Extinction * this->Unit);
    coefficients[i][2] = static_cast<float>(channel.Rayleigh * this->Unit);
  }
  program->SetUniform3fv("coefficients", 3, coefficients);
  program->SetUniformi("referenceChannel", this->GetReferenceChannel());
  program->SetUniformi("phase", this->Phase);
  SetNumber(program, "asymmetry", this->Asymmetry);
  if (this->Bounded)
  {
    SetBox(program, this->Bounds, view);
  }
  if (this->Falloff)
  {
    SetHeight(program, *this, view);
  }
}

void ShaftSettings::SetExtinctionRatios(vtkShaderProgram* program) const
{
  const double reference = std::max(this->Channels[this->GetReferenceChannel()].Extinction, 1e-300);
  float ratios[3];
  for (std::size_t i = 0; i < 3; ++i)
  {
    ratios[i] = static_cast<float>(this->Channels[i].Extinction / reference);
  }
  program->SetUniform3f("extinctionRatios", ratios);
}

}
