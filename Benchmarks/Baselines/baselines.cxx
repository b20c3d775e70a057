// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Compares images across machine configurations. `./penumbra benchmark baselines` runs this program
// once per configuration:
//   draw rays|opengl FOLDER            the gallery under the present settings
//   compare FOLDER REFERENCE SETTING   rows of the table: a setting against the reference
#include "BaselineScenes.h"
#include "vtkPenumbraImageComparison.h"
#include "vtkPenumbraRayCaster.h"

#include "vtkDataArray.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPNGReader.h"
#include "vtkPNGWriter.h"
#include "vtkPointData.h"
#include "vtkRenderWindow.h"
#include "vtkRenderer.h"
#include "vtkWindowToImageFilter.h"
#include "vtkXMLImageDataReader.h"
#include "vtkXMLImageDataWriter.h"

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <string>

namespace penumbra
{
namespace
{

constexpr int Size[2] = { 320, 240 };
/// Ambient occlusion by brute force is slow: the image is smaller and has a larger tolerance.
constexpr int SizeWithLight[2] = { 96, 72 };
constexpr double ToleranceWithLight = 1.0 / 16.0;

// Returns false if the ray caster fails, for example with an instruction set that the processor
// lacks.
bool DrawByRays(const BaselineScene& exhibit, const std::string& path)
{
  vtkNew<vtkPenumbraRayCaster> caster;
  caster->SetRenderer(exhibit.Make());
  caster->SetResolution(Size[0], Size[1]);
  if (exhibit.AddsLight)
  {
    caster->SetResolution(SizeWithLight[0], SizeWithLight[1]);
    caster->SetTolerance(ToleranceWithLight);
    caster->ShadowsOn();
    caster->AmbientOcclusionOn();
  }
  caster->GeometryArraysOn();
  caster->Update();
  if (caster->GetOutput()->GetPointData()->GetNumberOfArrays() == 0)
  {
    return false;
  }
  vtkNew<vtkXMLImageDataWriter> writer;
  writer->SetInputData(caster->GetOutput());
  writer->SetFileName((path + ".vti").c_str());
  return writer->Write() != 0;
}

void DrawByOpenGL(const BaselineScene& exhibit, const std::string& path)
{
  vtkNew<vtkRenderWindow> window;
  window->SetOffScreenRendering(1);
  window->SetShowWindow(false);
  window->SetSize(Size[0], Size[1]);
  window->SetMultiSamples(0);
  window->AddRenderer(exhibit.Make());
  window->Render();
  vtkNew<vtkWindowToImageFilter> reader;
  reader->SetInput(window);
  reader->ShouldRerenderOff();
  reader->ReadFrontBufferOff();
  vtkNew<vtkPNGWriter> writer;
  writer->SetInputConnection(reader->GetOutputPort());
  writer->SetFileName((path + ".png").c_str());
  writer->Write();
}

template <typename Reader>
vtkSmartPointer<vtkImageData> Read(const std::string& path)
{
  vtkNew<Reader> reader;
  reader->SetFileName(path.c_str());
  reader->Update();
  return reader->GetOutput();
}

// Counts the values of all arrays whose bits differ.
long long CountOtherBits(vtkImageData* a, vtkImageData* b)
{
  long long count = 0;
  for (int i = 0; i < a->GetPointData()->GetNumberOfArrays(); ++i)
  {
    vtkDataArray* left = a->GetPointData()->GetArray(i);
    vtkDataArray* right = b->GetPointData()->GetArray(left->GetName());
    const auto size = static_cast<std::size_t>(left->GetDataTypeSize());
    const auto* first = static_cast<const char*>(left->GetVoidPointer(0));
    const auto* second = static_cast<const char*>(right->GetVoidPointer(0));
    for (vtkIdType value = 0; value < left->GetNumberOfValues(); ++value)
    {
      count += std::memcmp(first + value * size, second + value * size, size) != 0;
    }
  }
  return count;
}

void Compare(const BaselineScene& exhibit, vtkImageData* image, vtkImageData* reference,
  const std::string& setting)
{
  using Comparison = vtkPenumbraImageComparison;
  vtkNew<vtkPenumbraImageComparison> comparison;
  comparison->SetImage(image);
  comparison->AddBaseline(reference);
  comparison->Compare();
  std::printf("| %s | %s | %lld | %.4f | %.5f | %.4f | %.4f | %s |\n", setting.c_str(),
    exhibit.Name.c_str(), CountOtherBits(image, reference),
    comparison->GetValue(Comparison::MAXIMUM), comparison->GetValue(Comparison::PIXELS),
    comparison->GetValue(Comparison::TILE_RMSE), comparison->GetValue(Comparison::TILE_PIXELS),
    comparison->IsNear() ? "yes" : "no");
}

}
}

int main(int argc, char* argv[])
{
  using namespace penumbra;
  if (argc < 4)
  {
    std::fprintf(stderr, "penumbra-benchmark-baselines: run ./penumbra benchmark baselines\n");
    return 2;
  }
  const std::string verb = argv[1];
  for (const BaselineScene& exhibit : Gallery())
  {
    if (verb == "draw")
    {
      const std::string path = std::string(argv[3]) + "/" + exhibit.Name;
      const bool byRays = std::string(argv[2]) == "rays";
      if (!byRays)
      {
        DrawByOpenGL(exhibit, path);
      }
      else if (exhibit.ByRays && !DrawByRays(exhibit, path))
      {
        return 3;
      }
      continue;
    }
    const std::string path = std::string(argv[2]) + "/" + exhibit.Name;
    const std::string reference = std::string(argv[3]) + "/" + exhibit.Name;
    if (std::filesystem::exists(path + ".vti"))
    {
      Compare(exhibit, Read<vtkXMLImageDataReader>(path + ".vti"),
        Read<vtkXMLImageDataReader>(reference + ".vti"), argv[argc - 1]);
    }
    if (std::filesystem::exists(path + ".png"))
    {
      Compare(exhibit, Read<vtkPNGReader>(path + ".png"), Read<vtkPNGReader>(reference + ".png"),
        argv[argc - 1]);
    }
  }
  return 0;
}
