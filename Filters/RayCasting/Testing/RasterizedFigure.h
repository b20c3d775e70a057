// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Figures of vtkPenumbraVectorExporter, rasterized by the programs rsvg-convert (Debian package
// librsvg2-bin) and pdftocairo (poppler-utils).
#ifndef penumbra_RasterizedFigure_h
#define penumbra_RasterizedFigure_h

#include "vtkDataArray.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPNGReader.h"
#include "vtkPenumbraRayCaster.h"
#include "vtkPenumbraVectorExporter.h"
#include "vtkPointData.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <utility>

namespace penumbra_testing
{

/// A folder that is removed with its files.
class TemporaryFolder
{
public:
  TemporaryFolder()
  {
    std::string name = (std::filesystem::temp_directory_path() / "penumbra-figure-XXXXXX").string();
    this->Path = mkdtemp(name.data()) ? name : "";
    EXPECT_FALSE(this->Path.empty());
  }
  ~TemporaryFolder()
  {
    std::error_code ignored;
    std::filesystem::remove_all(this->Path, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  void operator=(const TemporaryFolder&) = delete;

  std::string File(const std::string& name) const { return (this->Path / name).string(); }

  std::filesystem::path Path;
};

inline std::string ReadText(const std::string& path)
{
  std::ifstream file(path, std::ios::binary);
  return { std::istreambuf_iterator<char>(file), {} };
}

/// Writes settings of Fontconfig that select only fonts of the Debian package fonts-liberation, if they are
/// installed, so that figures do not depend on other fonts of the machine. Returns the
/// setting for the environment of a command.
inline std::string SelectFonts(const std::filesystem::path& folder)
{
  const std::string fonts = "/usr/share/fonts/truetype/liberation";
  if (!std::filesystem::exists(fonts))
  {
    return std::string();
  }
  const std::string path = (folder / "fonts.conf").string();
  std::ofstream file(path);
  file << "<fontconfig><dir>" << fonts << "</dir><cachedir>" << (folder / "fonts").string()
       << "</cachedir>";
  for (const auto& [family, other] : { std::pair("Arial", "Sans"), std::pair("Helvetica", "Sans"),
         std::pair("Times", "Serif"), std::pair("Courier", "Mono") })
  {
    file << "<alias binding=\"same\"><family>" << family << "</family><prefer><family>Liberation "
         << other << "</family></prefer></alias>";
  }
  file << "</fontconfig>";
  return "FONTCONFIG_FILE=" + path + " ";
}

/// Runs a command and fails if it does.
inline void RunCommand(const std::string& command, const std::string& package)
{
  EXPECT_EQ(std::system(command.c_str()), 0)
    << command << " failed; it needs the Debian package " << package;
}

/// Writes a figure with `exporter` and rasterizes it with one pixel per pixel of the ray caster.
inline vtkSmartPointer<vtkImageData> Rasterize(
  vtkPenumbraVectorExporter* exporter, const TemporaryFolder& folder, const std::string& format)
{
  const std::string path = folder.File("figure." + format);
  exporter->SetFileName(path.c_str());
  EXPECT_TRUE(exporter->Write());
  const std::string width = std::to_string(exporter->GetRayCaster()->GetResolution()[0]);
  const std::string height = std::to_string(exporter->GetRayCaster()->GetResolution()[1]);
  const std::string name = folder.File("raster-" + format);
  if (format == "svg")
  {
    RunCommand(SelectFonts(folder.Path) + "rsvg-convert -w " + width + " -h " + height + " " +
        path + " -o " + name + ".png",
      "librsvg2-bin");
  }
  else
  {
    RunCommand(SelectFonts(folder.Path) + "pdftocairo -png -singlefile -transp -scale-to-x " +
        width + " -scale-to-y " + height + " " + path + " " + name,
      "poppler-utils");
  }
  vtkNew<vtkPNGReader> reader;
  reader->SetFileName((name + ".png").c_str());
  reader->Update();
  return reader->GetOutput();
}

/// Calls `add` with the difference of each color, multiplied by its opacity, between a figure with 8
/// bits per channel and the image of the ray caster, which is rendered with its lines and text.
template <typename Function>
void ForEachDifference(vtkImageData* figure, vtkPenumbraRayCaster* caster, Function&& add)
{
  caster->UpdateWholeExtent();
  vtkDataArray* expected = caster->GetOutput()->GetPointData()->GetArray("Color");
  vtkDataArray* actual = figure->GetPointData()->GetScalars();
  if (!expected || !actual || expected->GetNumberOfTuples() != actual->GetNumberOfTuples())
  {
    ADD_FAILURE() << "the figure has another size than the image";
    add(1.0);
    return;
  }
  const int channels = actual->GetNumberOfComponents();
  for (vtkIdType i = 0; i < expected->GetNumberOfTuples(); ++i)
  {
    const double alpha = channels == 4 ? actual->GetComponent(i, 3) / 255.0 : 1.0;
    for (int c = 0; c < 3; ++c)
    {
      const double color = std::clamp(expected->GetComponent(i, c), 0.0, 1.0);
      add(alpha * actual->GetComponent(i, c) / 255.0 - expected->GetComponent(i, 3) * color);
    }
  }
}

inline double ComputeError(vtkImageData* figure, vtkPenumbraRayCaster* caster)
{
  double sum = 0.0;
  double count = 0.0;
  ForEachDifference(figure, caster, [&](double difference) {
    sum += difference * difference;
    count += 1.0;
  });
  return std::sqrt(sum / count);
}

inline double ComputeLargestDifference(vtkImageData* figure, vtkPenumbraRayCaster* caster)
{
  double largest = 0.0;
  ForEachDifference(
    figure, caster, [&](double difference) { largest = std::max(largest, std::abs(difference)); });
  return largest;
}

}
#endif
