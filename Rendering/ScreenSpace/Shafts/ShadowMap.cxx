// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ShadowMap.h"

#include "Frame/DelegateImage.h"
#include "Frame/OpenGLFunctions.h"
#include "Frame/ScopedCamera.h"
#include "Frame/ScreenSpaceConstants.h"
#include "Frame/Textures.h"
#include "Frame/Uniforms.h"
#include "vtkBoundingBox.h"
#include "vtkCamera.h"
#include "vtkLightCollection.h"
#include "vtkMath.h"
#include "vtkMatrix4x4.h"
#include "vtkNew.h"
#include "vtkOpenGLFramebufferObject.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkOpenGLRenderer.h"
#include "vtkOpenGLState.h"
#include "vtkProp.h"
#include "vtkRenderer.h"
#include "vtkShaderProgram.h"
#include "vtkTextureObject.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace penumbra
{

namespace
{

constexpr double Infinity = std::numeric_limits<double>::infinity();

using Point = std::array<double, 3>;

struct Interval
{
  double Low = Infinity;
  double High = -Infinity;

  void Add(double value)
  {
    this->Low = std::min(this->Low, value);
    this->High = std::max(this->High, value);
  }
  double GetLength() const { return this->High - this->Low; }
};

bool IsSpotlight(const ShaftLight& light)
{
  return light.IsPositional() && vtkMath::Norm(light.Axis.data()) > 0.0 &&
    light.Cone[3] > std::cos(vtkMath::RadiansFromDegrees(MaximumMapConeAngle));
}

/// Finds the side of the box that the point is farthest outside of, relative to the distances to
/// its corners. Returns the tangent of the largest angle between its normal and a corner, infinite
/// inside the box. `normal` points to the box.
double FindNearestSide(const Point& from, const double bounds[6], Point& normal)
{
  double best = Infinity;
  for (int side = 0; side < 6; ++side)
  {
    const int axis = side / 2;
    const double gap = side % 2 ? from[axis] - bounds[side] : bounds[side] - from[axis];
    double farthest = 0.0;
    for (int other = 0; other < 6; ++other)
    {
      if (other / 2 != axis)
      {
        farthest = std::max(farthest, std::abs(from[other / 2] - bounds[other]));
      }
    }
    const double tangent = gap > 0.0 ? farthest / gap : Infinity;
    if (tangent < best)
    {
      best = tangent;
      normal = { 0.0, 0.0, 0.0 };
      normal[axis] = side % 2 ? -1.0 : 1.0;
    }
  }
  return best;
}

/// World to light coordinates: the light looks along -z.
Matrix LookFrom(const Point& position, const Point& direction)
{
  vtkNew<vtkCamera> camera;
  camera->SetPosition(position.data());
  camera->SetFocalPoint(
    position[0] + direction[0], position[1] + direction[1], position[2] + direction[2]);
  const Point size = { std::abs(direction[0]), std::abs(direction[1]), std::abs(direction[2]) };
  const auto smallest = std::min_element(size.begin(), size.end()) - size.begin();
  camera->SetViewUp(smallest == 0, smallest == 1, smallest == 2);
  Matrix matrix;
  std::copy_n(camera->GetModelViewTransformMatrix()->GetData(), 16, matrix.begin());
  return matrix;
}

Point Transform(const Matrix& matrix, const Point& point, double w = 1.0)
{
  Point result;
  for (int row = 0; row < 3; ++row)
  {
    const double* m = matrix.data() + 4 * row;
    result[row] = m[0] * point[0] + m[1] * point[1] + m[2] * point[2] + m[3] * w;
  }
  return result;
}

/// The parts of the light's x and y axes over which the view extends.
std::array<Interval, 2> ProjectView(const Matrix& worldToLight, const ScreenTransform& view)
{
  Matrix eyeToWorld;
  vtkMatrix4x4::Invert(view.WorldToEye.data(), eyeToWorld.data());
  std::array<Interval, 2> parts;
  for (int corner = 0; corner < 4; ++corner)
  {
    const double y = (corner >> 1) * view.Height;
    const double plane[2] = { view.Offset[0] + (corner & 1) * view.Scale[0] * view.Width +
        view.Skew * y,
      view.Offset[1] + view.Scale[1] * y };
    const Point onPlane = { plane[0], plane[1], 0.0 };
    const Point start = view.Parallel ? onPlane : Point{ 0.0, 0.0, 0.0 };
    const Point slope = view.Parallel ? Point{ 0.0, 0.0, -1.0 } : Point{ plane[0], plane[1], -1.0 };
    const Point from = Transform(worldToLight, Transform(eyeToWorld, start));
    const Point toward = Transform(worldToLight, Transform(eyeToWorld, slope, 0.0), 0.0);
    for (int axis = 0; axis < 2; ++axis)
    {
      parts[axis].Add(from[axis]);
      parts[axis].Add(toward[axis] == 0.0 ? from[axis] : std::copysign(Infinity, toward[axis]));
    }
  }
  return parts;
}

/// Restricts the extent of the props to the cells of it that the view needs.
void Restrict(Interval& extent, const Interval& needed)
{
  const double cell = extent.GetLength() / MapCellsPerSide;
  const double low = extent.Low;
  if (!(cell > 0.0) || !(needed.Low < extent.High) || !(needed.High > extent.Low))
  {
    return; // nothing, or nothing to see
  }
  if (needed.High < extent.High)
  {
    extent.High = std::min(extent.High, low + cell * std::ceil((needed.High - low) / cell));
  }
  if (needed.Low > extent.Low)
  {
    extent.Low = low + cell * std::floor((needed.Low - low) / cell);
  }
}

/// Moves the ends of an interval apart, by a texel of the map and so far that it is not empty.
void Enlarge(Interval& extent, int size, double minimum)
{
  const double margin = std::max(extent.GetLength() / (size - 2), minimum);
  extent.Low -= margin;
  extent.High += margin;
}

Matrix ProjectParallel(const Interval& x, const Interval& y, const Interval& depth)
{
  Matrix matrix{};
  const Interval* axes[3] = { &x, &y, &depth };
  for (int axis = 0; axis < 3; ++axis)
  {
    const double length = axes[axis]->GetLength();
    matrix[5 * axis] = (axis == 2 ? -2.0 : 2.0) / length;
    matrix[4 * axis + 3] = -(axes[axis]->High + axes[axis]->Low) / length;
  }
  matrix[15] = 1.0;
  return matrix;
}

Matrix ProjectPerspective(const Interval& x, const Interval& y, const Interval& depth)
{
  Matrix matrix{};
  matrix[0] = 2.0 / x.GetLength();
  matrix[2] = (x.High + x.Low) / x.GetLength();
  matrix[5] = 2.0 / y.GetLength();
  matrix[6] = (y.High + y.Low) / y.GetLength();
  matrix[10] = -(depth.High + depth.Low) / depth.GetLength();
  matrix[11] = -2.0 * depth.High * depth.Low / depth.GetLength();
  matrix[14] = -1.0;
  return matrix;
}

Matrix FitDirectional(const Matrix& worldToLight, const std::vector<Point>& corners,
  const ScreenTransform& view, int size)
{
  Interval extents[3];
  for (const Point& corner : corners)
  {
    const Point point = Transform(worldToLight, corner);
    extents[0].Add(point[0]);
    extents[1].Add(point[1]);
    extents[2].Add(-point[2]);
  }
  double diagonal =
    std::hypot(extents[0].GetLength(), std::hypot(extents[1].GetLength(), extents[2].GetLength()));
  diagonal = diagonal > 0.0 ? diagonal : 1.0;
  const std::array<Interval, 2> needed = ProjectView(worldToLight, view);
  for (int axis = 0; axis < 2; ++axis)
  {
    Restrict(extents[axis], needed[axis]);
    Enlarge(extents[axis], size, 1e-4 * diagonal);
  }
  extents[2].Low -= MapDepthMargin * diagonal;
  extents[2].High += MapDepthMargin * diagonal;
  return ProjectParallel(extents[0], extents[1], extents[2]);
}

Matrix FitPositional(
  const Matrix& worldToLight, const std::vector<Point>& corners, const ShaftLight& light, int size)
{
  Interval extents[2];
  Interval depth;
  for (const Point& corner : corners)
  {
    const Point point = Transform(worldToLight, corner);
    depth.Add(-point[2]);
    extents[0].Add(-point[2] > 0.0 ? point[0] / -point[2] : Infinity);
    extents[1].Add(-point[2] > 0.0 ? point[1] / -point[2] : Infinity);
  }
  depth.High = depth.High > 0.0 ? (1.0 + MapDepthMargin) * depth.High : 1.0;
  const bool inFront = depth.Low > MapNearFraction * depth.High;
  depth.Low = inFront ? (1.0 - MapDepthMargin) * depth.Low : MapNearFraction * depth.High;
  for (Interval& extent : extents)
  {
    double widest = MaximumMapTangent;
    if (IsSpotlight(light))
    {
      const double cosine = light.Cone[3];
      widest = std::sqrt(std::max(1.0 - cosine * cosine, 0.0)) / cosine;
    }
    const Interval all = inFront ? extent : Interval{ -widest, widest };
    extent.Low = std::max(all.Low, -widest);
    extent.High = std::min(all.High, widest);
    if (!(extent.GetLength() > 0.0))
    {
      extent = { -widest, widest };
    }
    Enlarge(extent, size, 1e-6);
  }
  return ProjectPerspective(extents[0], extents[1], depth);
}

}

bool AssignShadowMaps(std::vector<ShaftLight>& lights, const double bounds[6])
{
  bool all = true;
  for (ShaftLight& light : lights)
  {
    Point normal;
    light.HasShadowMap = !light.IsPositional() || IsSpotlight(light) ||
      FindNearestSide(light.World, bounds, normal) < MaximumMapTangent;
    all = all && light.HasShadowMap;
  }
  return all;
}

void ShadowMap::Allocate(vtkOpenGLRenderWindow* window, int size)
{
  if (this->Depths && this->Depths->GetContext() == window &&
    static_cast<int>(this->Depths->GetWidth()) == size)
  {
    return;
  }
  this->Version = -1;
  for (vtkSmartPointer<vtkTextureObject>* texture : { &this->Color, &this->Depths })
  {
    *texture = vtkSmartPointer<vtkTextureObject>::New();
    (*texture)->SetContext(window);
    (*texture)->SetWrapS(vtkTextureObject::ClampToEdge);
    (*texture)->SetWrapT(vtkTextureObject::ClampToEdge);
  }
  this->Depths->SetMinificationFilter(vtkTextureObject::Linear);
  this->Depths->SetMagnificationFilter(vtkTextureObject::Linear);
  this->Depths->SetDepthTextureCompare(true);
  this->Depths->SetDepthTextureCompareFunction(vtkTextureObject::Lequal);
  this->Color->Allocate2D(size, size, 4, VTK_UNSIGNED_CHAR);
  this->Depths->AllocateDepth(size, size, vtkTextureObject::Float32);
  this->Framebuffer = vtkSmartPointer<vtkOpenGLFramebufferObject>::New();
  this->Framebuffer->SetContext(window);
}

bool ShadowMap::Update(vtkRenderer* renderer, const ShadowCasters& casters, const ShaftLight& light,
  const ScreenTransform& view, int size)
{
  auto* window = static_cast<vtkOpenGLRenderWindow*>(renderer->GetRenderWindow());
  this->Allocate(window, size);
  std::vector<Point> corners = casters.GetCorners();
  if (corners.empty())
  {
    corners.push_back({ 0.0, 0.0, 0.0 }); // the map stays empty
  }
  vtkBoundingBox box;
  for (const Point& corner : corners)
  {
    box.AddPoint(corner[0], corner[1], corner[2]);
  }
  double bounds[6];
  box.GetBounds(bounds);
  Matrix worldToLight;
  Matrix projection;
  if (light.IsPositional())
  {
    Point toward = light.Axis;
    if (!IsSpotlight(light))
    {
      FindNearestSide(light.World, bounds, toward);
    }
    worldToLight = LookFrom(light.World, toward);
    projection = FitPositional(worldToLight, corners, light, size);
  }
  else
  {
    Point center;
    box.GetCenter(center.data());
    worldToLight = LookFrom(center, { -light.World[0], -light.World[1], -light.World[2] });
    projection = FitDirectional(worldToLight, corners, view, size);
  }
  this->New = this->Version != casters.GetVersion() || worldToLight != this->WorldToLight ||
    projection != this->Projection;
  if (!this->New)
  {
    return true;
  }
  this->WorldToLight = worldToLight;
  this->Projection = projection;
  const bool drawn = FillTextures(this->Framebuffer, this->Color, this->Depths, GL_DEPTH_BUFFER_BIT,
    [&]() { this->DrawCasters(renderer, casters); });
  this->Version = drawn ? casters.GetVersion() : -1;
  return drawn;
}

void ShadowMap::DrawCasters(vtkRenderer* renderer, const ShadowCasters& casters) const
{
  auto* window = static_cast<vtkOpenGLRenderWindow*>(renderer->GetRenderWindow());
  vtkOpenGLState* gl = window->GetState();
  const vtkOpenGLState::ScopedglEnableDisable blend(gl, GL_BLEND);
  {
    const ScopedCamera camera(renderer, this->WorldToLight, this->Projection);
    gl->vtkglColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
    for (vtkProp* prop : casters.GetProps())
    {
      prop->RenderOpaqueGeometry(renderer);
    }
    gl->vtkglColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  }
  // Shaders now have light directions for the camera of the map. VTK replaces them only if the
  // lights are newer than these, because the modification time of its own camera is older.
  renderer->GetLights()->Modified();
  if (auto* openGL = vtkOpenGLRenderer::SafeDownCast(renderer))
  {
    openGL->UpdateLights();
  }
}

void ShadowMap::SetUniforms(vtkShaderProgram* program, const ScreenTransform& view) const
{
  // Shaders use eye coordinates with z along the view axis, in the unit of the view.
  const Matrix unitToEye = { view.Unit, 0.0, 0.0, 0.0, 0.0, view.Unit, 0.0, 0.0, 0.0, 0.0,
    -view.Unit, 0.0, 0.0, 0.0, 0.0, 1.0 };
  const Matrix clipToMap = { 0.5, 0.0, 0.0, 0.5, 0.0, 0.5, 0.0, 0.5, 0.0, 0.0, 0.5, 0.5, 0.0, 0.0,
    0.0, 1.0 };
  Matrix eyeToWorld;
  vtkMatrix4x4::Invert(view.WorldToEye.data(), eyeToWorld.data());
  Matrix product = unitToEye;
  for (const Matrix& left : { eyeToWorld, this->WorldToLight, this->Projection, clipToMap })
  {
    const Matrix right = product;
    vtkMatrix4x4::Multiply4x4(left.data(), right.data(), product.data());
  }
  SetMatrix(program, "eyeToMap", product);
}

void ShadowMap::ReleaseGraphicsResources(vtkWindow* window)
{
  Release(window, this->Color, this->Depths, this->Framebuffer);
}

}
