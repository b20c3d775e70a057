// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkPenumbraBaseline.h"

#include "BaselineFiles.h"
#include "vtkPenumbraImageComparison.h"

#include "vtkAlgorithm.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkRenderWindow.h"
#include "vtkVersion.h"
#include "vtkWindowToImageFilter.h"

#include <vtksys/SystemInformation.hxx>
#include <vtksys/SystemTools.hxx>

#include <cstdlib>
#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

namespace
{

constexpr const char* WindowVariable = "VTK_DEFAULT_OPENGL_WINDOW";
constexpr const char* AcceptVariable = "PENUMBRA_ACCEPT";
constexpr const char* FolderVariable = "PENUMBRA_FAILED_IMAGES";
constexpr const char* DefaultFolder = "failed-images";

// Returns the text after `key` in the report of a window, up to the end of the line.
std::string Find(const std::string& report, const std::string& key)
{
  const std::size_t at = report.find(key);
  const std::size_t begin =
    at == std::string::npos ? at : report.find_first_not_of(' ', at + key.size());
  return begin == std::string::npos ? "unknown"
                                    : report.substr(begin, report.find('\n', begin) - begin);
}

std::string Describe(vtkRenderWindow* window)
{
  const char* report = window->ReportCapabilities();
  const std::string capabilities = report ? report : "";
  return std::string(window->GetClassName()) + ", OpenGL " +
    Find(capabilities, "OpenGL version string:") + ", " +
    Find(capabilities, "OpenGL renderer string:");
}

// Returns whether no object factory replaced the base class, whose windows render nothing.
bool HasNoOpenGL(vtkObject* object)
{
  return object && std::string(object->GetClassName()) == "vtkRenderWindow";
}

// Render off screen at a fixed resolution, so that the image does not depend on a display.
vtkSmartPointer<vtkImageData> Draw(vtkRenderWindow* window)
{
  window->SetOffScreenRendering(1);
  window->SetShowWindow(false);
  window->SetDPI(72);
  window->Render();
  vtkNew<vtkWindowToImageFilter> reader;
  reader->SetInput(window);
  reader->ShouldRerenderOff();
  reader->ReadFrontBufferOff();
  reader->Update();
  return reader->GetOutput();
}

std::string DescribeProcessor()
{
  vtksys::SystemInformation machine;
  machine.RunCPUCheck();
  return machine.GetExtendedProcessorName();
}

}

struct vtkPenumbraBaseline::Internals
{
  vtkSmartPointer<vtkObject> Object;
  vtkSmartPointer<vtkImageData> Image; ///< as rendered last
  std::string RenderedBy;
  vtkNew<vtkPenumbraImageComparison> Comparison;
  std::ostringstream ReportStream;
  std::string Report;

  void Draw();
};

void vtkPenumbraBaseline::Internals::Draw()
{
  this->Image = nullptr;
  this->RenderedBy = this->Object ? this->Object->GetClassName() : "no object";
  if (HasNoOpenGL(this->Object))
  {
    return;
  }
  if (auto* window = vtkRenderWindow::SafeDownCast(this->Object))
  {
    this->Image = ::Draw(window);
    this->RenderedBy = Describe(window);
  }
  else if (auto* algorithm = vtkAlgorithm::SafeDownCast(this->Object))
  {
    algorithm->Update();
    this->Image = vtkImageData::SafeDownCast(algorithm->GetOutputDataObject(0));
  }
  else
  {
    this->Image = vtkImageData::SafeDownCast(this->Object);
  }
}

vtkStandardNewMacro(vtkPenumbraBaseline);

vtkPenumbraBaseline::vtkPenumbraBaseline()
  : Implementation(new Internals)
{
  this->Implementation->Comparison->SetMetric(vtkPenumbraImageComparison::EXCESS);
}

vtkPenumbraBaseline::~vtkPenumbraBaseline()
{
  this->SetFileName(nullptr);
  this->SetName(nullptr);
  this->SetOutputFolder(nullptr);
}

void vtkPenumbraBaseline::PreferOSMesa()
{
  if (!vtksys::SystemTools::HasEnv(WindowVariable))
  {
    vtksys::SystemTools::PutEnv(std::string(WindowVariable) + "=vtkOSOpenGLRenderWindow");
  }
}

void vtkPenumbraBaseline::SetImage(vtkObject* object)
{
  this->Implementation->Object = object;
  this->Modified();
}

vtkObject* vtkPenumbraBaseline::GetImage()
{
  return this->Implementation->Object;
}

vtkPenumbraImageComparison* vtkPenumbraBaseline::GetComparison()
{
  return this->Implementation->Comparison;
}

const char* vtkPenumbraBaseline::GetReport()
{
  return this->Implementation->Report.c_str();
}

bool vtkPenumbraBaseline::Check()
{
  Internals& implementation = *this->Implementation;
  implementation.ReportStream.str("");
  const std::string path = this->FileName ? this->FileName : "";
  const std::string accept =
    vtksys::SystemTools::HasEnv(AcceptVariable) ? std::getenv(AcceptVariable) : "";
  bool passes = false;
  implementation.Draw();
  if (!penumbra::IsBaselinePath(path))
  {
    implementation.ReportStream
      << "'" << path << "' is not a baseline file: give a path that ends in .png or .vti\n";
  }
  else if (HasNoOpenGL(implementation.Object))
  {
    implementation.ReportStream
      << "The window has no OpenGL: call vtk_module_autoinit for VTK::RenderingOpenGL2.\n";
  }
  else if (!implementation.Image || implementation.Image->GetNumberOfPoints() == 0)
  {
    implementation.ReportStream
      << path << ": no image was rendered by " << implementation.RenderedBy
      << ": set a window, an image, or an algorithm that outputs one; for a window, check that "
         "OpenGL works\n";
  }
  else if (!accept.empty() && accept != "replace" && accept != "add")
  {
    implementation.ReportStream << AcceptVariable << "=" << accept
                                << ": set it to 'replace' or 'add'\n";
  }
  else
  {
    passes = this->Compare() || (!accept.empty() && this->Accept(accept == "add"));
    if (!passes)
    {
      this->KeepEvidence();
    }
  }
  implementation.Report = implementation.ReportStream.str();
  return passes;
}

bool vtkPenumbraBaseline::Compare()
{
  Internals& implementation = *this->Implementation;
  vtkPenumbraImageComparison* comparison = implementation.Comparison;
  implementation.Image = penumbra::AsStored(implementation.Image, this->FileName);
  comparison->SetImage(implementation.Image);
  comparison->RemoveAllBaselines();
  const std::vector<std::string> paths = penumbra::FindBaselines(this->FileName);
  if (paths.empty())
  {
    implementation.ReportStream << "there is no baseline " << this->FileName << "\n";
    return false;
  }
  for (const std::string& path : paths)
  {
    const vtkSmartPointer<vtkImageData> baseline = penumbra::ReadBaseline(path);
    if (!baseline)
    {
      implementation.ReportStream << path << " cannot be read as an image\n";
      return false;
    }
    comparison->AddBaseline(baseline);
  }
  if (!comparison->Compare())
  {
    implementation.ReportStream << this->FileName << ": " << comparison->GetErrorText() << "\n";
    return false;
  }
  if (comparison->IsNear())
  {
    return true;
  }
  const auto value = [comparison](int metric) {
    std::ostringstream text;
    text << vtkPenumbraImageComparison::GetMetricName(metric) << " "
         << comparison->GetValue(metric);
    return text.str();
  };
  using Comparison = vtkPenumbraImageComparison;
  implementation.ReportStream << "the image is not near " << paths[comparison->GetBestBaseline()]
                              << "\n"
                              << "  " << value(Comparison::TILE_RMSE) << " (limit "
                              << comparison->GetTolerance() << "), " << value(Comparison::PIXELS)
                              << " (limit " << comparison->GetPixelLimit() << "), "
                              << value(Comparison::TILE_PIXELS) << " (limit "
                              << comparison->GetTilePixelLimit() << "); " << value(Comparison::RMSE)
                              << ", " << value(Comparison::MAXIMUM) << ", "
                              << value(Comparison::SSIM) << "\n";
  return false;
}

bool vtkPenumbraBaseline::Accept(bool add)
{
  Internals& implementation = *this->Implementation;
  const std::string path = add ? penumbra::NextBaseline(this->FileName) : this->FileName;
  if (!penumbra::WriteBaseline(implementation.Image, path))
  {
    implementation.ReportStream << path << " cannot be written\n";
    return false;
  }
  implementation.ReportStream << "accepted as " << path << ", rendered by "
                              << implementation.RenderedBy << "\n";
  return true;
}

void vtkPenumbraBaseline::KeepEvidence()
{
  namespace fs = std::filesystem;
  Internals& implementation = *this->Implementation;
  const std::string fromEnvironment =
    vtksys::SystemTools::HasEnv(FolderVariable) ? std::getenv(FolderVariable) : DefaultFolder;
  const fs::path folder = this->OutputFolder ? std::string(this->OutputFolder) : fromEnvironment;
  const fs::path file(this->FileName);
  const std::string stem = (this->Name ? std::string(this->Name) + "." : "") + file.stem().string();
  const auto keep = [&](const char* what, vtkImageData* image, const std::string& extension) {
    const std::string path =
      fs::absolute(folder / (stem + "." + what + extension)).lexically_normal().string();
    const bool written = penumbra::WriteBaseline(penumbra::AsStored(image, path), path);
    implementation.ReportStream << "  " << what << ": " << path
                                << (written ? "" : " (cannot be written)");
  };
  keep("actual", implementation.Image, file.extension().string());
  implementation.ReportStream << "\n";
  const double largest = implementation.Comparison->GetValue(vtkPenumbraImageComparison::MAXIMUM);
  if (implementation.Comparison->GetBestBaseline() >= 0 && largest > 0.0)
  {
    keep("difference", implementation.Comparison->MakeDifference(1.0 / largest), ".png");
    implementation.ReportStream << ", " << 1.0 / largest << " times\n";
  }
  implementation.ReportStream << "  rendered by: " << implementation.RenderedBy
                              << "\n  processor: " << DescribeProcessor() << "; VTK "
                              << vtkVersion::GetVTKVersion() << "\n"
                              << "Inspect the image. If it is correct, run this test again with "
                              << AcceptVariable << "=replace to make it the baseline, or "
                              << AcceptVariable << "=add to add it as another baseline.\n";
}

void vtkPenumbraBaseline::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Image: " << this->GetImage() << "\n";
  os << indent << "FileName: " << (this->FileName ? this->FileName : "(none)") << "\n";
  os << indent << "Name: " << (this->Name ? this->Name : "(none)") << "\n";
  os << indent << "OutputFolder: " << (this->OutputFolder ? this->OutputFolder : "(none)") << "\n";
  os << indent << "Comparison:\n";
  this->Implementation->Comparison->PrintSelf(os, indent.GetNextIndent());
}
