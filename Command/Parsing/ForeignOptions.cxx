// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ForeignOptions.h"

#include <algorithm>
#include <vector>

namespace penumbra
{

namespace
{

struct Row
{
  std::vector<std::string> Names; ///< at the end "*" stands for anything
  const char* Replacement;
};

const std::vector<Row>& Rows()
{
  static const std::vector<Row> rows = {
    { { "-o", "--point-sprites*" },
      "use --output for the image, and --representation points with --point-size or --point-radius "
      "for points" },
    { { "--input" }, "name the file without an option" },
    { { "--coloring-mode" }, "use --scalar-coloring, or --coloring-component -2 for colors" },
    { { "--coloring-field" }, "use --coloring-by-cells" },
    { { "--display-depth" }, "use --output FILE.vti, which has the array Depth" },
    { { "--reference*", "--ref", "--ref-threshold" }, "use `penumbra compare`" },
    { { "--list-readers", "--readers-list" }, "use `penumbra list`" },
    { { "--list-rendering-backends" }, "use `penumbra info`" },
    { { "--animation-index", "--animation-indices" },
      "the first animation of a file is rendered, see --time" },
    { { "--animation-autoplay", "--animation-speed-factor", "--frame-rate" },
      "use `penumbra animate`" },
    { { "--font-file" }, "set the environment variable PENUMBRA_FONT" },
    { { "--max-size" }, "use --read-limit" },
    { { "--loading-progress" }, "use --progress bar" },
    { { "--volume*", "-v", "-i" },
      "volumes are not rendered; use --contour, --slice or --threshold" },
    { { "--texture-*", "--textures-transform", "--roughness", "--metallic", "--base-ior",
        "--emissive-factor", "--normal-scale" },
      "materials are those of the file" },
    { { "--multi-file-regex", "--recursive-dir-add", "--force-reader", "--load-plugins" },
      "name all files; `penumbra list` prints the formats" },
    { { "-x", "--axis", "-g", "--grid*", "--axes-grid", "-m", "--metadata", "-z", "--fps", "-t",
        "--tone-mapping", "--final-shader", "--backface-type", "--normal-glyphs*",
        "--colormap-discretization", "--hdri-skybox", "--hdri-filename", "-u", "--blur-*",
        "--checkerboard", "--armature", "-k", "--interaction-style", "--trackball",
        "--scene-hierarchy", "--font-scale", "--font-color", "--verbose", "--define", "-D*",
        "--reset", "-R*", "--animation-progress", "--list-bindings", "--no-render", "--watch",
        "--position", "--screenshot-filename", "--dpi-aware", "--load-statefile",
        "--save-statefile", "--statefile-filename", "--interaction-test-*", "--command-script",
        "--backdrop-*", "--notifications", "--invert-zoom", "--plugins-path", "--scan-plugins",
        "--remove-empty-file-groups", "--x-color", "--y-color", "--z-color" },
      "this program has no such option" },
  };
  return rows;
}

bool Matches(const std::string& pattern, const std::string& name)
{
  const std::size_t size = pattern.size() - 1;
  return pattern.back() == '*' ? name.compare(0, size, pattern, 0, size) == 0 : name == pattern;
}

}

std::string FindReplacement(const std::string& option)
{
  for (const Row& row : Rows())
  {
    if (std::any_of(row.Names.begin(), row.Names.end(),
          [&](const std::string& pattern) { return Matches(pattern, option); }))
    {
      return row.Replacement;
    }
  }
  return {};
}

std::string FindShortOption(const std::string& cluster)
{
  for (std::size_t i = 1; i < cluster.size() && cluster[0] == '-' && cluster[1] != '-'; ++i)
  {
    const std::string option = std::string("-") + cluster[i];
    if (!FindReplacement(option).empty())
    {
      return option;
    }
  }
  return cluster;
}

}
