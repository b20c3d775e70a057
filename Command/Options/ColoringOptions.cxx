// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ColoringOptions.h"

#include "Colormaps.h"
#include "Parsing/Arguments.h"

#include <regex>

namespace penumbra
{

namespace
{

void DeclareScalarBar(const CommandLine& app, ScalarBarOptions& bar)
{
  app
    .AddParsed(
      "--scalar-bar-title", [&bar](const std::string& text) { bar.Title = text; },
      "Title of the scalar bar; default: the name of the array; empty: none")
    .TypeName("STRING");
  const auto storePosition = [&bar](const std::string& text) {
    bar.Position = ParseNumbers("--scalar-bar-position", text, 2, 2, { 0.0, 1.0 });
  };
  app
    .AddParsed("--scalar-bar-position", storePosition,
      "Lower left corner of the scalar bar with its title and labels, as fractions of the image")
    .TypeName("X,Y");
  const auto storeSize = [&bar](const std::string& text) {
    bar.Size = ParseNumbers("--scalar-bar-size", text, 2, 2, { 0.01, 1.0 });
  };
  app
    .AddParsed("--scalar-bar-size", storeSize,
      "Size of the scalar bar, as fractions of the image; horizontal if it is wider than high")
    .TypeName("W,H");
  AddInteger(app, "--scalar-bar-labels", bar.Labels, "Number of labels", 0, 64);
  const auto storeFormat = [&bar](const std::string& text) {
    // vtkScalarBarActor passes one number of type double.
    const std::regex one("([^%]|%%)*%[-+ 0#]*[0-9]{0,2}(\\.[0-9]{1,2})?[eEfFgG]([^%]|%%)*");
    if (text.size() > 100 || !std::regex_match(text, one))
    {
      throw InvalidValue("--scalar-bar-format",
        "'" + text + "' is not a format of one number, such as %.2f or %.3e");
    }
    bar.Format = text;
  };
  app
    .AddParsed("--scalar-bar-format", storeFormat,
      "Format of the labels as in printf, for example %.1f or \"%g mm\"")
    .TypeName("FORMAT")
    .Default(bar.Format);
}

}

void DeclareColoringOptions(const CommandLine& app, ColoringOptions& coloring)
{
  app.SetGroup("Coloring by data");
  app.AddFlag("-s,--scalar-coloring", coloring.Enabled, "Color by an array of the file");
  app.AddText("--coloring-array", coloring.Array, "NAME",
    "Name of the array; implies --scalar-coloring; default: the file's scalars, else its first "
    "array");
  AddInteger(app, "--coloring-component,--comp", coloring.Component,
    "Component of the array; -1: magnitude, -2: the values are colors", -2, 1000000);
  app.AddFlag("-y", coloring.ValuesAreColors, "The values are colors: --coloring-component -2");
  const auto storeRange = [&coloring](const std::string& text) {
    coloring.RangeOfAllSteps = text == "all";
    coloring.Range.clear();
    if (coloring.RangeOfAllSteps)
    {
      return;
    }
    coloring.Range = ParseNumbers("--coloring-range", text, 2, 2, {}, "`all`");
    if (coloring.Range[0] > coloring.Range[1])
    {
      throw InvalidValue("--coloring-range", "'" + text + "' has a minimum above its maximum");
    }
  };
  app
    .AddParsed("--coloring-range,--range", storeRange,
      "Values mapped to the first and the last color; all: the data range over all time steps; "
      "default: the data range")
    .TypeName("A,B|all");
  app.AddFlag("-c,--coloring-by-cells,--cells", coloring.ByCells,
    "Use a cell array instead of a point array");
  const auto storeColormap = [&coloring](const std::string& text) {
    coloring.Colormap = FindColormap(text);
    coloring.HasColormap = true;
  };
  app
    .AddParsed("--colormap,--colormap-file", storeColormap,
      "Colormap, or an image whose lowest row has its colors; without this option, colors that the "
      "file gives to its values are used")
    .TypeName(Join(ColormapNames(), "|") + "|FILE")
    .Default(coloring.Colormap);
  app.AddFlag("-b,--coloring-scalar-bar,--bar", coloring.ScalarBar, "Draw the scalar bar");
  DeclareScalarBar(app, coloring.Bar);
}

}
