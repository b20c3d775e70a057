// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "GltfImages.h"

#include "Files/ImageBytes.h"
#include "Files/TemporaryFile.h"
#include "GltfContainer.h"
#include "Processes/MessageLog.h"

#include "vtkImageData.h"
#include "vtkJPEGReader.h"
#include "vtkNew.h"
#include "vtkPNGReader.h"
#include "vtkPNGWriter.h"
#include "vtkPointData.h"
#include "vtkSmartPointer.h"
#include "vtkUnsignedCharArray.h"

#include <fstream>

namespace penumbra
{

namespace
{

using Json = nlohmann::json;

/// Decodes a temporary file: VTK 9.2 and 9.7 read images in memory in different ways. Returns null if it cannot.
template <typename Reader>
vtkSmartPointer<vtkImageData> Decode(const std::string& bytes)
{
  const TemporaryFile file(CreateTemporaryFile(""));
  if (file.Path.empty())
  {
    return nullptr;
  }
  std::ofstream(file.Path, std::ios::binary).write(bytes.data(), static_cast<long>(bytes.size()));
  TakeErrors();
  vtkNew<Reader> reader;
  reader->SetFileName(file.Path.c_str());
  reader->Update();
  const bool isDecoded = TakeErrors().empty() && reader->GetOutput()->GetNumberOfPoints() > 0 &&
    reader->GetOutput()->GetScalarPointer();
  return isDecoded ? reader->GetOutput() : nullptr;
}

std::string EncodePng(vtkImageData* image)
{
  vtkNew<vtkPNGWriter> writer;
  writer->SetInputData(image);
  writer->SetCompressionLevel(1); // VTK reads the image soon, and only once.
  writer->WriteToMemoryOn();
  writer->Write();
  vtkUnsignedCharArray* bytes = writer->GetResult();
  return std::string(reinterpret_cast<const char*>(bytes->GetPointer(0)),
    static_cast<std::size_t>(bytes->GetNumberOfValues()));
}

}

std::string FindDecodableType(const std::string& bytes)
{
  if (bytes.size() > 16 && bytes.compare(0, 4, "\x89PNG") == 0)
  {
    return IsWholePng(bytes.data(), bytes.size()) && Decode<vtkPNGReader>(bytes) ? "image/png" : "";
  }
  if (bytes.compare(0, 3, "\xff\xd8\xff") == 0)
  {
    return Decode<vtkJPEGReader>(bytes) ? "image/jpeg" : "";
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
  return EncodePng(pixel);
}

std::string MaskAlpha(const std::string& bytes, double factor, double cutoff)
{
  const bool isPng = bytes.compare(0, 4, "\x89PNG") == 0;
  const vtkSmartPointer<vtkImageData> image = isPng ? Decode<vtkPNGReader>(bytes) : nullptr;
  vtkDataArray* source = image ? image->GetPointData()->GetScalars() : nullptr;
  const int colors = source ? source->GetNumberOfComponents() - 1 : 0;
  if (colors != 1 && colors != 3)
  {
    return {};
  }
  const auto masked = vtkSmartPointer<vtkDataArray>::Take(source->NewInstance());
  masked->SetNumberOfComponents(cutoff > 0.0 ? colors + 1 : colors);
  masked->SetNumberOfTuples(source->GetNumberOfTuples());
  const double opaque = source->GetDataTypeMax();
  bool isChanged = false;
  for (vtkIdType i = 0; i < source->GetNumberOfTuples(); ++i)
  {
    for (int c = 0; c < colors; ++c)
    {
      masked->SetComponent(i, c, source->GetComponent(i, c));
    }
    const double alpha = source->GetComponent(i, colors);
    const double value = factor * alpha / opaque >= cutoff ? opaque : 0.0;
    isChanged = isChanged || value != alpha;
    if (cutoff > 0.0)
    {
      masked->SetComponent(i, colors, value);
    }
  }
  image->GetPointData()->SetScalars(masked);
  return isChanged ? EncodePng(image) : std::string();
}

std::set<std::size_t> FindUsedImages(const nlohmann::json& root)
{
  std::set<std::size_t> used;
  for (const Json& texture : ListOf(root, "textures"))
  {
    const auto source = texture.find("source");
    if (source != texture.end() && source->is_number_unsigned())
    {
      used.insert(source->get<std::size_t>());
    }
  }
  return used;
}

bool NamesTextures(const nlohmann::json& root)
{
  bool isNamed = false;
  VisitTextures(
    ListOf(root, "materials"), [&isNamed](const Json&, const std::string&) { isNamed = true; });
  return isNamed;
}

void RemoveTextures(
  nlohmann::json& root, const std::set<std::size_t>& badImages, std::vector<std::string>& warnings)
{
  std::set<std::size_t> goodTextures;
  std::set<std::string> missing;
  const std::size_t images = ListOf(root, "images").size();
  const std::size_t textures = ListOf(root, "textures").size();
  for (std::size_t i = 0; i < textures; ++i)
  {
    Json& texture = root["textures"][i];
    const auto source = texture.find("source");
    const bool isInRange = source != texture.end() && source->is_number_unsigned() &&
      source->get<std::size_t>() < images;
    if (source == texture.end() && !texture.value("extensions", Json::object()).empty())
    {
      warnings.push_back("a texture needs the extension " + texture["extensions"].begin().key() +
        "; its surfaces are drawn without it");
    }
    else if (!isInRange)
    {
      missing.insert("the image of the texture " + std::to_string(i));
    }
    if (isInRange && badImages.count(source->get<std::size_t>()) == 0)
    {
      goodTextures.insert(i);
    }
    else
    {
      texture["source"] = 0;
    }
  }
  for (Json& material : root["materials"])
  {
    VisitTextures(material, [&](Json& object, const std::string& name) {
      const Json& index = object[name]["index"];
      if (!index.is_number_unsigned() || index.get<std::size_t>() >= textures)
      {
        missing.insert("the texture " + index.dump().substr(0, 40));
      }
      if (!index.is_number_unsigned() || goodTextures.count(index.get<std::size_t>()) == 0)
      {
        object.erase(name);
      }
    });
  }
  for (const std::string& name : missing)
  {
    warnings.push_back(name + " is missing; its surfaces are drawn without it");
  }
  if (images == 0)
  {
    root.erase("textures");
  }
}

}
