// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// The triangles and spheres of a scene that emit light.
#ifndef penumbra_EmissiveSurfaces_h
#define penumbra_EmissiveSurfaces_h

#include "EmitterTree.h"
#include "Scene.h"

#include <vector>

namespace penumbra
{

struct EmissiveSurfaces
{
  /// Strengths are exact for surfaces of one color. For mapped colors they are the largest of the
  /// corners, for textures the mean of the image: only the distribution of samples depends on them.
  std::vector<Emitter> Emitters;
  bool HasTubes = false; ///< emissive tubes, which Emitters does not include

  /// Emitted radiance averaged over all surfaces, without lines and points, or over their bounding
  /// box if it has a larger area.
  double MeanRadiance = 0.0;
};

/// Finds the emissive primitives: those with ambient color, and those without lighting. Physically
/// based materials, lines and points are left out.
VTKPENUMBRAFILTERSRAYTRACING_EXPORT EmissiveSurfaces FindEmissiveSurfaces(const Scene& scene);

}
#endif
