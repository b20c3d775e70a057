// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "PlyBody.h"

#include "vtkDataArray.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>

namespace penumbra
{

namespace
{

template <typename T>
double Decode(const char* bytes)
{
  T value;
  std::memcpy(&value, bytes, sizeof(T));
  return static_cast<double>(value);
}

double Decode(const PlyType& type, const char* bytes)
{
  switch (type.Size)
  {
    case 1:
      return type.IsSigned ? Decode<std::int8_t>(bytes) : Decode<std::uint8_t>(bytes);
    case 2:
      return type.IsSigned ? Decode<std::int16_t>(bytes) : Decode<std::uint16_t>(bytes);
    case 4:
      return type.IsFloat ? Decode<float>(bytes)
        : type.IsSigned   ? Decode<std::int32_t>(bytes)
                          : Decode<std::uint32_t>(bytes);
    default:
      return type.IsFloat ? Decode<double>(bytes)
        : type.IsSigned   ? Decode<std::int64_t>(bytes)
                          : Decode<std::uint64_t>(bytes);
  }
}

/// Converts without undefined behavior: damaged files contain values of any size.
template <typename T>
T Convert(double value)
{
  if (std::isnan(value))
  {
    return T(0);
  }
  const double low = static_cast<double>(std::numeric_limits<T>::lowest());
  const double high = static_cast<double>(std::numeric_limits<T>::max());
  return value <= low ? std::numeric_limits<T>::lowest()
    : value >= high   ? std::numeric_limits<T>::max()
                      : static_cast<T>(value);
}

}

int VtkType(const PlyType& type)
{
  switch (type.Size)
  {
    case 1:
      return type.IsSigned ? VTK_SIGNED_CHAR : VTK_UNSIGNED_CHAR;
    case 2:
      return type.IsSigned ? VTK_SHORT : VTK_UNSIGNED_SHORT;
    case 4:
      return type.IsFloat ? VTK_FLOAT : type.IsSigned ? VTK_INT : VTK_UNSIGNED_INT;
    default:
      return type.IsFloat ? VTK_DOUBLE : type.IsSigned ? VTK_LONG_LONG : VTK_UNSIGNED_LONG_LONG;
  }
}

PlyTarget::PlyTarget(vtkDataArray* array, int component)
  : Values(array->GetVoidPointer(0)),
    Stride(array->GetNumberOfComponents()),
    Component(component),
    Type(array->GetDataType())
{
}

void PlyTarget::Set(long long row, double value) const
{
  const long long index = row * this->Stride + this->Component;
  switch (this->Type)
  {
    case VTK_FLOAT:
      static_cast<float*>(this->Values)[index] = static_cast<float>(value);
      break;
    case VTK_DOUBLE:
      static_cast<double*>(this->Values)[index] = value;
      break;
    case VTK_SIGNED_CHAR:
      static_cast<signed char*>(this->Values)[index] = Convert<signed char>(value);
      break;
    case VTK_UNSIGNED_CHAR:
      static_cast<unsigned char*>(this->Values)[index] = Convert<unsigned char>(value);
      break;
    case VTK_SHORT:
      static_cast<short*>(this->Values)[index] = Convert<short>(value);
      break;
    case VTK_UNSIGNED_SHORT:
      static_cast<unsigned short*>(this->Values)[index] = Convert<unsigned short>(value);
      break;
    case VTK_INT:
      static_cast<int*>(this->Values)[index] = Convert<int>(value);
      break;
    case VTK_UNSIGNED_INT:
      static_cast<unsigned int*>(this->Values)[index] = Convert<unsigned int>(value);
      break;
    case VTK_LONG_LONG:
      static_cast<long long*>(this->Values)[index] = Convert<long long>(value);
      break;
    default:
      static_cast<unsigned long long*>(this->Values)[index] = Convert<unsigned long long>(value);
  }
}

PlyBody::PlyBody(const char* begin, const char* end, const PlyHeader& header)
  : IsAscii(header.IsAscii),
    IsBigEndian(header.IsBigEndian),
    Text(begin, end),
    At(begin),
    End(end)
{
}

std::size_t PlyBody::Left() const
{
  return this->IsAscii ? this->Text.Left() : static_cast<std::size_t>(this->End - this->At);
}

bool PlyBody::CanHold(const PlyElement& element) const
{
  double bytes = 0.0;
  for (const PlyProperty& property : element.Properties)
  {
    // An ASCII value is a digit and a separator.
    bytes += this->IsAscii ? 2 : property.IsList() ? property.Count.Size : property.Type.Size;
  }
  return bytes * static_cast<double>(element.Count) <= static_cast<double>(this->Left()) + 1.0;
}

PlyBody::Row PlyBody::ReadValue(const PlyType& type, double& value)
{
  if (this->IsAscii)
  {
    const std::string_view word = this->Text.Word();
    return word.empty() ? Row::Truncated : ParseNumber(word, value) ? Row::Complete : Row::Damaged;
  }
  if (this->End - this->At < type.Size)
  {
    return Row::Truncated;
  }
  if (this->IsBigEndian)
  {
    char bytes[8];
    std::reverse_copy(this->At, this->At + type.Size, bytes);
    value = Decode(type, bytes);
  }
  else
  {
    value = Decode(type, this->At);
  }
  this->At += type.Size;
  return Row::Complete;
}

PlyBody::Row PlyBody::ReadList(
  const PlyProperty& property, bool isWanted, std::vector<vtkIdType>& indices)
{
  double count = 0.0;
  Row result = this->ReadValue(property.Count, count);
  if (result != Row::Complete)
  {
    return result;
  }
  if (!(count >= 0.0))
  {
    return Row::Damaged;
  }
  const double bytes = this->IsAscii ? 2 : property.Type.Size;
  if (count * bytes > static_cast<double>(this->Left()) + 1.0)
  {
    return Row::Truncated;
  }
  const auto size = static_cast<std::size_t>(count);
  if (isWanted)
  {
    indices.resize(size);
  }
  for (std::size_t i = 0; i < size; ++i)
  {
    double value = 0.0;
    result = this->ReadValue(property.Type, value);
    if (result != Row::Complete)
    {
      return result;
    }
    if (isWanted)
    {
      indices[i] = Convert<vtkIdType>(value);
    }
  }
  return Row::Complete;
}

PlyBody::Row PlyBody::ReadRow(const PlyElement& element, long long row,
  const std::vector<PlyTarget>& targets, int list, std::vector<vtkIdType>& indices)
{
  for (std::size_t i = 0; i < element.Properties.size(); ++i)
  {
    const PlyProperty& property = element.Properties[i];
    double value = 0.0;
    const Row result = property.IsList()
      ? this->ReadList(property, static_cast<int>(i) == list, indices)
      : this->ReadValue(property.Type, value);
    if (result != Row::Complete)
    {
      return result;
    }
    if (!targets[i].IsEmpty())
    {
      targets[i].Set(row, value);
    }
  }
  if (this->IsAscii)
  {
    this->Text.Line(); // One row per line; more words are ignored.
  }
  return Row::Complete;
}

}
