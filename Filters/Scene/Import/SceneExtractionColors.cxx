// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "SceneExtractionColors.h"

#include "vtkDataSet.h"
#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkTexture.h"

namespace penumbra
{
namespace
{

/// Converts texels with 1 to 4 components (luminance, luminance and alpha, RGB, RGBA) to RGBA.
std::vector<glm::u8vec4> MakeTexels(vtkUnsignedCharArray* from, std::size_t count)
{
  const int components = from->GetNumberOfComponents();
  std::vector<glm::u8vec4> texels(count);
  for (std::size_t i = 0; i < count; ++i)
  {
    const unsigned char* c = from->GetPointer(static_cast<vtkIdType>(i) * components);
    const bool gray = components < 3;
    const bool alpha = components % 2 == 0;
    texels[i] = { c[0], gray ? c[0] : c[1], gray ? c[0] : c[2],
      alpha ? c[components - 1] : static_cast<unsigned char>(255) };
  }
  return texels;
}

std::shared_ptr<Texture> MakeTexture(vtkUnsignedCharArray* colors, int width, int height)
{
  const auto count = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  if (!colors || count == 0 || static_cast<std::size_t>(colors->GetNumberOfTuples()) < count)
  {
    return nullptr;
  }
  auto texture = std::make_shared<Texture>();
  texture->Width = width;
  texture->Height = height;
  texture->Texels = MakeTexels(colors, count);
  return texture;
}

}

vtkStandardNewMacro(ScalarMapper);

int ScalarMapper::FillInputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkDataSet");
  return 1;
}

Coloring ScalarMapper::Map(vtkDataSet* data)
{
  Coloring result;
  this->SetInputDataObject(data);
  int association = 0;
  result.Colors = this->MapScalars(data, 1.0, association);
  vtkImageData* map = this->GetColorTextureMap();
  result.Coordinates = this->GetColorCoordinates();
  if (map && result.Coordinates)
  {
    int size[3];
    map->GetDimensions(size);
    auto texture = MakeTexture(
      vtkUnsignedCharArray::SafeDownCast(map->GetPointData()->GetScalars()), size[0], size[1]);
    if (texture && result.Coordinates->GetNumberOfTuples() >= data->GetNumberOfPoints())
    {
      texture->Repeat = false;
      result.Map = texture;
      result.Mode = Coloring::Modes::Texture;
    }
    return result;
  }
  if (!result.Colors || result.Colors->GetNumberOfComponents() != 4)
  {
    return result;
  }
  const vtkIdType count = result.Colors->GetNumberOfTuples();
  const vtkIdType tuple = this->GetFieldDataTupleId();
  if (association == 2 && tuple >= 0 && tuple < count)
  {
    const unsigned char* c = result.Colors->GetPointer(4 * tuple);
    result.SingleColor = { c[0], c[1], c[2], c[3] };
    result.Mode = Coloring::Modes::Single;
  }
  else if (association == 0 && count >= data->GetNumberOfPoints())
  {
    result.Mode = Coloring::Modes::PerPoint;
  }
  else if (association != 0 && count >= data->GetNumberOfCells())
  {
    result.Mode = Coloring::Modes::PerCell;
  }
  return result;
}

vtkDataArray* ScalarMapper::FindArray(vtkAlgorithm* algorithm, int which, vtkDataSet* data)
{
  this->SetInputArrayToProcess(which, algorithm->GetInputArrayInformation(which));
  return this->GetInputArrayToProcess(which, data);
}

std::shared_ptr<const Texture> MakeTexture(
  vtkTexture* texture, const std::string& name, std::vector<std::string>& warnings)
{
  if (!texture || !texture->GetInputAlgorithm())
  {
    return nullptr;
  }
  texture->GetInputAlgorithm()->Update();
  vtkImageData* image = texture->GetInput();
  vtkDataArray* scalars = image ? image->GetPointData()->GetScalars() : nullptr;
  if (!scalars || texture->GetCubeMap())
  {
    warnings.push_back(name +
      ": the texture was ignored because it is a cube map or its image has no point scalars.");
    return nullptr;
  }
  int size[3];
  image->GetDimensions(size);
  const bool direct = texture->GetColorMode() != VTK_COLOR_MODE_MAP_SCALARS &&
    scalars->GetDataType() == VTK_UNSIGNED_CHAR && scalars->GetNumberOfComponents() >= 3;
  vtkUnsignedCharArray* colors = vtkUnsignedCharArray::SafeDownCast(scalars);
  if (!direct)
  {
    texture->MapScalarsToColors(scalars);
    colors = texture->GetMappedScalars();
  }
  // The image may lie in any coordinate plane; its size is given by the dimensions greater than 1.
  const int width = size[0] > 1 ? size[0] : size[1];
  const int height = size[0] > 1 && size[1] > 1 ? size[1] : size[2];
  auto result = MakeTexture(colors, width, height);
  if (!result)
  {
    warnings.push_back(name + ": the texture was ignored because its image is empty.");
    return nullptr;
  }
  result->Interpolate = texture->GetInterpolate();
  result->Repeat = texture->GetRepeat();
  return result;
}

}
