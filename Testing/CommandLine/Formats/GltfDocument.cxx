// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "GltfDocument.h"

#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPNGWriter.h"

#include <cstdint>

namespace penumbra_testing
{

std::string Base64(const std::string& bytes)
{
  const char* digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3)
  {
    std::uint32_t bits = 0;
    for (std::size_t k = 0; k < 3; ++k)
    {
      bits = bits << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0u);
    }
    for (std::size_t k = 0; k < 4; ++k)
    {
      text += i + k <= bytes.size() ? digits[bits >> (18 - 6 * k) & 63] : '=';
    }
  }
  return text;
}

std::string Floats(const std::vector<float>& values)
{
  return std::string(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(float));
}

Document MakeGltf(const std::vector<float>& points, const std::vector<float>& normals)
{
  const std::string bytes = Floats(points) + Floats(normals);
  const std::size_t half = points.size() * sizeof(float);
  const std::size_t count = points.size() / 3;
  Document root;
  root["asset"]["version"] = "2.0";
  root["scene"] = 0;
  root["scenes"] = Document::array({ { { "nodes", { 0 } } } });
  root["nodes"] = Document::array({ { { "mesh", 0 } } });
  root["meshes"] = Document::array({ { { "primitives",
    Document::array({ { { "attributes", { { "POSITION", 0 }, { "NORMAL", 1 } } } } }) } } });
  const auto accessor = [&](int view) {
    return Document{ { "bufferView", view }, { "componentType", 5126 }, { "count", count },
      { "type", "VEC3" }, { "min", { -9, -9, -9 } }, { "max", { 9, 9, 9 } } };
  };
  root["accessors"] = Document::array({ accessor(0), accessor(1) });
  root["bufferViews"] = Document::array({ { { "buffer", 0 }, { "byteLength", half } },
    { { "buffer", 0 }, { "byteOffset", half }, { "byteLength", half } } });
  root["buffers"] = Document::array({ { { "byteLength", bytes.size() },
    { "uri", "data:application/octet-stream;base64," + Base64(bytes) } } });
  return root;
}

void AddAttribute(Document& root, const std::string& name, const std::string& type,
  const std::vector<float>& values)
{
  const std::size_t components = type == "VEC2" ? 2 : type == "VEC3" ? 3 : 4;
  const std::string bytes = Floats(values);
  root["meshes"][0]["primitives"][0]["attributes"][name] = root["accessors"].size();
  root["accessors"].push_back({ { "bufferView", root["bufferViews"].size() },
    { "componentType", 5126 }, { "count", values.size() / components }, { "type", type } });
  root["bufferViews"].push_back(
    { { "buffer", root["buffers"].size() }, { "byteLength", bytes.size() } });
  root["buffers"].push_back({ { "byteLength", bytes.size() },
    { "uri", "data:application/octet-stream;base64," + Base64(bytes) } });
}

Document MakeSquare()
{
  std::vector<float> normals;
  for (int i = 0; i < 6; ++i)
  {
    normals.insert(normals.end(), { 0.f, 0.f, 1.f });
  }
  Document root = MakeGltf({ 0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 0, 0, 1, 1, 0, 0, 1, 0 }, normals);
  AddAttribute(root, "TEXCOORD_0", "VEC2", { 0, 1, 1, 1, 1, 0, 0, 1, 1, 0, 0, 0 });
  return root;
}

void WriteTwoColors(const std::string& path)
{
  vtkNew<vtkImageData> image;
  image->SetDimensions(2, 1, 1);
  image->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
  for (int i = 0; i < 6; ++i)
  {
    image->SetScalarComponentFromDouble(i / 3, 0, 0, i % 3, 40.0 * (i + 1));
  }
  vtkNew<vtkPNGWriter> writer;
  writer->SetFileName(path.c_str());
  writer->SetInputData(image);
  writer->Write();
}

}
