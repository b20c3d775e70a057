// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "SceneExtractionSplats.h"

#include "Features/SceneFeatures.h"
#include "Scene.h"
#include "Surface.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkFloatArray.h"
#include "vtkIdList.h"
#include "vtkIdTypeArray.h"
#include "vtkNew.h"
#include "vtkPiecewiseFunction.h"
#include "vtkPointData.h"
#include "vtkPointGaussianMapper.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <cmath>
#include <regex>

namespace penumbra
{
namespace
{

/// Width and height of the image of a Gaussian, and of a disc, in texels.
constexpr int GaussianResolution = 128;
constexpr int DiscResolution = 256;

/// Image of a splat.
struct SplatImage
{
  double Extent = 1.0; ///< half the width of the image, in radii
  std::shared_ptr<const Texture> Image;
  bool Approximated = false;
};

/// Returns an image of size^2 texels of a function of the squared distance from the center, in
/// radii. The function returns brightness and alpha.
template <typename Function>
std::shared_ptr<const Texture> MakeImage(int size, double extent, Function&& evaluate)
{
  constexpr int Samples = 4; // per texel and axis
  auto texture = std::make_shared<Texture>();
  texture->Width = texture->Height = size;
  texture->Interpolate = true;
  texture->Wrap = Texture::WrapModes::ClampToEdge;
  texture->Texels.reserve(static_cast<std::size_t>(size) * size);
  const auto position = [&](int i, int sample) {
    return extent * (2.0 * (i + (sample + 0.5) / Samples) / size - 1.0);
  };
  for (int j = 0; j < size; ++j)
  {
    for (int i = 0; i < size; ++i)
    {
      double brightness = 0.0;
      double alpha = 0.0;
      for (int s = 0; s < Samples * Samples; ++s)
      {
        const double x = position(i, s % Samples);
        const double y = position(j, s / Samples);
        const glm::dvec2 value = evaluate(x * x + y * y);
        brightness += value.x * value.y;
        alpha += value.y;
      }
      const auto c = static_cast<unsigned char>(
        std::lround(alpha > 0.0 ? 255.0 * std::min(brightness / alpha, 1.0) : 0.0));
      texture->Texels.emplace_back(
        c, c, c, static_cast<unsigned char>(std::lround(255.0 * alpha / (Samples * Samples))));
    }
  }
  return texture;
}

// The size of the image in radii; VTK 9.4 renamed TriangleScale.
template <typename Mapper>
auto FindBoundScale(Mapper* mapper, int) -> decltype(static_cast<double>(mapper->GetBoundScale()))
{
  return mapper->GetBoundScale();
}
template <typename Mapper>
double FindBoundScale(Mapper* mapper, long)
{
  return mapper->GetTriangleScale();
}

template <typename Mapper>
auto IsAnisotropic(Mapper* mapper, int) -> decltype(static_cast<bool>(mapper->GetAnisotropic()))
{
  return mapper->GetAnisotropic();
}
template <typename Mapper>
bool IsAnisotropic(Mapper*, long)
{
  return false;
}

/// Interprets the shader code of a splat. Discs with `brightness` - d^2 as their brightness at the
/// squared distance d^2 are the spheres of ParaView and PyVista.
SplatImage MakeSplatImage(vtkPointGaussianMapper* mapper)
{
  SplatImage result;
  result.Approximated = IsAnisotropic(mapper, 0);
  const char* source = mapper->GetSplatShaderCode();
  std::string code = std::regex_replace(source ? source : "", std::regex("\\s+"), "");
  code = std::regex_replace(code, std::regex("//VTK::Color::Impl"), "");
  const double bound = FindBoundScale(mapper, 0);
  if (code.empty())
  {
    result.Extent = bound > 0.0 ? bound : 3.0;
    result.Image = MakeImage(GaussianResolution, result.Extent,
      [](double squared) { return glm::dvec2(1.0, std::exp(-0.5 * squared)); });
    return result;
  }
  double brightness = 0.0;
  std::smatch match;
  const bool isDisc = std::regex_search(code, std::regex("dist2?>1(\\.0?)?\\)\\{?discard;"));
  const bool isSphere = code.find("diffuseColor*=scale") != std::string::npos &&
    std::regex_search(code, match, std::regex("scale=\\(?([0-9.]+)-dist2?\\)?;"));
  if (isSphere)
  {
    brightness = std::strtod(match[1].str().c_str(), nullptr);
  }
  const bool changesColor =
    code.find("Color") != std::string::npos || code.find("opacity") != std::string::npos;
  result.Approximated |= !isDisc || (changesColor && !isSphere);
  result.Image = MakeImage(DiscResolution, result.Extent, [&](double squared) {
    return glm::dvec2(isSphere ? std::max(brightness - squared, 0.0) : 1.0, squared <= 1.0);
  });
  return result;
}

/// Returns a component of an array, or the norm if there is no such component.
double GetComponent(vtkDataArray* array, vtkIdType i, int component)
{
  const int count = array->GetNumberOfComponents();
  if (count == 1 || (component >= 0 && component < count))
  {
    return array->GetComponent(i, count == 1 ? 0 : component);
  }
  double sum = 0.0;
  for (int k = 0; k < count; ++k)
  {
    sum += array->GetComponent(i, k) * array->GetComponent(i, k);
  }
  return std::sqrt(sum);
}

double Evaluate(vtkPiecewiseFunction* function, double x)
{
  const double* range = function->GetRange();
  return function->GetValue(std::min(std::max(x, range[0]), range[1]));
}

/// Returns a point array; null, with a warning, if its length is wrong.
vtkDataArray* FindArray(
  vtkPolyData* data, const char* name, const std::string& prop, std::vector<std::string>& warnings)
{
  vtkDataArray* array = name ? data->GetPointData()->GetArray(name) : nullptr;
  if (array && array->GetNumberOfTuples() != data->GetNumberOfPoints())
  {
    warnings.push_back(prop + ": the array " + name + " was ignored because it has " +
      std::to_string(array->GetNumberOfTuples()) + " values for " +
      std::to_string(data->GetNumberOfPoints()) + " points.");
    return nullptr;
  }
  return array;
}

/// Returns the ids of the points that are drawn: those of vertex cells, or all if there are none.
std::vector<vtkIdType> FindPoints(vtkPolyData* data)
{
  std::vector<vtkIdType> ids;
  vtkCellArray* vertices = data->GetVerts();
  vtkNew<vtkIdList> cell;
  for (vtkIdType i = 0; i < vertices->GetNumberOfCells(); ++i)
  {
    vertices->GetCellAtId(i, cell);
    for (vtkIdType k = 0; k < cell->GetNumberOfIds(); ++k)
    {
      if (cell->GetId(k) >= 0 && cell->GetId(k) < data->GetNumberOfPoints())
      {
        ids.push_back(cell->GetId(k));
      }
    }
  }
  for (vtkIdType i = 0; vertices->GetNumberOfCells() == 0 && i < data->GetNumberOfPoints(); ++i)
  {
    ids.push_back(i);
  }
  return ids;
}

/// Multiplies the alpha of the points' colors by the opacity array, as VTK does.
void ApplyOpacity(vtkPointGaussianMapper* mapper, vtkDataArray* opacity, Coloring& coloring)
{
  vtkNew<vtkUnsignedCharArray> colors;
  colors->DeepCopy(coloring.Colors);
  for (vtkIdType i = 0; i < colors->GetNumberOfTuples(); ++i)
  {
    double value = GetComponent(opacity, i, mapper->GetOpacityArrayComponent());
    if (vtkPiecewiseFunction* function = mapper->GetScalarOpacityFunction())
    {
      value = Evaluate(function, value);
    }
    colors->SetComponent(
      i, 3, std::isfinite(value) ? std::min(std::max(255.0 * value, 0.0), 255.0) : 0.0);
  }
  coloring.Colors = colors;
}

/// Returns the radius of each point, in the coordinates of its data.
std::vector<float> FindRadii(vtkPointGaussianMapper* mapper, vtkPolyData* data,
  const std::string& name, std::vector<std::string>& warnings)
{
  vtkDataArray* scale = FindArray(data, mapper->GetScaleArray(), name, warnings);
  std::vector<float> radii(static_cast<std::size_t>(data->GetNumberOfPoints()));
  for (std::size_t i = 0; i < radii.size(); ++i)
  {
    double radius = 1.0;
    if (scale)
    {
      radius = GetComponent(scale, static_cast<vtkIdType>(i), mapper->GetScaleArrayComponent());
    }
    if (mapper->GetScaleFunction() && mapper->GetScaleArray())
    {
      radius = Evaluate(mapper->GetScaleFunction(), radius);
    }
    radii[i] = static_cast<float>(std::abs(radius * mapper->GetScaleFactor()));
  }
  const auto invalid =
    std::count_if(radii.begin(), radii.end(), [](float radius) { return !std::isfinite(radius); });
  if (invalid > 0)
  {
    warnings.push_back(name + ": " + std::to_string(invalid) +
      " splats were skipped because their radius is not finite.");
  }
  return radii;
}

/// Returns `data` with a vertex for each point.
vtkSmartPointer<vtkPolyData> MakeVertices(vtkPolyData* data, const std::vector<vtkIdType>& ids)
{
  vtkNew<vtkCellArray> vertices;
  for (const vtkIdType id : ids)
  {
    vertices->InsertNextCell(1, &id);
  }
  auto result = vtkSmartPointer<vtkPolyData>::New();
  result->SetPoints(data->GetPoints());
  result->SetVerts(vertices);
  return result;
}

/// Returns the two axes of a splat's image in the plane across Forward, for splats of radius 1.
/// @param center Coordinates of the splat relative to the camera.
/// @param shape Linear part of the transform of the splat.
std::array<glm::dvec3, 2> FindAxes(const Camera& camera, glm::dvec3 center, const glm::dmat3& shape)
{
  const double depth = glm::dot(center, camera.Forward);
  const double slope = camera.Parallel ? 0.0 : 1.0 / depth;
  const glm::dvec3 right = camera.Right - slope * glm::dot(center, camera.Right) * camera.Forward;
  const glm::dvec3 up = camera.Up - slope * glm::dot(center, camera.Up) * camera.Forward;
  // Covariance of the image: (a, b; b, c).
  const glm::dvec3 x = glm::transpose(shape) * right;
  const glm::dvec3 y = glm::transpose(shape) * up;
  const double a = glm::dot(x, x);
  const double b = glm::dot(x, y);
  const double c = glm::dot(y, y);
  const double mean = 0.5 * (a + c);
  const double term = std::sqrt(std::max(0.25 * (a - c) * (a - c) + b * b, 0.0));
  glm::dvec2 major = std::abs(b) > 1e-9 * mean ? glm::normalize(glm::dvec2(mean + term - c, b))
    : a >= c                                   ? glm::dvec2(1.0, 0.0)
                                               : glm::dvec2(0.0, 1.0);
  const glm::dvec2 minor = std::sqrt(std::max(mean - term, 0.0)) * glm::dvec2(-major.y, major.x);
  major *= std::sqrt(mean + term);
  return { major.x * camera.Right + major.y * camera.Up,
    minor.x * camera.Right + minor.y * camera.Up };
}

}

void AddSplats(vtkPointGaussianMapper* mapper, vtkPolyData* data, const DrawItem& prototype,
  ScalarMapper* scalars, std::vector<DrawItem>& items, std::vector<std::string>& warnings)
{
  const std::vector<vtkIdType> ids =
    data->GetPoints() ? FindPoints(data) : std::vector<vtkIdType>();
  if (ids.empty())
  {
    return;
  }
  DrawItem item = prototype;
  item.BackProperty = nullptr;
  item.BaseColorTexture = nullptr;
  item.LitTexture = nullptr;
  item.Property = vtkSmartPointer<vtkProperty>::New();
  item.Property->DeepCopy(prototype.Property);
  item.Property->LightingOff();
  item.Property->EdgeVisibilityOff();
  item.Property->VertexVisibilityOff();
  item.Property->BackfaceCullingOff();
  item.Property->FrontfaceCullingOff();
  item.Property->SetRepresentationToSurface();
  item.Data = MakeVertices(data, ids);
  scalars->SetInterpolateScalarsBeforeMapping(false);
  item.Colors = scalars->Map(data);
  if (item.Colors.Mode == Coloring::Modes::PerCell)
  {
    item.Colors = Coloring();
  }
  if (item.Colors.Mode == Coloring::Modes::PerPoint)
  {
    if (vtkDataArray* opacity =
          FindArray(data, mapper->GetOpacityArray(), prototype.Name, warnings))
    {
      ApplyOpacity(mapper, opacity, item.Colors);
    }
  }
  if (mapper->GetScaleFactor() != 0.0)
  {
    const SplatImage image = MakeSplatImage(mapper);
    if (image.Approximated)
    {
      WarnFeature(Feature::SplatShaders, prototype.Name, warnings);
    }
    auto splats = std::make_shared<Splats>();
    splats->Radii = FindRadii(mapper, data, prototype.Name, warnings);
    splats->Extent = image.Extent;
    splats->IsAdditive = mapper->GetEmissive();
    item.FacingSplats = splats;
    item.LitTexture = image.Image;
  }
  items.push_back(std::move(item));
}

DrawItem FaceCamera(const DrawItem& item, const Scene& scene)
{
  if (!item.FacingSplats)
  {
    return item;
  }
  const Camera& camera = scene.ViewCamera;
  const std::vector<float>& radii = item.FacingSplats->Radii;
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkFloatArray> coordinates;
  coordinates->SetNumberOfComponents(2);
  vtkNew<vtkCellArray> cells;
  vtkNew<vtkIdTypeArray> ids;
  vtkNew<vtkUnsignedCharArray> colors;
  colors->SetNumberOfComponents(4);
  vtkNew<vtkIdList> vertex;
  const bool isColored = item.Colors.Mode == Coloring::Modes::PerPoint;
  for (vtkIdType i = 0; i < item.Data->GetNumberOfVerts(); ++i)
  {
    item.Data->GetVerts()->GetCellAtId(i, vertex);
    const vtkIdType id = vertex->GetId(0);
    const double* x = item.Data->GetPoint(id);
    const glm::dvec4 world = item.ToWorld * glm::dvec4(x[0], x[1], x[2], 1.0);
    const glm::dvec3 center = scene.FromWorld(&world.x) - camera.Position;
    const double size = item.FacingSplats->Extent * radii[static_cast<std::size_t>(id)];
    if (!(size > 0.0 && std::isfinite(size) && glm::dot(center, camera.Forward) > camera.Near))
    {
      continue;
    }
    const std::array<glm::dvec3, 2> axes = FindAxes(camera, center, glm::dmat3(item.ToWorld));
    cells->InsertNextCell(4);
    for (int corner = 0; corner < 4; ++corner)
    {
      const bool isHigh[2] = { corner == 1 || corner == 2, corner >= 2 };
      const glm::dvec3 p = glm::dvec3(world) +
        size * ((isHigh[0] ? 1.0 : -1.0) * axes[0] + (isHigh[1] ? 1.0 : -1.0) * axes[1]);
      cells->InsertCellPoint(points->InsertNextPoint(p.x, p.y, p.z));
      coordinates->InsertNextTuple2(isHigh[0], isHigh[1]);
    }
    ids->InsertNextValue(id);
    if (isColored)
    {
      colors->InsertNextTuple(id, item.Colors.Colors);
    }
  }
  DrawItem result = item;
  result.ToWorld = glm::dmat4(1.0);
  result.Data = vtkSmartPointer<vtkPolyData>::New();
  result.Data->SetPoints(points);
  result.Data->SetPolys(cells);
  result.Data->GetPointData()->SetTCoords(coordinates);
  result.CellIds = ids;
  if (isColored)
  {
    result.Colors.Mode = Coloring::Modes::PerCell;
    result.Colors.Colors = colors;
  }
  return result;
}

}
