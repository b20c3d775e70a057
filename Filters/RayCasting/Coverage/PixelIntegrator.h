// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// The colour of one pixel from its corners, the edges that cross it and as many more rays as the
// tolerance asks for: the four cases of [AA], exact coverage, and error-driven refinement.
#ifndef penumbra_PixelIntegrator_h
#define penumbra_PixelIntegrator_h

#include "PixelArrangement.h"
#include "Sampling/CornerGrid.h"
#include "Sampling/SampleCache.h"
#include "Silhouettes.h"
#include "TriangleIntersection.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <vector>

namespace penumbra
{

struct IntegrationSettings
{
  enum class Methods
  {
    Silhouettes,
    Subdivision,
    Uniform
  };
  Methods Method = Methods::Silhouettes;
  double Tolerance = 1.0 / 256.0;
  int MaximumLevel = 3;
  bool FindSmallObjects = true;
  int UniformSamples = 8;
  bool Shadows = false;
  double Noise = 0.0; ///< standard error of the colours themselves: not to be chased
};

/// Pixels by what was done to them.
struct PixelCounts
{
  long long Empty = 0;       ///< case 1: nothing but background
  long long Interior = 0;    ///< case 2: the corners serve
  long long Edge = 0;        ///< case 3: cut by edges, covered exactly
  long long SmallObject = 0; ///< case 4: something lies between four equal corners
  long long Refined = 0;     ///< subdivided for contrast or for want of edges
  long long Uniform = 0;     ///< sampled uniformly: too dense, or on request

  PixelCounts& operator+=(const PixelCounts& other);
};

/// How many triangles and edges there are around a pixel.
enum class EdgeDensity
{
  Sparse,
  Crowded, ///< many edges in most pixels of the tile
  Dense    ///< triangles smaller than pixels
};

struct PixelResult
{
  glm::vec4 Color{ 0.f }; ///< premultiplied
  float Error = 0.f;      ///< believed, as an RMS over the three colours
};

/// One per thread; scratch memory is kept between pixels.
class PixelIntegrator
{
public:
  PixelIntegrator(const CameraRayTracer& tracer, const CornerGrid& corners,
    const std::vector<ProjectedEdge>& edges, const IntegrationSettings& settings);

  /// To be called before the pixels of another tile.
  void BeginTile()
  {
    this->Cache.Clear();
    this->FoundIntersection = false;
    this->SearchAllPixels = false;
  }

  /// Pixel (x, y), crossed by the listed edges.
  PixelResult Integrate(
    int x, int y, const std::uint32_t* edgeIndices, std::size_t count, EdgeDensity density);

  /// Has a pixel been found, since BeginTile(), where triangles pass through each other?
  bool HasFoundIntersection() const { return this->FoundIntersection; }

  /// Looks for more of them in every pixel with edges that follows.
  void SearchAllPixelsForIntersections() { this->SearchAllPixels = true; }

  /// What the medium in front of the last pixel's corners is believed to err, at most.
  float GetMediumError() const { return this->MediumError; }

  RayCounts Rays;
  PixelCounts Pixels;

private:
  struct Square
  {
    glm::ivec2 Low; ///< in units of the finest level
    int Level;
    Sample Corners[4]; ///< (0, 0), (1, 0), (0, 1), (1, 1)
  };

  /// Where a face is looked into and what rays found there.
  struct FaceProbe
  {
    static constexpr int Sides = 8;

    glm::dvec2 ExtremePoints[Sides]; ///< the corners farthest to each side
    bool IsEmpty = true;
    bool IsDiscontinuous =
      false; ///< there is a border in the face that the arrangement does not have

    void Add(glm::dvec2 point);
  };

  void LoadCorners(int x, int y);
  double MaximumOpaqueDepth(const Sample& sample) const;
  double ComputeDepthBehind(double depth) const;
  void UpdateMaximumFaceDepth(const Sample& sample);
  void LoadSegments(const std::uint32_t* edgeIndices, std::size_t count, bool cull);
  bool IsNearShadowBoundary() const;
  bool AnyNeighborCorner(const std::function<bool(const Sample&)>& test) const;
  PixelResult IntegrateInterior();
  PixelResult IntegrateExact(const std::uint32_t* edgeIndices, std::size_t count);
  PixelResult IntegrateSubdivided(bool byObject);
  PixelResult IntegrateUniform(int side);
  PixelResult IntegrateUniformAdaptive();
  PixelResult IntegrateSampled();
  void AddTriangle(const Sample& sample);
  void FindNearbyIntersections();
  bool AreDisconnected(const Hit& a, const Hit& b) const;
  void ProbeLargeTrapezoids();
  Hit ProbeAt(glm::dvec2 local);
  void ProbeTrapezoids();
  bool AddIntersectionSegments();
  void RetraceCornersOnEdges();
  bool RetraceIsolatedMiss();
  bool CornersAgree() const;
  float EstimateCurvatureError() const;
  void Subdivide(const Square& square, bool byObject, glm::vec4& color, float& squaredError);
  bool NeedsSubdivision(const Square& square) const;
  bool IsConstant(const Sample& sample) const;
  bool IsConstantBehindMedium(const Sample& sample) const;
  PixelResult ComputeFaceColor(std::size_t face);
  PixelResult SplitFace(std::size_t face);
  void SplitTrapezoid(const PixelArrangement::Trapezoid& trapezoid, glm::dvec2 low, double side,
    const Sample& center, glm::vec4& color, float& squaredError);
  const Sample& GetGridSample(glm::ivec2 fine);
  Sample Trace(glm::dvec2 local, double area = 1.0);

  /// An error of coverage and shading with what colours err by themselves: about four of them make
  /// a pixel.
  float CombineErrors(float error, float floor) const
  {
    return std::max(std::hypot(error, 0.5f * static_cast<float>(this->Settings.Noise)), floor);
  }

  const CameraRayTracer& Tracer;
  const CornerGrid& Grid;
  const std::vector<ProjectedEdge>& Edges;
  const IntegrationSettings Settings;
  SampleCache Cache;

  // The pixel at work.
  int X = 0;
  int Y = 0;
  Sample Corners[4];
  float MediumError = 0.f;
  unsigned int TrustedCorners = 0; ///< those that no edge passes nearer than a ray is precise
  std::vector<PixelSegment> Segments;
  double NearestCulledDepth = 0.0;
  double MaximumFaceDepth = 0.0;
  bool FoundIntersection = false;
  bool SearchAllPixels = false;
  std::vector<TriangleId> VisibleTriangles; ///< triangles that samples met
  bool HasIntersections = false;            ///< some of them pass through each other
  std::size_t PairsTested = 0;              ///< the first so many of Seen know each other
  PixelArrangement Arrangement;
  std::vector<glm::vec4> Colors;     ///< of uniform samples
  std::vector<FaceProbe> FaceProbes; ///< per face; empty: none was looked into
};

}
#endif
