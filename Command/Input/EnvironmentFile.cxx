// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "EnvironmentFile.h"

#include "Files/ImageFiles.h"
#include "Files/InputFiles.h"
#include "Processes/CommandError.h"
#include "Processes/MessageLog.h"
#include "Processes/OptionNames.h"
#include "ReadLimit.h"

#include "vtkHDRReader.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPenumbraEnvironment.h"
#include "vtkVersion.h"

#include <filesystem>
#include <memory>
#include <stdexcept>

namespace penumbra
{
namespace
{

vtkSmartPointer<vtkImageData> ReadHdr(const std::string& path)
{
  TakeErrors();
  vtkNew<vtkHDRReader> reader;
  const bool readable = reader->CanReadFile(path.c_str()) != 0;
  if (readable)
  {
    reader->SetFileName(path.c_str());
    reader->UpdateInformation();
    const int* extent = reader->GetDataExtent();
    if (extent[0] > extent[1] || extent[2] > extent[3])
    {
      throw CommandError(
        BadInput, "--hdri-file: " + path + ": the image has no pixels; export it again");
    }
    reader->Update();
  }
  const std::vector<std::string> errors = TakeErrors();
  if (!readable || !errors.empty())
  {
    throw CommandError(BadInput,
      "--hdri-file: " + path + ": VTK " + vtkVersion::GetVTKVersion() +
        " cannot read it; convert it to a .tif or .vti of floats" +
        (errors.empty() ? std::string() : " (" + errors.front() + ")"));
  }
  return reader->GetOutput();
}

}

vtkSmartPointer<vtkPenumbraEnvironment> ReadEnvironment(
  const std::string& path, const std::optional<Vector3>& up)
{
  const std::filesystem::path file(path);
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(file, ignored))
  {
    throw CommandError(BadInput, "--hdri-file: " + path + ": no such file; check the name");
  }
  RecordInput(path);
  auto limit = std::make_unique<ReadLimit>(path);
  const vtkSmartPointer<vtkImageData> image =
    file.extension() == ".hdr" ? ReadHdr(path) : ReadImage(path);
  limit.reset();
  auto environment = vtkSmartPointer<vtkPenumbraEnvironment>::New();
  environment->SetImage(image);
  const Vector3 upwards = up.value_or(Vector3{ 0.0, 1.0, 0.0 });
  environment->SetUp(upwards[0], upwards[1], upwards[2]);
  try
  {
    environment->GetMap();
  }
  catch (const std::runtime_error& error)
  {
    throw CommandError(BadInput, "--hdri-file: " + path + ": " + NameOptions(error.what()));
  }
  return environment;
}

void AddEnvironmentOptions(const CommandLine& app, std::string& path, std::optional<Vector3>& up)
{
  app.AddText("--hdri-file", path, "FILE",
    "Environment image in latitude-longitude layout: .hdr, or an image "
    "format of --output; replaces --environment-color");
  AddDirection(
    app, "--hdri-up", up, "Direction of the upper edge of the environment image; default: 0,1,0");
}

}
