// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ScalarBarOptions.h"

#include "Parsing/Arguments.h"

#include <regex>

namespace penumbra
{

void DeclareScalarBarOptions(const CommandLine& app, ScalarBarOptions& bar)
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
