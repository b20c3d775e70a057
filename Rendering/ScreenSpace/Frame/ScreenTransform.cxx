// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ScreenTransform.h"

#include "ScreenSpaceConstants.h"
#include "Stage.h"
#include "Uniforms.h"

#include "vtkCamera.h"
#include "vtkMath.h"
#include "vtkMatrix4x4.h"
#include "vtkPenumbraViewLib.h"
#include "vtkRenderer.h"
#include "vtkShaderProgram.h"
#include "vtkType.h"

#include <algorithm>
#include <cmath>

namespace penumbra
{

namespace
{

Matrix Copy(vtkMatrix4x4* matrix)
{
  Matrix copy;
  std::copy_n(matrix->GetData(), 16, copy.begin());
  return copy;
}

}

ScreenTransform ScreenTransform::FromRenderer(
  vtkRenderer* renderer, const int size[2], const int margin[2])
{
  vtkCamera* camera = renderer->GetActiveCamera();
  ScreenTransform view;
  view.Width = size[0] + 2 * margin[0];
  view.Height = size[1] + 2 * margin[1];
  view.Parallel = camera->GetParallelProjection() != 0;
  view.WorldToEye = Copy(camera->GetModelViewTransformMatrix());
  view.Projection =
    Copy(camera->GetProjectionTransformMatrix(renderer->GetTiledAspectRatio(), -1.0, 1.0));
  if (view.HasStandardAxes())
  {
    view.MoveOriginToEye();
  }
  else
  {
    view.MakeEyeRigid();
  }
  const int sides[2] = { view.Width, view.Height };
  for (int axis = 0; axis < 2; ++axis)
  {
    double* row = view.Projection.data() + 4 * axis;
    std::transform(row, row + 4, row,
      [&](double entry) { return entry * size[axis] / static_cast<double>(sides[axis]); });
    // In perspective x = depth * (ndc + row[2]) / row[0]; parallel x = (ndc - row[3]) / row[0].
    view.Scale[axis] = 2.0 / (sides[axis] * row[axis]);
    view.Offset[axis] = (-1.0 + (view.Parallel ? -row[3] : row[2])) / row[axis];
  }
  const double slope = view.Projection[1] / view.Projection[0]; // 0 unless the image is sheared
  view.Skew = -slope * view.Scale[1];
  view.Offset[0] -= slope * view.Offset[1];
  return view;
}

void ScreenTransform::MoveOriginToEye()
{
  for (int axis = 0; axis < 2 && !this->Parallel; ++axis)
  {
    double* row = this->Projection.data() + 4 * axis;
    const double offset = row[3] / row[axis];
    this->CameraToEye[4 * axis + 3] = offset;
    row[3] = 0.0;
    for (int k = 0; k < 4; ++k)
    {
      this->WorldToEye[4 * axis + k] += offset * this->WorldToEye[12 + k];
    }
  }
}

bool ScreenTransform::HasStandardAxes() const
{
  const double* p = this->Projection.data();
  const double w = this->Parallel ? p[15] : -p[14];
  bool standard = p[0] > 0.0 && p[5] > 0.0 && p[1] == 0.0 && p[4] == 0.0 && p[12] == 0.0 &&
    p[13] == 0.0 && w == 1.0 && (!this->Parallel || (p[2] == 0.0 && p[6] == 0.0));
  for (int i = 0; i < 3; ++i)
  {
    for (int j = i; j < 3; ++j)
    {
      const double dot =
        vtkMath::Dot(this->WorldToEye.data() + 4 * i, this->WorldToEye.data() + 4 * j);
      standard = standard && std::abs(dot - (i == j ? 1.0 : 0.0)) < RigidTolerance;
    }
  }
  return standard;
}

void ScreenTransform::MakeEyeRigid()
{
  // Gradients of the clip coordinates x, y and w in world coordinates.
  Matrix worldToClip;
  vtkMatrix4x4::Multiply4x4(this->Projection.data(), this->WorldToEye.data(), worldToClip.data());
  const double* x = worldToClip.data();
  const double* y = worldToClip.data() + 4;
  const double* w = worldToClip.data() + 12;
  double axes[3][3]; // of eye coordinates, in world coordinates
  if (this->Parallel)
  {
    vtkMath::Cross(x, y, axes[2]);
    const double forward = vtkMath::Dot(axes[2], worldToClip.data() + 8);
    vtkMath::MultiplyScalar(axes[2], forward > 0.0 ? -1.0 : 1.0);
  }
  else
  {
    std::transform(w, w + 3, axes[2], [](double value) { return -value; });
  }
  vtkMath::Normalize(axes[2]);
  const double alongAxis = vtkMath::Dot(y, axes[2]);
  for (int i = 0; i < 3; ++i)
  {
    axes[1][i] = y[i] - alongAxis * axes[2][i];
  }
  vtkMath::Normalize(axes[1]);
  vtkMath::Cross(axes[1], axes[2], axes[0]);
  vtkMath::MultiplyScalar(axes[0], vtkMath::Dot(axes[0], x) < 0.0 ? -1.0 : 1.0);

  // From camera to eye coordinates: the linear part, then the center of projection as origin.
  Matrix eyeToCamera{ 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1 };
  for (int row = 0; row < 3; ++row)
  {
    for (int column = 0; column < 3; ++column)
    {
      eyeToCamera[4 * row + column] = vtkMath::Dot(this->WorldToEye.data() + 4 * row, axes[column]);
    }
  }
  if (!this->Parallel)
  {
    double gradients[3][3];
    double center[3];
    constexpr int rows[3] = { 0, 1, 3 };
    for (int i = 0; i < 3; ++i)
    {
      const double* row = this->Projection.data() + 4 * rows[i];
      std::copy_n(row, 3, gradients[i]);
      center[i] = -row[3];
    }
    vtkMath::LinearSolve3x3(gradients, center, center);
    for (int row = 0; row < 3; ++row)
    {
      eyeToCamera[4 * row + 3] = center[row];
    }
  }
  Matrix product;
  vtkMatrix4x4::Invert(eyeToCamera.data(), this->CameraToEye.data());
  vtkMatrix4x4::Multiply4x4(this->CameraToEye.data(), this->WorldToEye.data(), product.data());
  this->WorldToEye = product;
  vtkMatrix4x4::Multiply4x4(this->Projection.data(), eyeToCamera.data(), product.data());
  const double scale = this->Parallel ? product[15] : -product[14];
  std::transform(product.begin(), product.end(), this->Projection.begin(),
    [scale](double entry) { return entry / scale; });
  // Zero by construction, except for rounding.
  for (const int entry : { 4, 12, 13, this->Parallel ? 14 : 15 })
  {
    this->Projection[entry] = 0.0;
  }
  for (const int row : { 0, 4 })
  {
    this->Projection[row + (this->Parallel ? 2 : 3)] = 0.0;
  }
}

bool ScreenTransform::TightenClippingRange(const double bounds[6])
{
  const double* lastRow = this->Projection.data() + 12;
  const bool isStandardProjection = this->Projection[8] == 0.0 && this->Projection[9] == 0.0 &&
    lastRow[0] == 0.0 && lastRow[1] == 0.0 && lastRow[this->Parallel ? 2 : 3] == 0.0;
  if (!isStandardProjection)
  {
    return false;
  }
  double& c = this->Projection[10];
  double& d = this->Projection[11];
  double nearest = VTK_DOUBLE_MAX;
  double farthest = -VTK_DOUBLE_MAX;
  for (int corner = 0; corner < 8; ++corner)
  {
    const double* row = this->WorldToEye.data() + 8;
    const double depth = -(row[0] * bounds[corner & 1] + row[1] * bounds[2 + (corner >> 1 & 1)] +
      row[2] * bounds[4 + (corner >> 2)] + row[3]);
    nearest = std::min(nearest, depth);
    farthest = std::max(farthest, depth);
  }
  const double planes[2] = { (this->Parallel ? d + 1.0 : d) / (this->Parallel ? c : c - 1.0),
    (this->Parallel ? d - 1.0 : d) / (this->Parallel ? c : c + 1.0) };
  const double reserve = std::max(farthest - nearest, 1e-3 * (planes[1] - planes[0]));
  const double lower = std::max(planes[0], this->Parallel ? nearest - reserve : 0.5 * nearest);
  const double upper = std::min(planes[1], this->Parallel ? farthest + reserve : 2.0 * farthest);
  const bool coarse = this->Parallel ? planes[1] - planes[0] > ClippingRangeRatio * (upper - lower)
                                     : lower > ClippingRangeRatio * planes[0];
  if (!(lower < upper) || !coarse || !std::isfinite(upper - lower))
  {
    return false;
  }
  const auto [a, b] = this->DepthToEye();
  c = (this->Parallel ? -2.0 : -(upper + lower)) / (upper - lower);
  d = (this->Parallel ? -(upper + lower) : -2.0 * upper * lower) / (upper - lower);
  // Both depths z are linear in q = a + b (1 - z), the distance or its inverse.
  const auto [now, slope] = this->DepthToEye();
  this->ToCameraDepth[0] = slope / b;
  this->ToCameraDepth[1] = 1.0 - (now + slope - a) / b;
  return true;
}

std::pair<double, double> ScreenTransform::DepthToEye() const
{
  // With z the depth buffer's value, clip z is 2 z - 1; near the far plane 1 - z is exact.
  const double c = this->Projection[10];
  const double d = this->Projection[11];
  return this->Parallel ? std::make_pair((d - 1.0) / c / this->Unit, 2.0 / c / this->Unit)
                        : std::make_pair((1.0 + c) / d * this->Unit, -2.0 / d * this->Unit);
}

ScreenTransform ScreenTransform::Downsampled(int block) const
{
  const int center = block / 2; // row and column of the pixel that represents its block
  ScreenTransform view = *this;
  view.Width = (this->Width + block - 1) / block;
  view.Height = (this->Height + block - 1) / block;
  view.Skew = this->Skew * block;
  view.Offset[0] += this->Skew * (center + 0.5 - 0.5 * block);
  for (int axis = 0; axis < 2; ++axis)
  {
    view.Scale[axis] = this->Scale[axis] * block;
    view.Offset[axis] += this->Scale[axis] * (center + 0.5 - 0.5 * block);
    // Clip coordinates: the last blocks may extend beyond the image.
    const int sides[2] = { this->Width, this->Height };
    const int blocks[2] = { view.Width, view.Height };
    const double wider = static_cast<double>(block) * blocks[axis] / sides[axis];
    const double shift = wider + (2.0 * center + 1.0 - block) / sides[axis] - 1.0;
    for (int k = 0; k < 4; ++k)
    {
      double& entry = view.Projection[4 * axis + k];
      entry = (entry - shift * view.Projection[12 + k]) / wider;
    }
  }
  return view;
}

void ScreenTransform::SetPixelUniforms(
  vtkShaderProgram* program, const char* toEye, const char* skew, const char* size) const
{
  const double unit = this->Parallel ? this->Unit : 1.0;
  const float pixelToEye[4] = { static_cast<float>(this->Scale[0] / unit),
    static_cast<float>(this->Scale[1] / unit), static_cast<float>(this->Offset[0] / unit),
    static_cast<float>(this->Offset[1] / unit) };
  program->SetUniform4f(toEye, pixelToEye);
  SetNumber(program, skew, this->Skew / unit);
  SetPixelSize(program, size, this->Width, this->Height);
}

void ScreenTransform::SetUniforms(vtkShaderProgram* program) const
{
  this->SetPixelUniforms(program, "pixelToEye", "pixelSkew", "pixelSize");
  program->SetUniformf("perspective", this->Parallel ? 0.f : 1.f);
  const auto [origin, slope] = this->DepthToEye();
  SetVector(program, "depthToEye", origin, slope);
}

Matrix ScreenTransform::EyeTransformTo(const ScreenTransform& other, const double* motion) const
{
  Matrix eyeToWorld;
  vtkMatrix4x4::Invert(this->WorldToEye.data(), eyeToWorld.data());
  Matrix product;
  if (motion)
  {
    vtkMatrix4x4::Multiply4x4(motion, eyeToWorld.data(), product.data());
    eyeToWorld = product;
  }
  vtkMatrix4x4::Multiply4x4(other.WorldToEye.data(), eyeToWorld.data(), product.data());
  for (int row = 0; row < 3; ++row)
  {
    for (int column = 0; column < 3; ++column)
    {
      product[4 * row + column] *= this->Unit / other.Unit;
    }
    product[4 * row + 3] /= other.Unit;
  }
  return product;
}

bool ScreenTransform::IsCutFrom(
  const ScreenTransform& other, double distance, double minimumCosine) const
{
  const Matrix transform = this->EyeTransformTo(other);
  const double depth = distance / this->Unit;
  const auto unitOf = [](const ScreenTransform& view) { return view.Parallel ? view.Unit : 1.0; };
  int seen = 0;
  for (int i = 0; i < CutGridSide * CutGridSide; ++i)
  {
    const double pixel[2] = { (i % CutGridSide + 0.5) / CutGridSide * this->Width,
      (i / CutGridSide + 0.5) / CutGridSide * this->Height };
    double here[3] = { 0.0, 0.0, -depth };
    for (int axis = 0; axis < 2; ++axis)
    {
      here[axis] = (this->Scale[axis] * pixel[axis] + this->Offset[axis]) / unitOf(*this) *
        (this->Parallel ? 1.0 : depth);
    }
    here[0] += this->Skew * pixel[1] / unitOf(*this) * (this->Parallel ? 1.0 : depth);
    double there[3];
    double towardHere[3]; // toward the camera of this view, in the coordinates of the other one
    const double viewed[3] = { this->Parallel ? 0.0 : here[0], this->Parallel ? 0.0 : here[1],
      -depth };
    for (int row = 0; row < 3; ++row)
    {
      const double* axis = transform.data() + 4 * row;
      there[row] = vtkMath::Dot(axis, here) + axis[3];
      towardHere[row] = -vtkMath::Dot(axis, viewed);
    }
    const double towardsThere[3] = { other.Parallel ? 0.0 : -there[0],
      other.Parallel ? 0.0 : -there[1], other.Parallel ? 1.0 : -there[2] };
    const double cosine = vtkMath::Dot(towardHere, towardsThere) /
      (vtkMath::Norm(towardHere) * vtkMath::Norm(towardsThere));
    const double perspective = other.Parallel ? 1.0 : -there[2];
    const double y = (there[1] / perspective * unitOf(other) - other.Offset[1]) / other.Scale[1];
    const double x =
      (there[0] / perspective * unitOf(other) - other.Offset[0] - other.Skew * y) / other.Scale[0];
    seen += perspective > 0.0 && x > 0.0 && y > 0.0 && x < other.Width && y < other.Height &&
      cosine > minimumCosine;
  }
  return seen < MinimumUncutFraction * CutGridSide * CutGridSide;
}

bool ScreenTransform::HasSameView(const ScreenTransform& other) const
{
  return this->Width == other.Width && this->Height == other.Height &&
    this->Parallel == other.Parallel && this->Unit == other.Unit &&
    this->WorldToEye == other.WorldToEye && this->Skew == other.Skew &&
    std::equal(this->Scale, this->Scale + 2, other.Scale) &&
    std::equal(this->Offset, this->Offset + 2, other.Offset);
}

std::string AssembleView(const std::string& source)
{
  return Assemble(source, { { "ViewLib", vtkPenumbraViewLib } });
}

double PixelAtFocus(vtkRenderer* renderer)
{
  vtkCamera* camera = renderer->GetActiveCamera();
  const double height = std::max(renderer->GetSize()[1], 1);
  if (camera->GetParallelProjection())
  {
    return 2.0 * camera->GetParallelScale() / height;
  }
  const double half = vtkMath::RadiansFromDegrees(camera->GetViewAngle()) / 2.0;
  return 2.0 * camera->GetDistance() * std::tan(half) / height;
}

}
