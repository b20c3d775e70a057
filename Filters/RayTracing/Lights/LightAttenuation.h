// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Attenuation of light between lights and surfaces by something other than surfaces.
#ifndef penumbra_LightAttenuation_h
#define penumbra_LightAttenuation_h

#include <glm/glm.hpp>

namespace penumbra
{

struct Light;

class LightAttenuation
{
public:
  virtual ~LightAttenuation() = default;

  /// Returns the transmittance, per color channel, between `light` (its center) and a point in scene
  /// coordinates.
  virtual glm::vec3 TransmittanceToLight(const Light& light, glm::vec3 point) const = 0;
};

}
#endif
