// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Pixels of .tif files that the tests write byte by byte, or that vtkTIFFWriter compresses.
#include "Files/ImageFiles.h"
#include "Processes/CommandError.h"
#include "Program.h"

#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkTIFFWriter.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <cstring>
#include <map>

using namespace penumbra_testing;

namespace
{

constexpr int Width = 7;
constexpr int Height = 5;

struct Kind
{
  int Bits = 8;
  int Channels = 1;
  bool IsFloat = false;
  int Photometric = 1; // gray
  bool IsPlanar = false;
  bool IsTiled = false;
  bool IsBigEndian = false;
  int Compression = 1;       // none
  bool IsAssociated = false; ///< colors are multiplied by alpha
};

// Value of a channel at a row from the top and a column from the left of the upright image.
double ValueAt(const Kind& kind, int row, int column, int channel)
{
  const int value = 1 + 40 * row + 5 * column + channel; // at most 194
  return kind.IsFloat ? value / 4.0 : kind.Bits == 16 ? 300.0 * value : value;
}

// Row and column of the upright image at the file's row and column [TIFF 6.0, Orientation].
void Place(int orientation, int row, int column, int& y, int& x)
{
  const bool isTransposed = orientation > 4;
  const int lastRow = (isTransposed ? Width : Height) - 1; // of the file
  const int lastColumn = (isTransposed ? Height : Width) - 1;
  const int places[8][2] = { { row, column }, { row, lastColumn - column },
    { lastRow - row, lastColumn - column }, { lastRow - row, column }, { column, row },
    { column, lastRow - row }, { lastColumn - column, lastRow - row },
    { lastColumn - column, row } };
  y = places[orientation - 1][0];
  x = places[orientation - 1][1];
}

void Append(std::string& bytes, const Kind& kind, unsigned int value, int size)
{
  for (int i = 0; i < size; ++i)
  {
    const int shift = 8 * (kind.IsBigEndian ? size - 1 - i : i);
    bytes += static_cast<char>(value >> shift & 255u);
  }
}

// Writes the image in strips of two rows, or tiles of 16 x 16 pixels.
void WriteTiff(const std::string& path, const Kind& kind, int orientation)
{
  const int columns = orientation > 4 ? Height : Width;
  const int rows = orientation > 4 ? Width : Height;
  const int blockColumns = kind.IsTiled ? 16 : columns;
  const int blockRows = kind.IsTiled ? 16 : 2;
  std::string bytes = kind.IsBigEndian ? "MM" : "II";
  Append(bytes, kind, 42, 2);
  Append(bytes, kind, 0, 4);
  std::vector<unsigned int> starts;
  std::vector<unsigned int> sizes;
  for (int plane = 0; plane < (kind.IsPlanar ? kind.Channels : 1); ++plane)
  {
    for (int first = 0; first < rows; first += blockRows)
    {
      starts.push_back(static_cast<unsigned int>(bytes.size()));
      for (int row = first; row < first + blockRows && (kind.IsTiled || row < rows); ++row)
      {
        for (int i = 0; i < blockColumns * (kind.IsPlanar ? 1 : kind.Channels); ++i)
        {
          const int column = kind.IsPlanar ? i : i / kind.Channels;
          int y = 0;
          int x = 0;
          Place(orientation, row, column, y, x);
          const bool isInside = row < rows && column < columns;
          const double value =
            isInside ? ValueAt(kind, y, x, kind.IsPlanar ? plane : i % kind.Channels) : 0.0;
          auto bits = static_cast<unsigned int>(value);
          if (kind.IsFloat)
          {
            const auto number = static_cast<float>(value);
            std::memcpy(&bits, &number, 4);
          }
          Append(bytes, kind, bits, kind.Bits / 8);
        }
      }
      sizes.push_back(static_cast<unsigned int>(bytes.size()) - starts.back());
    }
  }
  std::string arrays; // behind the directory
  std::string directory;
  int entries = 0;
  const unsigned int count = kind.IsTiled ? 15 : 14;
  const auto behind = static_cast<unsigned int>(bytes.size()) + 2 + 12 * count + 4;
  const auto add = [&](unsigned int tag, const std::vector<unsigned int>& values) {
    Append(directory, kind, tag, 2);
    Append(directory, kind, 4, 2);
    Append(directory, kind, static_cast<unsigned int>(values.size()), 4);
    Append(directory, kind,
      values.size() == 1 ? values[0] : behind + static_cast<unsigned int>(arrays.size()), 4);
    for (std::size_t i = 0; values.size() > 1 && i < values.size(); ++i)
    {
      Append(arrays, kind, values[i], 4);
    }
    ++entries;
  };
  const auto all = static_cast<unsigned int>(kind.Channels);
  add(256, { static_cast<unsigned int>(columns) });
  add(257, { static_cast<unsigned int>(rows) });
  add(258, std::vector<unsigned int>(all, kind.Bits));
  add(259, { static_cast<unsigned int>(kind.Compression) });
  add(262, { static_cast<unsigned int>(kind.Photometric) });
  add(274, { static_cast<unsigned int>(orientation) });
  add(277, { all });
  add(284, { kind.IsPlanar ? 2u : 1u });
  add(kind.IsTiled ? 324 : 273, starts);
  add(kind.IsTiled ? 325 : 279, sizes);
  add(339, std::vector<unsigned int>(all, kind.IsFloat ? 3 : 1));
  if (kind.IsAssociated)
  {
    add(338, { 1 });
  }
  if (kind.IsTiled)
  {
    add(322, { 16 });
    add(323, { 16 });
  }
  else
  {
    add(278, { 2 });
  }
  while (entries < static_cast<int>(count))
  {
    add(65000 + entries, { 0 });
  }
  std::string offset;
  Append(offset, kind, static_cast<unsigned int>(bytes.size()), 4);
  bytes.replace(4, 4, offset);
  Append(bytes, kind, count, 2);
  bytes += directory;
  Append(bytes, kind, 0, 4);
  WriteText(path, bytes + arrays);
}

// Compresses in the order of the specification [TIFF 6.0, section 13].
std::string CompressLzw(const std::string& text)
{
  std::string out;
  unsigned int buffer = 0;
  int filled = 0;
  std::map<std::string, unsigned int> table;
  const auto clear = [&] {
    table.clear();
    for (unsigned int i = 0; i < 256; ++i)
    {
      table[std::string(1, static_cast<char>(i))] = i;
    }
  };
  clear();
  unsigned int next = 258;
  const auto put = [&](unsigned int code) {
    const int bits = next <= 511 ? 9 : next <= 1023 ? 10 : next <= 2047 ? 11 : 12;
    buffer = buffer << bits | code;
    for (filled += bits; filled >= 8; filled -= 8)
    {
      out += static_cast<char>(buffer >> (filled - 8) & 255u);
    }
  };
  put(256);
  std::string prefix;
  for (const char byte : text)
  {
    if (table.count(prefix + byte) != 0)
    {
      prefix += byte;
      continue;
    }
    put(table[prefix]);
    table[prefix + byte] = next++;
    if (next == 4095)
    {
      put(256);
      clear();
      next = 258;
    }
    prefix = byte;
  }
  put(table[prefix]);
  ++next;
  put(257);
  out += static_cast<char>(buffer << (8 - filled) & 255u);
  return out;
}

void ExpectUpright(const std::string& path, const Kind& kind)
{
  const auto image = penumbra::ReadImage(path);
  const int* size = image->GetDimensions();
  ASSERT_EQ(size[0], Width);
  ASSERT_EQ(size[1], Height);
  ASSERT_EQ(image->GetNumberOfScalarComponents(), kind.Channels);
  for (int y = 0; y < Height; ++y)
  {
    for (int x = 0; x < Width; ++x)
    {
      for (int c = 0; c < kind.Channels; ++c)
      {
        // The first row of vtkImageData is the lowest.
        ASSERT_EQ(
          image->GetScalarComponentAsDouble(x, Height - 1 - y, 0, c), ValueAt(kind, y, x, c))
          << x << " " << y << " " << c;
      }
    }
  }
}

TEST(Tiff, AppliesOrientation)
{
  const Folder folder("tiff-orientation");
  const Kind kinds[] = { { 8, 1 }, { 8, 3, false, 2 }, { 8, 4, false, 2 }, { 16, 1 },
    { 16, 3, false, 2 }, { 16, 4, false, 2 }, { 32, 1, true }, { 32, 3, true, 2 },
    { 8, 3, false, 2, true }, { 16, 3, false, 2, false, true },
    { 16, 3, false, 2, true, true, true }, { 32, 3, true, 2, false, false, true } };
  for (std::size_t i = 0; i < std::size(kinds); ++i)
  {
    for (int orientation = 1; orientation <= 8; ++orientation)
    {
      SCOPED_TRACE("kind " + std::to_string(i) + ", orientation " + std::to_string(orientation));
      WriteTiff(folder / "a.tif", kinds[i], orientation);
      ExpectUpright(folder / "a.tif", kinds[i]);
    }
  }
}

TEST(Tiff, DividesColorsByAssociatedAlpha)
{
  const Folder folder("tiff-associated");
  for (const Kind& kind : { Kind{ 8, 4, false, 2, false, false, false, 1, true },
         Kind{ 16, 4, false, 2, true, false, false, 1, true },
         Kind{ 32, 4, true, 2, false, true, false, 1, true },
         Kind{ 8, 2, false, 1, false, false, false, 1, true } })
  {
    WriteTiff(folder / "a.tif", kind, 1);
    const auto image = penumbra::ReadImage(folder / "a.tif");
    const double white = kind.IsFloat ? 1.0 : kind.Bits == 16 ? 65535.0 : 255.0;
    for (int y = 0; y < Height; ++y)
    {
      const double alpha = ValueAt(kind, y, 2, kind.Channels - 1);
      for (int c = 0; c < kind.Channels; ++c)
      {
        const double value = ValueAt(kind, y, 2, c);
        const double expected = c == kind.Channels - 1 ? alpha : value * white / alpha;
        EXPECT_NEAR(image->GetScalarComponentAsDouble(2, Height - 1 - y, 0, c), expected,
          kind.IsFloat ? 1e-6 : 0.5001)
          << kind.Bits << " " << y << " " << c;
      }
    }
  }
}

TEST(Tiff, ConvertsCmyk)
{
  const Folder folder("tiff-cmyk");
  const Kind kind{ 8, 4, false, 5 };
  WriteTiff(folder / "a.tif", kind, 1);
  const auto image = penumbra::ReadImage(folder / "a.tif");
  ASSERT_EQ(image->GetNumberOfScalarComponents(), 3);
  for (int y = 0; y < Height; ++y)
  {
    const double black = ValueAt(kind, y, 3, 3);
    for (int c = 0; c < 3; ++c)
    {
      const double expected = (255.0 - ValueAt(kind, y, 3, c)) * (255.0 - black) / 255.0;
      EXPECT_NEAR(image->GetScalarComponentAsDouble(3, Height - 1 - y, 0, c), expected, 0.5);
    }
  }
}

TEST(Tiff, ReadsOwnFiles)
{
  const Folder folder("tiff-own");
  const std::string bracket = SourceFolder() + "/Data/bracket.stl";
  for (const std::string name : { "a.png", "a.tif" })
  {
    const ProgramResult outcome =
      RunProgram({ "render", bracket, "--resolution", "100,60", "--output", folder / name });
    ASSERT_EQ(outcome.Status, 0) << outcome.Errors;
  }
  const ProgramResult outcome =
    RunProgram({ "compare", folder / "a.tif", folder / "a.png", "--metric", "max" });
  EXPECT_EQ(outcome.Output.rfind("max 0 from", 0), 0u) << outcome.Output;
}

TEST(Tiff, ReadsLzw)
{
  // All widths of codes and a full table. Neither pixels nor codes repeat soon.
  std::string pixels;
  std::uint32_t state = 1;
  for (int i = 0; i < 9000; ++i)
  {
    state = state * 1664525u + 1013904223u;
    pixels += static_cast<char>(i % 900 < 300 ? i / 900 : state >> 24);
  }
  const std::string packed = CompressLzw(pixels);
  Kind kind;
  std::string bytes = "II";
  Append(bytes, kind, 42, 2);
  Append(bytes, kind, 8, 4);
  const unsigned int fields[][2] = { { 256, 90 }, { 257, 100 }, { 258, 8 }, { 259, 5 }, { 262, 1 },
    { 273, 8 + 2 + 9 * 12 + 4 }, { 277, 1 }, { 278, 100 },
    { 279, static_cast<unsigned int>(packed.size()) } };
  Append(bytes, kind, 9, 2);
  for (const auto& field : fields)
  {
    Append(bytes, kind, field[0], 2);
    Append(bytes, kind, 4, 2);
    Append(bytes, kind, 1, 4);
    Append(bytes, kind, field[1], 4);
  }
  Append(bytes, kind, 0, 4);
  const Folder folder("tiff-lzw");
  WriteText(folder / "a.tif", bytes + packed);
  const auto image = penumbra::ReadImage(folder / "a.tif");
  ASSERT_EQ(image->GetNumberOfPoints(), 9000);
  for (int i = 0; i < 9000; ++i)
  {
    ASSERT_EQ(image->GetScalarComponentAsDouble(i % 90, 99 - i / 90, 0, 0),
      static_cast<unsigned char>(pixels[i]))
      << i;
  }
}

TEST(Tiff, ReadsCompressedFiles)
{
  const Folder folder("tiff-compressed");
  vtkNew<vtkImageData> image;
  image->SetDimensions(61, 200, 1);
  image->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
  for (int y = 0; y < 200; ++y)
  {
    for (int x = 0; x < 61; ++x)
    {
      for (int c = 0; c < 3; ++c)
      {
        image->SetScalarComponentFromDouble(x, y, 0, c, (x * x * (c + 1) + 3 * y * y) / 7 % 256);
      }
    }
  }
  // vtkTIFFWriter changes its input if it compresses.
  const auto* begin = static_cast<const char*>(image->GetScalarPointer());
  const std::string pixels(begin, begin + 61 * 200 * 3);
  for (const int compression :
    { vtkTIFFWriter::NoCompression, vtkTIFFWriter::PackBits, vtkTIFFWriter::Deflate })
  {
    vtkNew<vtkTIFFWriter> writer;
    writer->SetInputData(image);
    writer->SetCompression(compression);
    writer->SetFileName((folder / "a.tif").c_str());
    writer->Write();
    const auto read = penumbra::ReadImage(folder / "a.tif");
    ASSERT_EQ(read->GetNumberOfPoints(), image->GetNumberOfPoints());
    EXPECT_EQ(std::memcmp(read->GetScalarPointer(), pixels.data(), pixels.size()), 0)
      << compression;
  }
}

TEST(Tiff, RejectsOtherKindsAndDamage)
{
  const Folder folder("tiff-rejected");
  const auto fail = [&](const std::string& name) -> std::string {
    try
    {
      penumbra::ReadImage(folder / name);
    }
    catch (const penumbra::CommandError& error)
    {
      return error.what();
    }
    return "";
  };
  Kind kind{ 8, 3, false, 6 };
  kind.Compression = 7;
  WriteTiff(folder / "jpeg.tif", kind, 1);
  EXPECT_NE(fail("jpeg.tif").find("JPEG compression is not supported; convert it to a .png"),
    std::string::npos)
    << fail("jpeg.tif");
  WriteTiff(folder / "lab.tif", { 8, 3, false, 8 }, 1);
  EXPECT_NE(fail("lab.tif").find("photometric interpretation 8"), std::string::npos)
    << fail("lab.tif");
  WriteTiff(folder / "whole.tif", { 8, 3, false, 2 }, 1);
  const std::string whole = ReadText(folder / "whole.tif");
  for (std::size_t size = 0; size < whole.size() - 8; ++size)
  {
    WriteText(folder / "cut.tif", whole.substr(0, size));
    ASSERT_NE(fail("cut.tif").find("the file is damaged"), std::string::npos) << size;
  }
}

}
