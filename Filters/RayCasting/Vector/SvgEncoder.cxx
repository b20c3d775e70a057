// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "SvgEncoder.h"

#include "FigureText.h"

#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPNGWriter.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <stdexcept>

namespace penumbra
{
namespace
{

std::string EncodeBase64(const unsigned char* bytes, std::size_t count)
{
  static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((count + 2) / 3 * 4);
  for (std::size_t i = 0; i < count; i += 3)
  {
    const std::size_t available = std::min<std::size_t>(3, count - i);
    unsigned int group = 0;
    for (std::size_t j = 0; j < 3; ++j)
    {
      group = group << 8 | (j < available ? bytes[i + j] : 0u);
    }
    for (std::size_t j = 0; j < 4; ++j)
    {
      text += j <= available ? digits[group >> (18 - 6 * j) & 63u] : '=';
    }
  }
  return text;
}

std::string EncodePng(const VectorFigure& figure)
{
  const bool opaque =
    std::all_of(figure.Image.begin(), figure.Image.end(), [](glm::u8vec4 c) { return c.a == 255; });
  const int channels = opaque ? 3 : 4;
  vtkNew<vtkImageData> image;
  image->SetDimensions(figure.Width, figure.Height, 1);
  image->AllocateScalars(VTK_UNSIGNED_CHAR, channels);
  for (int y = 0; y < figure.Height; ++y)
  {
    const glm::u8vec4* row =
      figure.Image.data() + static_cast<std::size_t>(figure.Height - 1 - y) * figure.Width;
    auto* bytes = static_cast<unsigned char*>(image->GetScalarPointer(0, y, 0));
    for (int x = 0; x < figure.Width; ++x)
    {
      for (int c = 0; c < channels; ++c)
      {
        *bytes++ = row[x][c];
      }
    }
  }
  vtkNew<vtkPNGWriter> writer;
  writer->SetInputData(image);
  writer->WriteToMemoryOn();
  writer->Write();
  vtkUnsignedCharArray* result = writer->GetResult();
  if (!result || result->GetNumberOfValues() == 0)
  {
    throw std::runtime_error("The image of the figure cannot be encoded as PNG.");
  }
  return EncodeBase64(result->GetPointer(0), static_cast<std::size_t>(result->GetNumberOfValues()));
}

std::string ToColor(glm::vec4 color)
{
  static const char digits[] = "0123456789abcdef";
  std::string text = "#";
  bool isShort = true;
  for (int c = 0; c < 3; ++c)
  {
    const int byte = ToByte(color[c]);
    text += digits[byte >> 4];
    text += digits[byte & 15];
    isShort = isShort && byte >> 4 == (byte & 15);
  }
  return isShort ? std::string{ '#', text[1], text[3], text[5] } : text;
}

/// Appends the commands of a path with relative coordinates.
void AppendCommands(const FigurePath& path, std::string& svg)
{
  glm::i64vec2 last(0);
  for (std::size_t i = 0; i < path.Points.size(); ++i)
  {
    const glm::i64vec2 point = ToUnits(path.Points[i]);
    const glm::i64vec2 step = point - last;
    svg += i == 0 ? "M" : i == 1 ? "l" : step.x < 0 ? "" : " ";
    svg += std::to_string(step.x) + (step.y < 0 ? "" : " ") + std::to_string(step.y);
    last = point;
  }
  svg += path.Width > 0.0 ? "" : "z";
  for (const auto& [low, size] : path.Squares)
  {
    const glm::i64vec2 corner = ToUnits(low);
    const glm::i64vec2 sides = ToUnits(size);
    svg += "M" + std::to_string(corner.x) + " " + std::to_string(corner.y) + "h" +
      std::to_string(sides.x) + "v" + std::to_string(sides.y) + "h" + std::to_string(-sides.x) +
      "z";
  }
}

/// Appends paths; those with the same style that follow each other are one element.
void AppendPaths(const std::vector<FigurePath>& paths, const std::string& prefix, std::string& svg)
{
  for (std::size_t i = 0; i < paths.size();)
  {
    const FigurePath& path = paths[i];
    if (path.HasGradient)
    {
      const std::string id = prefix + std::to_string(i);
      const glm::i64vec2 from = ToUnits(path.From);
      const glm::i64vec2 to = ToUnits(path.To);
      svg += "<linearGradient id=\"" + id + "\" gradientUnits=\"userSpaceOnUse\" x1=\"" +
        std::to_string(from.x) + "\" y1=\"" + std::to_string(from.y) + "\" x2=\"" +
        std::to_string(to.x) + "\" y2=\"" + std::to_string(to.y) + "\"><stop stop-color=\"" +
        ToColor(path.Color) + "\"/><stop offset=\"1\" stop-color=\"" + ToColor(path.EndColor) +
        "\"/></linearGradient>\n<path fill=\"url(#" + id + ")\" d=\"";
      AppendCommands(path, svg);
      ++i;
    }
    else
    {
      const std::string paint = path.Width > 0.0 ? "stroke" : "fill";
      svg += "<path " + paint + "=\"" + ToColor(path.Color) + "\"";
      if (path.Color.a < 1.f)
      {
        svg += " " + paint + "-opacity=\"" + ToText(path.Color.a) + "\"";
      }
      if (path.Width > 0.0)
      {
        svg += " fill=\"none\" stroke-width=\"" + ToText(path.Width * UnitsPerPixel) + "\"";
        svg += path.RoundCaps ? " stroke-linecap=\"round\" stroke-linejoin=\"round\"" : "";
      }
      svg += " d=\"";
      // Translucent paths in one element would not be drawn over each other.
      const bool single = path.Color.a < 1.f;
      do
      {
        AppendCommands(paths[i++], svg);
      }
      while (!single && i < paths.size() && paths[i].HasStyleOf(path));
    }
    svg += "\"/>\n";
  }
}

std::string Escape(const std::string& text)
{
  std::string escaped;
  for (const char c : text)
  {
    // XML has no other control characters than tabs.
    escaped += c == '&' ? "&amp;"
      : c == '<'        ? "&lt;"
      : c == '>'        ? "&gt;"
      : c == '"'        ? "&quot;"
                        : std::string(1, static_cast<unsigned char>(c) < 32 && c != '\t' ? ' ' : c);
  }
  return escaped;
}

std::string FindFonts(const std::string& family)
{
  return family == "Arial" ? "Arial, Helvetica, Liberation Sans, sans-serif"
    : family == "Courier"  ? "Courier New, Courier, Liberation Mono, monospace"
    : family == "Times"    ? "Times New Roman, Times, Liberation Serif, serif"
                           : family + ", sans-serif";
}

void AppendText(const OverlayShape& text, int height, std::string& svg)
{
  const std::string x = ToText(text.Baseline.x);
  const std::string y = ToText(height - text.Baseline.y);
  svg += "<text x=\"" + x + "\" y=\"" + y + "\" xml:space=\"preserve\" font-family=\"" +
    Escape(FindFonts(text.FontFamily)) + "\" font-size=\"" + ToText(text.FontSize) + "\" fill=\"" +
    ToColor(text.Color) + "\"";
  svg += text.Bold ? " font-weight=\"bold\"" : "";
  svg += text.Italic ? " font-style=\"italic\"" : "";
  if (text.Color.a < 1.f)
  {
    svg += " fill-opacity=\"" + ToText(text.Color.a) + "\"";
  }
  if (text.Angle != 0.0)
  {
    svg += " transform=\"rotate(" + ToText(-text.Angle) + " " + x + " " + y + ")\"";
  }
  svg += ">" + Escape(text.Text) + "</text>\n";
}

}

std::string EncodeSvg(const VectorFigure& figure)
{
  const std::string width = std::to_string(figure.Width);
  const std::string height = std::to_string(figure.Height);
  std::string svg = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
                    "<svg xmlns=\"http://www.w3.org/2000/svg\" "
                    "xmlns:xlink=\"http://www.w3.org/1999/xlink\" version=\"1.1\" width=\"" +
    ToText(figure.Width * figure.PointsPerPixel) + "pt\" height=\"" +
    ToText(figure.Height * figure.PointsPerPixel) + "pt\" viewBox=\"0 0 " + width + " " + height +
    "\">\n";
  // Paths have integer coordinates and y upward.
  const std::string begin = "<g transform=\"matrix(" + ToText(1.0 / UnitsPerPixel) + " 0 0 -" +
    ToText(1.0 / UnitsPerPixel) + " 0 " + height + ")\">\n";
  if (!figure.Faces.empty())
  {
    svg += begin;
    AppendPaths(figure.Faces, "f", svg);
    svg += "</g>\n";
  }
  if (!figure.Image.empty())
  {
    svg += "<image width=\"" + width + "\" height=\"" + height +
      "\" preserveAspectRatio=\"none\" xlink:href=\"data:image/png;base64," + EncodePng(figure) +
      "\"/>\n";
  }
  if (!figure.Lines.empty())
  {
    svg += begin;
    AppendPaths(figure.Lines, "l", svg);
    svg += "</g>\n";
  }
  for (const OverlayShape& shape : figure.Shapes)
  {
    if (shape.Text.empty())
    {
      FigurePath path;
      path.Points = shape.Corners;
      path.Color = shape.Color;
      svg += begin;
      AppendPaths({ path }, "s", svg);
      svg += "</g>\n";
    }
    else
    {
      AppendText(shape, figure.Height, svg);
    }
  }
  return svg + "</svg>\n";
}

}
