// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ImageFiles.h"

#include "AtomicFile.h"
#include "FileExtension.h"
#include "ImageBytes.h"
#include "InputFiles.h"
#include "MappedFile.h"
#include "Processes/CommandError.h"
#include "Processes/MessageLog.h"
#include "TiffFile.h"

#include "vtkBMPReader.h"
#include "vtkBMPWriter.h"
#include "vtkDataArray.h"
#include "vtkErrorCode.h"
#include "vtkFieldData.h"
#include "vtkImageData.h"
#include "vtkIntArray.h"
#include "vtkJPEGReader.h"
#include "vtkJPEGWriter.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPNGReader.h"
#include "vtkPNGWriter.h"
#include "vtkPointData.h"
#include "vtkTIFFWriter.h"
#include "vtkUnsignedCharArray.h"
#include "vtkXMLImageDataReader.h"
#include "vtkXMLImageDataWriter.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iterator>
#include <stdexcept>

namespace penumbra
{

namespace
{

// Keyword of the PNG text chunk that contains the note.
constexpr const char* NoteKey = "Penumbra";

// Sets the resolution, which VTK's writer exposes to subclasses only.
class TiffWriter : public vtkTIFFWriter
{
public:
  static TiffWriter* New();
  vtkTypeMacro(TiffWriter, vtkTIFFWriter);

  void SetDotsPerInch(int dotsPerInch)
  {
    this->XResolution = dotsPerInch;
    this->YResolution = dotsPerInch;
  }
};
vtkStandardNewMacro(TiffWriter);

std::string Extension(const std::string& path)
{
  const std::string extension = LowerExtension(path);
  return extension == ".jpeg" ? ".jpg" : extension == ".tiff" ? ".tif" : extension;
}

// Converts an image to 8 bits per channel.
vtkSmartPointer<vtkImageData> Quantize(vtkImageData* image, bool alpha)
{
  vtkDataArray* color = image->GetPointData()->GetArray("Color");
  auto quantized = vtkSmartPointer<vtkImageData>::New();
  quantized->SetDimensions(image->GetDimensions());
  vtkNew<vtkUnsignedCharArray> bytes;
  const int components = alpha ? 4 : 3;
  bytes->SetNumberOfComponents(components);
  bytes->SetNumberOfTuples(color->GetNumberOfTuples());
  for (vtkIdType i = 0; i < color->GetNumberOfTuples(); ++i)
  {
    for (int c = 0; c < components; ++c)
    {
      const double value = std::clamp(color->GetComponent(i, c), 0.0, 1.0);
      bytes->SetTypedComponent(i, c, static_cast<unsigned char>(std::lround(255.0 * value)));
    }
  }
  quantized->GetPointData()->SetScalars(bytes);
  return quantized;
}

template <typename Writer>
std::string Encode(vtkImageData* image, Writer* writer)
{
  writer->SetInputData(image);
  writer->WriteToMemoryOn();
  writer->Write();
  vtkUnsignedCharArray* result = writer->GetResult();
  if (!result || result->GetNumberOfValues() == 0)
  {
    throw CommandError(BadInput,
      "--output: the format does not support images of this size; choose another format or a "
      "smaller --resolution");
  }
  return std::string(
    reinterpret_cast<const char*>(result->GetPointer(0)), result->GetNumberOfValues());
}

// Throws if a writer that writes to files reported an error or left an incomplete file.
void CheckWritten(unsigned long errorCode, const AtomicFile& file)
{
  const bool failed = !TakeErrors().empty();
  std::error_code missing;
  const auto size = std::filesystem::file_size(file.TemporaryPath(), missing);
  if (errorCode == vtkErrorCode::OutOfDiskSpaceError)
  {
    file.Fail("the disk is full; free space or choose another folder");
  }
  if (errorCode != vtkErrorCode::NoError || failed || missing || size == 0)
  {
    file.Fail("the file is incomplete; check the free disk space");
  }
}

void WriteTiff(vtkImageData* image, AtomicFile& file, int dotsPerInch)
{
  vtkNew<TiffWriter> writer;
  writer->SetInputData(image);
  writer->SetFileName(file.TemporaryPath().c_str());
  writer->SetCompressionToDeflate();
  writer->SetDotsPerInch(dotsPerInch);
  writer->Write();
  CheckWritten(writer->GetErrorCode(), file);
  // Neither the writer nor libtiff detects a full disk.
  if (!IsWholeTiff(file.TemporaryPath()))
  {
    file.Fail("the file is incomplete; check the free disk space");
  }
}

void WriteArrays(vtkImageData* image, AtomicFile& file, int dotsPerInch)
{
  vtkNew<vtkImageData> output;
  output->ShallowCopy(image);
  vtkNew<vtkIntArray> density;
  density->SetName("DotsPerInch");
  density->InsertNextValue(dotsPerInch);
  output->GetFieldData()->AddArray(density);
  vtkNew<vtkXMLImageDataWriter> writer;
  writer->SetInputData(output);
  writer->SetFileName(file.TemporaryPath().c_str());
  writer->SetDataModeToAppended();
  writer->EncodeAppendedDataOff();
  writer->Write();
  CheckWritten(writer->GetErrorCode(), file);
}

bool IsWhole(const std::string& path)
{
  const MappedFile file(path);
  return IsWholePng(file.Begin(), file.Size());
}

template <typename Reader>
vtkSmartPointer<vtkImageData> Read(const std::string& path)
{
  vtkNew<Reader> reader;
  reader->SetFileName(path.c_str());
  reader->Update();
  return reader->GetOutput();
}

vtkSmartPointer<vtkImageData> ReadTiffImage(const std::string& path)
{
  try
  {
    return ReadTiff(path);
  }
  catch (const std::runtime_error& error)
  {
    throw CommandError(BadInput, path + ": cannot be read as an image: " + error.what());
  }
}

bool IsImage(const std::string& path)
{
  const std::string extension = Extension(path);
  const char* const known[] = { ".png", ".jpg", ".tif", ".bmp", ".vti" };
  return std::find(std::begin(known), std::end(known), extension) != std::end(known);
}

[[noreturn]] void RefuseFormat(
  const std::string& path, const std::string& option, const std::string& extensions)
{
  throw CommandError(BadInput,
    option + " " + path + ": unknown image format; the path must end in one of " + extensions);
}

}

std::string ImageExtensions()
{
  return ".png .jpg .jpeg .tif .tiff .bmp .vti";
}

void CheckImageExtension(const std::string& path, const std::string& option)
{
  if (!IsImage(path))
  {
    RefuseFormat(path, option, ImageExtensions());
  }
}

bool IsVectorGraphic(const std::string& path)
{
  const std::string extension = Extension(path);
  return extension == ".svg" || extension == ".pdf";
}

void CheckOutputExtension(const std::string& path, const std::string& option)
{
  if (!IsImage(path) && !IsVectorGraphic(path))
  {
    RefuseFormat(path, option, ImageExtensions() + " .svg .pdf");
  }
}

bool SupportsAlpha(const std::string& path)
{
  const std::string extension = Extension(path);
  return extension != ".jpg" && extension != ".bmp";
}

bool HoldsArrays(const std::string& path)
{
  return Extension(path) == ".vti";
}

void WriteImage(vtkImageData* image, AtomicFile& file, const std::string& path, bool alpha,
  int dotsPerInch, const std::string& note)
{
  const std::string extension = Extension(path);
  TakeErrors();
  if (extension == ".vti")
  {
    WriteArrays(image, file, dotsPerInch);
    return;
  }
  const vtkSmartPointer<vtkImageData> quantized = Quantize(image, alpha);
  if (extension == ".tif")
  {
    WriteTiff(quantized, file, dotsPerInch);
    return;
  }
  std::string bytes;
  if (extension == ".jpg")
  {
    vtkNew<vtkJPEGWriter> writer;
    bytes = Encode(quantized, writer.Get());
    SetDensityOfJpeg(bytes, dotsPerInch);
  }
  else if (extension == ".bmp")
  {
    vtkNew<vtkBMPWriter> writer;
    bytes = Encode(quantized, writer.Get());
    SetDensityOfBmp(bytes, dotsPerInch);
  }
  else
  {
    vtkNew<vtkPNGWriter> writer;
    if (!note.empty())
    {
      writer->AddText(NoteKey, note.c_str());
    }
    bytes = Encode(quantized, writer.Get());
    SetDensityOfPng(bytes, dotsPerInch);
  }
  file.Write(bytes);
}

std::string ReadNote(const std::string& path)
{
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(path, ignored) || !IsWhole(path))
  {
    return std::string();
  }
  TakeErrors();
  vtkNew<vtkPNGReader> reader;
  reader->SetFileName(path.c_str());
  reader->Update();
  int chunks[2] = { 0, 0 };
  reader->GetTextChunks(NoteKey, chunks);
  return TakeErrors().empty() && chunks[1] > chunks[0] ? reader->GetTextValue(chunks[0]) : "";
}

vtkSmartPointer<vtkImageData> ReadImage(const std::string& path)
{
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(path, ignored))
  {
    throw CommandError(BadInput, path + ": no such file; check the name");
  }
  CheckImageExtension(path, "image");
  RecordInput(path);
  const std::string extension = Extension(path);
  if (extension == ".png" && !IsWhole(path))
  {
    throw CommandError(BadInput, path + ": cannot be read as an image: the file is damaged");
  }
  TakeErrors();
  const vtkSmartPointer<vtkImageData> image = extension == ".vti"
    ? Read<vtkXMLImageDataReader>(path)
    : extension == ".tif" ? ReadTiffImage(path)
    : extension == ".bmp" ? Read<vtkBMPReader>(path)
    : extension == ".jpg" ? Read<vtkJPEGReader>(path)
                          : Read<vtkPNGReader>(path);
  const std::vector<std::string> errors = TakeErrors();
  if (!errors.empty() || !image || image->GetNumberOfPoints() == 0)
  {
    throw CommandError(BadInput,
      path + ": cannot be read as an image: " + (errors.empty() ? "it is empty" : errors.front()));
  }
  return image;
}

}
