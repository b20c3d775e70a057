// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Sizes of individual lights, which vtkLight does not have.
#ifndef penumbra_LightSizes_h
#define penumbra_LightSizes_h

#include "vtkWeakPointer.h"

#include <cmath>
#include <vector>

class vtkLight;

namespace penumbra
{

/// Throws std::runtime_error unless the radius of a light is finite and not negative, and its
/// angular diameter is between 0 and 180 degrees.
void RequireLightSize(double radius, double angle);

/// Sizes of individual lights, which replace the size of all lights.
class LightSizes
{
public:
  /// Sets the radius in world units. Invalid values are kept for Require().
  void SetRadius(vtkLight* light, double radius);

  /// Sets the angular diameter in degrees. Invalid values are kept for Require().
  void SetAngle(vtkLight* light, double angle);

  /// Return the size of `light`, or `all` if none was set.
  double GetRadius(vtkLight* light, double all) const;
  double GetAngle(vtkLight* light, double all) const;

  void Clear() { this->Lights.clear(); }
  std::size_t GetCount() const { return this->Lights.size(); }

  /// Throws std::runtime_error if a size is invalid.
  void Require() const;

private:
  /// Size of one light; NaN where none is set.
  struct SizedLight
  {
    vtkWeakPointer<vtkLight> Source;
    double Radius = std::nan("");
    double Angle = std::nan("");
  };

  const SizedLight* Find(vtkLight* light) const;
  SizedLight& GetOrAdd(vtkLight* light);

  std::vector<SizedLight> Lights;
};

}
#endif
