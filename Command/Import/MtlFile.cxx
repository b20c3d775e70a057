// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "MtlFile.h"

#include "Formats/TextFile.h"
#include "Formats/TextScanner.h"

#include <algorithm>

namespace penumbra
{

namespace
{

constexpr double MaximumEmission = 1e6; ///< keeps single precision finite

/// Parses up to `count` numbers; the last one is repeated. Returns how many were parsed.
template <typename Values>
int ParseValues(TextScanner& text, Values& values)
{
  std::size_t count = 0;
  while (count < values.size())
  {
    TextScanner ahead = text;
    double value = 0.0;
    if (!ParseNumber(ahead.WordInLine(), value))
    {
      break;
    }
    text = ahead;
    values[count++] = value;
  }
  for (std::size_t i = count; count > 0 && i < values.size(); ++i)
  {
    values[i] = values[count - 1];
  }
  return static_cast<int>(count);
}

void ParseColor(TextScanner& text, std::array<double, 3>& color, double maximum = 1.0)
{
  std::array<double, 3> values = color;
  if (ParseValues(text, values) > 0)
  {
    for (std::size_t c = 0; c < 3; ++c)
    {
      color[c] = std::clamp(values[c], 0.0, maximum);
    }
  }
}

double ParseValue(TextScanner& text, double otherwise)
{
  std::array<double, 1> value{ otherwise };
  ParseValues(text, value);
  return value[0];
}

/// Parses the options and the path of a texture.
void ParseTexture(TextScanner& text, MtlMaterial& material)
{
  for (;;)
  {
    TextScanner ahead = text;
    const std::string option(ahead.WordInLine());
    if (option.size() < 2 || option[0] != '-')
    {
      break;
    }
    text = ahead;
    std::array<double, 3> values{ 0.0, 0.0, 0.0 };
    if (option == "-s" || option == "-o" || option == "-t")
    {
      const int count = ParseValues(text, values);
      std::array<double, 2>& target =
        option == "-s" ? material.TextureScale : material.TextureOffset;
      if (count > 0 && option != "-t")
      {
        target = { values[0], count > 1 || option == "-s" ? values[1] : 0.0 };
      }
    }
    else if (option == "-mm" || option == "-bm" || option == "-boost" || option == "-texres")
    {
      ParseValues(text, values);
    }
    else // -clamp on, -blendu off, ...
    {
      text.WordInLine();
    }
  }
  material.Texture = text.WordsInLine();
  std::replace(material.Texture.begin(), material.Texture.end(), '\\', '/');
}

}

bool ReadMtl(const std::string& path, MtlMaterials& materials)
{
  const TextFile file(path);
  if (file.Size() == 0)
  {
    return false;
  }
  TextScanner text(file.Begin(), file.End(), '#');
  // vtkOBJExporter writes the opacity as Tr.
  const std::string head(file.Begin(), std::min<std::size_t>(file.Size(), 80));
  const bool isByVTK = head.find("written by the visualization toolkit") != head.npos;
  MtlMaterial none;
  MtlMaterial* material = &none;
  while (!text.AtEnd())
  {
    const std::string_view keyword = text.WordInLine();
    if (keyword == "newmtl")
    {
      material = &materials[text.WordsInLine()];
      *material = MtlMaterial();
    }
    else if (keyword == "Kd")
    {
      ParseColor(text, material->Diffuse);
    }
    else if (keyword == "Ks")
    {
      ParseColor(text, material->Specular);
    }
    else if (keyword == "Ke")
    {
      ParseColor(text, material->Emission, MaximumEmission);
    }
    else if (keyword == "Ns")
    {
      material->SpecularExponent = std::clamp(ParseValue(text, 0.0), 0.0, 1000.0);
    }
    else if (keyword == "d")
    {
      material->Opacity = std::clamp(ParseValue(text, 1.0), 0.0, 1.0);
    }
    else if (keyword == "Tr")
    {
      const double value = std::clamp(ParseValue(text, 0.0), 0.0, 1.0);
      material->Opacity = isByVTK ? value : 1.0 - value;
    }
    else if (keyword == "illum")
    {
      material->Illumination = static_cast<int>(std::clamp(ParseValue(text, 2.0), 0.0, 10.0));
    }
    else if (EqualsIgnoringCase(keyword, "map_Kd"))
    {
      ParseTexture(text, *material);
    }
    else if (EqualsIgnoringCase(keyword, "map_d"))
    {
      MtlMaterial opacity;
      ParseTexture(text, opacity);
      material->OpacityTexture = opacity.Texture;
    }
    text.Line();
  }
  return true;
}

}
