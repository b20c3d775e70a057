// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "PdfEncoder.h"

#include "FigureText.h"
#include "TextOutlines.h"

#include "vtkNew.h"
#include "vtkZLibDataCompressor.h"

#include <cstdint>
#include <cstdio>
#include <map>
#include <stdexcept>

namespace penumbra
{
namespace
{

/// Characters of code page 1252 from 128 to 159; 0: none.
constexpr std::uint32_t Windows1252[32] = { 0x20ac, 0, 0x201a, 0x192, 0x201e, 0x2026, 0x2020,
  0x2021, 0x2c6, 0x2030, 0x160, 0x2039, 0x152, 0, 0x17d, 0, 0, 0x2018, 0x2019, 0x201c, 0x201d,
  0x2022, 0x2013, 0x2014, 0x2dc, 0x2122, 0x161, 0x203a, 0x153, 0, 0x17e, 0x178 };

constexpr char Digits[] = "0123456789abcdef";

/// Returns the code of a character in code page 1252; 0 if there is none.
std::uint32_t ToWindows1252(std::uint32_t character)
{
  if (character < 32)
  {
    return ' ';
  }
  if (character < 0x7f || (character >= 0xa0 && character <= 0xff))
  {
    return character;
  }
  for (std::uint32_t i = 0; i < 32; ++i)
  {
    if (Windows1252[i] == character)
    {
      return 128 + i;
    }
  }
  return 0;
}

/// Returns true if the standard fonts can show a text.
bool HasStandardFont(const OverlayShape& text)
{
  for (std::size_t i = 0; i < text.Text.size();)
  {
    if (ToWindows1252(TakeCharacter(text.Text, i)) == 0)
    {
      return false;
    }
  }
  return text.FontFile.empty();
}

/// Returns UTF-8 text as a hexadecimal string of code page 1252, with question marks for others.
std::string EncodeText(const std::string& text)
{
  std::string hexadecimal = "<";
  for (std::size_t i = 0; i < text.size();)
  {
    const std::uint32_t found = ToWindows1252(TakeCharacter(text, i));
    const std::uint32_t byte = found == 0 ? '?' : found;
    hexadecimal += Digits[byte >> 4];
    hexadecimal += Digits[byte & 15];
  }
  return hexadecimal + ">";
}

/// Returns UTF-8 text as a hexadecimal string of UTF-16.
std::string EncodeUtf16(const std::string& text)
{
  std::string hexadecimal = "<feff";
  const auto add = [&](std::uint32_t unit) {
    for (int shift = 12; shift >= 0; shift -= 4)
    {
      hexadecimal += Digits[unit >> shift & 15u];
    }
  };
  for (std::size_t i = 0; i < text.size();)
  {
    const std::uint32_t character = TakeCharacter(text, i);
    if (character < 0x10000)
    {
      add(character);
      continue;
    }
    add(0xd800 + ((character - 0x10000) >> 10));
    add(0xdc00 + ((character - 0x10000) & 0x3ffu));
  }
  return hexadecimal + ">";
}

std::string FindFont(const OverlayShape& text)
{
  const bool times = text.FontFamily == "Times";
  const std::string slant = times ? "Italic" : "Oblique";
  std::string style = text.Bold ? "Bold" : "";
  style += text.Italic ? slant : "";
  style = style.empty() && times ? "Roman" : style;
  const std::string name = times ? "Times" : text.FontFamily == "Courier" ? "Courier" : "Helvetica";
  return style.empty() ? name : name + "-" + style;
}

std::string ToColor(glm::vec4 color)
{
  std::string text;
  for (int c = 0; c < 3; ++c)
  {
    text += ToText(ToByte(color[c]) / 255.0) + " ";
  }
  return text;
}

std::string ToPair(glm::i64vec2 x)
{
  return std::to_string(x.x) + " " + std::to_string(x.y) + " ";
}

/// Objects of a PDF file.
class PdfFile
{
public:
  /// Reserves the number of an object that Set() defines later.
  int Reserve()
  {
    this->Objects.emplace_back();
    return static_cast<int>(this->Objects.size());
  }
  void Set(int number, const std::string& object) { this->Objects[number - 1] = object; }
  int Add(const std::string& object)
  {
    this->Objects.push_back(object);
    return static_cast<int>(this->Objects.size());
  }

  /// Adds a compressed stream. `entries` are added to its dictionary.
  int AddStream(const std::string& entries, const unsigned char* bytes, std::size_t count)
  {
    vtkNew<vtkZLibDataCompressor> compressor;
    compressor->SetCompressionLevel(6);
    std::string packed(compressor->GetMaximumCompressionSpace(count), '\0');
    packed.resize(compressor->Compress(
      bytes, count, reinterpret_cast<unsigned char*>(&packed[0]), packed.size()));
    if (packed.empty())
    {
      throw std::runtime_error("A stream of the PDF file cannot be compressed.");
    }
    return this->Add("<< " + entries + "/Filter /FlateDecode /Length " +
      std::to_string(packed.size()) + " >>\nstream\n" + packed + "\nendstream");
  }

  /// Returns the file, whose catalog is the object `root`.
  std::string Finish(int root) const
  {
    std::string file = "%PDF-1.4\n%\xe2\xe3\xcf\xd3\n";
    std::string table;
    for (std::size_t i = 0; i < this->Objects.size(); ++i)
    {
      char entry[32];
      std::snprintf(entry, sizeof(entry), "%010zu 00000 n \n", file.size());
      table += entry;
      file += std::to_string(i + 1) + " 0 obj\n" + this->Objects[i] + "\nendobj\n";
    }
    const std::string count = std::to_string(this->Objects.size() + 1);
    const std::string start = std::to_string(file.size());
    return file + "xref\n0 " + count + "\n0000000000 65535 f \n" + table + "trailer\n<< /Size " +
      count + " /Root " + std::to_string(root) + " 0 R >>\nstartxref\n" + start + "\n%%EOF\n";
  }

private:
  std::vector<std::string> Objects;
};

/// The drawing commands of the page and the resources that they name.
class PageContents
{
public:
  std::string Commands;
  std::string Shadings;
  std::map<int, std::string> Opacities;     ///< by opacity in 1/255
  std::map<std::string, std::string> Fonts; ///< by the name of the font
  int OutlinedTexts = 0;

  void SetOpacity(float opacity)
  {
    const int byte = ToByte(opacity);
    if (byte != this->Opacity)
    {
      this->Opacity = byte;
      this->Opacities[byte] = "G" + std::to_string(byte);
      this->Commands += "/" + this->Opacities[byte] + " gs\n";
    }
  }

  /// @param next The path that follows, or null. It is painted with this one if both have the same style.
  void AddPath(const FigurePath& path, const FigurePath* next)
  {
    if (path.HasGradient)
    {
      this->AddGradient(path);
      return;
    }
    this->SetOpacity(path.Color.a);
    const bool stroke = path.Width > 0.0;
    if (!this->Last || !this->Last->HasStyleOf(path))
    {
      this->Commands += ToColor(path.Color) + (stroke ? "RG " : "rg ");
      this->Commands += stroke ? ToText(path.Width * UnitsPerPixel) + " w " : "";
      this->Commands += stroke ? (path.RoundCaps ? "1 J 1 j\n" : "0 J 0 j\n") : "\n";
    }
    this->Last = &path;
    this->AddCommands(path);
    // Translucent paths that are painted as one would not be drawn over each other.
    const bool continues = next && path.Color.a == 1.f && path.HasStyleOf(*next);
    this->Commands += continues ? "" : stroke ? "S\n" : "f\n";
  }

  void AddText(const OverlayShape& text)
  {
    this->SetOpacity(text.Color.a);
    this->Commands += ToColor(text.Color) + "rg ";
    const bool outlined = !HasStandardFont(text);
    if (outlined)
    {
      this->AddOutlines(text);
      // Invisible text in a standard font marks the place of the text that is read and selected.
      this->Commands += "/Span << /ActualText " + EncodeUtf16(text.Text) + " >> BDC ";
    }
    std::string& name = this->Fonts[FindFont(text)];
    name = name.empty() ? "F" + std::to_string(this->Fonts.size()) : name;
    this->Commands += "BT /" + name + " " + ToText(text.FontSize) + " Tf " +
      (outlined ? "3 Tr " : "") + ToMatrix(text) + "Tm " + EncodeText(text.Text) + " Tj " +
      (outlined ? "0 Tr ET EMC\n" : "ET\n");
    this->Last = nullptr;
  }

  void Begin(const std::string& matrix) { this->Commands += "q " + matrix + " cm\n"; }
  void End()
  {
    this->Commands += "Q\n";
    this->Last = nullptr;
    this->Opacity = -1;
  }

private:
  /// Returns the matrix of the base line.
  static std::string ToMatrix(const OverlayShape& text)
  {
    const double angle = glm::radians(text.Angle);
    const std::string c = ToText(std::cos(angle));
    const double s = std::sin(angle);
    return c + " " + ToText(s) + " " + ToText(-s) + " " + c + " " + ToText(text.Baseline.x) + " " +
      ToText(text.Baseline.y) + " ";
  }

  void AddOutlines(const OverlayShape& text)
  {
    this->Commands += "q " + ToMatrix(text) + "cm ";
    for (const OutlineCommand& command : MakeTextOutlines(text))
    {
      const bool curve = command.Kind == OutlineCommand::Cubic;
      for (int i = 0; i < (curve ? 3 : 1); ++i)
      {
        const glm::dvec2 point = text.FontSize * command.Points[i];
        this->Commands += ToText(point.x) + " " + ToText(point.y) + " ";
      }
      this->Commands += curve ? "c " : command.Kind == OutlineCommand::Line ? "l " : "m ";
    }
    this->Commands += "f Q\n";
    ++this->OutlinedTexts;
  }

  void AddCommands(const FigurePath& path)
  {
    for (std::size_t i = 0; i < path.Points.size(); ++i)
    {
      this->Commands += ToPair(ToUnits(path.Points[i])) + (i == 0 ? "m " : "l ");
    }
    this->Commands += path.Width > 0.0 ? "" : "h ";
    for (const auto& [low, size] : path.Squares)
    {
      this->Commands += ToPair(ToUnits(low)) + ToPair(ToUnits(size)) + "re ";
    }
  }

  void AddGradient(const FigurePath& path)
  {
    const std::string name = "S" + std::to_string(this->NumberOfShadings++);
    this->Shadings += "/" + name +
      " << /ShadingType 2 /ColorSpace /DeviceRGB /Extend [true true] " + "/Coords [" +
      ToPair(ToUnits(path.From)) + ToPair(ToUnits(path.To)) +
      "] /Function << /FunctionType 2 /Domain [0 1] /N 1 /C0 [" + ToColor(path.Color) + "] /C1 [" +
      ToColor(path.EndColor) + "] >> >>\n";
    this->Commands += "q ";
    this->AddCommands(path);
    this->Commands += "W n /" + name + " sh Q\n";
  }

  const FigurePath* Last = nullptr;
  int Opacity = -1; ///< in 1/255; negative: not set
  int NumberOfShadings = 0;
};

int AddImage(const VectorFigure& figure, PdfFile& file)
{
  std::vector<unsigned char> colors;
  std::vector<unsigned char> alphas;
  bool opaque = true;
  for (const glm::u8vec4& c : figure.Image)
  {
    colors.insert(colors.end(), { c.r, c.g, c.b });
    alphas.push_back(c.a);
    opaque = opaque && c.a == 255;
  }
  const std::string size = "/Type /XObject /Subtype /Image /BitsPerComponent 8 /Width " +
    std::to_string(figure.Width) + " /Height " + std::to_string(figure.Height);
  std::string mask;
  if (!opaque)
  {
    const int number =
      file.AddStream(size + " /ColorSpace /DeviceGray ", alphas.data(), alphas.size());
    mask = "/SMask " + std::to_string(number) + " 0 R ";
  }
  return file.AddStream(size + " /ColorSpace /DeviceRGB " + mask, colors.data(), colors.size());
}

void AddPaths(const std::vector<FigurePath>& paths, PageContents& page)
{
  const std::string unit = ToText(1.0 / UnitsPerPixel);
  page.Begin(unit + " 0 0 " + unit + " 0 0");
  for (std::size_t i = 0; i < paths.size(); ++i)
  {
    page.AddPath(paths[i], i + 1 < paths.size() ? &paths[i + 1] : nullptr);
  }
  page.End();
}

PageContents MakeContents(const VectorFigure& figure)
{
  PageContents page;
  const std::string scale = ToText(figure.PointsPerPixel);
  page.Begin(scale + " 0 0 " + scale + " 0 0");
  if (!figure.Faces.empty())
  {
    AddPaths(figure.Faces, page);
  }
  if (!figure.Image.empty())
  {
    page.Begin(std::to_string(figure.Width) + " 0 0 " + std::to_string(figure.Height) + " 0 0");
    page.Commands += "/Image Do\n";
    page.End();
  }
  if (!figure.Lines.empty())
  {
    AddPaths(figure.Lines, page);
  }
  for (const OverlayShape& shape : figure.Shapes)
  {
    if (!shape.Text.empty())
    {
      page.AddText(shape);
      continue;
    }
    FigurePath path;
    path.Points = shape.Corners;
    path.Color = shape.Color;
    AddPaths({ path }, page);
  }
  page.End();
  return page;
}

}

std::string EncodePdf(const VectorFigure& figure, int& outlinedTexts)
{
  PdfFile file;
  const int root = file.Reserve();
  const int pages = file.Reserve();
  const int leaf = file.Reserve();
  const PageContents page = MakeContents(figure);
  outlinedTexts = page.OutlinedTexts;
  std::string resources = "<< ";
  if (!figure.Image.empty())
  {
    resources += "/XObject << /Image " + std::to_string(AddImage(figure, file)) + " 0 R >> ";
  }
  resources += "/ExtGState << ";
  for (const auto& [byte, name] : page.Opacities)
  {
    const std::string opacity = ToText(byte / 255.0);
    resources += "/" + name + " << /SA false /ca " + opacity + " /CA " + opacity + " >> ";
  }
  resources += ">> /Font << ";
  for (const auto& [font, name] : page.Fonts)
  {
    resources += "/" + name + " << /Type /Font /Subtype /Type1 /Encoding /WinAnsiEncoding " +
      "/BaseFont /" + font + " >> ";
  }
  resources += ">> /Shading << " + page.Shadings + ">> >>";
  const int contents = file.AddStream(
    "", reinterpret_cast<const unsigned char*>(page.Commands.data()), page.Commands.size());
  const auto reference = [](int number) { return std::to_string(number) + " 0 R "; };
  file.Set(root, "<< /Type /Catalog /Pages " + reference(pages) + ">>");
  file.Set(pages, "<< /Type /Pages /Count 1 /Kids [" + reference(leaf) + "] >>");
  file.Set(leaf,
    "<< /Type /Page /Parent " + reference(pages) + "/MediaBox [0 0 " +
      ToText(figure.Width * figure.PointsPerPixel) + " " +
      ToText(figure.Height * figure.PointsPerPixel) + "] /Contents " + reference(contents) +
      "/Resources " + resources + " >>");
  return file.Finish(root);
}

}
