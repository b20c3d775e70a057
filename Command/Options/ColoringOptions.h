// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Options of coloring by data and of the scalar bar.
#ifndef penumbra_ColoringOptions_h
#define penumbra_ColoringOptions_h

#include <optional>
#include <string>
#include <vector>

namespace penumbra
{

class CommandLine;

struct ScalarBarOptions
{
  std::optional<std::string> Title; ///< unset: the name of the array
  std::vector<double>
    Position; ///< of the lower left corner, fractions of the image; empty: at the right
  std::vector<double> Size; ///< fractions of the image; empty: by Position
  int Labels = 5;
  std::string Format = "%.4g";
};

struct ColoringOptions
{
  bool Enabled = false;
  std::string Array;            ///< empty: the file's scalars, else its first array
  int Component = -1;           ///< -1: the magnitude, -2: the values are colors
  std::vector<double> Range;    ///< empty: the data range
  bool RangeOfAllSteps = false; ///< of the data range: over all time steps
  bool ByCells = false;
  std::string Colormap = "viridis"; ///< name, or path of an image
  bool HasColormap = false;         ///< --colormap is on the command line
  bool ScalarBar = false;
  ScalarBarOptions Bar;
  bool ValuesAreColors = false; ///< -y: Component is -2
};

/// Declares the options on `app`; parsing fills `coloring`, which must outlive `app`.
void DeclareColoringOptions(const CommandLine& app, ColoringOptions& coloring);

}
#endif
