// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Tuning constants of the passes; those of shaders stand in the shaders. Fractions
// and factors have no unit. Each section names the command that shows the effect of a change;
// "measured" values were chosen with it, the others are choices with the given reason.
#ifndef penumbra_ScreenSpaceConstants_h
#define penumbra_ScreenSpaceConstants_h

#include <cstddef>

namespace penumbra
{

// --- Camera coordinates (TestOcclusionViews) ---

/// Camera coordinates preserve lengths and angles if products of their axes are at most this far from 0 and 1. Larger
/// than the rounding of VTK's matrices.
constexpr double RigidTolerance = 1e-9;

// --- Camera cuts and clipping planes (TestOcclusionHistory) ---

/// Clipping planes are tightened if they are farther from the bounds than by this factor, because
/// less of the precision of the depth buffer would be left.
constexpr double ClippingRangeRatio = 32.0;

/// A view is a cut if less than this fraction of a grid of points was visible before, from a
/// direction that differs by less than the angle of one of these cosines: 3 degrees for kernels, which find
/// other occluders from another direction, and 30 degrees for rays. Measured by OcclusionInMotion.
constexpr double MinimumUncutFraction = 0.25;
constexpr double MinimumUncutCosine = 0.9986;
constexpr double MinimumUncutCosineOfRays = 0.866;
constexpr int CutGridSide = 5;

// --- Thickness of occluders (`./penumbra benchmark ambient-occlusion --only accuracy`) ---

/// Spacing of the sampled rows, columns and pixels, in pixels.
constexpr int ThicknessPixelStride = 4;

/// Minimum difference of depth at the outline of an object, in pixel widths.
constexpr float DepthDiscontinuity = 8.f;

/// Ratio of thickness to median width, and the range of the thickness in radii. Measured.
constexpr double ThicknessToWidthRatio = 1.5;
constexpr double MinimumThickness = 0.05;
constexpr double MaximumThickness = 1.5;

/// Number of frames between measurements of the thickness in motion. Each reads the depths back.
constexpr int FramesPerThickness = 8;

/// Number of frames after which depths that are read back in motion are used, so that no frame waits for them.
constexpr int FramesUntilThickness = 4;

/// Fraction of the ratio to the measured thickness by which the used one changes in a frame. 90 % are
/// reached when the next measurement begins.
constexpr double ThicknessStep = 0.25;

// --- Convergence of static views (`./penumbra benchmark ambient-occlusion --only noise`) ---

/// Minimum number of samples per pixel before the first check: earlier, reading the image costs
/// more than the samples that a check saves.
constexpr int FirstConvergenceCheck = 32;

/// Estimated error of a mean of 2 n samples as a multiple of its difference from the mean of n. For
/// independent samples the RMS ratio is 1. It is larger here, because tiles tend to converge when
/// their difference happens to be small. Measured.
constexpr double ErrorPerDifference = 1.25;

/// Weight of the mean error of a tile relative to the errors of its pixels: an error that all
/// pixels of a tile have in common is visible as a step at the tile's edge.
constexpr double TileOffsetWeight = 4.0;

/// A static view stops refining after this multiple of MaximumWeight samples, even above the tolerance.
constexpr double StillSampleLimit = 8.0;

/// A window draws a static view again when its number of samples has grown to this multiple: with fewer new ones
/// the frame looks the same, and drawing the scene takes time from the samples. Measured with
/// `./penumbra benchmark ambient-occlusion --only settling`, like the following constant.
constexpr int SamplesPerFrameGrowth = 4;

/// Factor of the samples of a step once a static view in a window has as many, because the rest of a step costs as
/// much with few. Larger steps save no more time, but delay the reaction to input.
constexpr int LargeStaticStep = 2;

/// Fraction of FrameTime for the samples of a frame in motion and during interaction.
constexpr double MotionTimeFraction = 0.2;

/// Number of samples that a pixel keeps if a neighbor moved and the estimator adds its own samples: so few
/// that the pixel gets new ones in each frame. Measured with `./penumbra benchmark session --only rays`.
constexpr double KeptOfOwnSamples = 0.45;

/// While actors move in front of a static camera, the number of frames between comparisons of depths.
constexpr int FramesPerDepthComparison = 8;

/// Number of frames after which the result of such a comparison is read, so that no frame waits for it.
constexpr int FramesUntilComparison = 4;

// --- Automatic margin (TestOcclusionHistory for zooms) ---

/// Maximum automatic margin as a fraction of the larger image side.
constexpr double MaximumMargin = 0.1;

/// An automatic margin that becomes too small grows to this multiple of the required size.
constexpr double MarginReserve = 1.5;

/// An automatic margin shrinks if less than this fraction of it is required.
constexpr double MinimumUsedMargin = 0.5;

// --- Light shafts (`./penumbra benchmark light-shafts`) ---

/// Minimum extinction times the diagonal, for a medium that scatters nothing: shaders divide by extinction.
constexpr double MinimumOpticalDepth = 1e-12;
/// Automatic steps times tolerance. This and the following constants were measured.
constexpr double StepsTimesTolerance = 0.375;
constexpr int MinimumShaftSteps = 16;
constexpr int MaximumShaftSteps = 1024;
/// Minimum number of blocks along the larger image side per step; more steps do not reduce the
/// error.
constexpr int BlocksPerStep = 2;
/// Pixels per side of the largest blocks, which are used from LargestBlockTolerance on. With each
/// halving of the tolerance the side shrinks by 1.
constexpr int LargestBlock = 4;
constexpr double LargestBlockTolerance = 1.0 / 128.0;
/// Automatic margin while a light is outside of the image, in percent of the larger image side.
constexpr double DefaultShaftMargin = 20.0;
/// Props thinner than the first fraction of the diagonal do not count for the mean thickness; the
/// second fraction is the thickness if no prop counts.
constexpr double FlatPropFraction = 0.002;
constexpr double DefaultThicknessFraction = 0.02;

/// Shadow maps: automatic steps times the square root of the tolerance, and texels per side.
/// Measured. Smaller blocks contribute the other half of the accuracy.
constexpr double MapStepsTimesRoot = 1.5;
constexpr int ShadowMapSize = 512;

/// Maximum tangent of the angle between the axis of a shadow map and its sides, 83 degrees: beyond
/// it, texels are coarse and unequal.
constexpr double MaximumMapTangent = 8.0;

/// Largest cone angle of a spotlight that has a shadow map, in degrees, for the same reason.
constexpr double MaximumMapConeAngle = 80.0;

/// Distance of the near plane of a spotlight among the props, as a fraction of the farthest depth.
constexpr double MapNearFraction = 1e-3;

/// Part of the range of depths that a shadow map adds before and behind the props, so that their
/// depths differ from that of an empty texel.
constexpr double MapDepthMargin = 1e-3;

/// The part of a directional light's shadow map that the view needs is enlarged to cells, this
/// number per side of the props' extent. So texels stay in place while the camera moves little.
constexpr double MapCellsPerSide = 8.0;

/// Fraction of the logarithmic distance to the target gain that each image covers.
constexpr double ExposureAdaptationRate = 0.1;

/// Number of images after which the brightness of one is used. By then it has arrived from the
/// graphics card, so that no frame waits for it.
constexpr std::size_t FramesUntilExposure = 2;

/// Upper bound of the gain; its inverse is the lower bound.
constexpr double MaximumExposureGain = 64.0;

/// Geometric spacing toward a light in front of the camera stops at this fraction of its distance,
/// where the steps would become infinitely small.
constexpr double MinimumRadialDistance = 1.0 / 64.0;

}
#endif
