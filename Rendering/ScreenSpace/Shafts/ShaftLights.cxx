// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ShaftLights.h"

#include "vtkLight.h"
#include "vtkLightCollection.h"
#include "vtkMath.h"
#include "vtkRenderer.h"
#include "vtkShaderProgram.h"

#include <algorithm>
#include <cmath>

namespace penumbra
{

namespace
{

/// Transforms to eye coordinates with z along the view axis, in the unit of the view. w = 0: a
/// direction.
void TransformToEye(const ScreenTransform& view, const double world[3], double w, double eye[3])
{
  for (int row = 0; row < 3; ++row)
  {
    const double* m = view.WorldToEye.data() + 4 * row;
    eye[row] = m[0] * world[0] + m[1] * world[1] + m[2] * world[2] + m[3] * w;
    eye[row] *= row == 2 ? -1.0 : 1.0;
    eye[row] /= w != 0.0 ? view.Unit : 1.0;
  }
}

bool IsInImage(const float position[4], const ScreenTransform& view)
{
  if (position[2] <= 0.f && !view.Parallel)
  {
    return false;
  }
  if (view.Parallel && position[3] == 0.f)
  {
    return false;
  }
  const double unit = view.Parallel ? view.Unit : 1.0;
  const int sizes[2] = { view.Width, view.Height };
  double pixel = 0.0;
  for (const int axis : { 1, 0 })
  {
    const double plane = unit * position[axis] / (view.Parallel ? 1.0 : position[2]);
    const double skew = axis == 0 ? view.Skew * pixel : 0.0;
    pixel = (plane - skew - view.Offset[axis]) / view.Scale[axis];
    if (!(pixel >= 0.0 && pixel <= sizes[axis]))
    {
      return false;
    }
  }
  return true;
}

ShaftLight Convert(vtkLight* light, const ScreenTransform& view)
{
  double position[3];
  double focus[3];
  light->GetTransformedPosition(position);
  light->GetTransformedFocalPoint(focus);
  double direction[3] = { focus[0] - position[0], focus[1] - position[1], focus[2] - position[2] };
  vtkMath::Normalize(direction);
  double eye[3];
  TransformToEye(view, direction, 0.0, eye);
  ShaftLight result;
  const bool positional = light->GetPositional() != 0;
  for (int i = 0; i < 3; ++i)
  {
    result.Position[i] = static_cast<float>(-eye[i]);
    result.Cone[i] = static_cast<float>(eye[i]);
    result.World[i] = positional ? position[i] : -direction[i];
    result.Axis[i] = direction[i];
    result.Color[i] = static_cast<float>(light->GetDiffuseColor()[i] * light->GetIntensity());
  }
  if (positional)
  {
    TransformToEye(view, position, 1.0, eye);
    std::copy(eye, eye + 3, result.Position);
    result.Position[3] = 1.f;
    const double* attenuation = light->GetAttenuationValues();
    for (int i = 0; i < 3; ++i)
    {
      result.Attenuation[i] = static_cast<float>(attenuation[i] * std::pow(view.Unit, i));
    }
    if (light->GetConeAngle() < 90.0)
    {
      const double angle = vtkMath::RadiansFromDegrees(light->GetConeAngle());
      result.Cone[3] = static_cast<float>(std::cos(angle));
      result.Exponent = static_cast<float>(light->GetExponent());
    }
  }
  result.InImage = IsInImage(result.Position, view);
  return result;
}

bool IsUsable(const ShaftLight& light)
{
  const auto finite = [](float x) { return std::isfinite(x); };
  const float square = light.Position[0] * light.Position[0] +
    light.Position[1] * light.Position[1] + light.Position[2] * light.Position[2];
  return std::all_of(light.Position, light.Position + 4, finite) &&
    std::all_of(light.Color, light.Color + 3, finite) &&
    std::all_of(light.Attenuation, light.Attenuation + 3, finite) && square > 0.f &&
    std::any_of(light.Color, light.Color + 3, [](float c) { return c > 0.f; });
}

}

bool ShaftLightGroup::Add(const ShaftLight& light)
{
  const bool fits = !this->IsPositional() && !light.IsPositional() &&
    static_cast<int>(this->Lights.size()) < Capacity;
  if (fits)
  {
    this->Lights.push_back(light);
  }
  return fits;
}

void ShaftLightGroup::SetUniforms(vtkShaderProgram* program) const
{
  float positions[Capacity][4] = {};
  for (std::size_t i = 0; i < this->Lights.size(); ++i)
  {
    std::copy_n(this->Lights[i].Position, 4, positions[i]);
  }
  program->SetUniform4fv("lights", Capacity, positions);
  program->SetUniformi("lightCount", static_cast<int>(this->Lights.size()));
  if (this->IsPositional())
  {
    const ShaftLight& light = this->Lights.front();
    program->SetUniform3f("attenuation", light.Attenuation);
    program->SetUniform4f("cone", light.Cone);
    program->SetUniformf("coneExponent", light.Exponent);
  }
}

void ShaftLightGroup::SetColors(vtkShaderProgram* program, double exposure) const
{
  float colors[Capacity][3] = {};
  for (std::size_t i = 0; i < this->Lights.size(); ++i)
  {
    for (int k = 0; k < 3; ++k)
    {
      colors[i][k] = this->Lights[i].Color[k] * static_cast<float>(exposure);
    }
  }
  program->SetUniform3fv("colors", Capacity, colors);
}

std::vector<ShaftLightGroup> GroupLights(const std::vector<ShaftLight>& lights, bool separate)
{
  std::vector<ShaftLight> sorted = lights;
  std::stable_partition(
    sorted.begin(), sorted.end(), [](const ShaftLight& light) { return !light.IsPositional(); });
  std::vector<ShaftLightGroup> groups;
  for (const ShaftLight& light : sorted)
  {
    if (separate || groups.empty() || !groups.back().Add(light))
    {
      groups.emplace_back(light);
    }
  }
  return groups;
}

bool ShaftLight::operator==(const ShaftLight& other) const
{
  return std::equal(this->Position, this->Position + 4, other.Position) &&
    std::equal(this->Color, this->Color + 3, other.Color) &&
    std::equal(this->Attenuation, this->Attenuation + 3, other.Attenuation) &&
    std::equal(this->Cone, this->Cone + 4, other.Cone) && this->Exponent == other.Exponent &&
    this->HasShadowMap == other.HasShadowMap;
}

std::vector<ShaftLight> FindShaftLights(
  vtkRenderer* renderer, const std::vector<vtkLight*>& chosen, const ScreenTransform& view)
{
  std::vector<ShaftLight> found;
  vtkLightCollection* lights = renderer->GetLights();
  vtkCollectionSimpleIterator position;
  lights->InitTraversal(position);
  while (vtkLight* light = lights->GetNextLight(position))
  {
    const bool selected = chosen.empty()
      ? !light->LightTypeIsHeadlight()
      : std::find(chosen.begin(), chosen.end(), light) != chosen.end();
    if (selected && light->GetSwitch())
    {
      const ShaftLight converted = Convert(light, view);
      if (IsUsable(converted))
      {
        found.push_back(converted);
      }
    }
  }
  return found;
}

}
