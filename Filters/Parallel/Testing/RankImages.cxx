// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "RankImages.h"

#include "ForkedRanks.h"

#include "vtkActor.h"
#include "vtkAppendPolyData.h"
#include "vtkCallbackCommand.h"
#include "vtkCamera.h"
#include "vtkCellArray.h"
#include "vtkCommand.h"
#include "vtkDataArray.h"
#include "vtkFieldData.h"
#include "vtkImageData.h"
#include "vtkLight.h"
#include "vtkNew.h"
#include "vtkPenumbraDistributedRayCaster.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyDataMapper.h"
#include "vtkSphereSource.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

namespace penumbra
{
namespace
{

/// Returns the strip `part` of `parts` of a bumpy sphere with the center (x, 0, 3 x). Points of both sides
/// of a seam are equal.
vtkSmartPointer<vtkPolyData> MakeStrip(int part, int parts, double x, int resolution)
{
  vtkNew<vtkSphereSource> sphere;
  sphere->SetThetaResolution(resolution);
  sphere->SetPhiResolution(resolution);
  sphere->SetStartTheta(360.0 * part / parts + 7.0);
  sphere->SetEndTheta(360.0 * (part + 1) / parts + 7.0);
  sphere->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
  sphere->Update();
  auto strip = vtkSmartPointer<vtkPolyData>::New();
  strip->DeepCopy(sphere->GetOutput());
  for (vtkIdType i = 0; i < strip->GetNumberOfPoints(); ++i)
  {
    double p[3];
    strip->GetPoint(i, p);
    for (double& c : p)
    {
      c = std::round(1e6 * c) / 1e6;
    }
    const double bump = 1.0 + 0.2 * std::sin(9.0 * p[1]) * std::sin(7.0 * p[2]);
    strip->GetPoints()->SetPoint(i, x + bump * p[0], bump * p[1], 3.0 * x + bump * p[2]);
  }
  strip->GetPointData()->Initialize();
  return strip;
}

/// Describes the pixels and the statistics of an image by name, in every bit.
std::map<std::string, std::string> Describe(vtkImageData* image)
{
  std::map<std::string, std::string> result;
  vtkFieldData* const all[] = { image->GetPointData(), image->GetFieldData() };
  for (vtkFieldData* fields : all)
  {
    const std::string prefix = fields == all[0] ? "" : "Statistics/";
    for (int i = 0; i < fields->GetNumberOfArrays(); ++i)
    {
      vtkDataArray* array = fields->GetArray(i);
      const char* bytes = static_cast<const char*>(array->GetVoidPointer(0));
      result[prefix + array->GetName()] =
        std::string(bytes, bytes + array->GetNumberOfValues() * array->GetDataTypeSize());
    }
  }
  return result;
}

}

vtkSmartPointer<vtkPolyData> MakePiece(int rank, int ranks, int resolution)
{
  vtkNew<vtkAppendPolyData> append;
  for (const double x : { -0.4, 0.0, 0.5 })
  {
    append->AddInputData(MakeStrip(rank, ranks, x, resolution));
  }
  append->Update();
  return append->GetOutput();
}

void AddVerticesAndLines(vtkPolyData* piece, int group, int count, double low)
{
  vtkNew<vtkCellArray> vertices;
  vtkNew<vtkCellArray> lines;
  vertices->DeepCopy(piece->GetVerts());
  lines->DeepCopy(piece->GetLines());
  for (int i = 0; i < count; ++i)
  {
    const double angle = 0.5 * i + group;
    const vtkIdType point =
      piece->GetPoints()->InsertNextPoint(std::cos(angle), std::sin(angle), 0.2 * i + low);
    vertices->InsertNextCell(1, &point);
    if (i % 3 != 0)
    {
      const vtkIdType ends[2] = { point - 1, point };
      lines->InsertNextCell(2, ends);
    }
  }
  piece->SetVerts(vertices);
  piece->SetLines(lines);
}

std::string Pack(const std::map<std::string, std::string>& arrays)
{
  std::string bytes;
  for (const auto& [name, value] : arrays)
  {
    bytes += name + '\n' + std::to_string(value.size()) + '\n' + value;
  }
  return bytes;
}

std::map<std::string, std::string> Unpack(const std::string& bytes)
{
  std::map<std::string, std::string> arrays;
  for (std::size_t at = 0; at < bytes.size();)
  {
    const std::size_t name = bytes.find('\n', at);
    const std::size_t size = bytes.find('\n', name + 1);
    const std::size_t length = std::stoul(bytes.substr(name + 1, size - name - 1));
    arrays[bytes.substr(at, name - at)] = bytes.substr(size + 1, length);
    at = size + 1 + length;
  }
  return arrays;
}

std::map<std::string, std::string> Render(
  Caster* caster, const std::vector<vtkDataObject*>& data, const Settings& settings)
{
  std::map<std::string, std::string> messages;
  vtkNew<vtkCallbackCommand> keep;
  keep->SetClientData(&messages);
  keep->SetCallback([](vtkObject*, unsigned long event, void* to, void* text) {
    auto& kept = *static_cast<std::map<std::string, std::string>*>(to);
    kept[event == vtkCommand::ErrorEvent ? "Error" : "Warning"] += static_cast<const char*>(text);
  });
  caster->AddObserver(vtkCommand::ErrorEvent, keep);
  caster->AddObserver(vtkCommand::WarningEvent, keep);
  caster->SetResolution(Width, Height);
  settings(caster);
  for (vtkDataObject* each : data)
  {
    caster->AddInputDataObject(each);
  }
  caster->Update();
  std::map<std::string, std::string> result = Describe(caster->GetOutput());
  result.insert(messages.begin(), messages.end());
  return result;
}

std::vector<Image> RenderOnRanks(int ranks, const MakeData& make, const Settings& settings)
{
  std::vector<Image> images;
  for (const RankResult& result : RunRanks(ranks, [&](int rank) {
         vtkNew<vtkPenumbraDistributedRayCaster> caster;
         caster->SetNumberOfThreads(1 + rank % 2);
         return Pack(Render(caster, { make(rank, ranks) }, settings));
       }))
  {
    EXPECT_TRUE(result.HasReturned);
    images.push_back(Unpack(result.Value));
  }
  return images;
}

Image RenderOnOne(int ranks, const MakeData& make, const Settings& settings)
{
  const RankResult result = RunRanks(1, [&](int) {
    vtkNew<vtkAppendPolyData> append;
    for (int rank = 0; rank < ranks; ++rank)
    {
      append->AddInputData(vtkPolyData::SafeDownCast(make(rank, ranks)));
    }
    append->Update();
    vtkNew<vtkPenumbraRayCaster> caster;
    return Pack(Render(caster, { append->GetOutput() }, settings));
  })[0];
  EXPECT_TRUE(result.HasReturned);
  return Unpack(result.Value);
}

double GetNumber(const Image& image, const char* name)
{
  const auto found = image.find(name);
  double value = std::nan("");
  if (found != image.end() && found->second.size() == sizeof value)
  {
    std::memcpy(&value, found->second.data(), sizeof value);
  }
  return value;
}

void ExpectSame(const Image& image, const Image& expected)
{
  for (const auto& [name, value] : image)
  {
    EXPECT_TRUE(expected.count(name) != 0 || name.rfind("Statistics/Exchange/", 0) == 0) << name;
  }
  for (const auto& [name, value] : expected)
  {
    if (name == "Warning") // contains an address
    {
      continue;
    }
    const auto found = image.find(name);
    ASSERT_NE(found, image.end()) << name;
    if (name != "Statistics/Rays/Repeated" && name != "CellId" &&
      name.rfind("Statistics/Exchange/", 0) != 0)
    {
      EXPECT_TRUE(found->second == value) << name << ": " << GetNumber(image, name.c_str()) << ", "
                                          << GetNumber(expected, name.c_str());
    }
  }
}

Image ExpectSameOnRanks(int ranks, const MakeData& make, const Settings& settings)
{
  const Image expected = RenderOnOne(ranks, make, settings);
  EXPECT_EQ(expected.at("Color").size(), 16u * Width * Height);
  EXPECT_EQ(expected.count("Error"), 0u);
  for (const Image& image : RenderOnRanks(ranks, make, settings))
  {
    ExpectSame(image, expected);
  }
  return expected;
}

vtkSmartPointer<vtkRenderer> MakeRenderer(
  vtkPolyData* data, const std::function<void(vtkActor*)>& change)
{
  auto renderer = vtkSmartPointer<vtkRenderer>::New();
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(data);
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  change(actor);
  renderer->AddActor(actor);
  renderer->SetBackground(0.1, 0.2, 0.3);
  vtkCamera* camera = renderer->GetActiveCamera();
  camera->SetPosition(2.0, 1.5, 6.0);
  camera->SetFocalPoint(0.1, 0.1, 0.1);
  camera->SetClippingRange(0.1, 100.0);
  vtkNew<vtkLight> light;
  light->SetPosition(3.0, 5.0, 4.0);
  renderer->AddLight(light);
  return renderer;
}

Image ExpectSameViewsOnRanks(int ranks, const MakeData& make,
  const std::function<void(vtkActor*)>& change, const Settings& settings)
{
  const auto view = [&](vtkPolyData* data) {
    return [=](Caster* caster) {
      caster->SetRenderer(MakeRenderer(data, change));
      settings(caster);
    };
  };
  const Image expected = Unpack(RunRanks(1,
    [&](int) {
      vtkNew<vtkAppendPolyData> append;
      for (int rank = 0; rank < ranks; ++rank)
      {
        append->AddInputData(vtkPolyData::SafeDownCast(make(rank, ranks)));
      }
      append->Update();
      vtkNew<vtkPenumbraRayCaster> caster;
      return Pack(Render(caster, {}, view(append->GetOutput())));
    })[0]
                                  .Value);
  EXPECT_EQ(expected.at("Color").size(), 16u * Width * Height);
  for (const RankResult& result : RunRanks(ranks, [&](int rank) {
         vtkNew<vtkPenumbraDistributedRayCaster> caster;
         const vtkSmartPointer<vtkDataObject> piece = make(rank, ranks);
         return Pack(Render(caster, {}, view(vtkPolyData::SafeDownCast(piece))));
       }))
  {
    EXPECT_TRUE(result.HasReturned);
    ExpectSame(Unpack(result.Value), expected);
  }
  return expected;
}

}
