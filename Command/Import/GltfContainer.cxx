// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "GltfContainer.h"

#include "Files/MappedFile.h"
#include "Files/TemporaryFile.h"
#include "Processes/CommandError.h"

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>

namespace penumbra
{

namespace
{

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

/// The binary format of version 1 has one chunk of text, of the given length, and one of bytes.
GltfContainer ReadBinaryVersion1(const MappedFile& file)
{
  constexpr std::size_t headerSize = 20;
  GltfContainer parts;
  if (file.Size() >= headerSize)
  {
    const std::size_t length = std::min<std::size_t>(WordAt(file, 12), file.Size() - headerSize);
    const char* const text = file.Begin() + headerSize;
    parts.Root = nlohmann::json::parse(text, text + length, nullptr, false);
    parts.Binary.assign(text + length, file.End());
  }
  return parts;
}

}

GltfContainer ReadGltf(const std::string& path)
{
  const MappedFile file(path);
  GltfContainer parts;
  if (file.Size() < 12 || std::memcmp(file.Begin(), "glTF", 4) != 0)
  {
    parts.Root = nlohmann::json::parse(file.Begin(), file.End(), nullptr, false);
    return parts;
  }
  if (WordAt(file, 4) == 1)
  {
    return ReadBinaryVersion1(file);
  }
  std::string text;
  for (std::size_t at = 12; at + 8 <= file.Size();)
  {
    const std::size_t length = std::min<std::size_t>(WordAt(file, at), file.Size() - at - 8);
    const std::uint32_t type = WordAt(file, at + 4);
    std::string& part = type == JsonChunk ? text : parts.Binary;
    if ((type == JsonChunk || type == BinaryChunk) && part.empty())
    {
      part.assign(file.Begin() + at + 8, length);
    }
    at += 8 + length;
  }
  parts.Root = nlohmann::json::parse(text, nullptr, false);
  return parts;
}

std::string WriteGlb(const nlohmann::json& root, const std::string& binary, const std::string& path)
{
  std::string text = root.dump();
  text.resize((text.size() + 3) / 4 * 4, ' ');
  const std::string name = CreateTemporaryFile(".glb");
  if (name.empty())
  {
    throw CommandError(BadInput,
      path + ": no temporary file can be created; set TMPDIR to a folder that is writable");
  }
  std::ofstream file(name, std::ios::binary);
  const auto padded = static_cast<std::uint32_t>((binary.size() + 3) / 4 * 4);
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
  file << binary << std::string(padded - binary.size(), '\0');
  file.close();
  if (!file)
  {
    std::filesystem::remove(name);
    throw CommandError(BadInput,
      path + ": its copy cannot be written to " + name + "; set TMPDIR to another folder");
  }
  return name;
}

const nlohmann::json& ListOf(const nlohmann::json& object, const char* name)
{
  static const nlohmann::json empty = nlohmann::json::array();
  const auto found = object.find(name);
  return found != object.end() && found->is_array() ? *found : empty;
}

std::size_t ComponentSize(int type)
{
  return type == 5120 || type == 5121 ? 1 : type == 5122 || type == 5123 ? 2 : 4;
}

std::size_t ElementSize(const nlohmann::json& accessor)
{
  static const nlohmann::json components = { { "SCALAR", 1 }, { "VEC2", 2 }, { "VEC3", 3 },
    { "VEC4", 4 }, { "MAT2", 4 }, { "MAT3", 9 }, { "MAT4", 16 } };
  return ComponentSize(accessor.at("componentType").get<int>()) *
    components.at(accessor.at("type").get<std::string>()).get<std::size_t>();
}

std::string DecodeDataUri(const std::string& uri)
{
  return DecodeBase64(uri.substr(std::min(uri.find(','), uri.size())));
}

std::string DecodePath(const std::string& uri)
{
  std::string decoded;
  for (std::size_t i = 0; i < uri.size(); ++i)
  {
    const bool isCode = uri[i] == '%' && i + 2 < uri.size() &&
      std::isxdigit(static_cast<unsigned char>(uri[i + 1])) &&
      std::isxdigit(static_cast<unsigned char>(uri[i + 2]));
    decoded += isCode  ? static_cast<char>(std::strtol(uri.substr(i + 1, 2).c_str(), nullptr, 16))
      : uri[i] == '\\' ? '/'
                       : uri[i];
    i += isCode ? 2 : 0;
  }
  return decoded;
}

}
