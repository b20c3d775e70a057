// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "SurfaceFromDepth.h"

#include "Execution/ParallelFor.h"
#include "Frame/BackgroundDepth.h"
#include "Frame/ScreenTransform.h"
#include "SceneCoordinates.h"
#include "Shading/HemisphereSampling.h"
#include "Surface.h"

#include "vtkMatrix4x4.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace penumbra
{

namespace
{

/// Rounding error of a float depth buffer near 1: twice its spacing, because the rasterizer rounds
/// as well.
constexpr double DepthPrecision = 0x1p-23;

/// Half length of the search ray around the depth of a pixel: this multiple of the depth error plus
/// this many pixel widths.
constexpr double SearchDepthErrors = 16.0;
constexpr double SearchPixelWidths = 4.0;

/// Depths that lie in a plane within this fraction of the pixel width define position and normal
/// without a ray. Measured with `./penumbra benchmark ambient-occlusion --only traced`: compared
/// with 0.02, the errors of up to 16 frames are equal, and converged errors are 0.0003 to 0.0006
/// larger, in two thirds of the time.
constexpr float PlanarTolerance = 0.1f;

/// Error of a rasterized vertex position (subpixel snapping), in pixels.
constexpr float VertexSnapping = 1.f / 128.f;

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
    const SceneCoordinates& coordinates = rays.GetCoordinates();
    const std::vector<Surface>& surfaces = rays.GetSurfaces();
    std::transform(surfaces.begin(), surfaces.end(), std::back_inserter(this->IsTranslucent),
      [](const Surface& surface) { return surface.IsTranslucent(); });
    for (int row = 0; row < 3; ++row)
    {
      for (int column = 0; column < 3; ++column)
      {
        this->EyeToScene[column][row] =
          static_cast<float>(eyeToWorld[4 * row + column] * view.Unit * coordinates.Scale);
      }
      this->Eye[row] =
        static_cast<float>((eyeToWorld[4 * row + 3] - coordinates.Origin[row]) * coordinates.Scale);
    }
    this->UnitLength = static_cast<float>(view.Unit * coordinates.Scale);
    // See ScreenTransform::SetUniforms().
    this->DepthSlope = std::abs(view.Parallel ? 2.0 / view.Projection[10] / view.Unit
                                              : 2.0 / view.Projection[11] * view.Unit);
  }

  /// Reconstructs the points of one row. Pixels whose depths are not planar are traced in packets.
  /// `needed`: flags of the pixels of the row, or null for all.
  void ReconstructRow(int row, const char* needed, SurfacePoint* points) const
  {
    Ray rays[PacketSize];
    int pixels[PacketSize];
    SurfacePoint* targets[PacketSize];
    int count = 0;
    for (int i = 0; i < this->View.Width; ++i)
    {
      const bool isNeeded = !needed || needed[i];
      const Ray ray = isNeeded ? this->SearchRay(i, row) : EmptyRay();
      if (ray.Near <= ray.Far && this->AtCenters && this->IsPlanar(i, row))
      {
        points[i] = this->ReconstructFromDepths(ray, i, row);
        points[i].PixelSize = this->PixelWidth(this->DepthAt(i, row)) * this->UnitLength;
      }
      else if (ray.Near <= ray.Far)
      {
        rays[count] = ray;
        targets[count] = points + i;
        pixels[count++] = i;
      }
      else if (isNeeded)
      {
        points[i] = SurfacePoint();
      }
      if (count == PacketSize || (count > 0 && i + 1 == this->View.Width))
      {
        std::fill(rays + count, rays + PacketSize, EmptyRay());
        this->TracePacket(rays, pixels, count, row, targets);
        count = 0;
      }
    }
  }

private:
  static Ray EmptyRay()
  {
    Ray ray;
    ray.Far = -1.f;
    return ray;
  }

  void TracePacket(
    const Ray* rays, const int* pixels, int count, int row, SurfacePoint* const* targets) const
  {
    Hit hits[PacketSize];
    this->Rays.Intersect16(rays, hits);
    for (int k = 0; k < count; ++k)
    {
      this->SkipTranslucent(rays[k], hits[k]);
      *targets[k] = hits[k].IsHit() ? this->ReconstructFromHit(rays[k], hits[k])
                                    : this->ReconstructFromDepths(rays[k], pixels[k], row);
      targets[k]->PixelSize = this->PixelWidth(this->DepthAt(pixels[k], row)) * this->UnitLength;
    }
  }

  /// Moves a hit to the first opaque surface: the depth buffer has no others.
  void SkipTranslucent(Ray ray, Hit& hit) const
  {
    while (hit.IsHit() && this->IsTranslucent[hit.Surface])
    {
      ray = ContinueBehind(ray, hit);
      hit = this->Rays.Intersect(ray);
    }
  }

  float DepthAt(int i, int j) const
  {
    i = std::clamp(i, 0, this->View.Width - 1);
    j = std::clamp(j, 0, this->View.Height - 1);
    return this->EyeDepths[static_cast<std::size_t>(j) * this->View.Width + i];
  }

  /// Pixel center on the plane at eye depth 1 (any depth in parallel projection), in units of the
  /// view.
  glm::vec2 PixelOnPlane(int i, int j) const
  {
    const double unit = this->View.Parallel ? this->View.Unit : 1.0;
    return glm::vec2(
      (this->View.Scale[0] * (i + .5) + this->View.Offset[0] + this->View.Skew * (j + .5)) / unit,
      (this->View.Scale[1] * (j + .5) + this->View.Offset[1]) / unit);
  }

  glm::vec3 EyePosition(int i, int j, float depth) const
  {
    return glm::vec3(this->PixelOnPlane(i, j) * (this->View.Parallel ? 1.f : depth), -depth);
  }

  /// Error of an eye depth caused by the precision of the depth buffer.
  float DepthError(float depth) const
  {
    const double scale = this->View.Parallel ? 1.0 : static_cast<double>(depth) * depth;
    return static_cast<float>(scale * this->DepthSlope * DepthPrecision);
  }

  float PixelWidth(float depth) const
  {
    return std::abs(static_cast<float>(
      this->View.Scale[0] * (this->View.Parallel ? 1.0 / this->View.Unit : depth)));
  }

  /// Depth value that is linear in pixels over a plane: eye depth, or its inverse in perspective.
  float LinearDepth(int i, int j) const
  {
    const float depth = this->DepthAt(i, j);
    return this->View.Parallel ? depth : 1.f / depth;
  }

  /// Returns whether the depths around a pixel lie in one plane and are precise enough to decide
  /// it.
  bool IsPlanar(int i, int j) const
  {
    const float depth = this->DepthAt(i, j);
    const float width = PlanarTolerance * this->PixelWidth(depth);
    const float scale = this->View.Parallel ? 1.f : depth * depth;
    const float center = 2.f * this->LinearDepth(i, j);
    const float alongX = this->LinearDepth(i - 1, j) + this->LinearDepth(i + 1, j) - center;
    const float alongY = this->LinearDepth(i, j - 1) + this->LinearDepth(i, j + 1) - center;
    return scale * std::max(std::abs(alongX), std::abs(alongY)) < width &&
      4.f * this->DepthError(depth) < width;
  }

  /// Ray through the pixel center, limited to an interval around its depth; empty for background.
  Ray SearchRay(int i, int j) const
  {
    const float depth = this->DepthAt(i, j);
    if (!(depth < BackgroundDepth))
    {
      return EmptyRay();
    }
    const glm::vec2 plane = this->PixelOnPlane(i, j);
    const bool parallel = this->View.Parallel;
    Ray ray;
    ray.Origin = this->Eye + this->EyeToScene * glm::vec3(parallel ? plane : glm::vec2(0.f), 0.f);
    ray.Direction = this->EyeToScene * glm::vec3(parallel ? glm::vec2(0.f) : plane, -1.f);
    const double unit = parallel ? this->View.Unit : 1.0 / depth;
    const auto halfLength = static_cast<float>(
      SearchDepthErrors * this->DepthError(depth) + SearchPixelWidths * this->View.Scale[0] / unit);
    ray.Near = std::max(depth - halfLength, 0.f);
    ray.Far = depth + halfLength;
    return ray;
  }

  SurfacePoint ReconstructFromHit(const Ray& ray, const Hit& hit) const
  {
    const Surface& surface = this->Rays.GetSurfaces()[hit.Surface];
    const std::array<glm::vec3, 3> points = surface.GetPoints(hit.Primitive);
    const glm::vec3 normal = surface.IsRound()
      ? this->Rays.GetNormal(ray, hit)
      : glm::cross(points[1] - points[0], points[2] - points[0]);
    return this->OffsetFromSurface(ray, ray.Origin + hit.Distance * ray.Direction, normal, 0.f);
  }

  /// Orients the normal toward the camera and offsets the position along it. `error`: distance
  /// that the position may have from the surface.
  SurfacePoint OffsetFromSurface(
    const Ray& ray, glm::vec3 position, glm::vec3 normal, float error) const
  {
    const float length = glm::length(normal);
    SurfacePoint point;
    point.Normal =
      length > 0.f && std::isfinite(length) ? normal / length : -glm::normalize(ray.Direction);
    point.Normal = glm::dot(point.Normal, ray.Direction) > 0.f ? -point.Normal : point.Normal;
    point.Position = position + (RayOriginOffset(position) + error) * point.Normal;
    return point;
  }

  /// Offset to the one of two opposite neighbors whose depth is closer, which is more likely on the
  /// same surface.
  glm::vec3 OffsetToNearerNeighbor(glm::vec3 position, int i, int j, int right, int up) const
  {
    const glm::vec3 next =
      this->EyePosition(i + right, j + up, this->DepthAt(i + right, j + up)) - position;
    const glm::vec3 previous =
      position - this->EyePosition(i - right, j - up, this->DepthAt(i - right, j - up));
    const glm::vec3 nearer = std::abs(next.z) < std::abs(previous.z) ? next : previous;
    return std::abs(nearer.z) < BackgroundDepth
      ? nearer
      : this->EyePosition(i + right, j + up, -position.z) - position;
  }

  SurfacePoint ReconstructFromDepths(const Ray& ray, int i, int j) const
  {
    const float depth = this->DepthAt(i, j);
    const glm::vec3 position = this->EyePosition(i, j, depth);
    const glm::vec3 normal = glm::cross(this->OffsetToNearerNeighbor(position, i, j, 1, 0),
      this->OffsetToNearerNeighbor(position, i, j, 0, 1));
    return this->OffsetFromSurface(ray, this->Eye + this->EyeToScene * position,
      this->EyeToScene * normal,
      (2.f * this->DepthError(depth) + VertexSnapping * this->PixelWidth(depth)) *
        this->UnitLength);
  }

  const std::vector<float>& EyeDepths;
  bool AtCenters;
  const ScreenTransform& View;
  const RayScene& Rays;
  std::vector<char> IsTranslucent; ///< by surface
  glm::mat3 EyeToScene{ 1.f };     ///< rotation and scale
  glm::vec3 Eye{ 0.f };            ///< camera position in scene coordinates
  float UnitLength = 1.f;          ///< unit of the view in scene coordinates
  /// Change of eye depth (of its inverse in perspective) per unit of the depth buffer.
  double DepthSlope = 0.0;
};

}

void ReconstructSurface(const std::vector<float>& eyeDepths, bool atCenters,
  const ScreenTransform& view, const RayScene& rays, const std::vector<char>* needed,
  std::vector<SurfacePoint>& points)
{
  points.resize(static_cast<std::size_t>(view.Width) * view.Height);
  const SurfaceReconstructor reconstructor(eyeDepths, atCenters, view, rays);
  ParallelFor(0, view.Height, 0, [&](int row) {
    const std::size_t first = static_cast<std::size_t>(row) * view.Width;
    reconstructor.ReconstructRow(
      row, needed ? needed->data() + first : nullptr, points.data() + first);
  });
}

}
