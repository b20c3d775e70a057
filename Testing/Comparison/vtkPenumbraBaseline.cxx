// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkPenumbraBaseline.h"

#include "PictureFiles.h"
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

// What the report of a window says after `key`, up to the end of the line.
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

// Off screen and at a fixed density of pixels: nothing is left for a display to decide.
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
  vtkSmartPointer<vtkObject> Picture;
  vtkSmartPointer<vtkImageData> Image; ///< as drawn last
  std::string DrawnBy;
  vtkNew<vtkPenumbraImageComparison> Comparison;
  std::ostringstream Sentences;
  std::string Report;

  void Draw();
};

void vtkPenumbraBaseline::Internals::Draw()
{
  this->Image = nullptr;
  this->DrawnBy = this->Picture ? this->Picture->GetClassName() : "nobody";
  if (auto* window = vtkRenderWindow::SafeDownCast(this->Picture))
  {
    this->Image = ::Draw(window);
    this->DrawnBy = Describe(window);
  }
  else if (auto* algorithm = vtkAlgorithm::SafeDownCast(this->Picture))
  {
    algorithm->Update();
    this->Image = vtkImageData::SafeDownCast(algorithm->GetOutputDataObject(0));
  }
  else
  {
    this->Image = vtkImageData::SafeDownCast(this->Picture);
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

void vtkPenumbraBaseline::SetPicture(vtkObject* picture)
{
  this->Implementation->Picture = picture;
  this->Modified();
}

vtkObject* vtkPenumbraBaseline::GetPicture()
{
  return this->Implementation->Picture;
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
  Internals& self = *this->Implementation;
  self.Sentences.str("");
  const std::string path = this->FileName ? this->FileName : "";
  const std::string accept =
    vtksys::SystemTools::HasEnv(AcceptVariable) ? std::getenv(AcceptVariable) : "";
  bool passes = false;
  self.Draw();
  if (!penumbra::IsPicturePath(path))
  {
    self.Sentences << "'" << path << "' is no baseline: name a .png or .vti\n";
  }
  else if (!self.Image || self.Image->GetNumberOfPoints() == 0)
  {
    self.Sentences
      << path << ": nothing was drawn by " << self.DrawnBy
      << ": give a window, an image, or an algorithm that makes one; a window may lack "
         "OpenGL\n";
  }
  else if (!accept.empty() && accept != "replace" && accept != "add")
  {
    self.Sentences << AcceptVariable << "=" << accept << ": give 'replace' or 'add'\n";
  }
  else
  {
    passes = this->Compare() || (!accept.empty() && this->Accept(accept == "add"));
    if (!passes)
    {
      this->KeepEvidence();
    }
  }
  self.Report = self.Sentences.str();
  return passes;
}

bool vtkPenumbraBaseline::Compare()
{
  Internals& self = *this->Implementation;
  vtkPenumbraImageComparison* comparison = self.Comparison;
  self.Image = penumbra::AsStored(self.Image, this->FileName);
  comparison->SetImage(self.Image);
  comparison->RemoveAllBaselines();
  const std::vector<std::string> paths = penumbra::FindBaselines(this->FileName);
  if (paths.empty())
  {
    self.Sentences << "there is no baseline " << this->FileName << "\n";
    return false;
  }
  for (const std::string& path : paths)
  {
    const vtkSmartPointer<vtkImageData> baseline = penumbra::ReadPicture(path);
    if (!baseline)
    {
      self.Sentences << path << " cannot be read as a picture\n";
      return false;
    }
    comparison->AddBaseline(baseline);
  }
  if (!comparison->Compare())
  {
    self.Sentences << this->FileName << ": " << comparison->GetErrorText() << "\n";
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
  self.Sentences << "the picture is not near " << paths[comparison->GetBestBaseline()] << "\n"
                 << "  " << value(Comparison::TILE_RMSE) << " (limit " << comparison->GetTolerance()
                 << "), " << value(Comparison::PIXELS) << " (limit " << comparison->GetPixelLimit()
                 << "), " << value(Comparison::TILE_PIXELS) << " (limit "
                 << comparison->GetTilePixelLimit() << "); " << value(Comparison::RMSE) << ", "
                 << value(Comparison::MAXIMUM) << ", " << value(Comparison::SSIM) << "\n";
  return false;
}

bool vtkPenumbraBaseline::Accept(bool add)
{
  Internals& self = *this->Implementation;
  const std::string path = add ? penumbra::NextBaseline(this->FileName) : this->FileName;
  if (!penumbra::WritePicture(self.Image, path))
  {
    self.Sentences << path << " cannot be written\n";
    return false;
  }
  self.Sentences << "accepted as " << path << ", drawn by " << self.DrawnBy << "\n";
  return true;
}

void vtkPenumbraBaseline::KeepEvidence()
{
  namespace fs = std::filesystem;
  Internals& self = *this->Implementation;
  const std::string fromEnvironment =
    vtksys::SystemTools::HasEnv(FolderVariable) ? std::getenv(FolderVariable) : DefaultFolder;
  const fs::path folder = this->OutputFolder ? std::string(this->OutputFolder) : fromEnvironment;
  const fs::path file(this->FileName);
  const std::string stem = (this->Name ? std::string(this->Name) + "." : "") + file.stem().string();
  const auto keep = [&](const char* what, vtkImageData* image, const std::string& extension) {
    const std::string path =
      fs::absolute(folder / (stem + "." + what + extension)).lexically_normal().string();
    const bool written = penumbra::WritePicture(penumbra::AsStored(image, path), path);
    self.Sentences << "  " << what << ": " << path << (written ? "" : " (cannot be written)");
  };
  keep("actual", self.Image, file.extension().string());
  self.Sentences << "\n";
  const double largest = self.Comparison->GetValue(vtkPenumbraImageComparison::MAXIMUM);
  if (self.Comparison->GetBestBaseline() >= 0 && largest > 0.0)
  {
    keep("difference", self.Comparison->MakeDifference(1.0 / largest), ".png");
    self.Sentences << ", " << 1.0 / largest << " times\n";
  }
  self.Sentences << "  drawn by: " << self.DrawnBy << "\n  processor: " << DescribeProcessor()
                 << "; VTK " << vtkVersion::GetVTKVersion() << "\n"
                 << "Look at it. If it is right, run this test again with " << AcceptVariable
                 << "=replace, which makes it the baseline, or " << AcceptVariable
                 << "=add, which adds it as one more.\n";
}

void vtkPenumbraBaseline::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Picture: " << this->GetPicture() << "\n";
  os << indent << "FileName: " << (this->FileName ? this->FileName : "(none)") << "\n";
  os << indent << "Name: " << (this->Name ? this->Name : "(none)") << "\n";
  os << indent << "OutputFolder: " << (this->OutputFolder ? this->OutputFolder : "(none)") << "\n";
  os << indent << "Comparison:\n";
  this->Implementation->Comparison->PrintSelf(os, indent.GetNextIndent());
}
