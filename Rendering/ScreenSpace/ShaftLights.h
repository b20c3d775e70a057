// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Lights that make light shafts, as their shaders take them: in eye coordinates with z along the
// view axis.
#ifndef penumbra_ShaftLights_h
#define penumbra_ShaftLights_h

#include "ScreenView.h"

#include <vector>

class vtkLight;
class vtkRenderer;

namespace penumbra
{

struct ShaftLight
{
  float Place[4] = { 0.f, 0.f, 1.f, 0.f }; ///< where it is (w = 1), or unit direction to it (w = 0)
  float Color[3] = { 1.f, 1.f, 1.f };      ///< times intensity
  float Attenuation[3] = { 1.f, 0.f, 0.f };
  float Cone[4] = { 0.f, 0.f, 1.f, -2.f }; ///< the way of a spot, cosine of its cone; -2: none
  float Exponent = 1.f;

  /// Seen on the picture: then nothing outside of it can shadow what is inside.
  bool InPicture = false;

  /// Sets the light's uniforms of vtkPenumbraShaftLib.glsl.
  void SetUniforms(vtkShaderProgram* program) const;

  bool operator==(const ShaftLight& other) const;
};

/// Those of `renderer` that are on, not black and finite: all but headlights, or the `chosen` ones
/// if there are any. `view` has no margin.
std::vector<ShaftLight> FindShaftLights(
  vtkRenderer* renderer, const std::vector<vtkLight*>& chosen, const ScreenView& view);

}
#endif
