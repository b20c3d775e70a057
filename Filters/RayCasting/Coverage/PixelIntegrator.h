// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Computes the color of one pixel from its corners, the edges that cross it, and additional rays as
// required by the tolerance: the four cases of [AA], exact coverage, and error-driven refinement.
#ifndef penumbra_PixelIntegrator_h
#define penumbra_PixelIntegrator_h

#include "Edges/Silhouettes.h"
#include "Execution/WorkLimit.h"
#include "PixelArrangement.h"
#include "Rasterization/TileRasterizer.h"
#include "SampledPixel.h"
#include "Sampling/CornerGrid.h"
#include "Sampling/SampleCache.h"
#include "TriangleIntersection.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <vector>

namespace penumbra
{

/// Settings of PixelIntegrator; see the properties of vtkPenumbraRayCaster with the same names.
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
  bool Rasterize = true; ///< if off, samples are always traced
  bool Shadows = false;
  double LightTolerance = 0.0; ///< accepted RMSE that light effects add; 0: there are none
  double Noise = 0.0;          ///< standard error of sampled colors, which refinement cannot reduce
  WorkLimit* Limit = nullptr;  ///< ends the refinement of pixels early; null: none

  /// Returns the accepted RMSE of a tile.
  double GetTileTolerance() const
  {
    return this->LightTolerance > 0.0 ? std::hypot(this->Tolerance, this->LightTolerance)
                                      : this->Tolerance;
  }
};

/// Number of pixels by method.
struct PixelCounts
{
  long long Empty = 0;       ///< case 1: only background
  long long Interior = 0;    ///< case 2: mean of the corners or of the texels
  long long Edge = 0;        ///< case 3: exact coverage between edges
  long long SmallObject = 0; ///< case 4: edges between four corners on one surface
  long long Refined = 0;     ///< subdivided because of contrast, or without edges
  long long Uniform = 0;     ///< sampled: too many edges, dense geometry, or UNIFORM

  PixelCounts& operator+=(const PixelCounts& other);
};

/// Integrates one pixel at a time. Each thread needs its own object, which keeps scratch memory.
class PixelIntegrator
{
public:
  /// `dense` has a flag per surface: its subpixel triangles have no edges in `edges` except
  /// silhouettes and boundaries. Empty: no surface is dense. `unsteady` has a flag per surface: it
  /// has triangles with unsteady normals.
  PixelIntegrator(const CameraRayTracer& tracer, const CornerGrid& corners,
    const std::vector<ProjectedEdge>& edges, const std::vector<char>& dense,
    const std::vector<char>& unsteady, const IntegrationSettings& settings);

  /// Sets the triangles of the tile, with which pixels full of edges are sampled; null: by rays.
  /// `crowded`: the tile has many edges; otherwise, only pixels with layers are sampled with them.
  void SetRasterizer(TileRasterizer* rasterizer, bool crowded)
  {
    this->Rasterizer = rasterizer;
    this->RasterizesAll = rasterizer && crowded;
  }

  /// Resets the state of a tile. Call it before the first pixel of a tile.
  void BeginTile()
  {
    this->Cache.Clear();
    this->FoundIntersection = false;
    this->SearchAllPixels = false;
    this->Sampled.clear();
    this->ConstantLayers.clear();
  }

  /// Computes pixel (x, y), which the listed edges cross. If it is sampled, GetSampledPixels()
  /// contains it afterwards, and the result is its first estimate. `crowded`: most pixels of the
  /// tile have many edges. The list of edges must remain valid until the next tile.
  PixelResult Integrate(
    int x, int y, const std::uint32_t* edgeIndices, std::size_t count, bool crowded);

  /// Returns the sampled pixels since BeginTile().
  std::vector<SampledPixel>& GetSampledPixels() { return this->Sampled; }

  /// Doubles the number of samples of a pixel; the first MinimumSamples are traced at once.
  void Refine(SampledPixel& pixel);

  const IntegrationSettings& GetSettings() const { return this->Settings; }

  /// Returns true if intersecting triangles were found in a pixel since BeginTile().
  bool HasFoundIntersection() const { return this->FoundIntersection; }

  /// Searches all following pixels with edges for intersecting triangles.
  void SearchAllPixelsForIntersections() { this->SearchAllPixels = true; }

  /// Returns the maximum estimated error of the medium over the corners of the last pixel.
  float GetMediumError() const { return this->MediumError; }

  RayCounts Rays;
  PixelCounts Pixels;

private:
  /// A square of the subdivision of a pixel.
  struct Square
  {
    glm::ivec2 Low; ///< lower left corner, in units of the finest level
    int Level;
    Sample Corners[4]; ///< (0, 0), (1, 0), (0, 1), (1, 1)
  };

  /// Samples of a rasterized pixel at which one triangle, or the background, is visible.
  struct VisibleTriangle
  {
    std::uint32_t Index; ///< see TileRasterizer::GetTriangle()
    std::uint32_t First; ///< of its samples in Grouped
    std::uint32_t Count; ///< number of its samples
  };

  /// Positions at which a face is probed by rays, and the result.
  struct FaceProbe
  {
    static constexpr int Sides = 8;

    glm::dvec2 ExtremePoints[Sides]; ///< farthest trapezoid corner in each direction
    bool IsEmpty = true;
    bool IsDiscontinuous = false; ///< the face contains an edge that the arrangement lacks

    void Add(glm::dvec2 point);
  };

  void LoadCorners(int x, int y);
  double MaximumOpaqueDepth(const Sample& sample) const;
  double ComputeDepthBehind(double depth) const;
  void UpdateMaximumFaceDepth(const Sample& sample);
  void LoadSegments(const std::uint32_t* edgeIndices, std::size_t count, bool cull);
  /// Returns the largest difference between the colors of `sample` and of the corners whose bits
  /// are set in `corners`; at least 1 if one of them is on another surface.
  float ComputeVariation(unsigned int corners, const Sample& sample) const;
  bool IsNearShadowBoundary() const;
  bool AnyNeighborCorner(const std::function<bool(const Sample&)>& test) const;
  PixelResult IntegrateInterior();
  PixelResult IntegrateExact(const std::uint32_t* edgeIndices, std::size_t count);
  PixelResult IntegrateSubdivided(bool byObject);
  PixelResult IntegrateUniform(int side);
  bool HitsDenseSurface() const;
  bool IsUnsteady(const Sample& sample) const;
  PixelResult IntegrateUnsteady();
  bool IsTextureDiscontinuous() const;
  bool IsTextureDiscontinuousInPlane() const;
  PixelResult IntegrateDense(bool unknown);
  PixelResult IntegrateSampled();
  bool MayRasterize(std::size_t edges) const;
  bool SelectLayers() const;
  bool IntegrateTexels(PixelResult& result);
  void RasterizeLayers(SampledPixel& pixel, std::size_t total);
  void ShadeLayer(SampledPixel& pixel, std::uint32_t layer, PixelLayerColor& color);
  void ShadePartOfLayer(SampledPixel& pixel, std::uint32_t layer, PixelLayerColor& color);
  void LoadBackground(const SampledPixel& pixel);
  glm::vec4 CompositeLayers(
    SampledPixel& pixel, glm::vec2 point, const LayerCandidate* begin, const LayerCandidate* end);
  void TraceSamples(SampledPixel& pixel, std::size_t total);
  void ComputePoints(const SampledPixel& pixel, std::size_t before, std::size_t total);
  void RasterizeSamples(SampledPixel& pixel, std::size_t total);
  void GroupSamples();
  std::uint32_t AddToTriangleColor(
    SampledPixel& pixel, std::size_t knownColors, const VisibleTriangle& triangle);
  glm::vec4 ShadeTriangle(
    const SampledPixel& pixel, const VisibleTriangle& triangle, PrimitiveId id, bool isConstant);
  SampledPixel& AddSampledPixel();
  bool BuildFaces();
  void ComputeFaceColors(SampledPixel& pixel);
  void AddTriangle(const Sample& sample);
  void AddPrimitive(PrimitiveId id);
  void AddHiddenShape(const ProjectedEdge& edge, double depth, double limit);
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
  /// Returns the penumbrae in this pixel, which predict each other, or null if there are none.
  std::vector<PenumbraNeighbors>* GetNeighbors(std::uint32_t penumbrae);

  /// Sets the errors of a pixel: an error of coverage and shading, and the noise of sampled colors.
  /// About four colors are averaged per pixel, which halves the noise.
  void SetErrors(float error, float floor, PixelResult& result) const
  {
    result.LightError = 0.5f * static_cast<float>(this->Noise);
    result.Error = std::max(std::hypot(error, result.LightError), floor);
  }

  const CameraRayTracer& Tracer;
  const CornerGrid& Grid;
  const std::vector<ProjectedEdge>& Edges;
  const std::vector<char>& Dense;
  const std::vector<char>& Unsteady;
  const IntegrationSettings Settings;
  TileRasterizer* Rasterizer = nullptr;
  bool RasterizesAll = false;
  SampleCache Cache;
  std::vector<SampledPixel> Sampled; ///< of the current tile
  /// Per triangle of the tile: its color, if it is constant and was found.
  std::vector<PixelLayerColor> ConstantLayers;
  PixelLayerColor Background; ///< in the current pixel, premultiplied by alpha; not of images

  // State of the current pixel.
  int X = 0;
  int Y = 0;
  Sample Corners[4];
  float MediumError = 0.f;
  std::vector<PenumbraNeighbors> Neighbors;   ///< one for each light
  const std::uint32_t* ListedEdges = nullptr; ///< edges that cross the pixel
  std::size_t NumberOfListedEdges = 0;
  double Noise; ///< standard error of sampled colors: Settings.Noise and penumbrae
  unsigned int TrustedCorners =
    0; ///< bits of the corners farther than EdgePrecision from all edges
  std::vector<PixelSegment> Segments;
  double NearestCulledDepth = 0.0;
  double MaximumFaceDepth = 0.0;
  bool FoundIntersection = false;
  bool SearchAllPixels = false;
  std::vector<PrimitiveId> VisibleTriangles; ///< triangles hit by samples
  bool HasIntersections = false;             ///< some of them intersect, or may
  bool IsTubeIntersected = false;            ///< a visible tube may intersect another surface here
  bool HitsUnsteadyTriangle = false;         ///< the color of a face changes abruptly
  std::size_t PairsTested = 0;               ///< number of triangles whose pairs were intersected
  PixelArrangement Arrangement;
  std::vector<glm::vec4> Colors;      ///< colors of uniform samples
  SamplePoints Points;                ///< of a rasterized pixel
  std::vector<std::uint32_t> Visible; ///< triangle at each of these points
  std::vector<VisibleTriangle> RasterizedTriangles;
  std::vector<std::uint32_t> Grouped; ///< indices of points, by triangle
  std::vector<std::uint32_t> Groups;  ///< scratch memory of GroupSamples()
  std::vector<FaceProbe> FaceProbes;  ///< per face; empty if the faces were not probed
};

}
#endif
