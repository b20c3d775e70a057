// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "SceneExtractionColors.h"

#include "Annotation/OverlayPainter.h"
#include "Features/SceneFeatures.h"

#include "vtkActor.h"
#include "vtkCellArray.h"
#include "vtkDataSet.h"
#include "vtkFloatArray.h"
#include "vtkIdList.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationDoubleVectorKey.h"
#include "vtkInformationKeyLookup.h"
#include "vtkMatrix4x4.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkPolyDataMapper.h"
#include "vtkProp.h"
#include "vtkProperty.h"
#include "vtkTexture.h"
#include "vtkTransform.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace penumbra
{
namespace
{

Texture::WrapModes ConvertWrapMode(vtkTexture* texture)
{
  switch (texture->GetWrap())
  {
    case vtkTexture::ClampToEdge:
      return Texture::WrapModes::ClampToEdge;
    case vtkTexture::MirroredRepeat:
      return Texture::WrapModes::MirroredRepeat;
    case vtkTexture::ClampToBorder:
      return Texture::WrapModes::ClampToBorder;
    default:
      return Texture::WrapModes::Repeat;
  }
}

/// Returns the texture transform of `prop` as 16 numbers by rows, or null. The name of its key
/// changed in VTK 9.6.
const double* FindTextureTransform(vtkProp* prop)
{
  // vtkActor replaces the key by the transform of its texture when OpenGL renders it.
  auto* actor = vtkActor::SafeDownCast(prop);
  if (actor && actor->GetTexture() && actor->GetTexture()->GetTransform())
  {
    return &actor->GetTexture()->GetTransform()->GetMatrix()->Element[0][0];
  }
  vtkInformation* keys = prop->GetPropertyKeys();
  for (const char* name : { "GENERAL_TEXTURE_TRANSFORM", "GeneralTextureTransform" })
  {
    auto* key =
      vtkInformationDoubleVectorKey::SafeDownCast(vtkInformationKeyLookup::Find(name, "vtkProp"));
    if (keys && key && keys->Has(key) && key->Length(keys) == 16)
    {
      return key->Get(keys);
    }
  }
  return nullptr;
}

/// Assigns unwrapped texture coordinates to polygons. Each point has up to four versions: in either
/// direction, its coordinate is in [0, 1) or in [-0.5, 0.5).
class CoordinateUnwrapper
{
public:
  CoordinateUnwrapper(vtkPolyData* from, vtkPolyData* to, const bool seamless[2])
    : From(from->GetPointData()),
      To(to->GetPointData()),
      Seamless{ seamless[0], seamless[1] },
      Versions(from->GetNumberOfPoints(), { -1, -1, -1, -1 })
  {
    vtkNew<vtkPoints> points;
    points->SetDataType(from->GetPoints()->GetDataType());
    points->DeepCopy(from->GetPoints());
    to->SetPoints(points);
    this->Points = points;
    this->To->DeepCopy(this->From);
  }

  /// Replaces the points of a polygon.
  void Unwrap(vtkIdList* ids)
  {
    int version = 0;
    for (int k = 0; k < 2; ++k)
    {
      version |=
        this->Seamless[k] && this->Range(ids, k, 0.5) < this->Range(ids, k, 0.0) ? 1 << k : 0;
    }
    for (vtkIdType i = 0; i < ids->GetNumberOfIds(); ++i)
    {
      ids->SetId(i, this->FindPoint(ids->GetId(i), version));
    }
  }

private:
  static double Wrap(double x) { return x - std::floor(x); }

  double Range(vtkIdList* ids, int component, double offset)
  {
    double low = 1.0;
    double high = 0.0;
    for (vtkIdType i = 0; i < ids->GetNumberOfIds(); ++i)
    {
      const double x =
        Wrap(this->From->GetTCoords()->GetComponent(ids->GetId(i), component) + offset);
      low = std::min(low, x);
      high = std::max(high, x);
    }
    return high - low;
  }

  vtkIdType FindPoint(vtkIdType id, int version)
  {
    vtkIdType& copy = this->Versions[id][version];
    if (copy < 0)
    {
      double x[3];
      this->Points->GetPoint(id, x);
      copy = this->Points->InsertNextPoint(x);
      for (int a = 0; a < this->To->GetNumberOfArrays(); ++a)
      {
        this->To->GetAbstractArray(a)->InsertTuple(copy, id, this->From->GetAbstractArray(a));
      }
      for (int k = 0; k < 2; ++k)
      {
        const double offset = version & (1 << k) ? 0.5 : 0.0;
        const double value = this->From->GetTCoords()->GetComponent(id, k);
        this->To->GetTCoords()->SetComponent(
          copy, k, this->Seamless[k] ? Wrap(value + offset) - offset : value);
      }
    }
    return copy;
  }

  vtkPointData* From;
  vtkPointData* To;
  vtkPoints* Points = nullptr; ///< of the result, which owns it
  bool Seamless[2];
  std::vector<std::array<vtkIdType, 4>> Versions;
};

}

std::shared_ptr<Texture> MakeTexture(vtkUnsignedCharArray* colors, int width, int height)
{
  auto texture =
    std::make_shared<Texture>(colors ? ConvertTexels(colors, width, height) : Texture());
  return texture->Texels.empty() ? nullptr : texture;
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
      texture->Wrap = Texture::WrapModes::ClampToEdge;
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

std::shared_ptr<Texture> MakeTextureFace(
  vtkTexture* texture, int port, const std::string& name, std::vector<std::string>& warnings)
{
  if (texture->GetNumberOfInputConnections(port) > 0)
  {
    texture->GetInputAlgorithm(port, 0)->Update();
  }
  auto* image = vtkImageData::SafeDownCast(texture->GetInputDataObject(port, 0));
  vtkDataArray* scalars = image ? image->GetPointData()->GetScalars() : nullptr;
  if (!scalars)
  {
    WarnFeature(Feature::TextureCubeMap, name, warnings);
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
  result->Wrap = ConvertWrapMode(texture);
  const float* border = texture->GetBorderColor();
  result->BorderColor = { border[0], border[1], border[2], border[3] };
  result->IsSRGB = texture->GetUseSRGBColorSpace();
  return result;
}

std::shared_ptr<const Texture> MakeTexture(
  vtkTexture* texture, const std::string& name, std::vector<std::string>& warnings)
{
  if (!texture || !texture->GetInputAlgorithm())
  {
    return nullptr;
  }
  if (texture->GetCubeMap())
  {
    WarnFeature(Feature::TextureCubeMap, name, warnings);
    return nullptr;
  }
  return MakeTextureFace(texture, 0, name, warnings);
}

std::shared_ptr<const MaterialTextures> MakeMaterialTextures(
  vtkProperty* property, const std::string& name, std::vector<std::string>& warnings)
{
  auto textures = std::make_shared<MaterialTextures>();
  bool isAnySet = false;
  const auto make = [&](const char* key) {
    std::shared_ptr<const Texture> texture = MakeTexture(property->GetTexture(key), name, warnings);
    isAnySet |= texture != nullptr;
    return texture;
  };
  textures->Normal = make("normalTex");
  textures->OcclusionRoughnessMetallic = make("materialTex");
  textures->Emission = make("emissiveTex");
  textures->Anisotropy = make("anisotropyTex");
  textures->CoatNormal = make("coatNormalTex");
  return isAnySet ? textures : nullptr;
}

vtkSmartPointer<vtkPolyData> TransformTextureCoordinates(vtkPolyData* data, vtkProp* prop)
{
  const double* matrix = FindTextureTransform(prop);
  vtkDataArray* from = data->GetPointData()->GetTCoords();
  if (!matrix || !from)
  {
    return data;
  }
  vtkNew<vtkFloatArray> coordinates;
  coordinates->SetNumberOfComponents(2);
  coordinates->SetNumberOfTuples(from->GetNumberOfTuples());
  for (vtkIdType i = 0; i < from->GetNumberOfTuples(); ++i)
  {
    const double u = from->GetComponent(i, 0);
    const double v = from->GetNumberOfComponents() > 1 ? from->GetComponent(i, 1) : 0.0;
    const double w = matrix[12] * u + matrix[13] * v + matrix[15];
    coordinates->SetTuple2(i, (matrix[0] * u + matrix[1] * v + matrix[3]) / w,
      (matrix[4] * u + matrix[5] * v + matrix[7]) / w);
  }
  auto transformed = vtkSmartPointer<vtkPolyData>::New();
  transformed->ShallowCopy(data);
  transformed->GetPointData()->SetTCoords(coordinates);
  return transformed;
}

vtkSmartPointer<vtkPolyData> UnwrapTextureCoordinates(vtkPolyData* data, vtkMapper* mapper)
{
  auto* polygons = vtkPolyDataMapper::SafeDownCast(mapper);
  vtkDataArray* from = data->GetPointData()->GetTCoords();
  const bool seamless[2] = { polygons && polygons->GetSeamlessU(),
    polygons && polygons->GetSeamlessV() };
  if (!(seamless[0] || seamless[1]) || !from || from->GetNumberOfComponents() < 2)
  {
    return data;
  }
  auto unwrapped = vtkSmartPointer<vtkPolyData>::New();
  unwrapped->ShallowCopy(data);
  CoordinateUnwrapper unwrapper(data, unwrapped, seamless);
  vtkNew<vtkCellArray> cells;
  vtkNew<vtkIdList> ids;
  for (vtkIdType i = 0; i < data->GetPolys()->GetNumberOfCells(); ++i)
  {
    data->GetPolys()->GetCellAtId(i, ids);
    unwrapper.Unwrap(ids);
    cells->InsertNextCell(ids);
  }
  unwrapped->SetPolys(cells);
  return unwrapped;
}

}
