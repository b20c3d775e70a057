// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ImageMessage.h"

#include "vtkDataArray.h"
#include "vtkFieldData.h"
#include "vtkImageData.h"
#include "vtkPointData.h"
#include "vtkSmartPointer.h"

#include <algorithm>
#include <array>

namespace penumbra
{
namespace
{

using Extent = std::array<int, 6>;

/// Calls visit(first, count) for the points of each row of the part `extent` of an image.
template <typename Visit>
void VisitRows(vtkImageData* image, const int extent[6], const Visit& visit)
{
  for (int y = extent[2]; y <= extent[3]; ++y)
  {
    int first[3] = { extent[0], y, 0 };
    visit(image->ComputePointId(first), extent[1] - extent[0] + 1);
  }
}

void AddHeader(vtkDataArray* array, ByteWriter& bytes)
{
  bytes.Add(std::string(array->GetName()));
  bytes.Add(array->GetDataType());
  bytes.Add(array->GetNumberOfComponents());
}

/// Returns the array of the header, which it adds if there is none, with this number of tuples.
vtkDataArray* FindArray(ByteReader& bytes, vtkIdType tuples, vtkFieldData* fields)
{
  const std::string name = bytes.Get<std::string>();
  const int type = bytes.Get<int>();
  const int components = bytes.Get<int>();
  vtkDataArray* array = fields->GetArray(name.c_str());
  if (!array)
  {
    const auto added = vtkSmartPointer<vtkDataArray>::Take(vtkDataArray::CreateDataArray(type));
    added->SetName(name.c_str());
    added->SetNumberOfComponents(components);
    added->SetNumberOfTuples(tuples);
    fields->AddArray(added);
    array = added;
  }
  return array;
}

char* GetTuple(vtkDataArray* array, vtkIdType tuple)
{
  return static_cast<char*>(array->GetVoidPointer(tuple * array->GetNumberOfComponents()));
}

std::size_t GetTupleSize(vtkDataArray* array)
{
  return static_cast<std::size_t>(array->GetNumberOfComponents()) * array->GetDataTypeSize();
}

}

void AddPixels(vtkImageData* image, const int extent[6], ByteWriter& bytes)
{
  for (int i = 0; i < 6; ++i)
  {
    bytes.Add(extent[i]);
  }
  bytes.Add(image->GetPointData()->GetNumberOfArrays());
  for (int i = 0; i < image->GetPointData()->GetNumberOfArrays(); ++i)
  {
    vtkDataArray* array = image->GetPointData()->GetArray(i);
    AddHeader(array, bytes);
    std::vector<char> rows;
    VisitRows(image, extent, [&](vtkIdType first, int count) {
      const char* const row = GetTuple(array, first);
      rows.insert(rows.end(), row, row + count * GetTupleSize(array));
    });
    bytes.Add(rows);
  }
  vtkFieldData* fields = image->GetFieldData();
  bytes.Add(fields->GetNumberOfArrays());
  for (int i = 0; i < fields->GetNumberOfArrays(); ++i)
  {
    vtkDataArray* array = fields->GetArray(i); // statistics are numbers
    AddHeader(array, bytes);
    const char* const first = GetTuple(array, 0);
    bytes.Add(std::vector<char>(first, first + array->GetNumberOfTuples() * GetTupleSize(array)));
  }
}

void GetPixels(ByteReader& bytes, vtkImageData* image)
{
  Extent extent;
  for (int& side : extent)
  {
    bytes.Get(side);
  }
  const int arrays = bytes.Get<int>();
  for (int i = 0; i < arrays; ++i)
  {
    vtkDataArray* array = FindArray(bytes, image->GetNumberOfPoints(), image->GetPointData());
    const auto rows = bytes.Get<std::vector<char>>();
    const char* from = rows.data();
    VisitRows(image, extent.data(), [&](vtkIdType first, int count) {
      const std::size_t size = count * GetTupleSize(array);
      std::copy_n(from, size, GetTuple(array, first));
      from += size;
    });
  }
  const int fields = bytes.Get<int>();
  for (int i = 0; i < fields; ++i)
  {
    vtkDataArray* array = FindArray(bytes, 0, image->GetFieldData());
    const auto values = bytes.Get<std::vector<char>>();
    array->SetNumberOfTuples(static_cast<vtkIdType>(values.size() / GetTupleSize(array)));
    std::copy(values.begin(), values.end(), GetTuple(array, 0));
  }
  if (image->GetPointData()->HasArray("Color"))
  {
    image->GetPointData()->SetActiveScalars("Color");
  }
}

void CropImage(const int extent[6], vtkImageData* image)
{
  int whole[6];
  image->GetExtent(whole);
  if (std::equal(whole, whole + 6, extent))
  {
    return;
  }
  ByteWriter writer;
  AddPixels(image, extent, writer);
  const std::string bytes = writer.Take();
  image->Initialize();
  image->SetExtent(extent[0], extent[1], extent[2], extent[3], extent[4], extent[5]);
  ByteReader reader(bytes);
  GetPixels(reader, image);
}

}
