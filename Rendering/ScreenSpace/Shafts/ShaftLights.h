// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Lights of the light shafts in the form that the shaders use: eye coordinates with z along the
// view axis, in groups that one stage processes together.
#ifndef penumbra_ShaftLights_h
#define penumbra_ShaftLights_h

#include "Frame/ScreenTransform.h"

#include <array>
#include <vector>

class vtkLight;
class vtkRenderer;

namespace penumbra
{

struct ShaftLight
{
  float Position[4] = { 0.f, 0.f, 1.f,
    0.f };                            ///< position (w = 1), or unit direction to the light (w = 0)
  float Color[3] = { 1.f, 1.f, 1.f }; ///< intensity included
  float Attenuation[3] = { 1.f, 0.f, 0.f };
  float Cone[4] = { 0.f, 0.f, 1.f,
    -2.f }; ///< direction of a spotlight, cosine of its cone; -2: no cone
  float Exponent = 1.f;

  std::array<double, 3> World{}; ///< position, or unit direction to the light, in world coordinates
  std::array<double, 3> Axis{};  ///< unit direction in which the light shines, in world coordinates
  bool HasShadowMap = false;     ///< lit fractions come from a shadow map

  /// The light projects into the image. Then nothing outside of the image can shadow what is
  /// inside.
  bool InImage = false;

  bool IsPositional() const { return this->Position[3] > 0.f; }
  bool operator==(const ShaftLight& other) const;
};

/// Lights that one stage processes together: up to three directional lights, or one positional
/// light.
class ShaftLightGroup
{
public:
  static constexpr int Capacity = 3; ///< as the arrays in the shaders

  explicit ShaftLightGroup(const ShaftLight& first)
    : Lights{ first }
  {
  }

  /// Adds a light. Returns false, without adding it, if it does not fit into the group.
  bool Add(const ShaftLight& light);

  const std::vector<ShaftLight>& GetLights() const { return this->Lights; }
  bool IsPositional() const { return this->Lights.front().IsPositional(); }

  /// Sets the uniforms of the lights in vtkPenumbraShaftLib.glsl.
  void SetUniforms(vtkShaderProgram* program) const;

  /// Sets the colors of the lights, multiplied by `exposure`.
  void SetColors(vtkShaderProgram* program, double exposure) const;

private:
  std::vector<ShaftLight> Lights;
};

/// Finds the lights of `renderer` that are on, finite and not black: all except headlights, or only
/// those in `chosen` if it is not empty. `view` has no margin.
std::vector<ShaftLight> FindShaftLights(
  vtkRenderer* renderer, const std::vector<vtkLight*>& chosen, const ScreenTransform& view);

/// Groups lights into as few groups as possible; if `separate` is on, one per light.
std::vector<ShaftLightGroup> GroupLights(const std::vector<ShaftLight>& lights, bool separate);

}
#endif
