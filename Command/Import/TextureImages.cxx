// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "TextureImages.h"

#include "vtkActor.h"
#include "vtkDataArray.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkProperty.h"
#include "vtkTexture.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>

namespace penumbra
{

void ConvertToBytes(vtkTexture* texture)
{
  if (!texture || !texture->GetInputAlgorithm())
  {
    return;
  }
  texture->GetInputAlgorithm()->Update();
  vtkImageData* image = texture->GetInput();
  vtkDataArray* values = image ? image->GetPointData()->GetScalars() : nullptr;
  if (!values || values->GetDataType() == VTK_UNSIGNED_CHAR)
  {
    return;
  }
  const bool isFloat = values->GetDataType() == VTK_FLOAT || values->GetDataType() == VTK_DOUBLE;
  const double scale = 255.0 / (isFloat ? 1.0 : values->GetDataTypeMax());
  vtkNew<vtkUnsignedCharArray> bytes;
  bytes->SetName(values->GetName());
  bytes->SetNumberOfComponents(values->GetNumberOfComponents());
  bytes->SetNumberOfTuples(values->GetNumberOfTuples());
  for (vtkIdType i = 0; i < values->GetNumberOfTuples(); ++i)
  {
    for (int c = 0; c < values->GetNumberOfComponents(); ++c)
    {
      // NaN becomes 0.
      const double value = std::min(std::max(0.0, scale * values->GetComponent(i, c)), 255.0);
      bytes->SetTypedComponent(i, c, static_cast<unsigned char>(value + 0.5));
    }
  }
  vtkNew<vtkImageData> converted;
  converted->CopyStructure(image);
  converted->GetPointData()->SetScalars(bytes);
  texture->SetInputData(converted);
}

void ConvertTexturesToBytes(vtkActor* actor)
{
  ConvertToBytes(actor->GetTexture());
  for (const auto& entry : actor->GetProperty()->GetAllTextures())
  {
    ConvertToBytes(entry.second);
  }
}

}
