// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Baking of ambient occlusion. The constants that decide error and cost are an argument, so that
// `./penumbra benchmark fit-baking` can vary them.
#ifndef penumbra_OcclusionBaking_h
#define penumbra_OcclusionBaking_h

#include "BakeInput.h"
#include "Baking.h"
#include "Gathering/IrradianceConstants.h"
#include "Gathering/RayGatherer.h"

#include "vtkPenumbraIrradianceProvider.h"

namespace penumbra
{

/// The fitted constants that decide most about error and cost. The defaults, which the filter uses,
/// are described in IrradianceConstants.h.
struct OcclusionBakingConstants
{
  double BruteForceErrorFactor = penumbra::BruteForceErrorFactor;
  double LowSampleNoiseFactor = penumbra::LowSampleNoiseFactor;
  double DenoisedErrorFactor = penumbra::DenoisedErrorFactor;
  double RegressionRadius = penumbra::RegressionRadius; ///< spacings
};

struct OcclusionBakingSettings
{
  double Tolerance;                                   ///< accepted RMSE over all query points
  vtkPenumbraIrradianceProvider::Occluders Occluders; ///< maximum distance and falloff
  bool UsesRecords; ///< if false, there are no records and no denoising, only brute force
};

/**
 * Computes the occlusion at the query points of `mesh`, in [0, 1]. `rays` and `gatherer` are of its
 * occluders. Adds records to `tree`, which must be initialized. Returns false or throws Stopped if
 * `progress` requested a stop.
 */
VTKPENUMBRAFILTERSIRRADIANCE_EXPORT bool BakeOcclusion(const BakeInput& mesh, const RayScene& rays,
  const Gatherer& gatherer, const OcclusionBakingSettings& settings,
  const OcclusionBakingConstants& constants, RecordOctree& tree, const ProgressCallback& progress,
  BakedValues& result);

}
#endif
