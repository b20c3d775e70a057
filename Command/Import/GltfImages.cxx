// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "GltfImages.h"

#include "Files/PngFile.h"
#include "Files/TemporaryFile.h"
#include "Processes/MessageLog.h"

#include "vtkImageData.h"
#include "vtkJPEGReader.h"
#include "vtkNew.h"
#include "vtkPNGReader.h"
#include "vtkPNGWriter.h"
#include "vtkUnsignedCharArray.h"

#include <filesystem>
#include <fstream>

namespace penumbra
{

namespace
{

using Json = nlohmann::json;

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
    return IsWholePng(bytes.data(), bytes.size()) && CanDecode<vtkPNGReader>(bytes) ? "image/png"
                                                                                    : "";
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

std::set<std::size_t> FindUsedImages(const nlohmann::json& root)
{
  std::set<std::size_t> used;
  const auto textures = root.find("textures");
  if (textures != root.end() && textures->is_array())
  {
    for (const Json& texture : *textures)
    {
      const auto source = texture.find("source");
      if (source != texture.end() && source->is_number_unsigned())
      {
        used.insert(source->get<std::size_t>());
      }
    }
  }
  return used;
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
