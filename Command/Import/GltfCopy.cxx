// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "GltfCopy.h"

#include "Files/InputFiles.h"
#include "Files/MappedFile.h"
#include "Files/TemporaryFile.h"
#include "GltfImages.h"
#include "Processes/CommandError.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cctype>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <set>
#include <vector>

namespace penumbra
{

namespace
{

using Json = nlohmann::json;

constexpr std::uint32_t JsonChunk = 0x4e4f534a;
constexpr std::uint32_t BinaryChunk = 0x004e4942;

std::uint32_t WordAt(const MappedFile& file, std::size_t offset)
{
  std::uint32_t word = 0;
  if (offset + sizeof(word) <= file.Size())
  {
    std::memcpy(&word, file.Begin() + offset, sizeof(word));
  }
  return word;
}

/// The JSON text and the binary chunk, which is empty in .gltf files.
struct Parts
{
  std::string Text;
  std::string Binary;
};

Parts Split(const MappedFile& file)
{
  Parts parts;
  if (file.Size() < 12 || std::memcmp(file.Begin(), "glTF", 4) != 0)
  {
    parts.Text.assign(file.Begin(), file.End());
    return parts;
  }
  for (std::size_t at = 12; at + 8 <= file.Size();)
  {
    const std::size_t length = std::min<std::size_t>(WordAt(file, at), file.Size() - at - 8);
    const std::uint32_t type = WordAt(file, at + 4);
    std::string& part = type == JsonChunk ? parts.Text : parts.Binary;
    if ((type == JsonChunk || type == BinaryChunk) && part.empty())
    {
      part.assign(file.Begin() + at + 8, length);
    }
    at += 8 + length;
  }
  return parts;
}

std::string DecodeBase64(const std::string& text)
{
  const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bytes;
  std::uint32_t bits = 0;
  int count = 0;
  for (const char c : text)
  {
    const std::size_t digit = digits.find(c);
    if (digit == digits.npos)
    {
      continue;
    }
    bits = bits << 6 | static_cast<std::uint32_t>(digit);
    count += 6;
    if (count >= 8)
    {
      count -= 8;
      bytes += static_cast<char>(bits >> count & 0xff);
    }
  }
  return bytes;
}

std::string DecodePercents(const std::string& text)
{
  std::string decoded;
  for (std::size_t i = 0; i < text.size(); ++i)
  {
    const bool isCode = text[i] == '%' && i + 2 < text.size() &&
      std::isxdigit(static_cast<unsigned char>(text[i + 1])) &&
      std::isxdigit(static_cast<unsigned char>(text[i + 2]));
    decoded += isCode   ? static_cast<char>(std::strtol(text.substr(i + 1, 2).c_str(), nullptr, 16))
      : text[i] == '\\' ? '/'
                        : text[i];
    i += isCode ? 2 : 0;
  }
  return decoded;
}

class Copy
{
public:
  explicit Copy(const std::string& path)
    : Path(path)
  {
    const MappedFile file(path);
    this->Version =
      file.Size() >= 8 && std::memcmp(file.Begin(), "glTF", 4) == 0 ? WordAt(file, 4) : 2;
    Parts parts = Split(file);
    this->Root = Json::parse(parts.Text, nullptr, false);
    this->Binary.swap(parts.Binary);
  }

  /// Throws CommandError if the file is of version 1, whose lists are JSON objects.
  void RefuseVersion1() const
  {
    const bool isText1 =
      this->Root.is_object() && this->Root.contains("meshes") && this->Root["meshes"].is_object();
    if (isText1 || this->Version == 1)
    {
      this->Fail("files of glTF 1 cannot be read; convert it to glTF 2, for example with "
                 "gltf-pipeline");
    }
  }

  /// Returns whether VTK's reader may refuse the file. It reports invalid JSON itself.
  bool IsNeeded() const
  {
    if (!this->Root.is_object())
    {
      return false;
    }
    const Json& accessors = this->List("accessors");
    const bool isSparse = std::any_of(accessors.begin(), accessors.end(),
      [](const Json& accessor) { return accessor.contains("sparse"); });
    const Json& buffers = this->List("buffers");
    const bool isUnusual = std::any_of(buffers.begin(), buffers.end(), [](const Json& buffer) {
      const std::string uri = buffer.value("uri", std::string());
      return uri.find_first_of(" \\") != uri.npos && uri.compare(0, 5, "data:") != 0;
    });
    return isSparse || isUnusual || this->Root.contains("images") ||
      this->Root.contains("textures") || this->Root.contains("extensionsRequired");
  }

  /// Writes the copy and returns its path. `warnings`: null to leave materials out.
  std::string Write(std::vector<std::string>* warnings)
  {
    this->RefuseCompression();
    this->JoinBuffers();
    for (Json& accessor : this->Root["accessors"])
    {
      this->MakeDense(accessor);
    }
    this->RemoveExtensions();
    if (warnings)
    {
      this->EmbedImages(*warnings);
    }
    else
    {
      this->RemoveMaterials();
    }
    this->Root["buffers"] = Json::array({ { { "byteLength", this->Joined.size() } } });
    return this->WriteBinary();
  }

private:
  const Json& List(const char* name) const
  {
    static const Json empty = Json::array();
    const auto found = this->Root.find(name);
    return found != this->Root.end() && found->is_array() ? *found : empty;
  }

  [[noreturn]] void Fail(const std::string& problem) const
  {
    throw CommandError(BadInput, this->Path + ": " + problem);
  }

  void RefuseCompression() const
  {
    for (const Json& extension : this->List("extensionsRequired"))
    {
      const std::string name = extension.get<std::string>();
      if (name.find("compression") != name.npos)
      {
        this->Fail("its geometry is compressed (" + name + "); export it without compression");
      }
    }
  }

  std::string ReadBuffer(const Json& buffer) const
  {
    const std::string uri = buffer.value("uri", std::string());
    if (uri.empty())
    {
      return this->Binary;
    }
    if (uri.compare(0, 5, "data:") == 0)
    {
      return DecodeBase64(uri.substr(std::min(uri.find(','), uri.size())));
    }
    const std::string name = DecodePercents(uri);
    const MappedFile file((std::filesystem::path(this->Path).parent_path() / name).string());
    if (file.Size() == 0)
    {
      this->Fail("its buffer '" + name + "' is missing; copy it to the folder of the file");
    }
    return std::string(file.Begin(), file.End());
  }

  void JoinBuffers()
  {
    std::vector<std::size_t> offsets;
    std::vector<std::size_t> ends;
    for (const Json& buffer : this->List("buffers"))
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

  static std::size_t ComponentSize(int type)
  {
    return type == 5120 || type == 5121 ? 1 : type == 5122 || type == 5123 ? 2 : 4;
  }

  static std::size_t ElementSize(const Json& accessor)
  {
    static const Json components = { { "SCALAR", 1 }, { "VEC2", 2 }, { "VEC3", 3 }, { "VEC4", 4 },
      { "MAT2", 4 }, { "MAT3", 9 }, { "MAT4", 16 } };
    return ComponentSize(accessor.at("componentType").get<int>()) *
      components.at(accessor.at("type").get<std::string>()).get<std::size_t>();
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
      return DecodeBase64(uri.substr(std::min(uri.find(','), uri.size())));
    }
    const std::filesystem::path folder = std::filesystem::path(this->Path).parent_path();
    const std::filesystem::path name = DecodePercents(uri);
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
    return isFile ? "'" + DecodePercents(uri) + "'" : std::to_string(index);
  }

  /// Moves all images to the buffer. Those that are missing or that VTK cannot decode are not used.
  void EmbedImages(std::vector<std::string>& warnings)
  {
    std::set<std::size_t> bad;
    Json images = this->List("images");
    for (std::size_t i = 0; i < images.size(); ++i)
    {
      const std::string bytes = this->ReadImageBytes(images[i]);
      std::string type = FindDecodableType(bytes);
      if (type.empty())
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
    RemoveTextures(this->Root, bad);
  }

  void RemoveExtensions()
  {
    this->Root.erase("extensionsRequired");
    for (Json& mesh : this->Root["meshes"])
    {
      for (Json& primitive : mesh["primitives"])
      {
        primitive.erase("extensions");
      }
    }
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

  std::string WriteBinary() const
  {
    std::string text = this->Root.dump();
    text.resize((text.size() + 3) / 4 * 4, ' ');
    const std::string name = CreateTemporaryFile(".glb");
    if (name.empty())
    {
      this->Fail("no temporary file can be created in " +
        std::filesystem::temp_directory_path().string() + "; set TMPDIR to another folder");
    }
    std::ofstream file(name, std::ios::binary);
    const auto padded = static_cast<std::uint32_t>((this->Joined.size() + 3) / 4 * 4);
    const auto length = static_cast<std::uint32_t>(28 + text.size() + padded);
    const auto writeWords = [&file](std::initializer_list<std::uint32_t> words) {
      for (const std::uint32_t word : words)
      {
        file.write(reinterpret_cast<const char*>(&word), sizeof(word));
      }
    };
    writeWords({ 0x46546c67, 2, length, static_cast<std::uint32_t>(text.size()), JsonChunk });
    file << text;
    writeWords({ padded, BinaryChunk });
    file << this->Joined << std::string(padded - this->Joined.size(), '\0');
    file.close();
    if (!file)
    {
      std::filesystem::remove(name);
      this->Fail("its copy cannot be written to " + name + "; set TMPDIR to another folder");
    }
    return name;
  }

  /// Elements that a sparse accessor may have without a buffer: 2^28, at most 16 GiB.
  static constexpr std::size_t MaximumSparseCount = std::size_t(1) << 28;

  const std::string& Path;
  std::uint32_t Version = 2;
  Json Root;
  std::string Binary; ///< chunk of a .glb file
  std::string Joined; ///< all buffers
};

}

namespace
{

std::string CopyGltf(const std::string& path, std::vector<std::string>* warnings)
{
  try
  {
    Copy copy(path);
    copy.RefuseVersion1();
    return copy.IsNeeded() ? copy.Write(warnings) : std::string();
  }
  catch (const Json::exception&)
  {
    throw CommandError(BadInput,
      path +
        ": the file is damaged or not glTF 2: a value is missing or has a wrong type; export "
        "it again");
  }
}

}

std::string CopyGltfGeometry(const std::string& path)
{
  return CopyGltf(path, nullptr);
}

std::string CopyGltfScene(const std::string& path, std::vector<std::string>& warnings)
{
  return CopyGltf(path, &warnings);
}

}
