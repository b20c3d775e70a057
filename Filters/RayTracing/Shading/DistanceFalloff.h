// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Falloff D(t) of occlusion with the distance t of the occluder, and its derivatives. In the
// literature 1 - D is called obscurance or rho(t) (Zhukov, Iones and Kronin, *An Ambient Light
// Illumination Model*, 1998); rho = sqrt(t / R) is due to Mendez, Sbert and Cata (*Real-time
// Obscurances with Color Bleeding*, 2003).
#ifndef penumbra_DistanceFalloff_h
#define penumbra_DistanceFalloff_h

#include <algorithm>
#include <cmath>
#include <limits>

namespace penumbra
{

struct DistanceFalloff
{
  /// Falloff functions, in the order of vtkPenumbraIrradianceProvider::Falloffs.
  enum class Shapes
  {
    None,      ///< D = 1
    Linear,    ///< 1 - t / R
    Quadratic, ///< 1 - (t / R)^2
    SquareRoot ///< 1 - sqrt(t / R)
  };

  DistanceFalloff(
    float radius = std::numeric_limits<float>::infinity(), Shapes shape = Shapes::None)
    : Radius(radius),
      Shape(std::isinf(radius) ? Shapes::None : shape)
  {
  }

  /// Creates a falloff from a radius in world units and one of
  /// vtkPenumbraIrradianceProvider::Falloffs; `scale` converts world units to scene units.
  static DistanceFalloff InScene(double radius, int falloff, double scale)
  {
    return { static_cast<float>(radius * scale), static_cast<Shapes>(falloff) };
  }

  float Radius; ///< R, in scene units; if infinite, D = 1 everywhere
  Shapes Shape;

  bool IsConstant() const { return this->Shape == Shapes::None; }

  /// Returns D at `distance`, which must be below Radius.
  float Evaluate(float distance) const
  {
    const float fraction = std::min(distance / this->Radius, 1.f);
    switch (this->Shape)
    {
      case Shapes::Linear:
        return 1.f - fraction;
      case Shapes::Quadratic:
        return 1.f - fraction * fraction;
      case Shapes::SquareRoot:
        return 1.f - std::sqrt(fraction);
      default:
        return 1.f;
    }
  }

  /// Returns the first derivative of D; `distance` must not be 0.
  float Derivative(float distance) const
  {
    switch (this->Shape)
    {
      case Shapes::Linear:
        return -1.f / this->Radius;
      case Shapes::Quadratic:
        return -2.f * distance / (this->Radius * this->Radius);
      case Shapes::SquareRoot:
        return -.5f / std::sqrt(distance * this->Radius);
      default:
        return 0.f;
    }
  }

  /// Returns the second derivative of D; `distance` must not be 0.
  float SecondDerivative(float distance) const
  {
    switch (this->Shape)
    {
      case Shapes::Quadratic:
        return -2.f / (this->Radius * this->Radius);
      case Shapes::SquareRoot:
        return .25f / (distance * std::sqrt(distance * this->Radius));
      default:
        return 0.f;
    }
  }
};

}
#endif
