// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "OcclusionScene.h"

#include "vtkPenumbraOcclusionConstants.h"

#include "vtkCallbackCommand.h"
#include "vtkCamera.h"
#include "vtkFloatArray.h"
#include "vtkPlaneSource.h"
#include "vtkPointData.h"
#include "vtkPolyDataMapper.h"
#include "vtkProperty.h"
#include "vtkSphereSource.h"
#include "vtkUnsignedCharArray.h"

#include <cmath>

namespace
{

vtkSmartPointer<vtkActor> NewActor(vtkAlgorithm* source)
{
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(source->GetOutputPort());
  auto actor = vtkSmartPointer<vtkActor>::New();
  actor->SetMapper(mapper);
  actor->GetProperty()->LightingOff();
  return actor;
}

}

OcclusionScene::OcclusionScene(int width, int height, int multiSamples)
  : Width(width),
    Height(height)
{
  this->Window->SetOffScreenRendering(1);
  this->Window->SetMultiSamples(multiSamples);
  this->Window->SetAlphaBitPlanes(1);
  this->Window->SetSize(width, height);
  this->Window->AddRenderer(this->Renderer);
  this->Renderer->SetBackground(0.2, 0.3, 0.4);
}

vtkSmartPointer<vtkActor> OcclusionScene::AddWall(
  const Vector& corner, const Vector& firstSide, const Vector& secondSide)
{
  vtkNew<vtkPlaneSource> plane;
  plane->SetOrigin(corner[0], corner[1], corner[2]);
  plane->SetPoint1(corner[0] + firstSide[0], corner[1] + firstSide[1], corner[2] + firstSide[2]);
  plane->SetPoint2(corner[0] + secondSide[0], corner[1] + secondSide[1], corner[2] + secondSide[2]);
  auto actor = NewActor(plane);
  this->Renderer->AddActor(actor);
  return actor;
}

vtkSmartPointer<vtkActor> OcclusionScene::AddFloor(double size)
{
  return this->AddWall({ -size, -size, 0 }, { 2 * size, 0, 0 }, { 0, 2 * size, 0 });
}

vtkSmartPointer<vtkActor> OcclusionScene::AddSphere(const Vector& center, double radius)
{
  vtkNew<vtkSphereSource> sphere;
  sphere->SetRadius(radius);
  sphere->SetThetaResolution(64);
  sphere->SetPhiResolution(64);
  auto actor = NewActor(sphere);
  actor->SetPosition(center[0], center[1], center[2]);
  this->Renderer->AddActor(actor);
  return actor;
}

void OcclusionScene::SetCamera(const Vector& from, const Vector& at, const Vector& up)
{
  vtkCamera* camera = this->Renderer->GetActiveCamera();
  camera->SetPosition(from.data());
  camera->SetFocalPoint(at.data());
  camera->SetViewUp(up.data());
  this->Renderer->ResetCameraClippingRange();
}

void OcclusionScene::UseParallelProjection(bool parallel, double halfHeight)
{
  this->Renderer->GetActiveCamera()->SetParallelProjection(parallel);
  this->Renderer->GetActiveCamera()->SetParallelScale(halfHeight);
  this->Renderer->ResetCameraClippingRange();
}

void OcclusionScene::CountWarnings()
{
  vtkNew<vtkCallbackCommand> counter;
  counter->SetClientData(&this->Warnings);
  counter->SetCallback(
    [](vtkObject*, unsigned long, void* count, void*) { ++*static_cast<int*>(count); });
  this->Pass->AddObserver(vtkCommand::WarningEvent, counter);
}

vtkPenumbraTemporalSSAOPass* OcclusionScene::AddOcclusionPass(double radius)
{
  this->Pass = vtkPenumbraTemporalSSAOPass::AddTo(this->Renderer);
  this->Pass->SetRadiusUnit(vtkPenumbraTemporalSSAOPass::WORLD);
  // The number of samples in a frame must not depend on time.
  this->Pass->GetConstants().StepsPerFrame = 1;
  this->Pass->SetRadius(radius);
  return this->Pass;
}

std::vector<float> OcclusionScene::Array(const std::string& name)
{
  vtkNew<vtkImageData> image;
  this->Pass->CopyOcclusion(image);
  auto* array = vtkFloatArray::SafeDownCast(image->GetPointData()->GetArray(name.c_str()));
  if (!array)
  {
    return {};
  }
  return { array->GetPointer(0), array->GetPointer(0) + array->GetNumberOfValues() };
}

std::vector<int> OcclusionScene::Image()
{
  vtkNew<vtkUnsignedCharArray> bytes;
  this->Window->GetRGBACharPixelData(0, 0, this->Width - 1, this->Height - 1, 0, bytes);
  return { bytes->GetPointer(0), bytes->GetPointer(0) + bytes->GetNumberOfValues() };
}

std::array<int, 2> OcclusionScene::Pixel(const Vector& position)
{
  this->Renderer->SetWorldPoint(position[0], position[1], position[2], 1.0);
  this->Renderer->WorldToDisplay();
  const double* at = this->Renderer->GetDisplayPoint();
  return { static_cast<int>(at[0]), static_cast<int>(at[1]) };
}

Vector OcclusionScene::FloorPointAt(double x, double y)
{
  double ends[2][4];
  for (int end = 0; end < 2; ++end)
  {
    this->Renderer->SetDisplayPoint(x, y, end);
    this->Renderer->DisplayToWorld();
    this->Renderer->GetWorldPoint(ends[end]);
    for (double& coordinate : ends[end])
    {
      coordinate /= ends[end][3];
    }
  }
  const double fraction = ends[0][2] / (ends[0][2] - ends[1][2]);
  return { ends[0][0] + fraction * (ends[1][0] - ends[0][0]),
    ends[0][1] + fraction * (ends[1][1] - ends[0][1]), 0.0 };
}

double OcclusionScene::At(const std::string& name, const Vector& position)
{
  const std::array<int, 2> pixel = this->Pixel(position);
  const std::vector<float> values = this->Array(name);
  const int at = pixel[1] * this->Width + pixel[0];
  return at >= 0 && at < static_cast<int>(values.size()) ? values[at] : -1.0;
}

void AddSphereBeforeWall(OcclusionScene& scene, double unit, const Vector& at)
{
  const auto transform = [&](double x, double y, double z) {
    return Vector{ at[0] + unit * x, at[1] + unit * y, at[2] + unit * z };
  };
  scene.AddWall(transform(-3, -3, 0), { 6 * unit, 0, 0 }, { 0, 4 * unit, 0 });
  scene.AddWall(transform(-3, 1, 0), { 6 * unit, 0, 0 }, { 0, 0, 2 * unit });
  scene.AddSphere(transform(0, 0, 0.5), 0.5 * unit);
  scene.SetCamera(transform(0, -5, 3), transform(0, 0, 0.4));
}

double BehindWall(double distance)
{
  // The wall blocks the part of the unit disk with w.y > distance.
  const double a = distance;
  return a < 1.0 ? (std::acos(a) - a * std::sqrt(1.0 - a * a)) / std::acos(-1.0) : 0.0;
}

double BehindWallFading(double distance)
{
  constexpr int steps = 2000;
  double sum = 0.0;
  for (int i = 0; i < steps; ++i)
  {
    sum += BehindWall(distance / ((i + 0.5) / steps));
  }
  return sum / steps;
}

std::vector<double> ErrorsBeforeAWall(OcclusionScene& scene, double (*reference)(double))
{
  scene.AddFloor();
  scene.AddWall({ -20, 0, 0 }, { 40, 0, 0 }, { 0, 0, 20 });
  scene.SetCamera({ 0, -4, 3 }, { 0, 0, 0 });
  scene.Window->Render();
  const std::vector<float> occlusion = scene.Array("AmbientOcclusion");
  const int footRow = scene.Pixel({ 0, 0, 0 })[1];
  const int column = scene.Width / 2;
  std::vector<double> errors;
  for (int row = 0; row < footRow; ++row)
  {
    const Vector floor = scene.FloorPointAt(column + 0.5, row + 0.5);
    errors.push_back(occlusion[row * scene.Width + column] - reference(-floor[1]));
  }
  return errors;
}

double RootMeanSquare(const std::vector<double>& values)
{
  double squares = 0.0;
  for (const double value : values)
  {
    squares += value * value;
  }
  return std::sqrt(squares / static_cast<double>(values.size()));
}

double Rms(const std::vector<float>& a, const std::vector<float>& b)
{
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size() && i < b.size(); ++i)
  {
    sum += (static_cast<double>(a[i]) - b[i]) * (static_cast<double>(a[i]) - b[i]);
  }
  return a.size() == b.size() && !a.empty() ? std::sqrt(sum / static_cast<double>(a.size())) : 1e9;
}
