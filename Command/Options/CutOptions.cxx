// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "CutOptions.h"

#include "SharedOptions.h"

#include <algorithm>
#include <sstream>

namespace penumbra
{

namespace
{

void AddPlane(const CommandLine& app, const std::string& name, Cut::Kinds kind,
  std::vector<Cut>& cuts, const std::string& description)
{
  const auto store = [name, kind, &cuts](const std::string& text) {
    Cut cut;
    cut.Kind = kind;
    const std::vector<double> numbers = ParseNumbers(name, text, 6, 6, Coordinate);
    std::copy(numbers.begin(), numbers.end(), cut.Plane.begin());
    if (numbers[3] == 0.0 && numbers[4] == 0.0 && numbers[5] == 0.0)
    {
      throw InvalidValue(name, "'" + text + "' has the normal 0,0,0");
    }
    cuts.push_back(cut);
  };
  app.AddOrdered(name, store, description).TypeName("X,Y,Z,NX,NY,NZ");
}

void AddValues(const CommandLine& app, const std::string& name, Cut::Kinds kind,
  std::vector<Cut>& cuts, const std::string& unit, const std::string& description)
{
  const auto store = [name, kind, &cuts](const std::string& text) {
    Cut cut;
    cut.Kind = kind;
    const std::size_t colon = text.rfind(':');
    const bool isNamed = colon != text.npos;
    cut.Array = isNamed ? text.substr(0, colon) : std::string();
    const std::size_t count = kind == Cut::Kinds::Contour ? 1 : 2;
    const Range any{ -Infinity, Infinity, false, count > 1 };
    const std::vector<double> numbers =
      ParseNumbers(name, isNamed ? text.substr(colon + 1) : text, count, count, any);
    std::copy(numbers.begin(), numbers.end(), cut.Values.begin());
    if (count > 1 && numbers[0] > numbers[1])
    {
      throw InvalidValue(name, "'" + text + "' has a minimum above its maximum");
    }
    cuts.push_back(cut);
  };
  app.AddOrdered(name, store, description).TypeName(unit);
}

}

void DeclareCutOptions(const CommandLine& app, std::vector<Cut>& cuts)
{
  app.SetGroup("Cuts");
  AddPlane(app, "--slice", Cut::Kinds::Slice, cuts,
    "Show a cross-section: point and normal of its plane; repeatable, as all cuts, which are "
    "applied "
    "in order");
  AddPlane(
    app, "--clip", Cut::Kinds::Clip, cuts, "Keep the side of the plane to which its normal points");
  AddValues(app, "--contour", Cut::Kinds::Contour, cuts, "[ARRAY:]VALUE",
    "Show where an array has this value; default: the array of the colors, else the first one");
  AddValues(app, "--threshold", Cut::Kinds::Threshold, cuts, "[ARRAY:]A,B",
    "Keep cells whose values are from A to B; -inf and inf are allowed");
}

std::string DescribeCuts(const std::vector<Cut>& cuts)
{
  static const char* const names[] = { "slice", "clip", "contour", "threshold" };
  std::ostringstream text;
  text.precision(std::numeric_limits<double>::max_digits10);
  for (const Cut& cut : cuts)
  {
    text << names[static_cast<int>(cut.Kind)] << '=' << cut.Array;
    for (const double number : cut.Plane)
    {
      text << ' ' << number;
    }
    text << ' ' << cut.Values[0] << ' ' << cut.Values[1] << '\n';
  }
  return text.str();
}

}
