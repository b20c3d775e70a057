// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkPenumbraEnvironment.h"

#include "Shading/EnvironmentMap.h"

#include "vtkDataArray.h"
#include "vtkImageData.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

vtkStandardNewMacro(vtkPenumbraEnvironment);

namespace
{

/// Converts an sRGB value in [0, 1] to a linear value (IEC 61966-2-1).
double LinearizeSRGB(double value)
{
  return value <= .04045 ? value / 12.92 : std::pow((value + .055) / 1.055, 2.4);
}

/// Returns the largest value of an integer type, which stands for radiance 1, or 0 for
/// floating-point types.
double GetIntegerMaximum(vtkDataArray* values)
{
  const int type = values->GetDataType();
  return type == VTK_FLOAT || type == VTK_DOUBLE ? 0.0 : values->GetDataTypeMax();
}

/// Returns the radiances of an image. Throws std::runtime_error if the image is missing or invalid.
std::vector<glm::vec3> ReadRadiances(vtkImageData* image, double intensity)
{
  vtkDataArray* values = image ? image->GetPointData()->GetScalars() : nullptr;
  const int* size = image ? image->GetDimensions() : nullptr;
  if (!values || size[0] < 1 || size[1] < 1 || size[2] != 1)
  {
    throw std::runtime_error(
      "vtkPenumbraEnvironment: Image must be set to a single slice with point scalars.");
  }
  const double maximum = GetIntegerMaximum(values);
  const int components = values->GetNumberOfComponents();
  std::vector<glm::vec3> radiances;
  radiances.reserve(values->GetNumberOfTuples());
  for (vtkIdType i = 0; i < values->GetNumberOfTuples(); ++i)
  {
    glm::dvec3 color;
    for (int c = 0; c < 3; ++c)
    {
      const double value = values->GetComponent(i, components < 3 ? 0 : c);
      color[c] = intensity * (maximum > 0.0 ? LinearizeSRGB(value / maximum) : value);
      if (!(color[c] >= 0.0 && color[c] < 1e30))
      {
        throw std::runtime_error("vtkPenumbraEnvironment: the values of Image must be finite and "
                                 "not negative.");
      }
    }
    radiances.emplace_back(color);
  }
  return radiances;
}

}

vtkPenumbraEnvironment::vtkPenumbraEnvironment() = default;
vtkPenumbraEnvironment::~vtkPenumbraEnvironment() = default;

vtkCxxSetSmartPointerMacro(vtkPenumbraEnvironment, Image, vtkImageData);

vtkImageData* vtkPenumbraEnvironment::GetImage()
{
  return this->Image;
}

vtkMTimeType vtkPenumbraEnvironment::GetMTime()
{
  const vtkMTimeType time = this->Superclass::GetMTime();
  return this->Image ? std::max(time, this->Image->GetMTime()) : time;
}

std::shared_ptr<const penumbra::EnvironmentMap> vtkPenumbraEnvironment::GetMap()
{
  const vtkMTimeType time = this->GetMTime();
  if (!this->Map || this->MapTime != time)
  {
    const glm::dvec3 up(this->Up[0], this->Up[1], this->Up[2]);
    glm::dvec3 right(this->Right[0], this->Right[1], this->Right[2]);
    const double length = glm::length(up);
    if (!(length > 0.0 && std::isfinite(length)))
    {
      throw std::runtime_error("vtkPenumbraEnvironment: Up must be a finite, nonzero vector.");
    }
    const glm::dvec3 unit = up / length;
    right -= glm::dot(right, unit) * unit;
    if (!(glm::length(right) > 1e-6) || !std::isfinite(glm::length(right)))
    {
      const glm::dvec3 other = std::abs(unit.z) < .9 ? glm::dvec3(0, 0, 1) : glm::dvec3(1, 0, 0);
      right = glm::cross(unit, other);
    }
    std::vector<glm::vec3> radiances = ReadRadiances(this->Image, this->Intensity);
    const int* size = this->Image->GetDimensions();
    this->Map = std::make_shared<penumbra::EnvironmentMap>(
      size[0], size[1], std::move(radiances), unit, glm::normalize(right));
    this->MapTime = time;
  }
  return this->Map;
}

void vtkPenumbraEnvironment::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Image: " << this->Image.Get() << "\n";
  os << indent << "Intensity: " << this->Intensity << "\n";
  os << indent << "Up: " << this->Up[0] << " " << this->Up[1] << " " << this->Up[2] << "\n";
  os << indent << "Right: " << this->Right[0] << " " << this->Right[1] << " " << this->Right[2]
     << "\n";
}
