// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "SurfaceFromDepth.h"

#include "Execution/ParallelFor.h"
#include "Frame/ScreenTransform.h"
#include "Shading/HemisphereSampling.h"

#include "vtkMatrix4x4.h"

#include <algorithm>
#include <cmath>

namespace penumbra
{

namespace
{

/// Eye depths beyond this are empty pixels: vtkPenumbraViewLib.glsl.
constexpr float FarAway = 1e17f;

/// Steps of a depth buffer of floats, near its far end; twice that, since the rasteriser rounds too.
constexpr double DepthStep = 0x1p-23;

/// The mesh is looked for so many steps of depth, and so many widths of a pixel, before and behind.
constexpr double StepsAround = 16.0;
constexpr double PixelsAround = 4.0;

/// Where depths lie in a plane within this share of a pixel's width, they tell all that the mesh would.
/// Measured, `./penumbra benchmark ambient-occlusion --only traced`: the errors of up to 16 frames are those of
/// .02, converged they are .0003 to .0006 larger, in two thirds of the time.
constexpr float FlatWithin = 0.1f;

/// As far off in pixels as the rasteriser may place a corner.
constexpr float Snap = 1.f / 128.f;

constexpr int PacketSize = 16;

class SurfaceReconstructor
{
public:
  SurfaceReconstructor(const std::vector<float>& eyeDepths, bool atCenters,
    const ScreenTransform& view, const RayScene& rays)
    : EyeDepths(eyeDepths),
      AtCenters(atCenters),
      View(view),
      Rays(rays)
  {
    Matrix eyeToWorld;
    vtkMatrix4x4::Invert(view.WorldToEye.data(), eyeToWorld.data());
    const Scene& scene = rays.GetScene();
    for (int row = 0; row < 3; ++row)
    {
      for (int column = 0; column < 3; ++column)
      {
        this->Turn[column][row] =
          static_cast<float>(eyeToWorld[4 * row + column] * view.Unit * scene.Scale);
      }
      this->Eye[row] =
        static_cast<float>((eyeToWorld[4 * row + 3] - scene.Origin[row]) * scene.Scale);
    }
    this->UnitLength = static_cast<float>(view.Unit * scene.Scale);
    // See ScreenTransform::SetUniforms: how fast eye depth, or its inverse, changes with the buffer's.
    this->Slope = std::abs(view.Parallel ? 2.0 / view.Projection[10] / view.Unit
                                         : 2.0 / view.Projection[11] * view.Unit);
  }

  /// What depths alone do not tell is looked for in packets of pixels of one row.
  void FindRow(const InterleavedPixels& lattice, int row, SurfacePoint* points) const
  {
    Ray rays[PacketSize];
    int pixels[PacketSize];
    SurfacePoint* wanted[PacketSize];
    int count = 0;
    for (int i = lattice.Column; i < this->View.Width; i += lattice.Step, ++points)
    {
      const Ray ray = this->RayNear(i, row);
      if (ray.Near <= ray.Far && this->AtCenters && this->IsFlat(i, row))
      {
        *points = this->FromDepths(ray, i, row);
      }
      else if (ray.Near <= ray.Far)
      {
        rays[count] = ray;
        wanted[count] = points;
        pixels[count++] = i;
      }
      if (count == PacketSize || (count > 0 && i + lattice.Step >= this->View.Width))
      {
        std::fill(rays + count, rays + PacketSize, Nothing());
        this->FindPacket(rays, pixels, count, row, wanted);
        count = 0;
      }
    }
  }

private:
  static Ray Nothing()
  {
    Ray ray;
    ray.Far = -1.f;
    return ray;
  }

  void FindPacket(
    const Ray* rays, const int* pixels, int count, int row, SurfacePoint* const* wanted) const
  {
    Hit hits[PacketSize];
    this->Rays.Intersect16(rays, hits);
    for (int k = 0; k < count; ++k)
    {
      *wanted[k] = hits[k].IsHit() ? this->OnMesh(rays[k], hits[k])
                                   : this->FromDepths(rays[k], pixels[k], row);
    }
  }

  float DepthAt(int i, int j) const
  {
    i = std::clamp(i, 0, this->View.Width - 1);
    j = std::clamp(j, 0, this->View.Height - 1);
    return this->EyeDepths[static_cast<std::size_t>(j) * this->View.Width + i];
  }

  /// A pixel's centre on the plane at eye depth 1 (parallel: anywhere), in units of the view.
  glm::vec2 OnPlane(int i, int j) const
  {
    const double unit = this->View.Parallel ? this->View.Unit : 1.0;
    return glm::vec2((this->View.Scale[0] * (i + .5) + this->View.Offset[0]) / unit,
      (this->View.Scale[1] * (j + .5) + this->View.Offset[1]) / unit);
  }

  glm::vec3 EyePosition(int i, int j, float depth) const
  {
    return glm::vec3(this->OnPlane(i, j) * (this->View.Parallel ? 1.f : depth), -depth);
  }

  /// How far off a depth may be.
  float RoundingAt(float depth) const
  {
    const double scale = this->View.Parallel ? 1.0 : static_cast<double>(depth) * depth;
    return static_cast<float>(scale * this->Slope * DepthStep);
  }

  float PixelWidth(float depth) const
  {
    return std::abs(static_cast<float>(
      this->View.Scale[0] * (this->View.Parallel ? 1.0 / this->View.Unit : depth)));
  }

  /// What is linear over the picture of a plane.
  float LinearAt(int i, int j) const
  {
    const float depth = this->DepthAt(i, j);
    return this->View.Parallel ? depth : 1.f / depth;
  }

  /// Do the depths around a pixel lie in one plane, and are they fine enough to tell?
  bool IsFlat(int i, int j) const
  {
    const float depth = this->DepthAt(i, j);
    const float width = FlatWithin * this->PixelWidth(depth);
    const float scale = this->View.Parallel ? 1.f : depth * depth;
    const float own = 2.f * this->LinearAt(i, j);
    const float across = this->LinearAt(i - 1, j) + this->LinearAt(i + 1, j) - own;
    const float along = this->LinearAt(i, j - 1) + this->LinearAt(i, j + 1) - own;
    return scale * std::max(std::abs(across), std::abs(along)) < width &&
      4.f * this->RoundingAt(depth) < width;
  }

  /// Along the view through a pixel's centre, close to its depth.
  Ray RayNear(int i, int j) const
  {
    const float depth = this->DepthAt(i, j);
    if (!(depth < FarAway))
    {
      return Nothing();
    }
    const glm::vec2 plane = this->OnPlane(i, j);
    const bool parallel = this->View.Parallel;
    Ray ray;
    ray.Origin = this->Eye + this->Turn * glm::vec3(parallel ? plane : glm::vec2(0.f), 0.f);
    ray.Direction = this->Turn * glm::vec3(parallel ? glm::vec2(0.f) : plane, -1.f);
    const double unit = parallel ? this->View.Unit : 1.0 / depth;
    const auto around = static_cast<float>(
      StepsAround * this->RoundingAt(depth) + PixelsAround * this->View.Scale[0] / unit);
    ray.Near = std::max(depth - around, 0.f);
    ray.Far = depth + around;
    return ray;
  }

  SurfacePoint OnMesh(const Ray& ray, const Hit& hit) const
  {
    const Surface& surface = this->Rays.GetScene().Surfaces[hit.Surface];
    const glm::uvec3 corners = surface.Triangles[hit.Triangle];
    const glm::vec3 a = surface.Positions[corners.x];
    const glm::vec3 normal =
      glm::cross(surface.Positions[corners.y] - a, surface.Positions[corners.z] - a);
    return this->Facing(ray, ray.Origin + hit.Distance * ray.Direction, normal, 0.f);
  }

  /// `off`: how far the position may be from the surface.
  SurfacePoint Facing(const Ray& ray, glm::vec3 position, glm::vec3 normal, float off) const
  {
    const float length = glm::length(normal);
    SurfacePoint point;
    point.Normal =
      length > 0.f && std::isfinite(length) ? normal / length : -glm::normalize(ray.Direction);
    point.Normal = glm::dot(point.Normal, ray.Direction) > 0.f ? -point.Normal : point.Normal;
    point.Position = position + (RayOriginOffset(position) + off) * point.Normal;
    return point;
  }

  /// Of two neighbours, the way to the one that lies on the same surface, as far as depths tell.
  glm::vec3 NearerNeighbour(glm::vec3 position, int i, int j, int right, int up) const
  {
    const glm::vec3 ahead =
      this->EyePosition(i + right, j + up, this->DepthAt(i + right, j + up)) - position;
    const glm::vec3 behind =
      position - this->EyePosition(i - right, j - up, this->DepthAt(i - right, j - up));
    const glm::vec3 nearer = std::abs(ahead.z) < std::abs(behind.z) ? ahead : behind;
    return std::abs(nearer.z) < FarAway
      ? nearer
      : this->EyePosition(i + right, j + up, -position.z) - position;
  }

  SurfacePoint FromDepths(const Ray& ray, int i, int j) const
  {
    const float depth = this->DepthAt(i, j);
    const glm::vec3 position = this->EyePosition(i, j, depth);
    const glm::vec3 normal = glm::cross(
      this->NearerNeighbour(position, i, j, 1, 0), this->NearerNeighbour(position, i, j, 0, 1));
    return this->Facing(ray, this->Eye + this->Turn * position, this->Turn * normal,
      (2.f * this->RoundingAt(depth) + Snap * this->PixelWidth(depth)) * this->UnitLength);
  }

  const std::vector<float>& EyeDepths;
  bool AtCenters;
  const ScreenTransform& View;
  const RayScene& Rays;
  glm::mat3 Turn{ 1.f };  ///< from eye to scene coordinates, lengths included
  glm::vec3 Eye{ 0.f };   ///< in scene coordinates
  float UnitLength = 1.f; ///< the view's unit in scene coordinates
  double Slope = 0.0;
};

}

std::vector<SurfacePoint> ReconstructSurface(const std::vector<float>& eyeDepths, bool atCenters,
  const ScreenTransform& view, const RayScene& rays, const InterleavedPixels& lattice)
{
  const int columns = lattice.CountIn(view.Width, lattice.Column);
  const int rows = lattice.CountIn(view.Height, lattice.Row);
  std::vector<SurfacePoint> points(static_cast<std::size_t>(columns) * rows);
  const SurfaceReconstructor finder(eyeDepths, atCenters, view, rays);
  ParallelFor(0, rows, 0, [&](int row) {
    finder.FindRow(lattice, lattice.Row + row * lattice.Step,
      points.data() + static_cast<std::size_t>(row) * columns);
  });
  return points;
}

}
