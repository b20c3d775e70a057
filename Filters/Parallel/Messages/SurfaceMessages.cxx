// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "SurfaceMessages.h"

#include "Surface.h"
#include "SurfacePart.h"

#include <utility>

namespace penumbra
{

void SurfaceMessage::Add(
  std::uint32_t index, const Surface& surface, const std::vector<std::uint32_t>& units)
{
  if (!units.empty())
  {
    CollectTextures(surface, this->Textures);
    this->Parts.Add(index);
    AddPart(surface, units, this->Parts);
  }
}

std::string SurfaceMessage::Take()
{
  ByteWriter textures;
  textures.Add(static_cast<std::uint64_t>(this->Textures.size()));
  for (const auto& [hash, texture] : this->Textures)
  {
    textures.Add(hash);
    AddTexture(*texture, textures);
  }
  return textures.Take() + this->Parts.Take();
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
