// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Stores samples by their position on a fine grid, so that rays at shared corners and sides of
// subpixels are traced once [AA].
#ifndef penumbra_SampleCache_h
#define penumbra_SampleCache_h

#include "CameraRayTracer.h"

#include <cstdint>
#include <unordered_map>

namespace penumbra
{

/// Hash map from integer grid positions to samples. Not thread-safe.
class SampleCache
{
public:
  void Clear() { this->Samples.clear(); }

  /// Returns the sample at grid position `fine`, or null.
  const Sample* Find(glm::ivec2 fine) const
  {
    const auto found = this->Samples.find(Key(fine));
    return found == this->Samples.end() ? nullptr : &found->second;
  }

  const Sample& Insert(glm::ivec2 fine, const Sample& sample)
  {
    return this->Samples.emplace(Key(fine), sample).first->second;
  }

private:
  static std::uint64_t Key(glm::ivec2 fine)
  {
    return static_cast<std::uint64_t>(static_cast<std::uint32_t>(fine.y)) << 32 |
      static_cast<std::uint32_t>(fine.x);
  }

  std::unordered_map<std::uint64_t, Sample> Samples;
};

}
#endif
