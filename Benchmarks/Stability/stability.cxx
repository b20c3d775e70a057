// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Measures every row of the failure catalogue, including the variant with a mechanism disabled and
// VTK's method, and writes the document about it. Run it with `./penumbra benchmark stability`.
#include "Program.h"
#include "PublishedLimitations.h"
#include "Scenario.h"

#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPNGWriter.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <set>

namespace
{

using namespace penumbra;

struct Measured
{
  Scenario Row;
  std::vector<ScenarioResult>
    Outcomes;         ///< Penumbra, the mechanism disabled, and VTK if the row has a peer
  std::string Panels; ///< what the image shows
};

std::string Number(double value)
{
  char text[32];
  std::snprintf(text, sizeof text, value >= 1e6 ? "fails" : "%.2g", value);
  return text;
}

/// The value that the share `above` of the pixels exceeds.
double Exceeded(const Frame& frame, double above)
{
  std::vector<double> values = frame.Values;
  const auto rank =
    static_cast<std::ptrdiff_t>((1.0 - above) * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + rank, values.end());
  return values[rank];
}

/// Returns 1 for values that can be seen, else a power of ten that makes `largest` at most 1.
int Gain(double largest, double visible)
{
  int gain = 1;
  while (largest > 1e-8 && largest * gain < visible && largest * gain * 10 <= 1.0)
  {
    gain *= 10;
  }
  return gain;
}

struct Panels
{
  std::vector<Frame> Frames;
  std::string Text; ///< what the frames are
};

/// Returns the values times `gain`, clamped to [0, 1].
Frame Scale(const Frame& frame, int gain)
{
  Frame scaled = frame;
  for (double& value : scaled.Values)
  {
    value = std::clamp(value * gain, 0.0, 1.0);
  }
  return scaled;
}

/// The images of the outcomes. Dark ones are brighter; if the first two look alike, their difference is the last.
Panels MakePanels(const Measured& measured)
{
  double bright = 0.0;
  for (const ScenarioResult& outcome : measured.Outcomes)
  {
    bright = std::max(bright, Exceeded(outcome.Image, 0.01)); // a light may be brighter
  }
  const int gain = Gain(bright, 0.25);
  Panels panels;
  for (const ScenarioResult& outcome : measured.Outcomes)
  {
    panels.Frames.push_back(Scale(outcome.Image, gain));
  }
  panels.Text = std::string("Penumbra; mechanism disabled") +
    (measured.Row.Peer.empty() ? "" : "; VTK") +
    (gain > 1 ? " (values times " + std::to_string(gain) + ")" : "");
  const Frame& one = panels.Frames[0];
  const Frame& two = panels.Frames[1];
  if (one.Width != two.Width || one.Height != two.Height)
  {
    return panels;
  }
  Frame difference = one;
  for (std::size_t i = 0; i < one.Values.size(); ++i)
  {
    difference.Values[i] = std::abs(one.Values[i] - two.Values[i]);
  }
  const double largest = Exceeded(difference, 0.0);
  const int contrast = Gain(largest, 0.1);
  if (contrast > 1)
  {
    panels.Frames.push_back(Scale(difference, contrast));
    panels.Text += "; difference of the first two, times " + std::to_string(contrast);
  }
  else if (largest == 0.0)
  {
    panels.Text += "; the first two are equal in this frame";
  }
  return panels;
}

/// Concatenates images, whose values are in [0, 1], horizontally with a gray gap between them. Every pixel becomes a
/// square of as many pixels as make the images at least `readable` high, so that a reader can tell them apart.
void WriteImage(const std::string& path, const std::vector<Frame>& frames)
{
  constexpr int gap = 8;
  constexpr int readable = 192;
  int height = 1;
  for (const Frame& frame : frames)
  {
    height = std::max(height, frame.Height);
  }
  const int zoom = (readable + height - 1) / height;
  int width = -gap;
  for (const Frame& frame : frames)
  {
    width += zoom * frame.Width + gap;
  }
  vtkNew<vtkImageData> image;
  image->SetDimensions(width, zoom * height, 1);
  image->AllocateScalars(VTK_UNSIGNED_CHAR, 1);
  auto* bytes = static_cast<unsigned char*>(image->GetScalarPointer());
  std::fill(bytes, bytes + static_cast<std::size_t>(width) * zoom * height, 160);
  int left = 0;
  for (const Frame& frame : frames)
  {
    for (int y = 0; y < zoom * frame.Height; ++y)
    {
      for (int x = 0; x < zoom * frame.Width; ++x)
      {
        const double value = frame.Values[y / zoom * frame.Width + x / zoom];
        bytes[y * width + left + x] = static_cast<unsigned char>(255.0 * value + .5);
      }
    }
    left += zoom * frame.Width + gap;
  }
  vtkNew<vtkPNGWriter> writer;
  writer->SetFileName(path.c_str());
  writer->SetInputData(image);
  writer->Write();
}

std::vector<Measured> MeasureAll(const std::string& images)
{
  std::vector<Measured> rows;
  for (const Scenario& row : Catalogue())
  {
    Measured measured{ row, {}, {} };
    for (const Variant variant : { Variant::Ours, Variant::Ablated, Variant::Peer })
    {
      if (variant != Variant::Peer || !row.Peer.empty())
      {
        measured.Outcomes.push_back(row.Measure(variant));
      }
    }
    const Panels panels = MakePanels(measured);
    measured.Panels = panels.Text;
    WriteImage(images + "/" + row.Name + ".png", panels.Frames);
    std::printf("%-26s %-18s bound %-8s Penumbra %-8s disabled %-8s %s%s\n", row.Name.c_str(),
      TextOf(row.Measured).Name.c_str(), Number(row.Bound).c_str(),
      Number(measured.Outcomes[0].Value).c_str(), Number(measured.Outcomes[1].Value).c_str(),
      row.Peer.empty() ? "" : ("VTK " + Number(measured.Outcomes[2].Value)).c_str(),
      row.IsKnownFailure ? " KNOWN FAILURE" : "");
    std::fflush(stdout);
    rows.push_back(measured);
  }
  return rows;
}

/// Returns the anchor of a heading, which is in lower case.
std::string LowerCase(std::string name)
{
  std::transform(name.begin(), name.end(), name.begin(),
    [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
  return name;
}

void WriteMetrics(std::ostream& out, const std::vector<Measured>& rows)
{
  out << "## Metrics\n\n| metric | is |\n|---|---|\n";
  std::set<Metric> seen;
  for (const Measured& row : rows)
  {
    if (seen.insert(row.Row.Measured).second)
    {
      const MetricText text = TextOf(row.Row.Measured);
      out << "| " << text.Name << " | " << text.Definition << " |\n";
    }
  }
}

void WriteOpenRows(std::ostream& out, const std::vector<Measured>& rows)
{
  const auto isOpen = [](const Measured& row) { return row.Row.IsKnownFailure; };
  out << "\n## Open\n\n";
  if (std::none_of(rows.begin(), rows.end(), isOpen))
  {
    out << "No row is above its bound.\n";
  }
  for (const Measured& row : rows)
  {
    if (isOpen(row))
    {
      out << "- **" << row.Row.Name << "** (" << row.Row.Scene << "; " << row.Row.Motion
          << "): " << TextOf(row.Row.Measured).Name << " " << Number(row.Outcomes[0].Value)
          << ", bound " << Number(row.Row.Bound) << ".\n";
    }
  }
}

void WriteWeaknesses(std::ostream& out)
{
  out
    << "\n## Published weaknesses\n\nWeaknesses that the papers state or contain, the remedy here, "
       "and the rows that test it.\n\n| paper, weakness | here | rows |\n|---|---|---|\n";
  for (const PublishedLimitation& weakness : PublishedWeaknesses())
  {
    out << "| " << weakness.Source << " | " << weakness.Remedy << " |";
    for (const Scenario& row : Catalogue())
    {
      if (row.Source == weakness.Source)
      {
        out << " [" << row.Name << "](#" << LowerCase(row.Name) << ")";
      }
    }
    out << " |\n";
  }
}

void WriteRow(std::ostream& out, const Measured& measured)
{
  const Scenario& row = measured.Row;
  const auto& outcomes = measured.Outcomes;
  out << "\n### " << row.Name << "\n\n"
      << (row.IsKnownFailure ? "Open. " : "") << row.Scene << "; " << row.Motion << "."
      << (row.Source.empty() ? "" : " Published weakness: " + row.Source + ".") << "\n\n!["
      << measured.Panels << "](Images/Stability/" << row.Name << ".png)\n\n*" << measured.Panels
      << ".*\n\n| metric | bound | Penumbra | disabled"
      << (row.Peer.empty() ? " |\n" : " | VTK |\n")
      << (row.Peer.empty() ? "|---|---|---|---|\n" : "|---|---|---|---|---|\n") << "| "
      << TextOf(row.Measured).Name << " | " << Number(row.Bound) << " | "
      << Number(outcomes[0].Value) << " | " << Number(outcomes[1].Value) << "<br>"
      << row.AblatedMechanism << " |";
  if (!row.Peer.empty())
  {
    out << " " << Number(outcomes[2].Value) << "<br>" << row.Peer << " |";
  }
  out << "\n";
}

void WriteRows(std::ostream& out, const std::vector<Measured>& rows)
{
  out << "\n## Rows\n\nImages: from left to right, Penumbra, the same with the mechanism disabled, "
         "and VTK if it has a comparable method; pixels are enlarged.\nOf a sequence, they are one "
         "frame. Where they look alike, their difference is the last image.\n";
  for (const Measured& measured : rows)
  {
    WriteRow(out, measured);
  }
}

void WriteDocument(const std::string& path, const std::vector<Measured>& rows)
{
  std::ofstream out(path);
  out
    << "# Where methods fail\n\n"
       "Each row is a situation in which rendering methods of this kind are known to fail, with a\n"
       "metric, a bound that Penumbra keeps, and the value with one mechanism disabled, which "
       "must\n"
       "exceed the bound. The column *disabled* says what is disabled, and what is used instead.\n"
       "`Testing/Stability/` holds the table and runs it as tests; `./penumbra benchmark "
       "stability`\n"
       "writes this page.\n\n"
    << "- " << rows.size() << " rows\n- " << RunLine() << "\n- " << VersionLine() << "\n\n";
  WriteMetrics(out, rows);
  WriteOpenRows(out, rows);
  WriteWeaknesses(out);
  WriteRows(out, rows);
}

}

int main(int argc, char** argv)
{
  if (argc != 2)
  {
    std::fprintf(stderr, "usage: penumbra-benchmark-stability DOCUMENTATION\n");
    return 2;
  }
  const std::string folder = argv[1];
  std::filesystem::create_directories(folder + "/Images/Stability");
  WriteDocument(folder + "/Stability.md", MeasureAll(folder + "/Images/Stability"));
  return 0;
}
