// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "SurfaceMessages.h"

#include "SurfacePart.h"

#include <utility>

namespace penumbra
{

SurfaceMessages::SurfaceMessages(int ranks)
  : Textures(static_cast<std::size_t>(ranks)),
    Parts(static_cast<std::size_t>(ranks))
{
}

void SurfaceMessages::Add(std::uint32_t index, const Surface& surface, std::size_t rank,
  const std::vector<std::uint32_t>& units)
{
  if (!units.empty())
  {
    CollectTextures(surface, this->Textures[rank]);
    this->Parts[rank].Add(index);
    AddPart(surface, units, this->Parts[rank]);
  }
}

std::string SurfaceMessages::Take(int rank)
{
  ByteWriter textures;
  textures.Add(static_cast<std::uint64_t>(this->Textures[rank].size()));
  for (const auto& [hash, texture] : this->Textures[rank])
  {
    textures.Add(hash);
    AddTexture(*texture, textures);
  }
  return textures.Take() + this->Parts[rank].Take();
}

ReceivedSurfaces::ReceivedSurfaces(std::vector<std::string> messages)
  : Messages(std::move(messages)),
    Readers(this->Messages.begin(), this->Messages.end())
{
  for (ByteReader& reader : this->Readers)
  {
    const auto count = reader.Get<std::uint64_t>();
    for (std::uint64_t i = 0; i < count; ++i)
    {
      const auto hash = reader.Get<std::uint64_t>();
      this->Textures[hash] = GetTexture(reader);
    }
  }
}

void ReceivedSurfaces::AppendTo(std::vector<Surface>& surfaces, std::size_t first, std::size_t last)
{
  for (std::size_t i = first; i < last; ++i)
  {
    while (!this->Readers[i].IsAtEnd())
    {
      const auto index = this->Readers[i].Get<std::uint32_t>();
      AppendPart(this->Readers[i], surfaces.at(index));
    }
    this->Messages[i] = std::string(); // frees the memory
  }
}

}
