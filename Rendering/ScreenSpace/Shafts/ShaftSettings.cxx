// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ShaftSettings.h"

#include "vtkShaderProgram.h"

#include <algorithm>
#include <tuple>

namespace penumbra
{

namespace
{

auto AsTuple(const ShaftSettings& s)
{
  return std::tie(s.Scattering, s.Extinction, s.Phase, s.Asymmetry, s.Exposure, s.Radial,
    s.RadialBlur, s.Thickness, s.MapSize, s.MapSteps, s.Steps, s.Block, s.Bounded, s.Bounds,
    s.Prepass, s.Emitters, s.AutomaticTone, s.Unit, s.Range);
}

void SetNumber(vtkShaderProgram* program, const char* name, double value)
{
  program->SetUniformf(name, static_cast<float>(value));
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

}

bool ShaftSettings::operator==(const ShaftSettings& other) const
{
  return AsTuple(*this) == AsTuple(other);
}

void ShaftSettings::SetMedium(vtkShaderProgram* program, const ScreenTransform& view) const
{
  SetNumber(program, "scattering", this->Scattering * this->Unit);
  SetNumber(program, "extinction", this->Extinction * this->Unit);
  program->SetUniformi("phase", this->Phase);
  SetNumber(program, "asymmetry", this->Asymmetry);
  if (this->Bounded)
  {
    SetBox(program, this->Bounds, view);
  }
}

}
