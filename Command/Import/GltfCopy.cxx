// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "GltfCopy.h"

#include "Appearance.h"
#include "Files/InputFiles.h"
#include "Files/MappedFile.h"
#include "Files/TemporaryFile.h"
#include "GltfAttributes.h"
#include "GltfContainer.h"
#include "GltfImages.h"
#include "GltfMaterials.h"
#include "GltfValidation.h"
#include "GltfVersion1.h"
#include "Processes/CommandError.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <memory>
#include <set>
#include <vector>

namespace penumbra
{

namespace
{

using Json = nlohmann::json;

/// Member of a material without which VTK 9.2 ends the process.
constexpr const char* ColorsOfMaterial = "pbrMetallicRoughness";

class Copy
{
public:
  explicit Copy(const std::string& path)
    : Path(path),
      Source(ReadGltf(path)),
      Root(Source.Root),
      WasVersion1(IsVersion1(Root))
  {
    if (this->WasVersion1)
    {
      this->Root = ConvertVersion1(this->Root);
    }
  }

  /// Throws CommandError if there is nothing to show, which VTK's reader reports as invalid JSON.
  void RequireMeshes() const
  {
    if (this->Root.is_object() && ListOf(this->Root, "meshes").empty())
    {
      this->Fail("the mesh is empty; choose a file that contains cells or points");
    }
  }

  /// Throws CommandError at what VTK's reader does not check. Appends warnings of what it leaves out.
  void Validate(bool materials, std::vector<std::string>& warnings) const
  {
    const std::string compression = FindCompression(this->Root);
    if (!compression.empty())
    {
      this->Fail("its geometry is compressed (" + compression + "); export it without compression");
    }
    std::vector<std::size_t> sizes;
    for (const Json& buffer : ListOf(this->Root, "buffers"))
    {
      sizes.push_back(this->CountBytes(buffer));
      const std::size_t declared = buffer.value("byteLength", std::size_t(0));
      if (declared > sizes.back())
      {
        this->Fail("the file is damaged: buffer " + std::to_string(sizes.size() - 1) + " has " +
          std::to_string(sizes.back()) + " instead of " + std::to_string(declared) +
          " bytes; copy it again");
      }
    }
    const std::string fault = FindGltfFault(this->Root, sizes);
    if (!fault.empty())
    {
      this->Fail("the file is damaged: " + fault + "; export it again");
    }
    WarnOfExtensions(this->Root, materials, warnings);
  }

  /// Returns whether VTK's reader may refuse the file. It reports invalid JSON itself.
  bool IsNeeded() const
  {
    if (!this->Root.is_object())
    {
      return false;
    }
    const Json& accessors = ListOf(this->Root, "accessors");
    const bool isSparse = std::any_of(accessors.begin(), accessors.end(),
      [](const Json& accessor) { return accessor.contains("sparse"); });
    const Json& buffers = ListOf(this->Root, "buffers");
    const bool isUnusual = std::any_of(buffers.begin(), buffers.end(), [](const Json& buffer) {
      const std::string uri = buffer.value("uri", std::string());
      return uri.find_first_of(" \\") != uri.npos && uri.compare(0, 5, "data:") != 0;
    });
    const Json& materials = ListOf(this->Root, "materials");
    const bool isIncomplete = std::any_of(materials.begin(), materials.end(),
      [](const Json& material) { return !material.contains(ColorsOfMaterial); });
    const bool hasScene = this->Root.contains("scenes");
    const bool isQuantized = !FindQuantizedAccessors(this->Root).empty();
    return this->WasVersion1 || isSparse || isUnusual || isIncomplete || !hasScene || isQuantized ||
      this->Root.contains("images") || this->Root.contains("textures") ||
      NamesTextures(this->Root) || HasPlainColors(this->Root) || HasPlainEmission(this->Root) ||
      this->Root.contains("extensionsRequired");
  }

  void SimplifyMaterials(std::vector<std::string>& warnings)
  {
    ReplaceSpecularGlossiness(this->Root, warnings);
    UseFirstTextureCoordinates(this->Root, warnings);
    AddEmissionCoordinates(this->Root);
    for (std::size_t i = 0; i < ListOf(this->Root, "materials").size(); ++i)
    {
      this->Root["materials"][i].emplace(ColorsOfMaterial, Json::object());
    }
  }

  /// Makes one buffer and dense accessors. `materials`: colors of vertices are those of the materials.
  void SimplifyGeometry(bool materials)
  {
    AddScene(this->Root);
    this->JoinBuffers();
    for (Json& accessor : this->Root["accessors"])
    {
      this->MakeDense(accessor);
    }
    for (const std::size_t accessor : FindQuantizedAccessors(this->Root))
    {
      this->MakeFloat(this->Root["accessors"][accessor]);
    }
    if (materials)
    {
      MultiplyVertexColors(this->Root, this->MakeBuffers());
    }
    this->AddEndsOfAnimations();
    RemoveExtensions(this->Root);
  }

  /// Writes a copy with materials and images and returns its path.
  std::string WriteScene(std::vector<std::string>& warnings)
  {
    const std::size_t views = this->Root["bufferViews"].size();
    const std::size_t bytes = this->Joined.size();
    this->EmbedImages(warnings);
    std::string path = this->Write();
    Json::array_t& list = this->Root["bufferViews"].get_ref<Json::array_t&>();
    list.erase(list.begin() + static_cast<std::ptrdiff_t>(views), list.end());
    this->Joined.resize(bytes);
    return path;
  }

  /// Writes a copy without materials and returns its path. Call last.
  std::string WriteGeometry()
  {
    this->RemoveMaterials();
    return this->Write();
  }

private:
  std::string Write()
  {
    this->Root["buffers"] = Json::array({ { { "byteLength", this->Joined.size() } } });
    return WriteGlb(this->Root, this->Joined, this->Path);
  }

  [[noreturn]] void Fail(const std::string& problem) const
  {
    throw CommandError(BadInput, this->Path + ": " + problem);
  }

  std::string ReadBuffer(const Json& buffer) const
  {
    const std::string uri = buffer.value("uri", std::string());
    if (uri.empty())
    {
      return this->Source.Binary;
    }
    if (uri.compare(0, 5, "data:") == 0)
    {
      return DecodeDataUri(uri);
    }
    const MappedFile file(this->FindBuffer(uri));
    return std::string(file.Begin(), file.End());
  }

  /// Returns the path of a buffer that is a file.
  std::string FindBuffer(const std::string& uri) const
  {
    const std::string name = DecodePath(uri);
    const std::filesystem::path path = std::filesystem::path(this->Path).parent_path() / name;
    std::error_code error;
    const std::uintmax_t size = std::filesystem::file_size(path, error);
    if (error || size == 0)
    {
      this->Fail("its buffer '" + name + "' is missing; copy it to the folder of the file");
    }
    return path.string();
  }

  std::size_t CountBytes(const Json& buffer) const
  {
    const std::string uri = buffer.value("uri", std::string());
    return uri.empty()                  ? this->Source.Binary.size()
      : uri.compare(0, 5, "data:") == 0 ? DecodeDataUri(uri).size()
                                        : std::filesystem::file_size(this->FindBuffer(uri));
  }

  void JoinBuffers()
  {
    std::vector<std::size_t> offsets;
    std::vector<std::size_t> ends;
    for (const Json& buffer : ListOf(this->Root, "buffers"))
    {
      this->Joined.resize((this->Joined.size() + 3) / 4 * 4);
      offsets.push_back(this->Joined.size());
      this->Joined += this->ReadBuffer(buffer);
      ends.push_back(this->Joined.size());
    }
    for (Json& view : this->Root["bufferViews"])
    {
      const std::size_t buffer = view.at("buffer").get<std::size_t>();
      const std::size_t begin = offsets.at(buffer) + view.value("byteOffset", std::size_t(0));
      const std::size_t length = view.at("byteLength").get<std::size_t>();
      if (begin > ends[buffer] || length > ends[buffer] - begin)
      {
        this->Fail("the file is damaged: a buffer is too short; copy it again");
      }
      view["buffer"] = 0;
      view["byteOffset"] = begin;
    }
  }

  /// Copies `count` elements of a buffer view.
  std::string ReadElements(const Json& reference, std::size_t count, std::size_t size) const
  {
    const Json& view =
      this->Root.at("bufferViews").at(reference.at("bufferView").get<std::size_t>());
    const std::size_t stride = std::max(view.value("byteStride", size), size);
    const std::size_t offset = reference.value("byteOffset", std::size_t(0));
    const std::size_t length = view.at("byteLength").get<std::size_t>();
    if (count > 0 &&
      (offset > length || (count - 1) > (length - offset) / stride ||
        (count - 1) * stride + size > length - offset))
    {
      this->Fail("the file is damaged: an accessor exceeds its buffer; export it again");
    }
    std::string elements;
    elements.reserve(count * size);
    const std::size_t begin = view.at("byteOffset").get<std::size_t>() + offset;
    for (std::size_t i = 0; i < count; ++i)
    {
      elements.append(this->Joined, begin + i * stride, size);
    }
    return elements;
  }

  /// Replaces a sparse accessor, or one without values, by a dense one.
  void MakeDense(Json& accessor)
  {
    const bool isSparse = accessor.contains("sparse");
    if (!isSparse && accessor.contains("bufferView"))
    {
      return;
    }
    const std::size_t size = ElementSize(accessor);
    const std::size_t count = accessor.at("count").get<std::size_t>();
    if (count > MaximumSparseCount)
    {
      this->Fail("the file is damaged: an accessor has too many elements; export it again");
    }
    std::string elements = accessor.contains("bufferView")
      ? this->ReadElements(accessor, count, size)
      : std::string(count * size, '\0');
    if (isSparse)
    {
      const Json& sparse = accessor["sparse"];
      const std::size_t changes = sparse.at("count").get<std::size_t>();
      const std::size_t indexSize =
        ComponentSize(sparse.at("indices").at("componentType").get<int>());
      const std::string indices = this->ReadElements(sparse.at("indices"), changes, indexSize);
      const std::string values = this->ReadElements(sparse.at("values"), changes, size);
      for (std::size_t i = 0; i < changes; ++i)
      {
        std::uint32_t index = 0;
        std::memcpy(&index, &indices[i * indexSize], indexSize);
        if (index >= count)
        {
          this->Fail("the file is damaged: a sparse index is out of range; export it again");
        }
        elements.replace(index * size, size, values, i * size, size);
      }
      accessor.erase("sparse");
    }
    accessor["bufferView"] = this->AddView(elements);
    accessor["byteOffset"] = 0;
  }

  /// Replaces integers by floating-point numbers.
  void MakeFloat(Json& accessor)
  {
    const std::size_t count = accessor.at("count").get<std::size_t>();
    const std::size_t size = ElementSize(accessor);
    const std::vector<float> values = ToFloats(this->ReadElements(accessor, count, size), accessor);
    const std::size_t components = size / ComponentSize(accessor.at("componentType").get<int>());
    std::vector<float> least(values.begin(), values.begin() + (count > 0 ? components : 0));
    std::vector<float> largest = least;
    for (std::size_t i = 0; i < values.size(); ++i)
    {
      least[i % components] = std::min(least[i % components], values[i]);
      largest[i % components] = std::max(largest[i % components], values[i]);
    }
    const auto* bytes = reinterpret_cast<const char*>(values.data());
    accessor = { { "bufferView", this->AddView(std::string(bytes, sizeof(float) * values.size())) },
      { "byteOffset", 0 }, { "componentType", FloatType }, { "count", count },
      { "type", accessor["type"] }, { "min", least }, { "max", largest } };
  }

  /// Adds the largest time of animations, which version 2 requires and version 1 does not.
  void AddEndsOfAnimations()
  {
    for (const Json& animation : ListOf(this->Root, "animations"))
    {
      for (const Json& sampler : animation.at("samplers"))
      {
        Json& times = this->Root.at("accessors").at(sampler.at("input").get<std::size_t>());
        const std::size_t count = times.at("count").get<std::size_t>();
        if (times.contains("max") || times.at("componentType") != FloatType || count == 0)
        {
          continue;
        }
        const std::string bytes = this->ReadElements(times, count, sizeof(float));
        std::vector<float> values(count);
        std::memcpy(values.data(), bytes.data(), bytes.size());
        const auto range = std::minmax_element(values.begin(), values.end());
        times["min"] = Json::array({ *range.first });
        times["max"] = Json::array({ *range.second });
      }
    }
  }

  /// Appends bytes to the buffer and returns the index of their view.
  std::size_t AddView(const std::string& bytes)
  {
    this->Joined.resize((this->Joined.size() + 3) / 4 * 4);
    Json& views = this->Root["bufferViews"];
    views.push_back(
      { { "buffer", 0 }, { "byteOffset", this->Joined.size() }, { "byteLength", bytes.size() } });
    this->Joined += bytes;
    return views.size() - 1;
  }

  GltfBuffers MakeBuffers()
  {
    return { [this](const Json& accessor) {
              return this->ReadElements(
                accessor, accessor.at("count").get<std::size_t>(), ElementSize(accessor));
            },
      [this](const Json& image) { return this->ReadImageBytes(image); },
      [this](const std::string& bytes) { return this->AddView(bytes); } };
  }

  /// Returns the bytes of an image; empty if they are missing.
  std::string ReadImageBytes(const Json& image) const
  {
    if (image.contains("bufferView"))
    {
      const Json& view = this->Root.at("bufferViews").at(image["bufferView"].get<std::size_t>());
      return this->Joined.substr(
        view.at("byteOffset").get<std::size_t>(), view.at("byteLength").get<std::size_t>());
    }
    const std::string uri = image.value("uri", std::string());
    if (uri.compare(0, 5, "data:") == 0)
    {
      return DecodeDataUri(uri);
    }
    const std::filesystem::path folder = std::filesystem::path(this->Path).parent_path();
    const std::filesystem::path name = DecodePath(uri);
    for (const std::filesystem::path& path : { folder / name, folder / name.filename() })
    {
      const bool isFile = !uri.empty() && uri.find("://") == uri.npos;
      const MappedFile file(isFile ? path.string() : std::string());
      if (file.Size() > 0)
      {
        RecordInput(path.string());
        return std::string(file.Begin(), file.End());
      }
    }
    return {};
  }

  static std::string NameImage(const Json& image, std::size_t index)
  {
    const std::string uri = image.value("uri", std::string());
    const bool isFile = !uri.empty() && uri.compare(0, 5, "data:") != 0;
    return isFile ? "'" + DecodePath(uri) + "'" : std::to_string(index);
  }

  /// Moves all images to the buffer. Those that are missing or that VTK cannot decode are not used.
  void EmbedImages(std::vector<std::string>& warnings)
  {
    std::set<std::size_t> bad;
    const std::set<std::size_t> used = FindUsedImages(this->Root);
    Json images = ListOf(this->Root, "images");
    for (std::size_t i = 0; i < images.size(); ++i)
    {
      const bool isUsed =
        used.count(i) > 0; // Others are alternatives for programs with an extension.
      const std::string bytes = isUsed ? this->ReadImageBytes(images[i]) : std::string();
      std::string type = FindDecodableType(bytes);
      if (isUsed && type.empty())
      {
        bad.insert(i);
        warnings.push_back("the texture " + NameImage(images[i], i) +
          (bytes.empty() ? " is missing" : " is neither .png nor .jpg, or damaged") +
          "; its surfaces are drawn without it");
      }
      images[i] = { { "bufferView", this->AddView(type.empty() ? MakeWhitePng() : bytes) },
        { "mimeType", type.empty() ? "image/png" : type } };
    }
    if (!images.empty())
    {
      this->Root["images"] = images;
    }
    RemoveTextures(this->Root, bad, warnings);
    MaskBaseColors(this->Root, this->MakeBuffers());
    AddEmissionTextures(this->Root, this->AddView(MakeWhitePng()));
  }

  void RemoveMaterials()
  {
    for (const char* name : { "images", "textures", "samplers", "materials" })
    {
      this->Root.erase(name);
    }
    for (Json& mesh : this->Root["meshes"])
    {
      for (Json& primitive : mesh["primitives"])
      {
        primitive.erase("material");
      }
    }
  }

  static constexpr int FloatType = 5126; ///< of components, OpenGL's constant

  /// Elements that a sparse accessor may have without a buffer: 2^28, at most 16 GiB.
  static constexpr std::size_t MaximumSparseCount = std::size_t(1) << 28;

  const std::string& Path;
  GltfContainer Source;
  Json& Root;
  const bool WasVersion1;
  std::string Joined; ///< all buffers
};

}

std::string CopyGltf(
  const std::string& path, Appearance* appearance, std::vector<std::string>& warnings)
{
  try
  {
    Copy copy(path);
    copy.RequireMeshes();
    copy.Validate(appearance != nullptr, warnings);
    if (!copy.IsNeeded())
    {
      return {};
    }
    if (appearance)
    {
      copy.SimplifyMaterials(warnings);
    }
    copy.SimplifyGeometry(appearance != nullptr);
    if (appearance)
    {
      appearance->Copy = std::make_shared<TemporaryFile>(copy.WriteScene(warnings));
    }
    return copy.WriteGeometry();
  }
  catch (const Json::exception&)
  {
    throw CommandError(BadInput,
      path +
        ": the file is damaged or not glTF: a value is missing or has a wrong type; export "
        "it again");
  }
}

}
