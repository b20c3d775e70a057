// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "RenderedImages.h"

#include "vtkDataArray.h"
#include "vtkImageData.h"
#include "vtkImageReader2.h"
#include "vtkImageReader2Factory.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkXMLImageDataReader.h"

#include <cmath>

namespace penumbra_testing
{

vtkSmartPointer<vtkImageData> ReadImage(const std::string& path)
{
  if (path.size() > 4 && path.compare(path.size() - 4, 4, ".vti") == 0)
  {
    vtkNew<vtkXMLImageDataReader> reader;
    reader->SetFileName(path.c_str());
    reader->Update();
    return reader->GetOutput();
  }
  const auto reader = vtkSmartPointer<vtkImageReader2>::Take(
    vtkImageReader2Factory::CreateImageReader2(path.c_str()));
  if (!reader)
  {
    return vtkSmartPointer<vtkImageData>::New();
  }
  reader->SetFileName(path.c_str());
  reader->Update();
  return reader->GetOutput();
}

Pixel PixelAt(vtkImageData* image, int x, int y)
{
  vtkDataArray* color = image->GetPointData()->GetArray("Color");
  const double scale = color ? 1.0 : 1.0 / 255.0;
  color = color ? color : image->GetPointData()->GetScalars();
  const vtkIdType index = static_cast<vtkIdType>(y) * image->GetDimensions()[0] + x;
  return { color->GetComponent(index, 0) * scale, color->GetComponent(index, 1) * scale,
    color->GetComponent(index, 2) * scale };
}

double Compare(
  const std::string& a, const std::string& b, vtkPenumbraImageComparison::Metrics metric)
{
  vtkNew<vtkPenumbraImageComparison> comparison;
  comparison->SetImage(ReadImage(a));
  comparison->AddBaseline(ReadImage(b));
  return comparison->Compare() ? comparison->GetValue(metric) : std::nan("");
}

}
