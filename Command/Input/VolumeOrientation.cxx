// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "VolumeOrientation.h"

#include "Formats/TextScanner.h"
#include "NrrdHeader.h"
#include "Processes/CommandError.h"

#include "vtkImageData.h"
#include "vtkMath.h"
#include "vtkMatrix3x3.h"
#include "vtkMatrix4x4.h"
#include "vtkMetaImageReader.h"
#include "vtkNIFTIImageReader.h"
#include "vtkNew.h"
#include "vtkNrrdReader.h"
#include "vtkObjectFactory.h"
#include "vtkStringArray.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <vector>

namespace penumbra
{

namespace
{

/// Position of the first voxel and the steps to the next voxel along each axis.
struct Frame
{
  double Origin[3] = { 0.0, 0.0, 0.0 };
  double Steps[3][3] = { { 1.0, 0.0, 0.0 }, { 0.0, 1.0, 0.0 }, { 0.0, 0.0, 1.0 } };
};

void SetFrame(vtkDataObject* data, const std::string& path, Frame frame)
{
  vtkImageData* image = vtkImageData::SafeDownCast(data);
  if (!image)
  {
    return;
  }
  if (image->GetDimensions()[2] == 1)
  {
    // The third axis of a slice may be missing.
    double normal[3];
    vtkMath::Cross(frame.Steps[0], frame.Steps[1], normal);
    vtkMath::Normalize(normal);
    if (std::abs(vtkMath::Dot(normal, frame.Steps[2])) <= 1e-6 * vtkMath::Norm(frame.Steps[2]))
    {
      std::copy(normal, normal + 3, frame.Steps[2]);
    }
  }
  double spacing[3];
  vtkNew<vtkMatrix3x3> direction;
  for (int axis = 0; axis < 3; ++axis)
  {
    spacing[axis] = vtkMath::Norm(frame.Steps[axis]);
    for (int i = 0; i < 3; ++i)
    {
      direction->SetElement(i, axis, frame.Steps[axis][i] / spacing[axis]);
    }
  }
  const double volume = direction->Determinant();
  if (!std::isfinite(volume) || std::abs(volume) < 1e-6)
  {
    throw CommandError(
      BadInput, path + ": the axes of the volume are parallel or zero; correct its orientation");
  }
  image->SetOrigin(frame.Origin);
  image->SetSpacing(spacing);
  image->SetDirectionMatrix(direction);
}

std::vector<double> ParseNumbers(std::string_view text)
{
  TextScanner words(text.data(), text.data() + text.size());
  std::vector<double> numbers;
  double number = 0.0;
  for (std::string_view word = words.Word(); !word.empty(); word = words.Word())
  {
    if (!ParseNumber(word, number))
    {
      break;
    }
    numbers.push_back(number);
  }
  return numbers;
}

struct MetaImageHeader
{
  std::vector<double> Origin;
  std::vector<double> Spacing;
  std::vector<double> Matrix;
  std::vector<double> Sizes; ///< numbers of voxels
};

MetaImageHeader ReadMetaImageHeader(const std::string& path)
{
  std::ifstream file(path, std::ios::binary);
  MetaImageHeader header;
  std::vector<double> size;
  std::string line;
  while (std::getline(file, line))
  {
    const std::size_t sign = line.find('=');
    if (sign == line.npos)
    {
      break;
    }
    TextScanner words(line.data(), line.data() + sign);
    const std::string_view key = words.Word();
    const std::vector<double> numbers = ParseNumbers(std::string_view(line).substr(sign + 1));
    if (key == "Offset" || key == "Position" || key == "Origin")
    {
      header.Origin = numbers;
    }
    else if (key == "TransformMatrix" || key == "Rotation" || key == "Orientation")
    {
      header.Matrix = numbers;
    }
    else if (key == "DimSize")
    {
      header.Sizes = numbers;
    }
    else if (key == "ElementSpacing")
    {
      header.Spacing = numbers;
    }
    else if (key == "ElementSize")
    {
      size = numbers;
    }
    else if (key == "ElementDataFile")
    {
      break; // Data may follow.
    }
  }
  header.Spacing = header.Spacing.empty() ? size : header.Spacing;
  return header;
}

/// Reads components by the header.
class NrrdReader : public vtkNrrdReader
{
public:
  static NrrdReader* New();
  vtkTypeMacro(NrrdReader, vtkNrrdReader);

  NrrdHeader Header;

protected:
  using vtkNrrdReader::ReadHeader;
  int ReadHeader(vtkCharArray* buffer) override
  {
    const int result = this->Superclass::ReadHeader(buffer);
    if (result && this->Header.IsKnown)
    {
      this->FileLowerLeft = 1; // The superclass flips the rows of some spaces.
      this->NumberOfScalarComponents = this->Header.Components;
      const bool isSplit = this->DataFiles->GetNumberOfValues() > 1;
      this->FileDimensionality = isSplit ? 2 : 3;
      for (int axis = 0; axis < 3; ++axis)
      {
        this->DataExtent[2 * axis] = 0;
        this->DataExtent[2 * axis + 1] = this->Header.Sizes[axis] - 1;
      }
    }
    return result;
  }
};

vtkStandardNewMacro(NrrdReader);

}

vtkSmartPointer<vtkAlgorithm> MakeNrrdReader(const std::string& path)
{
  auto reader = vtkSmartPointer<NrrdReader>::New();
  reader->Header = ReadNrrdHeader(path);
  reader->SetFileName(path.c_str());
  return reader;
}

void OrientNrrd(vtkAlgorithm* reader, const std::string& path, vtkDataObject* image)
{
  const NrrdHeader& header = static_cast<NrrdReader*>(reader)->Header;
  if (!header.IsKnown)
  {
    return;
  }
  Frame frame;
  for (int axis = 0; axis < 3; ++axis)
  {
    frame.Origin[axis] = header.Origin[axis];
    std::copy(header.Steps[axis], header.Steps[axis] + 3, frame.Steps[axis]);
  }
  SetFrame(image, path, frame);
}

vtkSmartPointer<vtkAlgorithm> MakeMetaImageReader(const std::string& path)
{
  const std::size_t dimensions = ReadMetaImageHeader(path).Sizes.size();
  if (dimensions > 3)
  {
    throw CommandError(BadInput,
      path + ": the volume has " + std::to_string(dimensions) +
        " dimensions instead of 3; write one file per volume");
  }
  auto reader = vtkSmartPointer<vtkMetaImageReader>::New();
  reader->SetFileName(path.c_str());
  return reader;
}

void OrientMetaImage(vtkAlgorithm*, const std::string& path, vtkDataObject* image)
{
  const MetaImageHeader header = ReadMetaImageHeader(path);
  const std::vector<double>& matrix = header.Matrix;
  const std::size_t dimension = matrix.size() == 4 ? 2 : 3;
  Frame frame;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    frame.Origin[axis] = axis < header.Origin.size() ? header.Origin[axis] : 0.0;
    // The matrix lists the direction of one axis after the other.
    for (std::size_t i = 0; i < dimension && axis < dimension && !matrix.empty(); ++i)
    {
      frame.Steps[axis][i] =
        axis * dimension + i < matrix.size() ? matrix[axis * dimension + i] : frame.Steps[axis][i];
    }
    const bool hasStep = axis < header.Spacing.size() && header.Spacing[axis] != 0.0;
    vtkMath::MultiplyScalar(frame.Steps[axis], hasStep ? std::abs(header.Spacing[axis]) : 1.0);
  }
  SetFrame(image, path, frame);
}

void OrientNifti(vtkAlgorithm* algorithm, const std::string& path, vtkDataObject* data)
{
  auto* reader = static_cast<vtkNIFTIImageReader*>(algorithm);
  vtkImageData* image = vtkImageData::SafeDownCast(data);
  vtkMatrix4x4* matrix =
    reader->GetSFormMatrix() ? reader->GetSFormMatrix() : reader->GetQFormMatrix();
  if (!matrix || !image)
  {
    return;
  }
  Frame frame;
  for (int axis = 0; axis < 3; ++axis)
  {
    frame.Origin[axis] = matrix->GetElement(axis, 3);
    for (int i = 0; i < 3; ++i)
    {
      frame.Steps[axis][i] = matrix->GetElement(i, axis) * image->GetSpacing()[axis];
    }
  }
  SetFrame(data, path, frame);
}

}
