// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Messages between ranks that consist of parts of surfaces and their textures.
#ifndef penumbra_SurfaceMessages_h
#define penumbra_SurfaceMessages_h

#include "ByteStream.h"
#include "SurfaceAppearance.h"

#include <cstdint>
#include <string>
#include <vector>

namespace penumbra
{

struct Surface;

/// A message to a rank.
class SurfaceMessage
{
public:
  /// Adds the part of a surface that has these units. `index` is the index of the surface that it is a
  /// part of, the same on all ranks.
  void Add(std::uint32_t index, const Surface& surface, const std::vector<std::uint32_t>& units);

  std::string Take();

private:
  TextureMap Textures;
  ByteWriter Parts;
};

/// Messages from all ranks.
class ReceivedSurfaces
{
public:
  explicit ReceivedSurfaces(std::vector<std::string> messages);
  ReceivedSurfaces(const ReceivedSurfaces&) = delete;
  ReceivedSurfaces& operator=(const ReceivedSurfaces&) = delete;

  const TextureMap& GetTextures() const { return this->Textures; }

  /// Returns the number of messages.
  std::size_t GetCount() const { return this->Readers.size(); }

  /// Appends the parts from rank `first` to before rank `last` to the surfaces that they are parts of.
  void AppendTo(std::vector<Surface>& surfaces, std::size_t first, std::size_t last);

private:
  std::vector<std::string> Messages;
  std::vector<ByteReader> Readers;
  TextureMap Textures;
};

}
#endif
