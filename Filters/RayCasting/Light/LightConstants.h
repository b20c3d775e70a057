// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Tuning constants of the light of images. Lengths are in pixels. Measured values were chosen with
// `./penumbra benchmark light --only occlusion` on head, bracket and brain.
#ifndef penumbra_LightConstants_h
#define penumbra_LightConstants_h

#include <cstddef>
#include <cstdint>

namespace penumbra
{

/// Side of the blocks of cells whose sites share one set of directions, and of the tiles whose error
/// is estimated and bounded. Tiles are made of whole blocks.
constexpr int DirectionBlockSide = 8;
constexpr int LightTileSide = 16;

// --- Sites ---

/// Largest number of sites of a pixel.
constexpr std::size_t MaximumSitesOfPixel = 10;
/// Number of layers behind each other that have sites of their own; those further behind share one.
constexpr std::size_t MaximumSiteLayers = 4;
/// Smallest cosine between the normals of points that belong to one site.
constexpr float SameSiteCosine = 0.7f;
/// Largest distance of the points of one site from its plane, in pixels, and relative to their distance
/// along the plane.
constexpr float SameSiteHeight = 0.5f;
constexpr float SameSiteSlope = 0.35f;
/// Numbers of samples, beside the first ones, that determine the parts of several sites in a pixel: the
/// maximum up to a tolerance of light of PartTolerance, fewer above it. Their error decreases with the power
/// 3/4 of their number.
constexpr std::uint32_t MaximumPartSamples = 32;
constexpr std::uint32_t MinimumPartSamples = 2;
constexpr double PartTolerance = 0.01;
/// Squared error of these parts, relative to the squared difference between both halves of the samples.
constexpr float PartVarianceGain = 0.125f;
/// Variance of the colors of a pixel, relative to 1 + their squared mean, below which changes are rather in
/// proportion to the color.
constexpr float PartRidge = 0.01f;

// --- Scattered tiles ---

/// Distance of the pixels in which pairs of camera rays decide whether a tile is scattered, and distance between the
/// rays of a pair.
constexpr int ProbedPixelStep = 4;
constexpr double ProbeDistance = 2.0;
/// A tile is scattered if more than this fraction of the pairs with a surface hit different sites. Measured:
/// 0.84 for spheres with a diameter of 3 pixels, 0.48 for 6 pixels, 0.09 to 0.16 for the meshes at 1000x600.
constexpr float ScatteredFraction = 0.6f;
/// Four times as many pairs are traced in a tile with fewer pairs with a surface than this, and if the fraction differs
/// by fewer standard errors. With fewer than FewestPairsOfAll among these, the tile is not scattered, such as the
/// corner of a mesh.
constexpr int FewestPairs = 8;
constexpr float CertainDeviation = 2.f;
constexpr int FewestPairsOfAll = 4;
/// A tile with fewer of all pairs with a surface than this is not scattered if the mean number of hits of a site is at
/// least HitsOfLargeSite: these pairs differ because they meet the edges of a surface that reaches into the tile, which
/// are exact. A hit stands for two pixels.
constexpr int PairsOfSparseTile = 16;
constexpr std::size_t HitsOfLargeSite = 4;
/// Number of rays from each hit of a camera ray.
constexpr std::uint32_t RaysOfLitSample = 2;

// --- Rays ---

/// Number of rays of a site: first round and maximum, powers of two.
constexpr int FirstSiteRays = 8;
constexpr int MaximumSiteRays = 1024;
/// Number of rounds after the first, and largest factor by which the number of rays grows in each.
constexpr int LightRounds = 6;
constexpr float LargestRayGrowth = 4.f;
/// Number of rays from each hit of a camera ray in these rounds: where a pixel has one site, and where it has several
/// without translucent layers.
constexpr std::uint32_t RaysOfHit = 4;
constexpr std::uint32_t RaysOfComplexHit = 2;
/// Number of cells on each side of the grid that directs the rays of these rounds; smallest fraction of them that it
/// does not direct; part of the squared mean that counts as noise. Measured with the part `skies` of the benchmark.
constexpr int GuideSide = 8;
constexpr float UnguidedFraction = 0.3f;
constexpr float GuideMeanPart = 0.1f;
/// Side of the blocks of pixels whose number of rays grows alike, and their number on each side of a tile.
constexpr int RayBlockSide = 4;
constexpr int RayBlocks = LightTileSide / RayBlockSide;

// --- Regression ---

/// Number of levels; the blocks of level L have sides of 2^L cells.
constexpr int LightLevels = 4;
/// Smallest cosine between the mean normals of patches that are joined.
constexpr float SamePatchCosine = 0.5f;
/// Largest distance of the mean of a patch from the plane of the other: in pixels, and relative to
/// the distance along the plane.
constexpr float SamePatchHeight = 0.5f;
constexpr float SamePatchSlope = 0.5f;
/// Changes of position (in sides of a block) and of the normal over which the value is expected to
/// change by the standard deviation that RidgeRays assumes.
constexpr float PositionUnit = 1.5f;
constexpr float NormalUnit = 0.5f;
/// Weight of the expectation that the value does not change, in rays.
constexpr float RidgeRays = 6.f;
/// Level whose patches average the estimated bias; and number of their blocks, on each side, of the
/// region whose ratios between levels are expected in a patch.
constexpr int BiasLevel = 3;
constexpr int BiasRegion = 3;
/// Squared change from a level to the next, relative to that of the next: expected range in a region.
constexpr float SmallestBiasRatio = 0.0625f;
constexpr float LargestBiasRatio = 0.5f;
/// Part of the standard error of such a change that is added to it, because the level with the smallest
/// estimated error is chosen.
constexpr float BiasCaution = 1.f;
/// Additional bias of sites that cover a small part of their pixels, relative to that of others.
constexpr float PartialSiteBias = 6.f;
/// Lower bound of the estimated squared error.
constexpr float SmallestSquaredError = 1e-8f;
/// Variance of a site that is estimated alone, relative to that of independent rays.
constexpr float AloneVarianceGain = 0.8f;
/// Number of blocks whose rays the blended models of a level share.
constexpr float SharedBlocks = 8.f;
/// Expected variance of the models of the first level, relative to that of independent rays. Its weight, and that of
/// the ratio of each level for the next one, in numbers of independent models that are measured.
constexpr float WindowVarianceGain = 0.8f;
constexpr float ExpectedModels = 8.f;

}
#endif
