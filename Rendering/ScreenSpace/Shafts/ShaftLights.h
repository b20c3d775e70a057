// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Lights that make light shafts, as their shaders take them: in eye coordinates with z along the
// view axis, several at once.
#ifndef penumbra_ShaftLights_h
#define penumbra_ShaftLights_h

#include "Frame/ScreenTransform.h"

#include <vector>

class vtkLight;
class vtkRenderer;

namespace penumbra
{

struct ShaftLight
{
  float Position[4] = { 0.f, 0.f, 1.f,
    0.f };                            ///< where it is (w = 1), or unit direction to it (w = 0)
  float Color[3] = { 1.f, 1.f, 1.f }; ///< times intensity
  float Attenuation[3] = { 1.f, 0.f, 0.f };
  float Cone[4] = { 0.f, 0.f, 1.f, -2.f }; ///< the way of a spot, cosine of its cone; -2: none
  float Exponent = 1.f;

  /// Seen on the picture: then nothing outside of it can shadow what is inside.
  bool InPicture = false;

  bool IsPositional() const { return this->Position[3] > 0.f; }
  bool operator==(const ShaftLight& other) const;
};

/// Lights that one stage takes together: up to three suns, or a lamp.
class ShaftLightGroup
{
public:
  static constexpr int Most = 3;

  explicit ShaftLightGroup(const ShaftLight& first)
    : Lights{ first }
  {
  }

  /// Takes one more, if it can.
  bool Join(const ShaftLight& light);

  const std::vector<ShaftLight>& GetLights() const { return this->Lights; }
  bool IsLamp() const { return this->Lights.front().IsPositional(); }

  /// Sets the lights' uniforms of vtkPenumbraShaftLib.glsl.
  void SetUniforms(vtkShaderProgram* program) const;

  /// And their colours, times `exposure`.
  void SetColors(vtkShaderProgram* program, double exposure) const;

private:
  std::vector<ShaftLight> Lights;
};

/// Those of `renderer` that are on, not black and finite: all but headlights, or the `chosen` ones
/// if there are any. `view` has no margin.
std::vector<ShaftLight> FindShaftLights(
  vtkRenderer* renderer, const std::vector<vtkLight*>& chosen, const ScreenTransform& view);

/// As few groups as there may be; `alone`: one for each light.
std::vector<ShaftLightGroup> GroupLights(const std::vector<ShaftLight>& lights, bool alone);

}
#endif
