// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Tuning constants of pixel coverage: when a pixel is covered exactly, when it is sampled instead,
// and how errors are estimated. Lengths are in pixels, areas in pixel areas, colors in [0, 1].
// After changing a value run TestCoverageOfScenes and TestHardScenes (errors against a reference)
// and TestCeilings (numbers of rays).
#ifndef penumbra_CoverageConstants_h
#define penumbra_CoverageConstants_h

#include "Edges/EdgeConstants.h"

#include <cstddef>

namespace penumbra
{

// --- Limits of exact coverage ---

/// Number of edges per pixel, on average over a tile, above which the tile is crowded.
constexpr std::size_t CrowdedEdgesPerPixel = 6;
/// Number of edges in a pixel above which an arrangement is more expensive than samples.
constexpr std::size_t MaximumEdges = 512;
/// The same for pixels of crowded tiles, in which the cost of arrangements adds up.
constexpr std::size_t MaximumEdgesInCrowdedTile = 32;
/// Number of trapezoids of an arrangement that cost about as much as one ray.
constexpr std::size_t TrapezoidsPerRay = 16;
/// Faces with a smaller area are ignored, because rays cannot be aimed at them reliably.
constexpr double MinimumFaceArea = 1e-6;
/// Relative difference of distances along rays below which they are treated as equal.
constexpr double RelativeDepthTolerance = 1e-5;

// --- Rasterization ---

/// Number of edges per pixel, on average over a tile, above which pixels with many edges are
/// rasterized. Few small objects are covered exactly.
constexpr std::size_t RasterizedEdgesPerPixel = 1;
/// Number of edges of a tile of 32x32 pixels without lines from which its triangles are sorted by pixels.
constexpr std::size_t MinimumEdgesOfRasterizedTile = 256;
/// Number of visible edges in a pixel from which its samples are rasterized instead of covering it exactly.
constexpr std::size_t MinimumRasterizedEdges = 5;
/// Number of all edges in a pixel above which its samples are rasterized even if fewer are visible. Measured with 8,
/// 12 and 24: Soup30000 of `./penumbra benchmark accuracy` takes 1.00, 1.08 and 1.21, flat `brain.vtp` 0.95, 0.88 and
/// 0.76 times as long as without exact coverage.
constexpr std::size_t MaximumHiddenEdges = 12;
/// Number of all edges from which opaque lines and points are rasterized, in tiles with any number of edges. They
/// intersect what is below, so that their exact coverage takes many rays. Single lines have two edges.
constexpr std::size_t MinimumRasterizedLineEdges = 3;
/// The same at lines on translucent surfaces or translucent lines, in tiles with any number of edges.
/// Exact coverage takes a ray through all layers for each face, and edges of surfaces are close to
/// their faces, so that more rays search for intersections. Measured with
/// `./penumbra benchmark accuracy --ordinary`: hills with edges take 13 times the time of plain ones with 3,
/// 10 with 2, and no less with 1.
constexpr std::size_t MinimumLayeredEdges = 2;
/// Maximum number of the first samples of a rasterized pixel.
constexpr int MaximumFirstRasterizedSamples = 256;
/// Number of rasterized samples that cost about as much as one ray.
constexpr double RasterizedSamplesPerRay = 4.0;
/// The same where a texture varies, which few triangles show.
constexpr double TexturedSamplesPerRay = 16.0;

// --- Intersections of triangles ---

/// Surfaces in one pixel may intersect if their depths differ by less than this number of pixels.
constexpr double TouchingDepth = 16.0;
/// Maximum number of triangles per pixel whose pairs are intersected.
constexpr std::size_t MaximumTriangles = 48;
/// Maximum number of layers behind a translucent surface, at each corner, that may intersect.
constexpr int MaximumIntersectedLayers = 4;
/// Maximum number of layers behind a translucent surface, at each corner, whose textures are compared.
constexpr std::size_t MaximumTexturedLayers = 256;
/// Minimum area of a trapezoid that is probed when surfaces may intersect.
constexpr double MinimumTrapezoidArea = 0.02;
/// Minimum area of a face that is probed when triangles are known to intersect.
constexpr double MinimumProbedFaceArea = 0.005;
/// Distance of probe rays from the sides of a trapezoid, as a fraction of its size.
constexpr double ProbeInset = 0.02;
/// Maximum number of times that the faces of one pixel are probed. New faces result from each pass.
constexpr int MaximumProbePasses = 4;

// --- Error estimates ---

/// Minimum estimated error of a pixel without edges: rounding.
constexpr float ErrorFloor = 2e-5f;
/// Minimum estimated error of a pixel with edges: differences between the positions of an edge in
/// the arrangement and along a ray.
constexpr float EdgeErrorFloor = 1.5e-4f;
/// Minimum estimated error of a pixel that contains only background.
constexpr float EmptyErrorFloor = 1e-6f;
/// Fraction of the last difference between samples that is estimated to remain as an error.
/// Together with CurvatureSafetyFactor chosen on a smooth scan so that the error of 95 % of the
/// tiles is below its estimate.
constexpr float ResidualErrorFraction = 0.35f;
/// Safety factor of errors estimated from second differences: across the vertices of a mesh the
/// gradient of colors is discontinuous.
constexpr float CurvatureSafetyFactor = 3.f;
/// Color difference between corners of one surface that only a shadow boundary causes.
constexpr float ShadowContrast = 0.05f;
/// Distance in pixels of a corner up to which the cone of a spotlight may cross the pixels around it.
constexpr double LightConeMargin = 2.0;
/// Assumed variation of color on a piece of surface with only one sample.
constexpr float UnknownVariation = 0.25f;
/// RMS error of the mean of four corners relative to their contrast, over all straight edges
/// through a square. Measured with uniform samples of a half-plane.
constexpr float ContrastError = 0.3f;

// --- Samples ---

/// Number of the first samples of a pixel, traced as one packet, and the maximum number.
constexpr int MinimumSamples = 16;
constexpr int MaximumSamples = 4096;
/// Distance of samples from the sides of their pixel, so that rounding does not move them into its
/// neighbors.
constexpr double SampleInset = 1e-4;
/// Factor on the number of samples that straight edges require. Dense edges, as of slivers, need
/// more.
constexpr int SampleBudgetFactor = 4;
/// Sampling of a tile does not stop before this number of samples per pixel, nor before this
/// fraction of the number that straight edges require.
constexpr double MinimumSampleBudget = 64.0;
constexpr double SampleBudgetFraction = 0.25;
/// Maximum number of samples with light of a tile, per pixel, relative to that of samples alone. Measured: thin rods of
/// `./penumbra benchmark light --only occlusion --width 192` need up to 1.1.
constexpr double LitSampleBudgetFactor = 1.5;
/// Maximum estimated error of a sampled pixel, in multiples of the tolerance of a tile.
constexpr double MaximumPixelError = 2.0;
/// The squared error of n samples of a low-discrepancy sequence is assumed to be proportional to
/// this power of 1/n, as for straight edges.
constexpr double SampledErrorDecay = 1.5;
/// The same for samples with light, whose variance dominates.
constexpr double LitErrorDecay = 1.0;
/// Number of samples whose own estimate of their error counts as much as that of the tile.
constexpr double PooledSamples = 8.0;
/// Factor on the standard error of samples, so that few errors exceed the estimate.
constexpr float ConfidenceFactor = 1.1f;
/// The same for samples of layers, whose colors vary less between the cells of the sequence. Measured
/// with TestTranslucentLines: with the factor of others, 95 % of the tiles have errors below 0.56 of
/// their estimates.
constexpr float LayerConfidenceFactor = 0.7f;
/// The same for pixels with outlines of many spheres, tubes or instances. Measured with 128x96 pixels of the million
/// spheres of `./penumbra benchmark scale`: with the factor of others, errors are 0.6 of the estimates, those of single
/// tiles up to 0.75.
constexpr float DenseConfidenceFactor = 0.85f;
/// Estimated error of objects between n samples, times n.
constexpr float HiddenError = 0.25f;
/// Assumed error of a pixel with a single sample.
constexpr float SingleSampleError = 0.125f;

}
#endif
