// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "NrrdHeader.h"

#include "Files/FileExtension.h"
#include "Formats/TextScanner.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <vector>

namespace penumbra
{

namespace
{

using Fields = std::map<std::string, std::string>;
using Vector = std::vector<double>;

/// Reads the fields up to the empty line, in lower case and without spaces in their names.
Fields ReadFields(const std::string& path)
{
  std::ifstream file(path, std::ios::binary);
  Fields fields;
  std::string line;
  while (std::getline(file, line))
  {
    line.erase(line.find_last_not_of(" \t\r") + 1);
    if (line.empty())
    {
      break;
    }
    const std::size_t colon = line.find(':');
    if (line[0] != '#' && colon != line.npos && line.compare(colon, 2, ":=") != 0)
    {
      std::string name = LowerCase(line.substr(0, colon));
      name.erase(std::remove(name.begin(), name.end(), ' '), name.end());
      fields[name] = line.substr(colon + 1);
    }
  }
  return fields;
}

std::vector<std::string> SplitWords(const std::string& text)
{
  TextScanner scanner(text.data(), text.data() + text.size());
  std::vector<std::string> words;
  for (std::string_view word = scanner.Word(); !word.empty(); word = scanner.Word())
  {
    words.emplace_back(word);
  }
  return words;
}

/// Splits "(1,0,0) none (0, 1, 0)" into vectors; those of "none" are empty.
std::vector<Vector> SplitVectors(const std::string& text)
{
  std::vector<Vector> vectors;
  for (std::size_t at = 0; (at = text.find_first_not_of(" \t", at)) != text.npos;)
  {
    vectors.emplace_back();
    if (text[at] != '(')
    {
      at = std::min(text.find_first_of(" \t", at), text.size());
      continue;
    }
    const std::size_t end = std::min(text.find(')', at), text.size());
    std::string inside = text.substr(at + 1, end - at - 1);
    std::replace(inside.begin(), inside.end(), ',', ' ');
    for (const std::string& word : SplitWords(inside))
    {
      double number = 0.0;
      ParseNumber(word, number);
      vectors.back().push_back(number);
    }
    at = std::min(end + 1, text.size());
  }
  return vectors;
}

bool IsSpatialKind(const std::string& kind)
{
  return kind == "domain" || kind == "space";
}

double NumberOr(const std::vector<std::string>& words, std::size_t index, double otherwise)
{
  double number = 0.0;
  const bool found =
    index < words.size() && ParseNumber(words[index], number) && std::isfinite(number);
  return found ? number : otherwise;
}

/// Returns the spatial axes; empty if the header does not tell.
std::vector<std::size_t> FindSpatialAxes(
  Fields& fields, std::size_t dimension, const std::vector<Vector>& directions)
{
  const std::vector<std::string> kinds = SplitWords(LowerCase(fields["kinds"]));
  std::vector<std::size_t> axes;
  for (std::size_t axis = 0; axis < dimension; ++axis)
  {
    const bool isSpatial = directions.size() == dimension ? !directions[axis].empty()
      : kinds.size() == dimension                         ? IsSpatialKind(kinds[axis])
                                                          : false;
    if (isSpatial)
    {
      axes.push_back(axis);
    }
  }
  const bool isMeasured = !fields["spacings"].empty() || !fields["axismins"].empty();
  if (axes.empty() && dimension <= 3 && isMeasured)
  {
    for (std::size_t axis = 0; axis < dimension; ++axis)
    {
      axes.push_back(axis);
    }
  }
  return axes;
}

}

NrrdHeader ReadNrrdHeader(const std::string& path)
{
  Fields fields = ReadFields(path);
  const std::vector<std::string> sizes = SplitWords(fields["sizes"]);
  const std::vector<Vector> directions = SplitVectors(fields["spacedirections"]);
  const std::vector<std::size_t> axes = FindSpatialAxes(fields, sizes.size(), directions);
  NrrdHeader header;
  if (axes.empty() || axes.size() > 3 || axes.back() - axes.front() + 1 != axes.size())
  {
    return header;
  }
  header.IsKnown = true;
  double components = 1.0;
  for (std::size_t axis = 0; axis < axes.front(); ++axis)
  {
    components *= NumberOr(sizes, axis, 1.0);
  }
  header.Components = static_cast<int>(std::clamp(components, 1.0, 1e6));
  const std::vector<Vector> origin = SplitVectors(fields["spaceorigin"]);
  const std::vector<std::string> spacings = SplitWords(fields["spacings"]);
  const std::vector<std::string> minima = SplitWords(fields["axismins"]);
  for (std::size_t i = 0; i < axes.size(); ++i)
  {
    const std::size_t axis = axes[i];
    header.Sizes[i] = static_cast<int>(std::clamp(NumberOr(sizes, axis, 1.0), 1.0, 2147483647.0));
    if (directions.size() == sizes.size() && !directions[axis].empty())
    {
      for (std::size_t k = 0; k < 3; ++k)
      {
        header.Steps[i][k] = k < directions[axis].size() ? directions[axis][k] : 0.0;
      }
    }
    else
    {
      header.Steps[i][i] = NumberOr(spacings, axis, 1.0);
      header.Origin[i] = NumberOr(minima, axis, 0.0);
    }
  }
  for (std::size_t k = 0; k < 3 && !origin.empty() && k < origin[0].size(); ++k)
  {
    header.Origin[k] = origin[0][k];
  }
  return header;
}

}
