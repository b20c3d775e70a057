// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Tuning constants of lights, emitters, translucent layers and media. Fractions and factors have no
// unit; optical depths neither. Each section names the command that shows the effect of a change;
// "measured" values were chosen with it, the others are choices with the given reason. Bounds of
// rounding errors stay with the intersections in Embree/.
#ifndef penumbra_RayTracingConstants_h
#define penumbra_RayTracingConstants_h

#include <cstddef>
#include <cstdint>

namespace penumbra
{

// --- Samples of a hemisphere or a light (`./penumbra benchmark irradiance --only forms`) ---

/// Fraction of the hemisphere, times the number of rays n, that occluders may cover although all
/// rays agree: the error is at least this divided by n.
constexpr double UndetectedFraction = 0.5;

/// Standard error of the mean of n stratified rays above half-planes and disks, divided by n^(-3/4)
/// (measured over thousands of random ones; see the test SphereAbovePlane.ReportsCalibratedError).
constexpr double StandardErrorScale = 0.42;
/// Ratio of the error of stratified rays to that of independent pairs of rays, measured likewise.
constexpr double StratificationGain = 0.62;

/// Number of pairs that are assumed to differ in addition to those found. Some cells that an edge
/// crosses agree by chance, and stopping then would underestimate the error.
constexpr double VarianceFloorPairs = 2.0;

/// Number of paths per MinimumRays in the first round. Light sources are smaller than occluders, so
/// that irradiance needs more.
constexpr std::uint32_t PathsPerRay = 8;

// --- Lights with a size, seen as a disk (TestAreaLight: errors against closed forms) ---

/// Number of points on the circumference of the disk: first round and maximum.
constexpr int FirstCirclePoints = 4;
constexpr int MinimumCirclePoints = 8; ///< if all agree
constexpr int MaximumCirclePoints = 32;
/// Radius of the circumference, slightly inside the light.
constexpr float CircleRadius = 0.999f;
/// Number of points inside the disk that are traced if all points on the circumference agree: for a
/// single point, in a block of neighbors, and if all of the light is as visible from a neighbor. The
/// neighbors of a block detect what one of them misses.
constexpr std::uint32_t InteriorPoints = 8;
constexpr std::uint32_t BlockInteriorPoints = 4;
constexpr std::uint32_t SupportedInteriorPoints = 1;
/// Smallest distance of a predicted boundary outside the disk from its center, in radii, and angle
/// of the probes on both sides of the nearest point of the circumference, in radians.
constexpr float MinimumOutsideDistance = 1.0f;
constexpr float OutsideProbeAngle = 0.5f;
/// Standard error of a cap that the points on the circumference miss, as a fraction of its area.
constexpr float MissedCapError = 0.4f;
/// Distance of the probes on both sides of the predicted boundary, in radii.
constexpr float ProbeDistance = 0.05f;
/// Distance of the points that check the shape of the boundary, in radii.
constexpr float CheckDistance = 0.12f;
/// Number of further points that check it: at the first point, at neighbors of a point with one
/// boundary, and at neighbors of a point with more than one.
constexpr int CheckPoints = 6;
constexpr int BlockCheckPoints = 2;
constexpr int ComplexCheckPoints = 12;
/// Bracket of an end of the boundary, in radians, that is narrow enough for a prediction.
constexpr float NarrowBracket = 0.35f;
/// Standard error of the area as a fraction of the chord times the bracket of the sagitta, times
/// pi / 2: for curved boundaries, and for those that are straight as far as the probes show.
constexpr float CurvedError = 0.25f;
constexpr float StraightError = 0.12f;
/// Errors of the ends and of the sagitta as fractions of the tolerance.
constexpr float EndErrorFraction = 0.8f;
constexpr float SagittaErrorFraction = 0.6f;
/// Smallest half angle of a cap whose ends are predicted from neighbors.
constexpr float MinimumPredictedAngle = 0.2f;
/// Bracket of a predicted end relative to the one that meets the tolerance.
constexpr float PredictedBracket = 0.85f;
/// Largest number of brackets next to the predicted one that are tried.
constexpr int MaximumPredictedBrackets = 4;
/// Largest sagitta of a boundary that is predicted to be straight.
constexpr float StraightSagitta = 0.02f;
/// Second moment, in squared pixels, that is added to those of the positions of neighbors: without
/// neighbors in a direction, the predicted gradient in this direction is 0.
constexpr float GradientRegularization = 0.05f;
/// Number of samples of the sequence: first round and maximum.
constexpr std::uint32_t FirstLightSamples = 32;
constexpr std::uint32_t MaximumLightSamples = 1024;
/// Number of pairs that are assumed to differ in addition to those found.
constexpr double LightVarianceFloorPairs = 1.0;

// --- Environment maps and emissive triangles (TestvtkPenumbraEnvironment) ---

/// Threshold of suns, as a multiple of the mean over the sphere of the largest channel, clamped to
/// the threshold. Skies are below it: if the radiance is the sine of the elevation above the horizon,
/// the zenith is at 4.
constexpr double SunThreshold = 8.0;
/// Relative accuracy of the threshold, and the fraction of the mean radiance with suns that it is
/// worth to compute it for.
constexpr double SunThresholdAccuracy = 1e-3;

/// Number of rays to the suns of the environment map per point: first round, the same where rays disagree, and maximum.
constexpr std::uint32_t FirstSunRays = 16;
constexpr std::uint32_t FirstPenumbraRays = 64;
constexpr std::uint32_t MaximumSunRays = 4096;

/// Radiance of emitters from which rays are traced toward them, as a multiple of the mean radiance of
/// the surfaces of the scene or, if these are smaller, of their bounding box. At least one of this
/// number of gathered rays would hit a dimmer emitter, in a room that it lights alone.
constexpr double EmitterThreshold = 8.0;

/// Number of rays toward emitters per point: first round, and maximum of all rounds.
constexpr std::uint32_t FirstEmitterRays = 8;
constexpr std::uint32_t MaximumEmitterRays = 4096;

/// Accepted error of the first round as a fraction of the tolerance. With 1, penumbrae and surfaces at
/// grazing angles look grainy; 16 rays in the first round cost 11 to 28 % more (measured, `./penumbra
/// benchmark light --only box`).
constexpr double FirstEmitterErrorFraction = 0.4;

/// Tolerance of the distance at which a ray reaches the sampled point of an emitter.
constexpr float EmitterDistanceTolerance = 1e-3f;

/// With more emissive triangles than this that are not sampled, records treat none of them as a small
/// light source.
constexpr std::size_t MaximumEmitters = 8;

// --- Views without light (TestLightWarnings) ---

/// Side of the grid of pixels that are tested for light, and number of paths at each. Light that reaches
/// a hemisphere through a thousandth of it is found with a probability above 98 %.
constexpr int MissingLightGridSide = 8;
constexpr int MissingLightPaths = 64;

// --- Translucent layers: bounds of the work of one ray (TestLayerCeilings) ---

/// Maximum number of layers along one ray: camera rays, shadow rays and rays of a hemisphere.
constexpr int MaximumLayers = 256;
/// A shadow ray, or a camera ray, ends when the transmittance of the layers in front falls below this,
/// less than half a step of an image with 8 bits per channel.
constexpr float OpaqueTransmittance = 1.f / 4096.f;
/// A ray of a hemisphere that gathers light ends when the transmittance of the layers in front falls
/// below this, a quarter of a step of an image with 8 bits per channel.
constexpr float MinimumTransmittance = 1.f / 1024.f;
/// The same for rays that gather occlusion, as a fraction of the tolerance of the mean of all rays,
/// and its largest value.
constexpr double OcclusionCutFraction = 0.125;
constexpr double MaximumOcclusionCut = 0.125;
/// Weight, as a fraction of the tolerance, of the layers of a camera ray without an estimate of
/// their own. They share those of the layers in front and behind.
constexpr double SharedWeightFraction = 0.5;
/// Number of estimates of a camera ray from which on this weight grows, its growth per estimate, and
/// its maximum: a stack of any number of layers gets about 20 estimates.
constexpr int FullEstimates = 8;
constexpr double SharedWeightGrowth = 1.0 / 64.0;
constexpr double MaximumSharedWeight = 1.0 / 12.0;
/// Number of shadow rays of a camera ray after which lights with a size get one ray per layer, as a
/// multiple of MaximumLightSamples.
constexpr long long LightSampleBudgetFactor = 4;

// --- Single scattering (`./penumbra benchmark light-shafts`) ---

/// In-scattered light per initial step, in tolerances.
constexpr double LightPerStep = 2.0;
/// Bounds of the number of steps per interval.
constexpr double MinimumMarchSteps = 3.0;
constexpr double MaximumMarchSteps = 4096.0;
/// Estimated light that the steps miss, in units of the light of one step: per shadow boundary
/// found, and per interval.
constexpr double MissedPerBoundary = 0.2;
constexpr double MissedPerInterval = 0.05;
/// The number of steps is doubled while the estimated missed light exceeds this, in tolerances.
constexpr double MissedLightTolerance = 0.75;
/// Shadow boundaries are bisected down to this fraction of the tolerance.
constexpr double BoundaryFractionOfTolerance = 0.1;
/// With a given number of steps, shadow boundaries are bisected down to this fraction of a step.
constexpr double BoundaryFractionOfStep = 1.0 / 64.0;
/// Fraction of the interval at each end without steps, since rounding lets surfaces shadow
/// themselves there.
constexpr double MarchEndMargin = 1e-4;
/// Depth of the hierarchy: 2^ShadowVolumeLevels boxes. More boxes cost more per ray than they save
/// in steps.
constexpr int ShadowVolumeLevels = 4;
/// Margin of boxes against rounding, as a fraction of their coordinates.
constexpr float ShadowVolumeMargin = 1e-5f;
/// Number of segments of a table with equal angles, seen from the light.
constexpr int AngularSegments = 16;
/// Number of segments of a table with equal extinction, seen from the camera.
constexpr int ExtinctionSegments = 8;
/// Tables of inhomogeneous media: segments are divided until two quadratures of each differ by less
/// than this fraction of the light of the ray, but at most this number of times.
constexpr double SegmentTolerance = 2e-5;
constexpr int MaximumSegmentLevels = 12;
/// Accuracy of the positions of steps in a medium that is not gray, as a fraction of a step, and
/// bound of the iterations to find one.
constexpr double StepAccuracy = 0.1;
constexpr int MaximumInversionSteps = 60;
/// Rays end at this optical depth; the remaining transmittance is e^-18 = 1.5e-8.
constexpr double MaximumOpticalDepth = 18.0;
/// Lower bound of the distance between the ray and a light, as a fraction of the length of the ray.
constexpr double MinimumLightDistance = 1e-6;

}
#endif
