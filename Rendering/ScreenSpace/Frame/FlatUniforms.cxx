// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "FlatUniforms.h"

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <regex>
#include <vector>

namespace penumbra
{

namespace
{

/// Number of inputs of four components that OpenGL 3.2 guarantees.
constexpr std::size_t MaximumInputs = 15;

struct Uniform
{
  std::string Type;
  std::string Name;
  std::size_t Components = 0;
};

bool IsPartOfWord(char character)
{
  return std::isalnum(static_cast<unsigned char>(character)) != 0 || character == '_';
}

/// Returns whether a word occurs in a text more than once.
bool IsRepeated(const std::string& text, const std::string& word)
{
  int count = 0;
  for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1))
  {
    const std::size_t end = at + word.size();
    const bool isWord =
      (at == 0 || !IsPartOfWord(text[at - 1])) && (end == text.size() || !IsPartOfWord(text[end]));
    count += isWord ? 1 : 0;
  }
  return count > 1;
}

/// Returns the uniforms that can be moved, the largest first, so that they fill the inputs.
std::vector<Uniform> FindUniforms(const std::string& shader)
{
  static const std::regex declaration("\\buniform (float|vec2|vec3|vec4|mat4) (\\w+);");
  std::vector<Uniform> uniforms;
  for (std::sregex_iterator found(shader.begin(), shader.end(), declaration), end; found != end;
       ++found)
  {
    const std::string type = (*found)[1];
    const std::string name = (*found)[2];
    if (IsRepeated(shader, name)) // it is used
    {
      uniforms.push_back({ type, name,
        type == "float"    ? 1
          : type == "mat4" ? 16
                           : static_cast<std::size_t>(type.back() - '0') });
    }
  }
  std::stable_sort(uniforms.begin(), uniforms.end(),
    [](const Uniform& a, const Uniform& b) { return a.Components > b.Components; });
  return uniforms;
}

std::string InputName(std::size_t index)
{
  return "flatUniforms" + std::to_string(index);
}

void InsertAfter(std::string& shader, const std::string& line, const std::string& text)
{
  const std::size_t at = shader.rfind(line);
  if (at != std::string::npos)
  {
    shader.insert(at + line.size(), text);
  }
}

}

void PassUniformsFlat(std::string& vertexShader, std::string& fragmentShader)
{
  std::vector<std::size_t> used; // components of each input
  std::string uniforms;
  std::string outputs;
  std::string inputs;
  for (const Uniform& uniform : FindUniforms(fragmentShader))
  {
    const std::size_t columns = (uniform.Components + 3) / 4;
    const std::size_t components = uniform.Components / columns;
    const auto partial = std::find_if(
      used.begin(), used.end(), [&](std::size_t count) { return count + components <= 4; });
    const bool isNew = columns > 1 || partial == used.end();
    const std::size_t input =
      isNew ? used.size() : static_cast<std::size_t>(partial - used.begin());
    if (input + columns > MaximumInputs)
    {
      continue;
    }
    used.resize(std::max(used.size(), input + columns), 0);
    std::string value;
    for (std::size_t column = 0; column < columns; ++column)
    {
      const std::string part = InputName(input + column) + "." +
        std::string("xyzw").substr(used[input + column], components);
      used[input + column] += components;
      const std::string index = columns > 1 ? "[" + std::to_string(column) + "]" : "";
      outputs += "  " + part + " = " + uniform.Name + index + ";\n";
      value += (column > 0 ? ", " : "") + part;
    }
    const std::string prefix = uniform.Type + " " + uniform.Name + ";";
    uniforms += "uniform " + prefix + "\n";
    const std::string old = "uniform " + prefix;
    fragmentShader.replace(fragmentShader.find(old), old.size(),
      uniform.Type + " " + uniform.Name + " = " + uniform.Type + "(" + value + ");");
  }
  for (std::size_t input = 0; input < used.size(); ++input)
  {
    uniforms += "flat out vec4 " + InputName(input) + ";\n";
    inputs += "flat in vec4 " + InputName(input) + ";\n";
  }
  const std::string head = "//VTK::System::Dec\n";
  const std::string entry = "void main()\n{\n";
  InsertAfter(vertexShader, head, uniforms);
  InsertAfter(vertexShader, entry, outputs);
  InsertAfter(fragmentShader, head, inputs);
}

}
