// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Tuning constants of the irradiance cache and of baking. Cosines, fractions and factors have no
// unit; a spacing is the distance of neighboring points of a mesh. Each section names the command
// that shows the effect of a change; "measured" values were chosen with it, the others are choices
// with the given reason. Afterwards run TestHemisphereEstimate, TestIrradiance,
// TestvtkPenumbraIrradianceCache and TestvtkPenumbraIrradianceFilter (errors against closed forms
// and brute force).
#ifndef penumbra_IrradianceConstants_h
#define penumbra_IrradianceConstants_h

#include "Shading/RayTracingConstants.h"

#include <cstddef>
#include <cstdint>

namespace penumbra
{

// --- Gathering: derivatives of one hemisphere (`./penumbra benchmark irradiance --only forms`) ---

/// Variance per boundary side, as a fraction of the squared jump. A fraction p of a cell on a
/// straight boundary lies on one side. The variance of its single sample, p (1 - p), is 1/6 on
/// average, and a staircase has about 4/3 sides per cell.
constexpr float VariancePerSide = 1.f / 8.f;

/// A hit is a wall if the cosine between its direction and the normal is below the first constant
/// and the cosine between the normals is below the second.
constexpr float LowCosine = 0.35f;
constexpr float SteepCosine = 0.7f;

/// Directions with a smaller cosine to the normal are ignored for the nearest hit [IC], which would
/// be 0 on every concave surface.
constexpr float GrazingCosine = 0.3f;

/// Minimum cosine between normals of one plane.
constexpr float FlatCosine = 0.99999f;

/// Upper bound of the distance of an occluder edge, relative to the hit next to it.
constexpr float MaximumEdgeFactor = 4.f;

/// Lower bound of the distance of an occluder edge, in scene units. In a corner it would be 0 and
/// the derivatives infinite.
constexpr float MinimumEdgeDistance = 1e-9f;

/// Lower bound of the squared sine between view direction and surface normal, which limits the
/// gradient at the maximum distance on surfaces seen face-on.
constexpr float MinimumSlope = 0.05f;

/// Number of samples along each side of a triangular emitter, and on the whole triangle.
constexpr int SamplesPerSide = 4;
constexpr float SamplesPerEmitter = 0.5f * SamplesPerSide * (SamplesPerSide + 1);

// --- Records: position and radius (`... --only records` and `... --only spheres`) ---

/// A point is covered if the maximum weight of a record exceeds this. Some overlap makes
/// transitions smooth; more overlap costs records and gains less than the tolerance (measured).
constexpr float MinimumWeight = 0.05f;

/// The same for the irradiance of images, which changes faster toward edges than occlusion does.
/// Records of less weight would show as blotches where they disagree (measured,
/// `./penumbra benchmark light --only box` and `--only skies`: with 0.05, single tiles are off by 2
/// tolerances and fewer tiles meet it).
constexpr float MinimumLightWeight = 0.25f;

/// Factor on the radius at which the error of a single record, half its Hessian norm times the
/// squared distance, equals the tolerance. Larger than 1 because weights decrease toward the radius
/// and errors of neighboring records cancel (measured).
constexpr double OverlapFactor = 2.0;

/// Error of the mean of a grid with side ReferenceGridSide if half of the hemisphere is occluded.
/// It decreases with the power -3/2 of the side (measured).
constexpr double ReferenceGridSide = 32.0;
constexpr double ReferenceGridError = 0.005;

/// Side of the first grid. The full grid follows if the samples of the first differ. Occluders that
/// the first grid misses are too small or too far to matter within the maximum radius.
constexpr int CoarseSide = 16;

/// Maximum radius as a fraction of the distance of occluder edges, near which the derivatives
/// change.
constexpr float OccluderEdgeFraction = 0.5f;

/// Ratio of the accuracy of split-sphere radii (a fraction of the distance) to the square root of
/// the tolerance. Gives about the usual accuracy of 0.3 at a tolerance of 0.005.
constexpr double SplitSphereAccuracy = 4.0;

/// Maximum radius as a fraction of the limit of the candidate if all samples are equal. The grid
/// misses low distant occluders that nearer points see. Without this on meshes, occlusion of 0.08
/// next to a sphere was baked as 0.
constexpr double UniformRadiusFraction = 0.5;

/// Maximum radius as a fraction of the distance to the shadow boundary of an emitter.
constexpr double ShadowRadiusFraction = 0.5;

/// Hits nearer than this fraction of the distance of an emitter occlude it.
constexpr float EmitterDistanceFraction = 0.97f;

/// Maximum radius as a fraction of the maximum distance of occluders; rays end at that distance.
constexpr float OcclusionRadiusFraction = 0.25f;

/// A record is invalid if its radius is below this fraction of the minimum radius: its error would
/// be above twice the tolerance. With an obstacle the fraction is 1, because derivatives grow toward
/// it.
constexpr double MinimumRadiusFraction = 0.7;

/// Radius of an invalid record over the minimum radius. No other record is placed within this
/// radius.
constexpr double InvalidRadiusFactor = 2.0;

/// Accepted noise of one record as a fraction of the tolerance if cells are supersampled.
constexpr double NoiseFraction = 0.5;

/// Maximum number of parts along each side of a supersampled cell.
constexpr int MaximumSubdivisions = 12;

/// Maximum number of supersampling rays of the first round over the number of cells.
constexpr double MaximumRayFactor = 3.0;

/// Fractions of the angle between a ray and the horizon of the planar surface that it hit, at which
/// further rays test whether the surface continues.
constexpr float HorizonFractions[] = { 0.002f, 0.016f, 0.125f };

/// Estimated error of a record, over its Hessian norm times the squared distance. It is 1/2 in the
/// direction of the maximum second derivative and less in others.
constexpr float RecordErrorFraction = 0.25f;

/// Error of interpolation along a surface as a fraction of the tolerance. Surfaces of scans are
/// rough.
constexpr double HessianErrorFraction = 0.5;

/// Error of the grid of one irradiance record over the tolerance. Above 1 because cells are
/// supersampled and several records are interpolated. Twice as many records with half as many rays
/// each have a smaller error (measured, `... --only light`).
constexpr double GridNoise = 2.5;

/// Error of interpolated values as a fraction of the tolerance of an image. Below 1 because errors
/// of neighboring pixels are correlated and do not average out.
constexpr double InterpolationErrorFraction = 0.5;

/// Relative tolerance up to which the tolerance of an image is not divided by the radiance of the
/// scene if that is above 1: that of the default image. Smaller ones would trace up to 65,536 rays
/// per record under a sky that is much brighter than the image shows.
constexpr double BrightTolerance = 1.0 / 128.0;

/// Minimum tolerance of the mean over the hemisphere, relative to the radiance of the scene.
constexpr double MinimumTolerance = 1e-4;

// --- Records of a view (`... --only spheres`) ---

/// Lower bound of the cosine between view direction and normal, which limits the projected pixel
/// size.
constexpr double MinimumViewCosine = 0.02;

/// The sphere of a record stays beyond this fraction of its distance from the camera. Nearer points
/// would see its radius as many pixels, and a far record may miss occluders that matter to them.
constexpr double NearestFraction = 0.5;

/// A square of the image is subdivided if the maximum weight of a corner is at most MinimumWeight,
/// or at most this if the four corners are not all on the surface of the center, which then has
/// records on one side only.
constexpr float MinimumPartialWeight = 0.4f;

/// If all four corners are used, maximum distance of a point from each over the radius of its
/// record.
constexpr float FourCornerRadiusFactor = 2.f;

/// Maximum fraction of invalid records. If more are invalid at a stride of at most CoarseStride
/// pixels, no further records are made and the rest is left to brute force.
constexpr double MaximumInvalidFraction = 0.7;
constexpr int CoarseStride = 16;

/// Error of n rays over n^(-3/4), as in vtkPenumbraBruteForceIrradiance, and maximum number of
/// rays.
constexpr double ReferenceRayError = StandardErrorScale;
constexpr std::uint32_t MaximumRays = 16384;

// --- Tree of records (`... --only spheres`: CPU seconds) ---

/// A leaf with more references is split if half of its side is at least MinimumHalfSide times the
/// mean radius of its records. Smaller leaves cost more memory accesses than they save comparisons
/// (measured).
constexpr std::size_t MaximumReferences = 24;
constexpr float MinimumHalfSide = 2.f;

/// Minimum size of a node as a fraction of the root. Bounds the depth if many records coincide.
constexpr float MinimumNodeSize = 1e-5f;

/// Shift and growth of the root cube as fractions of its size. Floors and walls often pass through
/// the center of a scene, where all their records would be referenced on both sides of node
/// boundaries.
constexpr float RootShift = 0.0137f;
constexpr float RootGrowth = 1.03f;

// --- Reflections (`... --only light`) ---

/// Approximate number of points (less than twice as many) that trace rays to find candidates, and
/// side of the grid of rays of each.
constexpr std::size_t ViewpointCount = 1024;
constexpr int ViewpointGridSide = 8;

/// The same number for baking, whose points lie everywhere on the mesh.
constexpr std::size_t BakingViewpointCount = 256;

/// Minimum stride in pixels of the visible points that trace rays.
constexpr int ViewpointStride = 8;

/// Tolerance of these records over that of the records that use them. Larger than 1 because their
/// errors are averaged over the hemisphere and attenuated by each reflection (measured).
constexpr double ReflectionToleranceFactor = 4.0;

/// Pixel size of a candidate over the length of the ray that found it. The solid angle of one of
/// the usual 1024 rays is about 14 times as wide.
constexpr float PixelPerDistance = 0.004f;

/// Minimum pixel size of a candidate as a fraction of the mean. Smaller ones lie in corners.
constexpr float MinimumPixelFraction = 0.25f;

/// Number of candidates of the first level, which doubles with each level, and fraction of
/// candidates that become records below which a level is the last.
constexpr std::size_t FirstLevel = 64;
constexpr double MinimumRecordFraction = 0.02;

// --- Baking (`... --only baking`; values marked "measured" on a scan of 104 thousand points) ---

/// Height of ray origins above a point, over the radius of its disk, so that the disks of
/// neighboring points on a convex surface do not occlude it.
constexpr float DiscRayHeight = 0.5f;

/// Width of the grid cells of the first level in spacings, and number of levels. Each level halves
/// the width, down to one spacing.
constexpr float CoarsestCellWidth = 32.f;
constexpr int BakingLevels = 6;

/// A level whose records cover fewer points each is the last. A record costs about as much as two
/// points by brute force, because it needs nearest hits and more rays for its derivatives.
constexpr double MinimumCoveredPoints = 2.5;

/// The same if other points use denoised low-sample estimates, which are cheaper (measured).
constexpr double MinimumCoveredPointsDenoised = 16.0;

/// Minimum cosine between the normals of two neighbors of one patch. Minimum number of points of a
/// patch with records or denoising; fewer are coarse compared to the surfaces around them, and brute
/// force at each of them costs little.
constexpr float PatchCosine = 0.5f;
constexpr std::size_t MinimumPatchPoints = 128;

/// Maximum radius of a record over the distance of its nearest obstacle: an obstacle is not much
/// nearer to a point that the record serves than to the record. If a ray that is not grazing hits
/// something within SeenDistanceFactor of this distance, the derivatives of the record include the
/// obstacle, and the larger fraction applies. Triangles of the same patch are obstacles if the cosine
/// of the angle between the normals is smaller than ObstacleCosine. Minimum height of an obstacle
/// over that of ray origins.
constexpr float ObstacleRadiusFraction = 0.5f;
constexpr float SeenObstacleFraction = 2.f;
constexpr float SeenDistanceFactor = 1.25f;
constexpr float ObstacleCosine = 0.3f;
constexpr float ObstacleHeightPerRayOffset = 4.f;

/// Denoising is tried on the points in one of TrialInterval grid cells of width TrialCellWidth. If
/// the fraction of these points that it can denoise is below the minimum, brute force is as fast.
constexpr double MinimumDenoisedFraction = 0.4;
constexpr float TrialCellWidth = 6.f; ///< spacings
constexpr std::size_t TrialInterval = 16;

/// Pixel size of a mesh in spacings. The minimum radius of a record must include its neighbors.
constexpr float PixelPerSpacing = 0.5f;

/// Error of rotation between normals as a fraction of the tolerance (measured).
constexpr double RotationErrorFraction = 0.1;

/// Maximum radius of a record, in pixels as defined by PixelPerSpacing (measured).
constexpr double MaximumRadiusPixels = 16.0;

/// Noise of one record over the tolerance. Above 1 because several records are interpolated
/// (measured).
constexpr double RecordNoiseFactor = 1.4;

/// Estimated error of brute force over the tolerance. Above 1 because the estimate exceeds the true
/// error (measured, `./penumbra benchmark fit-baking`: 1.6 misses the tolerance on a held-out
/// mesh).
constexpr double BruteForceErrorFactor = 1.3;

/// Noise of low-sample estimates over the tolerance (measured, `fit-baking`: 1.8 costs 9 to 27 %
/// more rays at equal error, 4.4 up to 37 %; 2.2 and 2.75 are the same 64 rays at a tolerance of
/// 0.01).
constexpr double LowSampleNoiseFactor = 2.2;

/// Maximum noise of low-sample estimates; that of 32 rays.
constexpr double MaximumLowSampleNoise = 0.032;

/// Estimated error of denoised values over the tolerance (measured, `fit-baking`: 0.7 costs 3 to
/// 7 % more rays at equal error, 1.1 up to 12 %).
constexpr double DenoisedErrorFactor = 0.88;

/// Difference between the estimate of a point and the fit, over the noise of the estimate, above
/// which the point differs from its neighbors.
constexpr float OutlierFactor = 3.f;

/// The same if all rays of a point agree, over the accepted RMS error.
constexpr float AgreeingErrorFactor = 2.f;

/// Maximum error of a denoised value over the accepted RMS error.
constexpr float MaximumDenoisedError = 2.f;

/// Minimum number of rays per point by brute force. More than for pixels, whose errors average out
/// over the samples of a pixel.
constexpr int MinimumRays = 128;

/// Fraction of occluded points from which normals are reported as inward facing, and occlusion from
/// which a point counts as occluded.
constexpr double MinimumOccludedFraction = 0.99;
constexpr float OccludedThreshold = 0.999f;

/// Number of polygons that exist twice, and of points whose polygons face opposite sides, over the
/// number of points, above which a warning reports them.
constexpr double MinimumReportedFraction = 0.01;

/// Radius of the neighborhood of a regression in spacings, and minimum cosine between normals.
/// Larger neighborhoods add more bias than they remove noise (measured, `fit-baking`: a radius of 5
/// costs 20 % more rays at equal error on held-out meshes).
constexpr float RegressionRadius = 2.5f;
constexpr float RegressionCosine = 0.95f;

/// True variance over the variance that brute force estimates, which is too large (measured).
constexpr double VarianceFactor = 0.6;

/// Fraction of the mean variance that is added to the variance of each estimate before the weights
/// are computed. It prevents single estimates from dominating the fit.
constexpr float CommonVarianceFraction = 0.5f;

/// Ridge regularization: added to the diagonal, as a fraction of the sum of weights. Makes the
/// function constant in directions without data, such as across a line of neighbors.
constexpr double Ridge = 1e-3;

/// True error of fitted values over the estimate from noise and residual (measured).
constexpr double RegressionErrorFactor = 0.8;

/// Minimum number of estimates in excess of the number of terms.
constexpr std::size_t MinimumSurplus = 4;

/// Maximum number of points used per grid cell, many times the number on a mesh of uniform density.
constexpr std::size_t MaximumPointsPerCell = 128;

// --- Baking: points in contact with other polygons ---

/// Distance of other polygons up to which a point touches them, over the height of ray origins.
constexpr float ContactDistancePerRayOffset = 2.f;

/// Distance by which such a point is moved into its polygons, over its spacing: small, so that the
/// value is that of the point. Minimum of the distance over the height of ray origins: origins over
/// a moved point are inside of concave edges of more than 2 degrees.
constexpr float ContactOffset = 1e-3f;
constexpr float ContactOffsetPerRayOffset = 32.f;

/// Maximum of the distance over the length of the triangle along its bisector.
constexpr float MaximumContactFraction = 0.25f;

/// Polygons with a larger cosine to the normal of the point are parallel: all ray origins around the
/// point are on the same side of them.
constexpr float ContactParallelCosine = 0.999f;

/// A polygon in contact separates a triangle if the sines of the angles between it and the sides of
/// the triangle exceed this.
constexpr float MinimumContactSine = 0.01f;

/// The parts of a point on the same side of all polygons in contact are used as one if their mean
/// bisector has at least this length. It is 0 if they surround the point.
constexpr float MinimumContactBisector = 0.3f;

/// Maximum number of parts of a point; those with the largest angles are used. Maximum number of
/// planes that separate them, and of triangles near a point that are tested for contact.
constexpr std::size_t MaximumContactParts = 16;
constexpr std::size_t MaximumContactPlanes = 8;
constexpr int MaximumContacts = 4096;

// --- All: fraction of the progress ---

/// Fraction of the progress of irradiance spent on all reflections but the last: of a view, and of
/// baking. Fraction of the progress of baking spent on records; the rest is spent on rays.
constexpr double ReflectionProgress = 0.5;
constexpr double BakingReflectionProgress = 0.4;
constexpr double RecordProgress = 0.5;

}
#endif
