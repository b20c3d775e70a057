// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkPenumbraMedium.h"

#include "vtkDataArray.h"
#include "vtkImageData.h"
#include "vtkMatrix3x3.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"

#include <algorithm>
#include <cmath>

vtkStandardNewMacro(vtkPenumbraMedium);

vtkPenumbraMedium::vtkPenumbraMedium() = default;

vtkPenumbraMedium::~vtkPenumbraMedium() = default;

vtkCxxSetSmartPointerMacro(vtkPenumbraMedium, Density, vtkImageData);

vtkImageData* vtkPenumbraMedium::GetDensity()
{
  return this->Density;
}

vtkMTimeType vtkPenumbraMedium::GetMTime()
{
  const vtkMTimeType time = this->Superclass::GetMTime();
  return this->Density ? std::max(time, this->Density->GetMTime()) : time;
}

std::string vtkPenumbraMedium::FindInvalidDensity(vtkDataObject* data)
{
  vtkImageData* image = vtkImageData::SafeDownCast(data);
  if (!image)
  {
    return std::string("is a ") + (data ? data->GetClassName() : "null pointer") +
      ", not a vtkImageData";
  }
  for (int axis = 0; axis < 3; ++axis)
  {
    const double spacing = image->GetSpacing()[axis];
    if (image->GetDimensions()[axis] < 2 || !(spacing > 0.0) || !std::isfinite(spacing) ||
      !std::isfinite(image->GetOrigin()[axis]))
    {
      return "must have at least 2 points, a positive spacing and a finite origin on each axis";
    }
  }
  if (!image->GetDirectionMatrix()->IsIdentity())
  {
    return "is rotated by its direction matrix; resample it on the axes";
  }
  vtkDataArray* scalars = image->GetPointData()->GetScalars();
  if (!scalars)
  {
    return "has no point scalars";
  }
  if (scalars->GetNumberOfComponents() != 1)
  {
    return "has point scalars with " + std::to_string(scalars->GetNumberOfComponents()) +
      " components, not with one";
  }
  for (vtkIdType i = 0; i < scalars->GetNumberOfTuples(); ++i)
  {
    const double value = scalars->GetComponent(i, 0);
    if (!(value >= 0.0) || !std::isfinite(value))
    {
      return "has a negative or infinite value, or one that is not a number";
    }
  }
  return std::string();
}

const char* vtkPenumbraMedium::GetPhaseAsString()
{
  static const char* const names[] = { "Isotropic", "Rayleigh", "HenyeyGreenstein" };
  return names[this->Phase];
}

const char* vtkPenumbraMedium::GetSurfaceLightAsString()
{
  static const char* const names[] = { "Automatic", "Unattenuated", "Attenuated" };
  return names[this->SurfaceLight];
}

void vtkPenumbraMedium::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  const auto print = [&os, indent](const char* name, const double* numbers, int count) {
    os << indent << name << ":";
    std::for_each(numbers, numbers + count, [&os](double number) { os << " " << number; });
    os << "\n";
  };
  os << indent << "Scattering: " << this->Scattering << "\n";
  os << indent << "Extinction: " << this->Extinction << "\n";
  print("ScatteringColor", this->ScatteringColor, 3);
  print("ExtinctionColor", this->ExtinctionColor, 3);
  os << indent << "RayleighScattering: " << this->RayleighScattering << "\n";
  os << indent << "Phase: " << this->GetPhaseAsString() << "\n";
  os << indent << "Asymmetry: " << this->Asymmetry << "\n";
  print("Bounds", this->Bounds, 6);
  os << indent << "ScaleHeight: " << this->ScaleHeight << "\n";
  os << indent << "BaseHeight: " << this->BaseHeight << "\n";
  print("Up", this->Up, 3);
  os << indent << "Density: " << this->Density.Get() << "\n";
  os << indent << "SurfaceLight: " << this->GetSurfaceLightAsString() << "\n";
  os << indent << "TranslucentSurfaces: " << this->TranslucentSurfaces << "\n";
}
