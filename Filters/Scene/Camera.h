// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Maps image coordinates to camera rays and scene points to image coordinates, in double precision.
// Image coordinates are in pixels with (0, 0) at the lower left corner of the image; pixel (i, j)
// covers [i, i+1] x [j, j+1].
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
  /// Side length of a pixel: in perspective on the plane at depth 1, in parallel projection in
  /// scene units.
  double PixelSize = 1.0;
  /// Image coordinates of the view axis: the center of the image, unless the projection is
  /// off-axis.
  glm::dvec2 Center{ 0.5, 0.5 };
  /// Distance from the camera to the ray origins, in scene units. It is positive for scenes far
  /// from the camera. In parallel projection, Position already includes it.
  double Advance = 0.0;
  /// Smallest difference in depth that VTK's depth buffer is assumed to resolve: in perspective of
  /// 1 / depth, in parallel projection of the depth, in scene units. See DepthOffset.
  double DepthUnit = 0.0;
  double Near = 0.0; ///< minimum depth along Forward that is rendered
  double Far = 1e30; ///< maximum depth along Forward that is rendered

  /// Returns the origin of the ray through image point p.
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

  /// Returns the direction of the ray through p, scaled so that the ray parameter is the distance
  /// along Forward from the ray origin.
  glm::dvec3 RayDirection(glm::dvec2 p) const
  {
    if (this->Parallel)
    {
      return this->Forward;
    }
    const glm::dvec2 q = (p - this->Center) * this->PixelSize;
    return this->Forward + q.x * this->Right + q.y * this->Up;
  }

  /// Returns true if all rays through the image are finite and differ from pixel to pixel.
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

  /// Returns the depth of the ray origins. The depth of a hit is this value plus the ray parameter.
  double DepthOfRayOrigins() const { return this->Parallel ? 0.0 : this->Advance; }

  /// Returns the distance of x from the camera along Forward.
  double Depth(glm::dvec3 x) const { return glm::dot(x - this->Position, this->Forward); }

  /// Returns the image coordinates of x. In perspective, the result is valid only if Depth(x) > 0.
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
