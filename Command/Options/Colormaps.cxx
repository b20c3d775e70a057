// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "Colormaps.h"

#include "Files/ImageFiles.h"
#include "Parsing/Arguments.h"
#include "Processes/CommandError.h"

#include "vtkColorTransferFunction.h"
#include "vtkImageData.h"
#include "vtkLookupTable.h"
#include "vtkNew.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>

namespace penumbra
{

namespace
{

// 33 equidistant colors with two hexadecimal digits per channel. viridis, plasma, inferno and
// magma by S. van der Walt and N. Smith (CC0), cividis by J. Nunez, C. Anderton and R. Renslow
// (PLOS ONE 13, 2018), turbo by A. Mikhailov (Apache 2.0).
struct SampledColormap
{
  const char* Name;
  const char* Colors;
};

const SampledColormap Sampled[] = {
  { "viridis",
    "440154470d6048186a482374472d7b4537814240863e49893b528b375b8d33638d2f6b8e"
    "2c728e297a8e26828e23898e21918c1f988b1fa08822a78528ae8032b67a3fbc734ec36b"
    "5ec96270cf5784d44b98d83eaddc30c2df23d8e219ece51bfde725" },
  { "plasma",
    "0d08872206903105973f049c4c02a15901a56600a77201a87e03a88a09a59511a1a01a9c"
    "aa2395b32c8ebc3587c43e7fcc4778d35171da5a6ae06363e66c5ceb7655f0804ef58b47"
    "f89540fba139fdac33feb82cfdc527fcd225f8df25f4ed27f0f921" },
  { "inferno",
    "0000040403120b0724150b37210c4a2f0a5b3d09654a0c6b57106e64156e71196e7d1e6d"
    "8a226a972766a32c61b0315bbc3754c73e4cd24644db503be45a31eb6628f1731df68013"
    "f98e09fb9d07fcac11fbbc21f9cb35f5db4cf2ea69f3f68afcffa4" },
  { "magma",
    "0000040303120a0822130d341d114729115a36106b440f7651127c5d177f6a1c81762181"
    "832681902a819c2e7faa337db73779c43c75d0416fdc4869e75263ef5d5ef56b5cf9795d"
    "fc8961fd9869fea772feb67cfec488fed395fde2a3fcf0b2fcfdbf" },
  { "cividis",
    "00224e00285b002e6a0533711a386f273e6e32436d3b496c434e6c4b546c535a6d5a5f6e"
    "61656f686a716f70737676767d7c788482798c8878938e789b9476a39a74aba072b4a76f"
    "bcae6cc4b468cdbb63d5c25edec958e7d150f0d846f9e03afee838" },
  { "turbo",
    "30123b392a734040a24456c7466be34680f64294ff37a8fa28bceb1ccdd818ddc21fe9af"
    "32f2984ef97d6dfe628bff4ba4fc3cb9f635cdec34dfdf37eecf3af8be39fdac34fe962b"
    "fb7e21f46617eb500edf3f08d02f05be2102a91601920b017a0403" },
};

constexpr int SampledColors = 33;

double Channel(const char* colors, int color, int channel)
{
  const char digits[3] = { colors[6 * color + 2 * channel], colors[6 * color + 2 * channel + 1],
    0 };
  return std::strtol(digits, nullptr, 16) / 255.0;
}

// Fills `function` with the named colormap; returns false if the name is unknown.
bool FillFunction(vtkColorTransferFunction* function, const std::string& name)
{
  for (const SampledColormap& map : Sampled)
  {
    if (name == map.Name)
    {
      for (int i = 0; i < SampledColors; ++i)
      {
        function->AddRGBPoint(static_cast<double>(i) / (SampledColors - 1),
          Channel(map.Colors, i, 0), Channel(map.Colors, i, 1), Channel(map.Colors, i, 2));
      }
      return true;
    }
  }
  if (name == "coolwarm")
  {
    // K. Moreland, Diverging Color Maps for Scientific Visualization (ISVC 2009).
    function->SetColorSpaceToDiverging();
    function->AddRGBPoint(0.0, 0.230, 0.299, 0.754);
    function->AddRGBPoint(1.0, 0.706, 0.016, 0.150);
    return true;
  }
  if (name == "gray")
  {
    function->AddRGBPoint(0.0, 0.0, 0.0, 0.0);
    function->AddRGBPoint(1.0, 1.0, 1.0, 1.0);
    return true;
  }
  if (name == "rainbow")
  {
    function->SetColorSpaceToHSV();
    function->HSVWrapOff();
    function->AddHSVPoint(0.0, 2.0 / 3.0, 1.0, 1.0);
    function->AddHSVPoint(1.0, 0.0, 1.0, 1.0);
    return true;
  }
  return false;
}

/// Fills `function` with the colors of the lowest row of an image.
void FillFromImage(vtkColorTransferFunction* function, const std::string& path)
{
  const vtkSmartPointer<vtkImageData> image = ReadImage(path);
  const int width = image->GetDimensions()[0];
  const int channels = image->GetNumberOfScalarComponents();
  const double scale = image->GetScalarType() == VTK_UNSIGNED_CHAR ? 255.0
    : image->GetScalarType() == VTK_UNSIGNED_SHORT                 ? 65535.0
                                                                   : 1.0;
  if (channels < 3)
  {
    throw CommandError(BadInput, "--colormap " + path + ": the image has no colors");
  }
  for (int x = 0; x < width; ++x)
  {
    double color[3];
    for (int c = 0; c < 3; ++c)
    {
      color[c] = image->GetScalarComponentAsDouble(x, 0, 0, c) / scale;
    }
    function->AddRGBPoint(x / std::max(width - 1.0, 1.0), color[0], color[1], color[2]);
  }
}

}

std::vector<std::string> ColormapNames()
{
  std::vector<std::string> names;
  for (const SampledColormap& map : Sampled)
  {
    names.emplace_back(map.Name);
  }
  names.insert(names.end(), { "coolwarm", "gray", "rainbow" });
  return names;
}

std::string FindColormap(const std::string& text)
{
  const std::vector<std::string> names = ColormapNames();
  const std::filesystem::path path(text);
  std::error_code ignored;
  if (std::filesystem::is_regular_file(path, ignored))
  {
    return text;
  }
  const std::string stem = path.has_parent_path() ? text : path.stem().string();
  if (!std::count(names.begin(), names.end(), stem))
  {
    throw InvalidValue(
      "--colormap", "'" + text + "' is not an image or one of " + Join(names, ", "));
  }
  return stem;
}

vtkSmartPointer<vtkLookupTable> MakeColormap(const std::string& name)
{
  vtkNew<vtkColorTransferFunction> function;
  if (!FillFunction(function, name))
  {
    FillFromImage(function, name);
  }
  auto table = vtkSmartPointer<vtkLookupTable>::New();
  const int colors = 256;
  table->SetNumberOfTableValues(colors);
  for (int i = 0; i < colors; ++i)
  {
    double color[3];
    function->GetColor(static_cast<double>(i) / (colors - 1), color);
    table->SetTableValue(i, color[0], color[1], color[2], 1.0);
  }
  table->SetNanColor(0.5, 0.5, 0.5, 1.0);
  return table;
}

}
