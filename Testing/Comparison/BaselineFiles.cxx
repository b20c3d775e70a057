// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "BaselineFiles.h"

#include "vtkDataArray.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPNGReader.h"
#include "vtkPNGWriter.h"
#include "vtkPointData.h"
#include "vtkUnsignedCharArray.h"
#include "vtkXMLImageDataReader.h"
#include "vtkXMLImageDataWriter.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

namespace penumbra
{

namespace fs = std::filesystem;

namespace
{

bool HoldsFloats(const std::string& path)
{
  return fs::path(path).extension() == ".vti";
}

std::string Numbered(const std::string& path, int number)
{
  const fs::path base(path);
  const std::string suffix = number > 0 ? "_" + std::to_string(number) : "";
  return (base.parent_path() / (base.stem().string() + suffix + base.extension().string()))
    .string();
}

vtkDataArray* ColorOf(vtkImageData* image)
{
  vtkDataArray* color = image->GetPointData()->GetArray("Color");
  return color ? color : image->GetPointData()->GetScalars();
}

bool IsOpaque(vtkDataArray* color)
{
  const int components = color->GetNumberOfComponents();
  const bool isInteger = color->GetDataType() != VTK_FLOAT && color->GetDataType() != VTK_DOUBLE;
  const double full = isInteger ? color->GetDataTypeMax() : 1.0;
  return components % 2 != 0 || color->GetRange(components - 1)[0] >= full;
}

}

bool IsBaselinePath(const std::string& path)
{
  return HoldsFloats(path) || fs::path(path).extension() == ".png";
}

std::vector<std::string> FindBaselines(const std::string& path)
{
  std::vector<std::string> found;
  for (int number = 0; fs::exists(Numbered(path, number)); ++number)
  {
    found.push_back(Numbered(path, number));
  }
  return found;
}

std::string NextBaseline(const std::string& path)
{
  return Numbered(path, static_cast<int>(FindBaselines(path).size()));
}

vtkSmartPointer<vtkImageData> ReadBaseline(const std::string& path)
{
  vtkSmartPointer<vtkImageData> image;
  if (HoldsFloats(path))
  {
    vtkNew<vtkXMLImageDataReader> reader;
    if (reader->CanReadFile(path.c_str()))
    {
      reader->SetFileName(path.c_str());
      reader->Update();
      image = reader->GetErrorCode() == 0 ? reader->GetOutput() : nullptr;
    }
    return image;
  }
  vtkNew<vtkPNGReader> reader;
  if (reader->CanReadFile(path.c_str()))
  {
    reader->SetFileName(path.c_str());
    reader->Update();
    image = reader->GetErrorCode() == 0 ? reader->GetOutput() : nullptr;
  }
  return image;
}

vtkSmartPointer<vtkImageData> AsStored(vtkImageData* image, const std::string& path)
{
  vtkDataArray* color = ColorOf(image);
  if (!color || HoldsFloats(path))
  {
    return image;
  }
  const int type = color->GetDataType();
  const bool isStorable = type == VTK_UNSIGNED_CHAR || type == VTK_UNSIGNED_SHORT;
  const int components =
    color->GetNumberOfComponents() - (IsOpaque(color) ? 1 - color->GetNumberOfComponents() % 2 : 0);
  vtkSmartPointer<vtkDataArray> stored = vtkSmartPointer<vtkDataArray>::Take(
    vtkDataArray::CreateDataArray(isStorable ? type : VTK_UNSIGNED_CHAR));
  stored->SetName("Color");
  stored->SetNumberOfComponents(components);
  stored->SetNumberOfTuples(color->GetNumberOfTuples());
  for (vtkIdType i = 0; i < color->GetNumberOfTuples(); ++i)
  {
    for (int c = 0; c < components; ++c)
    {
      const double value = color->GetComponent(i, c);
      stored->SetComponent(
        i, c, isStorable ? value : std::floor(255.0 * std::clamp(value, 0.0, 1.0) + 0.5));
    }
  }
  auto result = vtkSmartPointer<vtkImageData>::New();
  result->CopyStructure(image);
  result->GetPointData()->SetScalars(stored);
  return result;
}

bool WriteBaseline(vtkImageData* image, const std::string& path)
{
  std::error_code error;
  fs::create_directories(fs::absolute(path).parent_path(), error);
  const std::string part = path + ".part";
  unsigned long problem = 0;
  if (HoldsFloats(path))
  {
    vtkNew<vtkXMLImageDataWriter> writer;
    writer->SetInputData(image);
    writer->SetFileName(part.c_str());
    writer->Write();
    problem = writer->GetErrorCode();
  }
  else
  {
    vtkNew<vtkPNGWriter> writer;
    writer->SetInputData(image);
    writer->SetFileName(part.c_str());
    writer->Write();
    problem = writer->GetErrorCode();
  }
  if (problem == 0)
  {
    fs::rename(part, path, error);
  }
  if (problem != 0 || error)
  {
    fs::remove(part, error);
    return false;
  }
  return true;
}

}
