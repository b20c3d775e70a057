// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Identifies a primitive of a scene.
#ifndef penumbra_PrimitiveId_h
#define penumbra_PrimitiveId_h

#include <cstdint>

namespace penumbra
{

/// Identifies a triangle, sphere or tube: the index of its surface in Scene::Surfaces and its index
/// in the surface.
struct PrimitiveId
{
  std::uint32_t Surface;
  std::uint32_t Primitive;

  bool operator==(const PrimitiveId& other) const
  {
    return this->Surface == other.Surface && this->Primitive == other.Primitive;
  }
};

}
#endif
