// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// The triangles and spheres of a scene that emit light.
#ifndef penumbra_EmissiveSurfaces_h
#define penumbra_EmissiveSurfaces_h

#include "EmitterTree.h"

#include <cstddef>
#include <vector>

namespace penumbra
{

struct Scene;

struct EmissiveSurfaces
{
  /// Strengths are exact for surfaces of one color. For mapped colors they are the largest of the
  /// corners, for textures the mean of the image: only the distribution of samples depends on them.
  std::vector<Emitter> Bright;
  std::vector<Emitter> Dim;
  bool HasMoreDim = false; ///< there are more dim emitters than the maximum, and Dim is empty
  bool HasTubes = false;   ///< emissive tubes, which are neither bright nor dim

  /// Emitted radiance averaged over all surfaces, without lines and points, or over their bounding
  /// box if it has a larger area.
  double MeanRadiance = 0.0;
};

/// Finds the emissive primitives: those with ambient color, and those without lighting. Physically
/// based materials, lines and points are left out. They are bright if their strength exceeds
/// `threshold` times the mean radiance, and dim otherwise; more than `maximumDim` dim ones are not
/// stored. Throws InsufficientMemory if the bright ones do not fit into memory.
VTKPENUMBRAFILTERSRAYTRACING_EXPORT EmissiveSurfaces FindEmissiveSurfaces(
  const Scene& scene, double threshold, std::size_t maximumDim);

}
#endif
