// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "PlyFile.h"

#include "vtkDataArray.h"
#include "vtkSetGet.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <map>
#include <type_traits>

namespace penumbra
{

namespace
{

/// Returns a VTK type; VTK_VOID: unknown.
int TypeOf(std::string_view name)
{
  static const std::map<std::string_view, int> types = { { "char", VTK_SIGNED_CHAR },
    { "int8", VTK_SIGNED_CHAR }, { "uchar", VTK_UNSIGNED_CHAR }, { "uint8", VTK_UNSIGNED_CHAR },
    { "short", VTK_SHORT }, { "int16", VTK_SHORT }, { "ushort", VTK_UNSIGNED_SHORT },
    { "uint16", VTK_UNSIGNED_SHORT }, { "int", VTK_INT }, { "int32", VTK_INT },
    { "uint", VTK_UNSIGNED_INT }, { "uint32", VTK_UNSIGNED_INT }, { "int64", VTK_LONG_LONG },
    { "long", VTK_LONG_LONG }, { "uint64", VTK_UNSIGNED_LONG_LONG },
    { "ulong", VTK_UNSIGNED_LONG_LONG }, { "float", VTK_FLOAT }, { "float32", VTK_FLOAT },
    { "double", VTK_DOUBLE }, { "float64", VTK_DOUBLE } };
  const auto found = types.find(name);
  return found == types.end() ? VTK_VOID : found->second;
}

bool ParseElement(TextScanner& line, PlyHeader& header)
{
  PlyElement element;
  element.Name = line.WordInLine();
  header.Elements.push_back(element);
  long long& count = header.Elements.back().Count;
  return ParseInteger(line.WordInLine(), count) && count >= 0;
}

bool ParseProperty(TextScanner& line, PlyHeader& header)
{
  PlyProperty property;
  std::string_view type = line.WordInLine();
  const bool isList = type == "list";
  if (isList)
  {
    property.Count = TypeOf(line.WordInLine());
    type = line.WordInLine();
  }
  property.Type = TypeOf(type);
  property.Name = line.WordInLine();
  if (property.Name.empty() || header.Elements.empty() || property.Type == VTK_VOID ||
    (isList && property.Count == VTK_VOID) || property.Count == VTK_FLOAT ||
    property.Count == VTK_DOUBLE)
  {
    return false;
  }
  header.Elements.back().Properties.push_back(property);
  return true;
}

bool ParseFormat(TextScanner& line, PlyHeader& header)
{
  const std::string_view format = line.WordInLine();
  header.IsAscii = format == "ascii";
  header.IsBigEndian = format == "binary_big_endian";
  return header.IsAscii || header.IsBigEndian || format == "binary_little_endian";
}

template <typename T>
double Decode(const char* bytes)
{
  T value;
  std::memcpy(&value, bytes, sizeof(T));
  return static_cast<double>(value);
}

double Decode(int type, const char* bytes)
{
  switch (type)
  {
    vtkTemplateMacro(return Decode<VTK_TT>(bytes));
    default:
      return 0.0;
  }
}

/// Converts without undefined behavior: damaged files contain values of any size.
template <typename T>
T Convert(double value)
{
  if (std::is_floating_point<T>::value)
  {
    return static_cast<T>(value);
  }
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

bool ParsePlyHeader(const char* begin, const char* end, PlyHeader& header)
{
  TextScanner text(begin, end);
  if (text.WordInLine() != "ply")
  {
    return false;
  }
  text.Line();
  bool valid = false;
  while (!text.AtEnd())
  {
    const std::string_view keyword = text.WordInLine();
    if (keyword == "end_header")
    {
      text.Line();
      header.Size = static_cast<std::size_t>(text.Rest() - begin);
      return valid;
    }
    if (keyword == "format")
    {
      valid = ParseFormat(text, header);
    }
    if ((keyword == "element" && !ParseElement(text, header)) ||
      (keyword == "property" && !ParseProperty(text, header)))
    {
      return false;
    }
    text.Line();
  }
  return false;
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
    vtkTemplateMacro(static_cast<VTK_TT*>(this->Values)[index] = Convert<VTK_TT>(value));
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
    bytes += this->IsAscii ? 2
      : property.IsList()  ? vtkDataArray::GetDataTypeSize(property.Count)
                           : vtkDataArray::GetDataTypeSize(property.Type);
  }
  return bytes * static_cast<double>(element.Count) <= static_cast<double>(this->Left()) + 1.0;
}

PlyBody::Row PlyBody::ReadValue(int type, double& value)
{
  if (this->IsAscii)
  {
    const std::string_view word = this->Text.Word();
    return word.empty() ? Row::Truncated : ParseNumber(word, value) ? Row::Complete : Row::Damaged;
  }
  const int size = vtkDataArray::GetDataTypeSize(type);
  if (this->End - this->At < size)
  {
    return Row::Truncated;
  }
  if (this->IsBigEndian)
  {
    char bytes[8];
    std::reverse_copy(this->At, this->At + size, bytes);
    value = Decode(type, bytes);
  }
  else
  {
    value = Decode(type, this->At);
  }
  this->At += size;
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
  const double bytes = this->IsAscii ? 2 : vtkDataArray::GetDataTypeSize(property.Type);
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
