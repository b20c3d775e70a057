// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "TiffFile.h"

#include "MappedFile.h"
#include "TiffCodecs.h"

#include "vtkDataArray.h"
#include "vtkImageData.h"
#include "vtkPointData.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <map>
#include <stdexcept>
#include <vector>

namespace penumbra
{

namespace
{

enum Tag
{
  Width = 256,
  Height = 257,
  BitsPerSample = 258,
  Compression = 259,
  Photometric = 262,
  FillOrder = 266,
  StripOffsets = 273,
  Orientation = 274,
  SamplesPerPixel = 277,
  RowsPerStrip = 278,
  StripByteCounts = 279,
  PlanarConfiguration = 284,
  Predictor = 317,
  ColorMap = 320,
  TileWidth = 322,
  TileLength = 323,
  TileOffsets = 324,
  TileByteCounts = 325,
  ExtraSamples = 338,
  SampleFormat = 339
};

using Bytes = std::vector<unsigned char>;

[[noreturn]] void FailDamaged()
{
  throw std::runtime_error("the file is damaged; export it again");
}

[[noreturn]] void Refuse(const std::string& kind)
{
  throw std::runtime_error(
    kind + " is not supported; convert it to a .png, or floats to a .tif without compression");
}

bool IsMachineLittleEndian()
{
  const std::uint16_t one = 1;
  unsigned char first = 0;
  std::memcpy(&first, &one, 1);
  return first == 1;
}

class TiffFile
{
public:
  explicit TiffFile(const std::string& path)
    : File(path),
      Data(reinterpret_cast<const unsigned char*>(this->File.Begin()))
  {
    this->ReadDirectory();
    this->CheckKind();
  }

  vtkSmartPointer<vtkImageData> Read()
  {
    auto image = vtkSmartPointer<vtkImageData>::New();
    const bool isTransposed = this->Turn > 4;
    image->SetDimensions(static_cast<int>(isTransposed ? this->Rows : this->Columns),
      static_cast<int>(isTransposed ? this->Columns : this->Rows), 1);
    const int type = this->Bits == 32 ? VTK_FLOAT
      : this->Bits == 16              ? VTK_UNSIGNED_SHORT
                                      : VTK_UNSIGNED_CHAR;
    image->AllocateScalars(type, this->CountChannels());
    image->GetPointData()->GetScalars()->SetName("Tiff Scalars");
    switch (type)
    {
      case VTK_FLOAT:
        this->Fill<float>(image);
        break;
      case VTK_UNSIGNED_SHORT:
        this->Fill<std::uint16_t>(image);
        break;
      default:
        this->Fill<unsigned char>(image);
    }
    return image;
  }

private:
  // Returns an unsigned integer of 1 to 4 bytes.
  std::size_t Number(std::size_t at, std::size_t bytes) const
  {
    if (at > this->File.Size() || this->File.Size() - at < bytes)
    {
      FailDamaged();
    }
    std::size_t value = 0;
    for (std::size_t i = 0; i < bytes; ++i)
    {
      value = value << 8 | this->Data[at + (this->IsLittleEndian ? bytes - 1 - i : i)];
    }
    return value;
  }

  void ReadDirectory()
  {
    const bool isIntel = this->File.Size() > 8 && std::memcmp(this->Data, "II", 2) == 0;
    if (!isIntel && (this->File.Size() <= 8 || std::memcmp(this->Data, "MM", 2) != 0))
    {
      FailDamaged();
    }
    this->IsLittleEndian = isIntel;
    if (this->Number(2, 2) == 43)
    {
      Refuse("BigTIFF");
    }
    const std::size_t directory = this->Number(4, 4);
    const std::size_t entries = this->Number(directory, 2);
    for (std::size_t i = 0; i < entries; ++i)
    {
      const std::size_t entry = directory + 2 + 12 * i;
      const std::size_t type = this->Number(entry + 2, 2);
      const std::size_t bytes = type == 1 ? 1 : type == 3 ? 2 : type == 4 ? 4 : 0;
      const std::size_t count = this->Number(entry + 4, 4);
      if (bytes == 0)
      {
        continue; // texts, fractions: not needed
      }
      const std::size_t first = count * bytes <= 4 ? entry + 8 : this->Number(entry + 8, 4);
      if (count == 0 || first > this->File.Size() || (this->File.Size() - first) / bytes < count)
      {
        FailDamaged();
      }
      std::vector<std::size_t>& values = this->Fields[this->Number(entry, 2)];
      values.clear();
      for (std::size_t k = 0; k < count; ++k)
      {
        values.push_back(this->Number(first + k * bytes, bytes));
      }
    }
  }

  std::size_t Get(std::size_t tag, std::size_t missing) const
  {
    const auto found = this->Fields.find(tag);
    return found == this->Fields.end() ? missing : found->second[0];
  }

  void CheckKind()
  {
    this->Columns = this->Get(Width, 0);
    this->Rows = this->Get(Height, 0);
    this->Bits = this->Get(BitsPerSample, 1);
    this->Samples = this->Get(SamplesPerPixel, 1);
    this->Colors = this->Get(Photometric, 1);
    this->Coding = this->Get(Compression, 1);
    this->Prediction = this->Get(Predictor, 1);
    this->IsPlanar = this->Get(PlanarConfiguration, 1) == 2 && this->Samples > 1;
    const std::size_t turn = this->Get(Orientation, 1);
    this->Turn = turn >= 1 && turn <= 8 ? turn : 1;
    const std::size_t format = this->Get(SampleFormat, 1);
    const std::size_t limit = std::numeric_limits<int>::max();
    if (this->Columns == 0 || this->Rows == 0 || this->Samples == 0 || this->Columns > limit ||
      this->Rows > limit || this->Samples > 64)
    {
      FailDamaged();
    }
    for (const std::size_t bits : this->Fields[BitsPerSample])
    {
      if (bits != this->Bits)
      {
        Refuse("TIFF with channels of different sizes");
      }
    }
    const std::size_t codings[] = { 1, 5, 8, 32773, 32946 };
    if (std::find(std::begin(codings), std::end(codings), this->Coding) == std::end(codings))
    {
      Refuse(this->Coding == 6 || this->Coding == 7
          ? "TIFF with JPEG compression"
          : "TIFF with compression " + std::to_string(this->Coding));
    }
    const bool isSmall = this->Bits == 1 || this->Bits == 2 || this->Bits == 4;
    const bool isInteger =
      format == 1 && (this->Bits == 8 || this->Bits == 16 || (isSmall && this->Samples == 1));
    const bool isFloat = format == 3 && this->Bits == 32;
    if (!isInteger && !isFloat)
    {
      Refuse("TIFF with " + std::to_string(this->Bits) + " bits per channel of sample format " +
        std::to_string(format));
    }
    const bool isGray = this->Colors == 1 || (this->Colors == 0 && isInteger);
    const bool isRgb = this->Colors == 2 && this->Samples >= 3;
    const bool isPalette = this->Colors == 3 && isInteger && this->Samples == 1 && this->Bits <= 8;
    const bool isCmyk = this->Colors == 5 && this->Samples == 4 && this->Bits == 8;
    if (!isGray && !isRgb && !isPalette && !isCmyk)
    {
      Refuse("TIFF with photometric interpretation " + std::to_string(this->Colors) + " and " +
        std::to_string(this->Samples) + " channels of " + std::to_string(this->Bits) + " bits");
    }
    if (isPalette && this->Fields[ColorMap].size() != 3u << this->Bits)
    {
      FailDamaged();
    }
    const bool isPredictable = this->Prediction == 1 ||
      (this->Prediction == 2 && !isSmall && !isFloat) || (this->Prediction == 3 && isFloat);
    if (!isPredictable || this->Get(FillOrder, 1) != 1)
    {
      Refuse("TIFF with predictor " + std::to_string(this->Prediction) + " or reversed bits");
    }
    constexpr double MaximumRatio = 3000.0; // of LZW
    if (static_cast<double>(this->Columns) * this->Rows * this->Samples * this->Bits / 8 >
      MaximumRatio * static_cast<double>(this->File.Size()))
    {
      FailDamaged();
    }
  }

  int CountChannels() const
  {
    const bool isGray = this->Colors <= 1;
    return this->Colors == 3 || this->Colors == 5
      ? 3
      : static_cast<int>(std::min<std::size_t>(this->Samples, isGray ? 2 : 4));
  }

  // Returns the bytes of a strip or tile of `rows` rows of `rowBytes` each.
  Bytes Decode(std::size_t offset, std::size_t size, std::size_t rowBytes, std::size_t rows,
    std::size_t fullRows) const
  {
    if (offset > this->File.Size() || this->File.Size() - offset < size)
    {
      FailDamaged();
    }
    const unsigned char* in = this->Data + offset;
    const std::size_t expected = rowBytes * rows;
    Bytes out;
    if (this->Coding == 1)
    {
      out.assign(in, in + std::min(size, expected));
    }
    else if (this->Coding == 5)
    {
      out = DecodeTiffLzw(in, size, expected);
    }
    else if (this->Coding == 32773)
    {
      out = DecodeTiffPackBits(in, size, expected);
    }
    else
    {
      out = InflateTiff(in, size, expected);
      if (out.size() < expected && fullRows > rows)
      {
        out = InflateTiff(in, size, rowBytes * fullRows); // some programs fill the last strip
      }
    }
    if (out.size() < expected)
    {
      FailDamaged();
    }
    return out;
  }

  // Converts a row to values in the machine's byte order; small integers become bytes.
  template <typename T>
  std::vector<T> Unpack(unsigned char* row, std::size_t pixels, std::size_t channels) const
  {
    const std::size_t count = pixels * channels;
    std::vector<T> values(count);
    if (this->Bits < 8)
    {
      const unsigned int mask = (1u << this->Bits) - 1;
      const unsigned int scale = this->Colors == 3 ? 1 : 255 / mask;
      for (std::size_t i = 0; i < count; ++i)
      {
        const std::size_t bit = i * this->Bits;
        values[i] = static_cast<T>((row[bit / 8] >> (8 - this->Bits - bit % 8) & mask) * scale);
      }
      return values;
    }
    bool isLittleEndian = this->IsLittleEndian;
    Bytes sorted;
    if (this->Prediction == 3)
    {
      // Differences of bytes, all first bytes first [Adobe Photoshop TIFF Technical Note 3].
      for (std::size_t i = channels; i < count * sizeof(T); ++i)
      {
        row[i] = static_cast<unsigned char>(row[i] + row[i - channels]);
      }
      sorted.resize(count * sizeof(T));
      for (std::size_t i = 0; i < sorted.size(); ++i)
      {
        sorted[i % count * sizeof(T) + i / count] = row[i];
      }
      row = sorted.data();
      isLittleEndian = false;
    }
    if (isLittleEndian != IsMachineLittleEndian())
    {
      for (std::size_t i = 0; i < count; ++i)
      {
        std::reverse(row + i * sizeof(T), row + (i + 1) * sizeof(T));
      }
    }
    std::memcpy(values.data(), row, count * sizeof(T));
    for (std::size_t i = channels; this->Prediction == 2 && i < count; ++i)
    {
      values[i] = static_cast<T>(values[i] + values[i - channels]);
    }
    return values;
  }

  // Writes a pixel of the file's row and column; `first` is its first channel in a planar file.
  template <typename T>
  void Store(T* pixels, std::size_t row, std::size_t column, const T* in, std::size_t first) const
  {
    const std::size_t lastRow = this->Rows - 1;
    const std::size_t lastColumn = this->Columns - 1;
    const bool rowReversed =
      this->Turn == 3 || this->Turn == 4 || this->Turn == 6 || this->Turn == 7;
    const bool columnReversed =
      this->Turn == 2 || this->Turn == 3 || this->Turn == 7 || this->Turn == 8;
    const std::size_t r = rowReversed ? lastRow - row : row;
    const std::size_t c = columnReversed ? lastColumn - column : column;
    const bool isTransposed = this->Turn > 4;
    const std::size_t x = isTransposed ? r : c;
    const std::size_t y = isTransposed ? lastColumn - c : lastRow - r; // from the bottom
    const std::size_t channels = this->CountChannels();
    T* out = pixels + (y * (isTransposed ? this->Rows : this->Columns) + x) * channels;
    if (this->Colors == 3)
    {
      const std::vector<std::size_t>& map = this->Fields.at(ColorMap);
      for (std::size_t i = 0; i < 3; ++i)
      {
        out[i] = static_cast<T>(map[(i << this->Bits) + static_cast<std::size_t>(in[0])] >> 8);
      }
      return;
    }
    if (this->Colors == 5)
    {
      for (std::size_t i = 0; i < 3; ++i)
      {
        out[i] = static_cast<T>(((255 - in[i]) * (255 - in[3]) + 127) / 255);
      }
      return;
    }
    const std::size_t count = this->IsPlanar ? 1 : channels;
    for (std::size_t i = 0; i < count && first + i < channels; ++i)
    {
      const bool isInverted = this->Colors == 0 && first + i == 0;
      out[first + i] = isInverted ? static_cast<T>(std::numeric_limits<T>::max() - in[i]) : in[i];
    }
  }

  // Divides colors that are multiplied by alpha, the last channel ["associated", TIFF 6.0, section 18].
  template <typename T>
  void DivideByAlpha(T* pixels) const
  {
    const auto channels = static_cast<std::size_t>(this->CountChannels());
    const bool hasAlpha = channels % 2 == 0 && this->Colors != 3 && this->Colors != 5;
    if (!hasAlpha || this->Get(ExtraSamples, 0) != 1)
    {
      return;
    }
    constexpr bool isInteger = std::numeric_limits<T>::is_integer;
    const double white = isInteger ? static_cast<double>(std::numeric_limits<T>::max()) : 1.0;
    for (std::size_t i = 0; i < this->Rows * this->Columns; ++i, pixels += channels)
    {
      const double alpha = static_cast<double>(pixels[channels - 1]) / white;
      for (std::size_t k = 0; alpha > 0.0 && k + 1 < channels; ++k)
      {
        const double color = static_cast<double>(pixels[k]) / alpha;
        pixels[k] = static_cast<T>(isInteger ? std::min(std::floor(color + 0.5), white) : color);
      }
    }
  }

  template <typename T>
  void Fill(vtkImageData* image)
  {
    T* pixels = static_cast<T*>(image->GetScalarPointer());
    const bool isTiled = this->Fields.count(TileWidth) != 0;
    const std::size_t blockWidth = isTiled ? this->Get(TileWidth, 0) : this->Columns;
    const std::size_t blockRows = isTiled
      ? this->Get(TileLength, 0)
      : std::min(this->Get(RowsPerStrip, this->Rows), this->Rows);
    const std::vector<std::size_t>& starts = this->Fields[isTiled ? TileOffsets : StripOffsets];
    const std::vector<std::size_t>& sizes =
      this->Fields[isTiled ? TileByteCounts : StripByteCounts];
    constexpr std::size_t LargestTile = 65536;
    if (blockWidth == 0 || blockRows == 0 ||
      (isTiled && std::max(blockWidth, blockRows) > LargestTile))
    {
      FailDamaged();
    }
    if (this->IsPlanar && this->Colors == 5)
    {
      Refuse("CMYK TIFF with separate planes");
    }
    const std::size_t across = (this->Columns + blockWidth - 1) / blockWidth;
    const std::size_t down = (this->Rows + blockRows - 1) / blockRows;
    const std::size_t planes = this->IsPlanar ? this->Samples : 1;
    const std::size_t channels = this->IsPlanar ? 1 : this->Samples;
    const std::size_t rowBytes = (blockWidth * channels * this->Bits + 7) / 8;
    if (starts.size() < across * down * planes || sizes.size() < across * down * planes)
    {
      FailDamaged();
    }
    for (std::size_t block = 0; block < across * down * planes; ++block)
    {
      const std::size_t plane = block / (across * down);
      const std::size_t firstRow = block / across % down * blockRows;
      const std::size_t firstColumn = block % across * blockWidth;
      const std::size_t rows = std::min(blockRows, this->Rows - firstRow);
      const std::size_t columns = std::min(blockWidth, this->Columns - firstColumn);
      Bytes bytes =
        this->Decode(starts[block], sizes[block], rowBytes, isTiled ? blockRows : rows, blockRows);
      for (std::size_t row = 0; row < rows; ++row)
      {
        const std::vector<T> values =
          this->Unpack<T>(bytes.data() + row * rowBytes, blockWidth, channels);
        for (std::size_t column = 0; column < columns; ++column)
        {
          this->Store(
            pixels, firstRow + row, firstColumn + column, values.data() + column * channels, plane);
        }
      }
    }
    this->DivideByAlpha(pixels);
  }

  MappedFile File;
  const unsigned char* Data;
  bool IsLittleEndian = true;
  std::map<std::size_t, std::vector<std::size_t>> Fields;
  std::size_t Columns = 0;
  std::size_t Rows = 0;
  std::size_t Bits = 1;
  std::size_t Samples = 1;
  std::size_t Colors = 1;
  std::size_t Coding = 1;
  std::size_t Prediction = 1;
  std::size_t Turn = 1;
  bool IsPlanar = false;
};

}

vtkSmartPointer<vtkImageData> ReadTiff(const std::string& path)
{
  return TiffFile(path).Read();
}

}
