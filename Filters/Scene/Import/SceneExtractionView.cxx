// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "SceneExtractionView.h"

#include "CollectionItems.h"
#include "Features/SceneFeatures.h"
#include "Geometry/FixedOrigin.h"
#include "Scene.h"
#include "SceneExtractionColors.h"
#include "SceneExtractionSky.h"

#include "vtkBoundingBox.h"
#include "vtkCamera.h"
#include "vtkCollection.h"
#include "vtkLight.h"
#include "vtkLightCollection.h"
#include "vtkMath.h"
#include "vtkMatrix4x4.h"
#include "vtkNew.h"
#include "vtkRenderWindow.h"
#include "vtkRenderer.h"

#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace penumbra
{
namespace
{

/// Minimum depth that is rendered in perspective, in scene units. The far end of the scene is at
/// about 1.
constexpr double NearDistance = 1e-9;

/// Fraction of the far plane up to which a near plane does not clip. VTK resets ranges to 1e-3 or more.
constexpr double MinimumNearFraction = 1e-6;

bool IsFinite(const double bounds[6])
{
  return std::all_of(bounds, bounds + 6, [](double x) { return std::isfinite(x); }) &&
    bounds[0] <= bounds[1] && bounds[2] <= bounds[3] && bounds[4] <= bounds[5];
}

/// Returns the scale for which the farthest corner of `bounds` is at a distance of about 1 from
/// `origin`. A power of two, so that scaling is exact. `fallback` is the distance used for empty
/// bounds.
double ChooseScale(glm::dvec3 origin, const double bounds[6], double fallback)
{
  double extent = 0.0;
  if (IsFinite(bounds))
  {
    const glm::dvec3 low(bounds[0], bounds[2], bounds[4]);
    const glm::dvec3 high(bounds[1], bounds[3], bounds[5]);
    extent = glm::length(glm::max(glm::abs(low - origin), glm::abs(high - origin)));
  }
  if (!(extent > 0.0) || !std::isfinite(extent))
  {
    extent = fallback;
  }
  return std::exp2(-std::round(std::log2(std::clamp(extent, 1e-290, 1e290))));
}

glm::dmat4 ToMatrix(vtkMatrix4x4* from)
{
  glm::dmat4 result(1.0);
  for (int i = 0; i < 16; ++i)
  {
    result[i % 4][i / 4] = from->GetElement(i / 4, i % 4);
  }
  return result;
}

/// Sets the axes of `camera` and its world `position` from the view transform. `offset` is the
/// position in view coordinates. Returns false if the transform is not a rigid motion with uniform
/// scaling.
bool SetPose(const glm::dmat4& view, glm::dvec2 offset, Camera& camera, glm::dvec3& position)
{
  glm::dvec3 rows[3];
  for (int i = 0; i < 3; ++i)
  {
    rows[i] = { view[0][i], view[1][i], view[2][i] };
  }
  const glm::dvec3 shift = glm::dvec3(view[3]) - glm::dvec3(offset, 0.0);
  const double length = glm::length(rows[0]);
  camera.Right = rows[0] / length;
  camera.Up = rows[1] / length;
  camera.Forward = -rows[2] / length;
  position = -(shift.x * rows[0] + shift.y * rows[1] + shift.z * rows[2]) / (length * length);
  const double tolerance = 1e-6;
  return std::abs(glm::length(camera.Up) - 1.0) < tolerance &&
    std::abs(glm::length(camera.Forward) - 1.0) < tolerance &&
    std::abs(glm::dot(camera.Right, camera.Up)) < tolerance &&
    glm::length(glm::cross(camera.Right, camera.Up) + camera.Forward) < tolerance;
}

/// Sets the pixel size and the center from VTK's projection matrix, which may be off-axis. `offset`
/// receives the center of projection in view coordinates: eyes and sheared views have one beside
/// the camera. Returns false if the matrix is neither a perspective nor a parallel projection with
/// square pixels.
bool SetProjection(vtkMatrix4x4* projection, Camera& camera, glm::dvec2& offset)
{
  const auto p = [&](int i, int j) { return projection->GetElement(i, j); };
  camera.Parallel = p(3, 3) != 0.0;
  const double w = camera.Parallel ? p(3, 3) : -p(3, 2);
  const double horizontal = 2.0 * w / (p(0, 0) * camera.Width);
  const double vertical = 2.0 * w / (p(1, 1) * camera.Height);
  camera.PixelSize = vertical;
  const glm::dvec2 shift =
    camera.Parallel ? glm::dvec2(p(0, 3), p(1, 3)) / w : -glm::dvec2(p(0, 2), p(1, 2)) / w;
  camera.Center = 0.5 * glm::dvec2(camera.Width, camera.Height) * (1.0 + shift);
  if (!camera.Parallel)
  {
    offset = -glm::dvec2(p(0, 3) / p(0, 0), p(1, 3) / p(1, 1));
  }
  return p(0, 1) == 0.0 && p(1, 0) == 0.0 && p(3, 0) == 0.0 && p(3, 1) == 0.0 &&
    (!camera.Parallel || (p(0, 2) == 0.0 && p(1, 2) == 0.0)) &&
    std::abs(horizontal - vertical) < 1e-6 * std::abs(vertical);
}

/// Distance of the scene, as a multiple of its size, beyond which ray origins are moved toward the
/// scene. At larger distances, single precision does not resolve the positions that the image
/// shows.
constexpr double FarSceneRatio = 32.0;

/// Returns the distance by which ray origins can be moved forward so that they stay in front of
/// `bounds` by at least the length of their diagonal. In perspective, the result is 0 unless the
/// scene is far away and larger than a point.
double ComputeAdvance(
  glm::dvec3 position, glm::dvec3 forward, bool parallel, const double bounds[6])
{
  double nearest = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 8; ++i)
  {
    const glm::dvec3 corner(bounds[i % 2], bounds[2 + i / 2 % 2], bounds[4 + i / 4]);
    nearest = std::min(nearest, glm::dot(corner - position, forward));
  }
  const glm::dvec3 size(bounds[1] - bounds[0], bounds[3] - bounds[2], bounds[5] - bounds[4]);
  const double distance = std::max(nearest - glm::length(size), 0.0);
  if (size == glm::dvec3(0.0))
  {
    return 0.0; // A single point must not be at the ray origins.
  }
  return parallel || distance > FarSceneRatio * glm::length(size) ? distance : 0.0;
}

/// Sets Origin, Scale and the camera's coordinates. If `keepOrigin` is true, the origin depends only
/// on `bounds`, if that is precise enough.
void SetSceneCoordinates(
  glm::dvec3 position, const double bounds[6], double fallback, bool keepOrigin, Scene& scene)
{
  Camera& camera = scene.ViewCamera;
  double advance = 0.0;
  if (IsFinite(bounds))
  {
    advance = ComputeAdvance(position, camera.Forward, camera.Parallel, bounds);
    position += advance * camera.Forward;
  }
  const glm::dvec3 low(bounds[0], bounds[2], bounds[4]);
  const glm::dvec3 high(bounds[1], bounds[3], bounds[5]);
  scene.HasFixedOrigin = keepOrigin && IsFinite(bounds) && (camera.Parallel || advance == 0.0) &&
    IsFixedOriginPrecise(camera, position, low, high);
  scene.Origin = scene.HasFixedOrigin ? BoundingSphere(low, high).FindFixedOrigin() : position;
  scene.Scale = ChooseScale(scene.Origin, bounds, fallback);
  camera.Advance = advance * scene.Scale;
  // Ray origins are in single precision. The projection uses the same position.
  camera.Position = scene.HasFixedOrigin
    ? glm::dvec3(glm::vec3((position - scene.Origin) * scene.Scale))
    : -camera.DepthOfRayOrigins() * camera.Forward;
  camera.Near = camera.Parallel ? 0.0 : NearDistance;
  if (camera.Parallel)
  {
    camera.PixelSize *= scene.Scale;
  }
}

// vtkViewport has gradient modes since VTK 9.2.
template <typename Renderer>
auto FindGradientMode(Renderer* renderer, int)
  -> decltype(static_cast<int>(renderer->GetGradientMode()))
{
  return static_cast<int>(renderer->GetGradientMode());
}
template <typename Renderer>
int FindGradientMode(Renderer*, long)
{
  return 0;
}

/// Computes the position and the focal point of a light in world coordinates.
void ComputeLightPosition(
  vtkRenderer* renderer, vtkLight* light, double position[3], double focalPoint[3])
{
  vtkCamera* camera = renderer->IsActiveCameraCreated() ? renderer->GetActiveCamera() : nullptr;
  const bool follows = renderer->GetLightFollowCamera() && camera;
  if (follows && light->LightTypeIsHeadlight())
  {
    camera->GetPosition(position);
    camera->GetFocalPoint(focalPoint);
  }
  else if (follows && light->LightTypeIsCameraLight())
  {
    vtkMatrix4x4* toWorld = camera->GetCameraLightTransformMatrix();
    double x[4] = { 0.0, 0.0, 0.0, 1.0 };
    light->GetPosition(x);
    toWorld->MultiplyPoint(x, x);
    std::copy(x, x + 3, position);
    light->GetFocalPoint(x);
    x[3] = 1.0;
    toWorld->MultiplyPoint(x, x);
    std::copy(x, x + 3, focalPoint);
  }
  else
  {
    light->GetTransformedPosition(position);
    light->GetTransformedFocalPoint(focalPoint);
  }
}

Light ConvertLight(vtkRenderer* renderer, vtkLight* light, const LightSize& size,
  const glm::dmat4& distortion, const Scene& scene)
{
  double position[3];
  double focalPoint[3];
  ComputeLightPosition(renderer, light, position, focalPoint);
  Light result;
  result.Headlight = light->LightTypeIsHeadlight() && !light->GetPositional();
  result.CastsShadow = !light->LightTypeIsHeadlight();
  result.MovesWithCamera = light->LightTypeIsCameraLight();
  if (light->GetPositional())
  {
    // As in VTK, a cone angle of 90 degrees or more means a light without a cone.
    const double angle = light->GetConeAngle();
    result.Kind = angle < 90.0 ? Light::Kinds::Spot : Light::Kinds::Positional;
    result.ConeCosine = static_cast<float>(std::cos(vtkMath::RadiansFromDegrees(angle)));
    result.Exponent = static_cast<float>(light->GetExponent());
    result.Radius = static_cast<float>(size.Radius * scene.Scale);
  }
  else
  {
    result.AngularRadius = static_cast<float>(vtkMath::RadiansFromDegrees(0.5 * size.Angle));
  }
  const glm::dvec3 distorted = distortion * glm::dvec4(glm::make_vec3(position), 1.0);
  result.Position = (distorted - scene.Origin) * scene.Scale;
  glm::dvec3 direction = glm::make_vec3(focalPoint) - glm::make_vec3(position);
  if (distortion != glm::dmat4(1.0))
  {
    // VTK transforms the directions of lights like normals.
    direction = glm::transpose(glm::inverse(glm::dmat3(distortion))) * direction;
  }
  const double length = glm::length(direction);
  result.Direction = glm::vec3(length > 0.0 ? direction / length : scene.ViewCamera.Forward);
  const glm::dvec3 color = glm::make_vec3(light->GetDiffuseColor()) * light->GetIntensity();
  // VTK's shaders use the diffuse color for highlights, too.
  result.DiffuseColor = color;
  result.SpecularColor = color;
  const double* attenuation = light->GetAttenuationValues();
  result.Attenuation = glm::dvec3(
    attenuation[0], attenuation[1] / scene.Scale, attenuation[2] / (scene.Scale * scene.Scale));
  return result;
}

}

glm::dmat4 FindViewDistortion(vtkRenderer* renderer)
{
  if (!renderer->IsActiveCameraCreated())
  {
    return glm::dmat4(1.0);
  }
  vtkCamera* camera = renderer->GetActiveCamera();
  const glm::dmat4 view = ToMatrix(camera->GetModelViewTransformMatrix());
  Camera pose;
  glm::dvec3 position;
  const double determinant = glm::determinant(view);
  if (SetPose(view, glm::dvec2(0.0), pose, position) || !std::isfinite(determinant) ||
    determinant == 0.0)
  {
    return glm::dmat4(1.0);
  }
  vtkNew<vtkCamera> plain;
  plain->SetPosition(camera->GetPosition());
  plain->SetFocalPoint(camera->GetFocalPoint());
  plain->SetViewUp(camera->GetViewUp());
  return glm::inverse(ToMatrix(plain->GetModelViewTransformMatrix())) * view;
}

void ApplyViewDistortion(const glm::dmat4& distortion, std::vector<DrawItem>& items,
  double bounds[6], std::vector<std::string>& warnings)
{
  if (distortion == glm::dmat4(1.0))
  {
    return;
  }
  for (DrawItem& item : items)
  {
    item.ToWorld = distortion * item.ToWorld;
    for (glm::dvec4& plane : item.ClippingPlanes)
    {
      plane = plane * glm::inverse(distortion);
    }
    if (item.GlyphInstances)
    {
      item.GlyphInstances = std::make_shared<Instances>(*item.GlyphInstances);
      for (glm::dmat4x3& transform : item.GlyphInstances->Transforms)
      {
        transform = glm::dmat4x3(distortion * glm::dmat4(transform));
      }
    }
    if (item.Radii || item.FacingSplats)
    {
      warnings.push_back(item.Name +
        ": the transform of the camera does not distort spheres, tubes "
        "and splats. Use a rigid transform.");
    }
  }
  vtkBoundingBox distorted;
  for (int i = 0; IsFinite(bounds) && i < 8; ++i)
  {
    glm::dvec3 corner =
      distortion * glm::dvec4(bounds[i & 1], bounds[2 + (i >> 1 & 1)], bounds[4 + (i >> 2)], 1.0);
    distorted.AddPoint(&corner.x);
  }
  distorted.GetBounds(bounds);
}

void ExtractCamera(vtkRenderer* renderer, const double bounds[6], const ExtractionOptions& options,
  const glm::dmat4& distortion, Scene& scene)
{
  if (!renderer->IsActiveCameraCreated())
  {
    ResetCamera(bounds, options, scene);
    return;
  }
  vtkCamera* camera = renderer->GetActiveCamera();
  vtkRenderWindow* window = renderer->GetRenderWindow();
  const int stereo = window ? window->GetStereoType() : 0;
  if (camera->GetStereo() && stereo != VTK_STEREO_LEFT && stereo != VTK_STEREO_RIGHT)
  {
    WarnFeature(Feature::Stereo, "", scene.Warnings);
  }
  scene.ViewCamera.Width = options.Resolution[0];
  scene.ViewCamera.Height = options.Resolution[1];
  glm::dvec3 position;
  const double aspect = static_cast<double>(scene.ViewCamera.Width) / scene.ViewCamera.Height;
  glm::dvec2 offset(0.0);
  const bool isSupported = SetProjection(
    camera->GetProjectionTransformMatrix(aspect, -1.0, 1.0), scene.ViewCamera, offset);
  const glm::dmat4 view =
    ToMatrix(camera->GetModelViewTransformMatrix()) * glm::inverse(distortion);
  const bool isRigid = SetPose(view, offset, scene.ViewCamera, position);
  if (!isRigid || !isSupported)
  {
    WarnFeature(Feature::CameraShear, "", scene.Warnings);
  }
  SetSceneCoordinates(position, bounds, camera->GetDistance(), options.KeepOrigin, scene);
}

std::vector<glm::dvec4> FindClippingRange(
  vtkRenderer* renderer, const double bounds[6], const glm::dmat4& distortion)
{
  if (!renderer->IsActiveCameraCreated() || !IsFinite(bounds))
  {
    return {};
  }
  vtkCamera* camera = renderer->GetActiveCamera();
  const double* range = camera->GetClippingRange();
  const glm::dmat4 view =
    ToMatrix(camera->GetModelViewTransformMatrix()) * glm::inverse(distortion);
  const glm::dvec4 depth(-view[0][2], -view[1][2], -view[2][2], -view[3][2]);
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  for (int i = 0; i < 8; ++i)
  {
    const glm::dvec4 corner(bounds[i & 1], bounds[2 + (i >> 1 & 1)], bounds[4 + (i >> 2)], 1.0);
    low = std::min(low, glm::dot(depth, corner));
    high = std::max(high, glm::dot(depth, corner));
  }
  std::vector<glm::dvec4> planes;
  if (low < range[0] && range[0] > MinimumNearFraction * range[1])
  {
    planes.push_back(depth - glm::dvec4(0.0, 0.0, 0.0, range[0]));
  }
  if (high > range[1])
  {
    planes.push_back(glm::dvec4(0.0, 0.0, 0.0, range[1]) - depth);
  }
  return planes;
}

void ResetCamera(const double bounds[6], const ExtractionOptions& options, Scene& scene)
{
  const bool hasBounds = IsFinite(bounds);
  const glm::dvec3 low = hasBounds ? glm::dvec3(bounds[0], bounds[2], bounds[4]) : glm::dvec3(-0.5);
  const glm::dvec3 high = hasBounds ? glm::dvec3(bounds[1], bounds[3], bounds[5]) : glm::dvec3(0.5);
  const double radius = low == high ? 0.5 : 0.5 * glm::length(high - low);
  Camera& camera = scene.ViewCamera;
  camera = Camera();
  camera.Width = options.Resolution[0];
  camera.Height = options.Resolution[1];
  camera.Center = 0.5 * glm::dvec2(camera.Width, camera.Height);
  // As in VTK, the view angle is 30 degrees and the bounding sphere fits the smaller side of the
  // image.
  const double half = std::tan(vtkMath::RadiansFromDegrees(15.0));
  camera.PixelSize = 2.0 * half / camera.Height;
  const double aspect = static_cast<double>(camera.Width) / camera.Height;
  const double distance = radius / std::sin(std::atan(half * std::min(aspect, 1.0)));
  const glm::dvec3 position = 0.5 * (low + high) + glm::dvec3(0.0, 0.0, distance);
  SetSceneCoordinates(position, bounds, distance, false, scene);
}

Light MakeHeadlight(const Scene& scene)
{
  Light light;
  light.Direction = scene.ViewCamera.Forward;
  light.Headlight = true;
  light.CastsShadow = false;
  return light;
}

void ExtractLights(vtkRenderer* renderer, const ExtractionOptions& options,
  const glm::dmat4& distortion, Scene& scene)
{
  for (vtkLight* light : GetItems<vtkLight>(renderer->GetLights()))
  {
    if (light->GetSwitch())
    {
      const LightSize size = options.GetLightSize ? options.GetLightSize(light) : LightSize();
      scene.Lights.push_back(ConvertLight(renderer, light, size, distortion, scene));
    }
  }
  if (scene.Lights.empty() && renderer->GetAutomaticLightCreation())
  {
    scene.Lights.push_back(MakeHeadlight(scene));
  }
}

void ExtractBackground(vtkRenderer* renderer, const ExtractionOptions& options, Scene& scene)
{
  if (!options.Background)
  {
    return;
  }
  // VTK's default of 0 is visible only if the window has an alpha channel, so it counts as opaque.
  const double alpha = renderer->GetBackgroundAlpha() > 0.0 ? renderer->GetBackgroundAlpha() : 1.0;
  Background& background = scene.BackgroundColors;
  background.First = glm::vec4(glm::make_vec3(renderer->GetBackground()), alpha);
  background.Second = background.First;
  if (renderer->GetGradientBackground())
  {
    background.Second = glm::vec4(glm::make_vec3(renderer->GetBackground2()), alpha);
    background.Gradient = static_cast<Background::Gradients>(FindGradientMode(renderer, 0));
  }
  if (renderer->GetTexturedBackground())
  {
    const std::shared_ptr<const Texture> texture =
      MakeTexture(renderer->GetBackgroundTexture(), "Background", scene.Warnings);
    if (texture)
    {
      // vtkOpenGLRenderer::Clear() turns interpolation on.
      const auto image = std::make_shared<Texture>(*texture);
      image->Interpolate = true;
      background.Image = image;
    }
  }
  ExtractSky(renderer, scene);
}

}
