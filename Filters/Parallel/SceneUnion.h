// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// The surfaces that the scenes of all ranks make together, without their primitives.
#ifndef penumbra_SceneUnion_h
#define penumbra_SceneUnion_h

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace penumbra
{

class RankGroup;
struct Scene;
struct WholeSurface;

/// A surface of which ranks have parts: those of one object with the same appearance. They follow
/// each other in the order of the ranks. Surfaces with Instances are not joined.
struct UnitedSurface
{
  std::string Appearance;
  std::shared_ptr<WholeSurface> Whole;
  std::size_t Count = 0;           ///< number of primitives
  std::vector<std::uint32_t> Own;  ///< surfaces of this rank's scene
  std::vector<std::size_t> Firsts; ///< index of the first primitive of each of them in the whole
};

/// Returns the surfaces of all scenes, the same on all ranks except for the last two members. They are ordered
/// by their objects, then by the first rank that has a part. Collective.
std::vector<UnitedSurface> UniteSurfaces(const Scene& scene, RankGroup& ranks);

/// Sets WholeSurface::IsDense. Collective.
void FindDenseSurfaces(const Scene& scene, RankGroup& ranks, std::vector<UnitedSurface>& surfaces);

}
#endif
