// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// From picture coordinates to rays and back, in double. Picture coordinates are in pixels, (0, 0)
// the lower left corner of the picture; pixel (i, j) covers [i, i+1] x [j, j+1].
#ifndef penumbra_Camera_h
#define penumbra_Camera_h

#include <glm/glm.hpp>

#include <cmath>
#include <initializer_list>

namespace penumbra
{

/// A perspective or parallel camera. Right, Up and Forward are orthonormal.
struct Camera
{
  bool Parallel = false;
  glm::dvec3 Position{ 0.0 };
  glm::dvec3 Right{ 1.0, 0.0, 0.0 };
  glm::dvec3 Up{ 0.0, 1.0, 0.0 };
  glm::dvec3 Forward{ 0.0, 0.0, -1.0 };
  int Width = 1;
  int Height = 1;
  /// Side of a pixel: perspective, on the plane at distance 1; parallel, in scene units.
  double PixelSize = 1.0;
  /// Where the view axis meets the picture, in pixels (the middle, unless the view is off-centre).
  glm::dvec2 Center{ 0.5, 0.5 };
  /// How far in front of the eye rays begin, closer to a scene far away. In parallel projection
  /// Position has been moved there.
  double Advance = 0.0;
  double Near = 0.0; ///< nearest distance along Forward that is drawn
  double Far = 1e30;

  /// Origin of the ray through picture point p.
  glm::dvec3 RayOrigin(glm::dvec2 p) const
  {
    if (!this->Parallel)
    {
      return this->Advance > 0.0 ? this->Position + this->Advance * this->RayDirection(p)
                                 : this->Position;
    }
    const glm::dvec2 q = (p - this->Center) * this->PixelSize;
    return this->Position + q.x * this->Right + q.y * this->Up;
  }

  /// Direction of the ray through p, scaled so that its parameter is the distance along Forward.
  glm::dvec3 RayDirection(glm::dvec2 p) const
  {
    if (this->Parallel)
    {
      return this->Forward;
    }
    const glm::dvec2 q = (p - this->Center) * this->PixelSize;
    return this->Forward + q.x * this->Right + q.y * this->Up;
  }

  /// True if all rays through the image are finite and differ from pixel to pixel.
  bool IsUsable() const
  {
    if (!(this->PixelSize > 0.0 && this->Near >= 0.0))
    {
      return false;
    }
    for (const glm::dvec2 corner : { glm::dvec2(0.0), glm::dvec2(this->Width, this->Height) })
    {
      for (const glm::dvec3 x : { this->RayOrigin(corner), this->RayDirection(corner) })
      {
        if (!std::isfinite(glm::dot(x, x)))
        {
          return false;
        }
      }
    }
    return true;
  }

  /// Depth of the places where rays begin: that of what a ray meets less its distance.
  double DepthOfRayOrigins() const { return this->Parallel ? 0.0 : this->Advance; }

  /// Distance along Forward.
  double Depth(glm::dvec3 x) const { return glm::dot(x - this->Position, this->Forward); }

  /// Picture point of x; only meaningful in perspective where Depth(x) > 0.
  glm::dvec2 Project(glm::dvec3 x) const
  {
    const glm::dvec3 d = x - this->Position;
    const glm::dvec2 q(glm::dot(d, this->Right), glm::dot(d, this->Up));
    const double s = this->Parallel ? 1.0 : 1.0 / glm::dot(d, this->Forward);
    return this->Center + q * (s / this->PixelSize);
  }
};

}
#endif
