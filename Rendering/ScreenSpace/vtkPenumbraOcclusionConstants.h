// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Constants of vtkPenumbraTemporalSSAOPass, most of them from Table 1 of [TSSAO]. Benchmarks and tests
// change them through vtkPenumbraTemporalSSAOPass::GetConstants(); their values are not checked.
#ifndef vtkPenumbraOcclusionConstants_h
#define vtkPenumbraOcclusionConstants_h

namespace penumbra
{

/// The convergence of a pixel is its number of samples divided by MaximumWeight.
struct OcclusionConstants
{
  /// Samples (depth fetches) per pixel and frame: for static views, and in motion for pixels whose
  /// convergence is below AdaptiveConvergence. k1 in [TSSAO].
  int FirstSamples = 32;

  /// The same in motion, at pixels above AdaptiveConvergence. k2 in [TSSAO].
  int Samples = 8;

  /// Number of steps in a frame of a static view: of FirstSamples samples, or of the rays of 16x16 pixels.
  /// 0: as many as fit into FrameTime.
  int StepsPerFrame = 0;

  /// Number of frames in which a pixel takes Samples once while only the camera moves, if the kernel
  /// reads depth only and the pixel is above AdaptiveConvergence and SpatialConvergence. Blocks of 4x4
  /// pixels take turns. Above 1, frames are faster and the image is steadier, but it follows the view
  /// more slowly.
  int SettledPeriod = 1;

  /// Number of samples above which older ones fade, w_max in [TSSAO].
  double MaximumWeight = 500.0;

  /// Convergence up to which pixels take FirstSamples in motion, c_adaptive in [TSSAO].
  double AdaptiveConvergence = 0.2;

  /// Convergence from which pixels are not filtered, c_spatial in [TSSAO], which has 0.3. Measured by
  /// OcclusionInMotion: at 0.3, pixels that have just left the filter are the noisiest of the image.
  double SpatialConvergence = 0.5;

  /// Convergence up to which samples differ from pixel to pixel, c_rot in [TSSAO].
  double RotationConvergence = 0.5;

  /// Maximum number of samples kept at a pixel if the view stops or the estimator changes, and if a neighbor
  /// moved [TSSAO eq. 9]. In the last case, the default means 0.45 for estimators that add their samples to
  /// the history, such as rays. From MaximumWeight on, samples are kept regardless of what moved.
  double InvalidationWeight = 30.0;

  /// Relative depth difference from which history is rejected as that of another surface; limited to
  /// 0.08 radii. 1: history that is inside of the image is kept, also at camera cuts, unless depths differ by as much.
  double DepthTolerance = 0.02;

  /// If true, pixels below SpatialConvergence are filtered.
  bool Filter = true;

  /// Margin around the image, in which occluders have an effect, in percent of the larger image side.
  /// Negative: the radius, at most 10 percent, and 0 for ray tracing. Requires OpaqueOnly.
  double Margin = -1.0;

  /// If true, history is reprojected with actors that move as rigid bodies; they are rendered a second
  /// time to identify the pixels of each actor. If false, history is discarded where depth shows motion.
  /// Requires OpaqueOnly.
  bool UseActorMotion = true;
};

}
#endif
