// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "MeshArrays.h"

#include "MeshReaders.h"
#include "Processes/CommandError.h"

#include "vtkDataArray.h"
#include "vtkDataObject.h"
#include "vtkDataSetAttributes.h"
#include "vtkFieldData.h"
#include "vtkNew.h"
#include "vtkStringArray.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <cmath>

namespace penumbra
{

namespace
{

/// Returns the value of full intensity in components [first, end).
double FindWhite(vtkDataArray* colors, int first, int end)
{
  double largest = 0.0;
  for (int component = first; component < end; ++component)
  {
    double range[2];
    colors->GetFiniteRange(range, component);
    largest = std::max(largest, range[1]);
  }
  const bool floating = colors->GetDataType() == VTK_FLOAT || colors->GetDataType() == VTK_DOUBLE;
  if (floating && largest <= 1.0)
  {
    return 1.0;
  }
  return largest > 255.0 ? 65535.0 : 255.0;
}

}

void ThrowDamaged(const std::string& path, const std::string& reason)
{
  throw CommandError(BadInput, path + ": the file is damaged: " + reason + "; export it again");
}

void ThrowTruncated(const std::string& path, const std::string& item)
{
  throw CommandError(
    BadInput, path + ": the file is damaged: it ends before its last " + item + "; copy it again");
}

void AddUnread(vtkDataObject* data, const std::string& warning)
{
  vtkFieldData* fields = data->GetFieldData();
  auto warnings = vtkSmartPointer<vtkStringArray>(
    vtkStringArray::SafeDownCast(fields->GetAbstractArray(UnreadContent)));
  if (!warnings)
  {
    warnings = vtkSmartPointer<vtkStringArray>::New();
    warnings->SetName(UnreadContent);
    fields->AddArray(warnings);
  }
  warnings->InsertNextValue(warning);
}

void AddColors(vtkDataSetAttributes* attributes, vtkDataArray* colors)
{
  const int components = colors->GetNumberOfComponents();
  const vtkIdType tuples = colors->GetNumberOfTuples();
  const char* const name = components == 4 ? "RGBA" : "RGB";
  if (colors->GetDataType() == VTK_UNSIGNED_CHAR)
  {
    colors->SetName(name);
    attributes->SetScalars(colors);
    return;
  }
  // Opacity may have another range than the color.
  const double white = FindWhite(colors, 0, 3);
  const double opaque = components == 4 ? FindWhite(colors, 3, 4) : 1.0;
  vtkNew<vtkUnsignedCharArray> bytes;
  bytes->SetName(name);
  bytes->SetNumberOfComponents(components);
  bytes->SetNumberOfTuples(tuples);
  for (vtkIdType tuple = 0; tuple < tuples; ++tuple)
  {
    for (int component = 0; component < components; ++component)
    {
      const double value =
        colors->GetComponent(tuple, component) / (component < 3 ? white : opaque);
      const double clamped = std::isnan(value) ? 0.0 : std::clamp(value, 0.0, 1.0);
      bytes->SetTypedComponent(
        tuple, component, static_cast<unsigned char>(std::lround(255.0 * clamped)));
    }
  }
  attributes->SetScalars(bytes);
}

}
