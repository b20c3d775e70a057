// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// How occluders count less with their distance: D(t) of the integral of occlusion, and how it changes
// with t. Other words for 1 - D are obscurance and rho(t) (Zhukov, Iones and Kronin, *An Ambient Light
// Illumination Model*, 1998); rho = sqrt(t / R) is Mendez, Sbert and Cata's (*Real-time Obscurances with
// Color Bleeding*, 2003).
#ifndef penumbra_DistanceFalloff_h
#define penumbra_DistanceFalloff_h

#include <algorithm>
#include <cmath>
#include <limits>

namespace penumbra
{

struct DistanceFalloff
{
  /// In the order of vtkPenumbraIrradianceProvider::Falloffs.
  enum class Shapes
  {
    None,      ///< D = 1
    Linear,    ///< 1 - t / R
    Quadratic, ///< 1 - (t / R)^2
    SquareRoot ///< 1 - sqrt(t / R)
  };

  DistanceFalloff(float reach = std::numeric_limits<float>::infinity(), Shapes shape = Shapes::None)
    : Radius(reach),
      Shape(std::isinf(reach) ? Shapes::None : shape)
  {
  }

  /// From world units and one of vtkPenumbraIrradianceProvider::Falloffs.
  static DistanceFalloff InScene(double radius, int falloff, double scale)
  {
    return { static_cast<float>(radius * scale), static_cast<Shapes>(falloff) };
  }

  float Radius; ///< R, scene units; infinite: everything counts in full
  Shapes Shape;

  bool IsConstant() const { return this->Shape == Shapes::None; }

  /// D of what was met at `distance`, which is below Reach.
  float Evaluate(float distance) const
  {
    const float share = std::min(distance / this->Radius, 1.f);
    switch (this->Shape)
    {
      case Shapes::Linear:
        return 1.f - share;
      case Shapes::Quadratic:
        return 1.f - share * share;
      case Shapes::SquareRoot:
        return 1.f - std::sqrt(share);
      default:
        return 1.f;
    }
  }

  /// Its first derivative; `distance` is not 0.
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

  /// Its second derivative, likewise.
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
