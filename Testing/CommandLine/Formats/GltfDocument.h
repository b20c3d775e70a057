// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Small glTF files, made by the tests.
#ifndef penumbra_testing_GltfDocument_h
#define penumbra_testing_GltfDocument_h

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace penumbra_testing
{

using Document = nlohmann::json;

std::string Base64(const std::string& bytes);

/// Bytes of single-precision numbers.
std::string Floats(const std::vector<float>& values);

/// Triangles with normals: one mesh of one primitive, shown by one node.
Document MakeGltf(const std::vector<float>& points, const std::vector<float>& normals);

/// Adds an attribute of the points of the first primitive, such as "COLOR_0" of type "VEC3".
void AddAttribute(Document& root, const std::string& name, const std::string& type,
  const std::vector<float>& values);

/// A square from 0 to 1 with texture coordinates.
Document MakeSquare();

/// Writes an image of two pixels of different colors, one right of the other.
void WriteTwoColors(const std::string& path);

}
#endif
