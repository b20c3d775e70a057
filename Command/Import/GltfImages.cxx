// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "GltfImages.h"

#include "Files/TemporaryFile.h"
#include "Processes/MessageLog.h"

#include "vtkImageData.h"
#include "vtkJPEGReader.h"
#include "vtkNew.h"
#include "vtkPNGReader.h"
#include "vtkPNGWriter.h"
#include "vtkUnsignedCharArray.h"

#include <cstdint>
#include <filesystem>
#include <fstream>

namespace penumbra
{

namespace
{

using Json = nlohmann::json;

/// Checksum of a chunk [PNG annex D].
std::uint32_t ComputeCrc(const unsigned char* begin, std::size_t size)
{
  std::uint32_t crc = 0xffffffffu;
  for (std::size_t i = 0; i < size; ++i)
  {
    crc ^= begin[i];
    for (int bit = 0; bit < 8; ++bit)
    {
      crc = crc & 1u ? 0xedb88320u ^ (crc >> 1) : crc >> 1;
    }
  }
  return ~crc;
}

/// Returns whether all chunks of a .png are complete and undamaged: vtkPNGReader may crash otherwise.
bool HasIntactChunks(const std::string& bytes)
{
  const auto* data = reinterpret_cast<const unsigned char*>(bytes.data());
  const auto word = [data](std::size_t at) {
    return static_cast<std::uint32_t>(data[at]) << 24 |
      static_cast<std::uint32_t>(data[at + 1]) << 16 |
      static_cast<std::uint32_t>(data[at + 2]) << 8 | data[at + 3];
  };
  constexpr std::size_t Signature = 8;
  constexpr std::size_t Overhead = 12; // length, type and checksum
  if (bytes.compare(Signature + 4, 4, "IHDR") != 0)
  {
    return false;
  }
  for (std::size_t at = Signature; bytes.size() - at >= Overhead;)
  {
    const std::size_t length = word(at);
    if (length > bytes.size() - at - Overhead ||
      word(at + 8 + length) != ComputeCrc(data + at + 4, length + 4))
    {
      return false;
    }
    if (bytes.compare(at + 4, 4, "IEND") == 0)
    {
      return true;
    }
    at += Overhead + length;
  }
  return false;
}

/// Decodes a temporary file: VTK 9.2 and 9.7 read images in memory in different ways.
template <typename Reader>
bool CanDecode(const std::string& bytes)
{
  const TemporaryFile file(CreateTemporaryFile(""));
  if (file.Path.empty())
  {
    return false;
  }
  std::ofstream(file.Path, std::ios::binary).write(bytes.data(), static_cast<long>(bytes.size()));
  TakeErrors();
  vtkNew<Reader> reader;
  reader->SetFileName(file.Path.c_str());
  reader->Update();
  return TakeErrors().empty() && reader->GetOutput()->GetNumberOfPoints() > 0 &&
    reader->GetOutput()->GetScalarPointer();
}

/// Removes the textures of an object of a material, which may contain others.
void RemoveReferences(Json& object, const std::set<std::size_t>& badTextures, std::size_t count)
{
  for (auto entry = object.begin(); entry != object.end();)
  {
    Json& value = entry.value();
    const bool isTexture = value.is_object() && value.contains("index") &&
      entry.key().size() >= 7 && entry.key().compare(entry.key().size() - 7, 7, "Texture") == 0;
    if (isTexture)
    {
      const Json& index = value["index"];
      if (!index.is_number_unsigned() || index.get<std::size_t>() >= count ||
        badTextures.count(index.get<std::size_t>()) > 0)
      {
        entry = object.erase(entry);
        continue;
      }
    }
    else if (value.is_object())
    {
      RemoveReferences(value, badTextures, count);
    }
    ++entry;
  }
}

}

std::string FindDecodableType(const std::string& bytes)
{
  if (bytes.size() > 16 && bytes.compare(0, 4, "\x89PNG") == 0)
  {
    return HasIntactChunks(bytes) && CanDecode<vtkPNGReader>(bytes) ? "image/png" : "";
  }
  if (bytes.compare(0, 3, "\xff\xd8\xff") == 0)
  {
    return CanDecode<vtkJPEGReader>(bytes) ? "image/jpeg" : "";
  }
  return {};
}

std::string MakeWhitePng()
{
  vtkNew<vtkImageData> pixel;
  pixel->SetDimensions(1, 1, 1);
  pixel->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
  for (int c = 0; c < 3; ++c)
  {
    pixel->SetScalarComponentFromDouble(0, 0, 0, c, 255.0);
  }
  vtkNew<vtkPNGWriter> writer;
  writer->SetInputData(pixel);
  writer->WriteToMemoryOn();
  writer->Write();
  vtkUnsignedCharArray* bytes = writer->GetResult();
  return std::string(reinterpret_cast<const char*>(bytes->GetPointer(0)),
    static_cast<std::size_t>(bytes->GetNumberOfValues()));
}

void RemoveTextures(nlohmann::json& root, const std::set<std::size_t>& badImages)
{
  std::set<std::size_t> badTextures;
  const auto textures = root.find("textures");
  const std::size_t count =
    textures != root.end() && textures->is_array() ? textures->size() : std::size_t(0);
  const auto images = root.find("images");
  const std::size_t imageCount =
    images != root.end() && images->is_array() ? images->size() : std::size_t(0);
  for (std::size_t i = 0; i < count; ++i)
  {
    Json& texture = (*textures)[i];
    const auto source = texture.find("source");
    const bool isValid = source != texture.end() && source->is_number_unsigned() &&
      source->get<std::size_t>() < imageCount && badImages.count(source->get<std::size_t>()) == 0;
    if (!isValid)
    {
      badTextures.insert(i);
      texture["source"] = 0;
    }
  }
  for (Json& material : root["materials"])
  {
    RemoveReferences(material, badTextures, imageCount > 0 ? count : 0);
  }
  if (imageCount == 0)
  {
    root.erase("textures");
  }
}

}
