// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "SceneExtractionProps.h"

#include "Annotation/SceneExtractionOverlay.h"
#include "CollectionItems.h"
#include "Scene.h"
#include "SceneExtractionColors.h"

#include "vtkActor.h"
#include "vtkAnnotatedCubeActor.h"
#include "vtkAssembly.h"
#include "vtkAxesActor.h"
#include "vtkBillboardTextActor3D.h"
#include "vtkCameraActor.h"
#include "vtkCellArray.h"
#include "vtkDataArray.h"
#include "vtkFloatArray.h"
#include "vtkImageActor.h"
#include "vtkImageData.h"
#include "vtkImageProperty.h"
#include "vtkImageSliceMapper.h"
#include "vtkLODProp3D.h"
#include "vtkLight.h"
#include "vtkLightActor.h"
#include "vtkNew.h"
#include "vtkPlane.h"
#include "vtkPlaneCollection.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkPropCollection.h"
#include "vtkRenderer.h"
#include "vtkScalarsToColors.h"
#include "vtkTextActor3D.h"
#include "vtkTextProperty.h"
#include "vtkWidgetRepresentation.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace penumbra
{
namespace
{

/// Rectangle of an image in its index coordinates: axes U and V, position on the third axis.
struct SliceRectangle
{
  int U = 0;
  int V = 1;
  std::array<int, 6> Extent{};    ///< pixels of the slice; both ends are equal on the third axis
  std::array<double, 2> Margin{}; ///< distance of the border from the outermost pixel centers
};

/// Calls vtkAxesActor::UpdateProps(), which sets the transforms of the parts.
struct AxesAccess : public vtkAxesActor
{
  static void Update(vtkAxesActor* axes) { (axes->*(&AxesAccess::UpdateProps))(); }
};

/// Updates and reads the parts of a vtkCameraActor, which have no public accessor.
struct CameraAccess : public vtkCameraActor
{
  static vtkProp* FindPart(vtkCameraActor* actor)
  {
    (actor->*(&CameraAccess::UpdateViewProps))();
    return actor->*(&CameraAccess::FrustumActor);
  }
};

/// The same for the cone and the frustum of a spotlight.
struct LightAccess : public vtkLightActor
{
  static std::array<vtkProp*, 2> FindParts(vtkLightActor* actor)
  {
    (actor->*(&LightAccess::UpdateViewProps))();
    return { actor->*(&LightAccess::ConeActor), actor->*(&LightAccess::FrustumActor) };
  }
};

/// Reads the levels of a vtkLODProp3D, which have no public accessor by index.
struct LevelAccess : public vtkLODProp3D
{
  static vtkProp3D* FindBest(vtkLODProp3D* prop)
  {
    const vtkLODProp3DEntry* levels = prop->*(&LevelAccess::LODs);
    const int count = prop->*(&LevelAccess::NumberOfEntries);
    const vtkLODProp3DEntry* best = nullptr;
    for (int i = 0; i < count; ++i)
    {
      const vtkLODProp3DEntry& level = levels[i];
      if (!level.Prop3D || level.ID < 0)
      {
        continue;
      }
      if (!prop->GetAutomaticLODSelection())
      {
        best = level.ID == prop->GetSelectedLODID() ? &level : best;
        continue;
      }
      // VTK chooses between equal levels by measured times, which vary.
      best = level.State && (!best || level.Level < best->Level) ? &level : best;
    }
    return best ? best->Prop3D : nullptr;
  }
};

vtkSmartPointer<vtkPolyData> MakeRectangle(
  const std::array<glm::dvec3, 4>& corners, const std::array<glm::dvec2, 4>& coordinates)
{
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkFloatArray> textureCoordinates;
  textureCoordinates->SetNumberOfComponents(2);
  for (std::size_t i = 0; i < 4; ++i)
  {
    points->InsertNextPoint(corners[i].x, corners[i].y, corners[i].z);
    textureCoordinates->InsertNextTuple2(coordinates[i].x, coordinates[i].y);
  }
  vtkNew<vtkCellArray> cells;
  const vtkIdType ids[4] = { 0, 1, 2, 3 };
  cells->InsertNextCell(4, ids);
  auto data = vtkSmartPointer<vtkPolyData>::New();
  data->SetPoints(points);
  data->SetPolys(cells);
  data->GetPointData()->SetTCoords(textureCoordinates);
  return data;
}

/// Returns a white material whose color is that of the texture.
vtkSmartPointer<vtkProperty> MakeUnlitProperty()
{
  auto property = vtkSmartPointer<vtkProperty>::New();
  property->SetColor(1.0, 1.0, 1.0);
  property->SetAmbient(1.0);
  property->SetDiffuse(0.0);
  return property;
}

vtkSmartPointer<vtkPolyData> MakeRectangle(vtkImageData* image, const SliceRectangle& slice)
{
  const int axes[2] = { slice.U, slice.V };
  std::array<glm::dvec3, 4> corners;
  std::array<glm::dvec2, 4> coordinates;
  for (int i = 0; i < 4; ++i)
  {
    const int isHigh[2] = { i == 1 || i == 2, i >= 2 };
    double index[3] = { static_cast<double>(slice.Extent[0]), static_cast<double>(slice.Extent[2]),
      static_cast<double>(slice.Extent[4]) };
    for (int k = 0; k < 2; ++k)
    {
      const int low = slice.Extent[2 * axes[k]];
      const int high = slice.Extent[2 * axes[k] + 1];
      index[axes[k]] = isHigh[k] ? high + slice.Margin[k] : low - slice.Margin[k];
      coordinates[i][k] = (index[axes[k]] - low + 0.5) / (high - low + 1);
    }
    image->TransformContinuousIndexToPhysicalPoint(index, &corners[i].x);
  }
  return MakeRectangle(corners, coordinates);
}

/// Maps values of an image to RGBA, as vtkImageMapper3D does.
class ImageColors
{
public:
  explicit ImageColors(vtkImageProperty* property)
  {
    if (!property)
    {
      return;
    }
    this->Low = property->GetColorLevel() - 0.5 * property->GetColorWindow();
    this->Window = property->GetColorWindow();
    this->Table = property->GetLookupTable();
    this->UsesTableRange = property->GetUseLookupTableScalarRange();
  }

  glm::u8vec4 Map(const double* value, int components) const
  {
    if (components == 1 && this->Table)
    {
      double x = value[0];
      const double* range = this->Table->GetRange();
      if (!this->UsesTableRange)
      {
        x = range[0] + (x - this->Low) / this->Window * (range[1] - range[0]);
      }
      const unsigned char* c = this->Table->MapValue(x);
      return { c[0], c[1], c[2], c[3] };
    }
    const auto level = [&](int i) { return ToByte((value[i] - this->Low) / this->Window); };
    const bool isGray = components < 3;
    return { level(0), isGray ? level(0) : level(1), isGray ? level(0) : level(2),
      components % 2 == 0 ? ToByte(value[components - 1] / 255.0)
                          : static_cast<unsigned char>(255) };
  }

private:
  static unsigned char ToByte(double x)
  {
    return static_cast<unsigned char>(std::lround(255.0 * std::min(std::max(x, 0.0), 1.0)));
  }

  double Low = 0.0;
  double Window = 255.0;
  vtkScalarsToColors* Table = nullptr;
  bool UsesTableRange = false;
};

std::shared_ptr<Texture> MakeSliceTexture(
  vtkImageData* image, const SliceRectangle& slice, vtkImageProperty* property)
{
  vtkDataArray* scalars = image->GetPointData()->GetScalars();
  const int components = scalars ? scalars->GetNumberOfComponents() : 0;
  if (components < 1 || components > 4)
  {
    return nullptr;
  }
  const ImageColors colors(property);
  auto texture = std::make_shared<Texture>();
  texture->Width = slice.Extent[2 * slice.U + 1] - slice.Extent[2 * slice.U] + 1;
  texture->Height = slice.Extent[2 * slice.V + 1] - slice.Extent[2 * slice.V] + 1;
  texture->Interpolate = !property || property->GetInterpolationType() != VTK_NEAREST_INTERPOLATION;
  texture->Wrap = Texture::WrapModes::ClampToEdge;
  texture->Texels.reserve(static_cast<std::size_t>(texture->Width) * texture->Height);
  int index[3] = { slice.Extent[0], slice.Extent[2], slice.Extent[4] };
  for (int j = 0; j < texture->Height; ++j)
  {
    for (int i = 0; i < texture->Width; ++i)
    {
      index[slice.U] = slice.Extent[2 * slice.U] + i;
      index[slice.V] = slice.Extent[2 * slice.V] + j;
      double value[4];
      scalars->GetTuple(image->ComputePointId(index), value);
      texture->Texels.push_back(colors.Map(value, components));
    }
  }
  return texture;
}

/// Finds the pixels that an image slice shows. Returns false if there are none.
bool FindSlice(vtkImageSlice* prop, vtkImageSliceMapper* mapper, SliceRectangle& slice)
{
  vtkImageData* image = mapper->GetInput();
  std::copy_n(image->GetExtent(), 6, slice.Extent.begin());
  const auto clip = [&](const int* extent) {
    for (int k = 0; k < 3; ++k)
    {
      slice.Extent[2 * k] = std::max(slice.Extent[2 * k], extent[2 * k]);
      slice.Extent[2 * k + 1] = std::min(slice.Extent[2 * k + 1], extent[2 * k + 1]);
    }
  };
  int normal = mapper->GetOrientation();
  if (auto* actor = vtkImageActor::SafeDownCast(prop))
  {
    const int* extent = actor->GetDisplayExtent();
    if (extent[0] <= extent[1])
    {
      clip(extent);
    }
    normal = slice.Extent[4] == slice.Extent[5] ? 2
      : slice.Extent[2] == slice.Extent[3]      ? 1
      : slice.Extent[0] == slice.Extent[1]      ? 0
                                                : 2;
    slice.Extent[2 * normal + 1] = slice.Extent[2 * normal];
  }
  else
  {
    if (mapper->GetCropping())
    {
      clip(mapper->GetCroppingRegion());
    }
    const int number = std::min(
      std::max(mapper->GetSliceNumber(), slice.Extent[2 * normal]), slice.Extent[2 * normal + 1]);
    slice.Extent[2 * normal] = slice.Extent[2 * normal + 1] = number;
  }
  slice.U = normal == 0 ? 1 : 0;
  slice.V = normal == 2 ? 1 : 2;
  slice.Margin.fill(mapper->GetBorder() ? 0.5 : 0.0);
  return slice.Extent[0] <= slice.Extent[1] && slice.Extent[2] <= slice.Extent[3] &&
    slice.Extent[4] <= slice.Extent[5];
}

void MakeImageSlice(vtkImageSlice* prop, vtkImageSliceMapper* mapper, DrawItem& item)
{
  mapper->Update();
  SliceRectangle slice;
  if (!mapper->GetInput() || !FindSlice(prop, mapper, slice))
  {
    return;
  }
  item.LitTexture = MakeSliceTexture(mapper->GetInput(), slice, prop->GetProperty());
  item.Property = MakeUnlitProperty();
  if (vtkImageProperty* property = prop->GetProperty())
  {
    item.Property->SetOpacity(property->GetOpacity());
    item.Property->SetAmbient(property->GetAmbient());
    item.Property->SetDiffuse(property->GetDiffuse());
  }
  if (item.LitTexture)
  {
    item.Data = MakeRectangle(mapper->GetInput(), slice);
  }
}

SliceRectangle WholeImage(vtkImageData* image)
{
  SliceRectangle slice;
  std::copy_n(image->GetExtent(), 6, slice.Extent.begin());
  return slice;
}

void MakeText3D(vtkTextActor3D* prop, DrawItem& item)
{
  glm::ivec2 corner;
  vtkSmartPointer<vtkImageData> image =
    RenderText(prop->GetInput(), prop->GetTextProperty(), vtkTextActor3D::GetRenderedDPI(), corner);
  if (!image)
  {
    return;
  }
  image->SetOrigin(corner.x, corner.y, 0.0);
  image->SetSpacing(1.0, 1.0, 1.0);
  const SliceRectangle slice = WholeImage(image);
  item.LitTexture = MakeSliceTexture(image, slice, nullptr);
  item.Property = MakeUnlitProperty();
  item.Data = MakeRectangle(image, slice);
}

/// Returns the corners of a rectangle of pixels at the depth of a point, in world coordinates.
std::array<glm::dvec3, 4> UnprojectRectangle(
  const Scene& scene, glm::dvec2 low, glm::dvec2 high, double depth)
{
  const Camera& camera = scene.ViewCamera;
  std::array<glm::dvec3, 4> corners;
  for (int i = 0; i < 4; ++i)
  {
    const glm::dvec2 p(i == 1 || i == 2 ? high.x : low.x, i >= 2 ? high.y : low.y);
    corners[static_cast<std::size_t>(i)] = scene.ToWorld(
      camera.RayOrigin(p) + (depth - camera.DepthOfRayOrigins()) * camera.RayDirection(p));
  }
  return corners;
}

}

bool CollectParts(vtkProp* prop, vtkPropCollection* parts)
{
  if (auto* axes = vtkAxesActor::SafeDownCast(prop))
  {
    AxesAccess::Update(axes);
    axes->GetActors(parts);
    return true;
  }
  if (auto* cube = vtkAnnotatedCubeActor::SafeDownCast(prop))
  {
    parts->AddItem(cube->GetAssembly());
    return true;
  }
  if (auto* camera = vtkCameraActor::SafeDownCast(prop))
  {
    if (vtkProp* part = camera->GetCamera() ? CameraAccess::FindPart(camera) : nullptr)
    {
      parts->AddItem(part);
    }
    return true;
  }
  if (auto* light = vtkLightActor::SafeDownCast(prop))
  {
    // Only spotlights are shown.
    vtkLight* shown = light->GetLight();
    if (shown && shown->GetPositional() && shown->GetConeAngle() < 180.0)
    {
      for (vtkProp* part : LightAccess::FindParts(light))
      {
        if (part)
        {
          parts->AddItem(part);
        }
      }
    }
    return true;
  }
  if (prop->IsA("vtkCameraOrientationRepresentation"))
  {
    auto* widget = vtkWidgetRepresentation::SafeDownCast(prop);
    widget->BuildRepresentation();
    widget->GetActors(parts);
    return true;
  }
  return false;
}

vtkProp3D* FindBestLevel(vtkLODProp3D* prop)
{
  return LevelAccess::FindBest(prop);
}

bool MakeTexturedProp(
  vtkProp* prop, const glm::dmat4& toWorld, DrawItem& item, std::vector<std::string>&)
{
  item.ToWorld = toWorld;
  if (auto* text = vtkTextActor3D::SafeDownCast(prop))
  {
    MakeText3D(text, item);
    return true;
  }
  auto* slice = vtkImageSlice::SafeDownCast(prop);
  auto* mapper = slice ? vtkImageSliceMapper::SafeDownCast(slice->GetMapper()) : nullptr;
  if (!mapper)
  {
    return false;
  }
  MakeImageSlice(slice, mapper, item);
  return true;
}

bool IsBillboard(vtkProp* prop)
{
  return vtkBillboardTextActor3D::SafeDownCast(prop) != nullptr;
}

std::vector<DrawItem> MakeBillboards(
  vtkRenderer* renderer, int dpi, int firstObject, const Scene& scene)
{
  std::vector<DrawItem> items;
  for (vtkProp* prop : GetItems<vtkProp>(renderer->GetViewProps()))
  {
    auto* text = vtkBillboardTextActor3D::SafeDownCast(prop);
    if (!text || !text->GetVisibility())
    {
      continue;
    }
    const glm::dvec3 anchor = scene.FromWorld(text->GetPosition());
    const double depth = scene.ViewCamera.Depth(anchor);
    glm::ivec2 corner;
    vtkSmartPointer<vtkImageData> image =
      RenderText(text->GetInput(), text->GetTextProperty(), dpi, corner);
    if (!image || !(depth > scene.ViewCamera.Near))
    {
      continue;
    }
    const SliceRectangle slice = WholeImage(image);
    const int* offset = text->GetDisplayOffset();
    const glm::dvec2 low = glm::floor(scene.ViewCamera.Project(anchor)) +
      glm::dvec2(corner.x + offset[0], corner.y + offset[1]);
    DrawItem item;
    item.ObjectId = firstObject + static_cast<int>(items.size());
    item.Name = "Object " + std::to_string(item.ObjectId);
    item.LitTexture = MakeSliceTexture(image, slice, nullptr);
    if (!item.LitTexture)
    {
      continue;
    }
    const glm::dvec2 size(item.LitTexture->Width, item.LitTexture->Height);
    item.Data = MakeRectangle(UnprojectRectangle(scene, low, low + size, depth),
      { glm::dvec2(0.0, 0.0), { 1.0, 0.0 }, { 1.0, 1.0 }, { 0.0, 1.0 } });
    item.Property = vtkSmartPointer<vtkProperty>::New(); // lit: VTK's rectangle is an actor
    items.push_back(std::move(item));
  }
  return items;
}

}
