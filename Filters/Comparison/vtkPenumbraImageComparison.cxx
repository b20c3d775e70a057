// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkPenumbraImageComparison.h"

#include "ImageMetrics.h"

#include "vtkDataArray.h"
#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <string>
#include <vector>

namespace
{

std::string SizeText(vtkImageData* image)
{
  int dimensions[3];
  image->GetDimensions(dimensions);
  std::ostringstream text;
  text << dimensions[0] << "x" << dimensions[1];
  return text.str();
}

vtkDataArray* FindColor(vtkImageData* image)
{
  vtkDataArray* color = image->GetPointData()->GetArray("Color");
  return color ? color : image->GetPointData()->GetScalars();
}

// Returns the value of full intensity: the maximum of an integer type, 1 for floats.
double FullIntensity(vtkDataArray* color)
{
  const int type = color->GetDataType();
  return type == VTK_FLOAT || type == VTK_DOUBLE ? 1.0 : color->GetDataTypeMax();
}

// Returns the reason why `image` cannot be compared, or an empty string.
std::string FindInconsistency(vtkImageData* image)
{
  int dimensions[3];
  image->GetDimensions(dimensions);
  vtkDataArray* color = FindColor(image);
  if (!color || image->GetNumberOfPoints() == 0)
  {
    return "an image has no pixels";
  }
  if (dimensions[2] != 1 || color->GetNumberOfComponents() > 4)
  {
    return "an image is not two-dimensional with 1 to 4 channels";
  }
  return std::string();
}

penumbra::Planes ReadPlanes(vtkImageData* image)
{
  int dimensions[3];
  image->GetDimensions(dimensions);
  vtkDataArray* color = FindColor(image);
  const int components = color->GetNumberOfComponents();
  const bool hasAlpha = components == 2 || components == 4;
  const double scale = 1.0 / FullIntensity(color);

  penumbra::Planes planes;
  planes.Width = dimensions[0];
  planes.Height = dimensions[1];
  const vtkIdType pixels = color->GetNumberOfTuples();
  for (std::vector<double>& channel : planes.Channels)
  {
    channel.resize(pixels);
  }
  for (vtkIdType i = 0; i < pixels; ++i)
  {
    const double alpha = hasAlpha ? color->GetComponent(i, components - 1) * scale : 1.0;
    for (int c = 0; c < 3; ++c)
    {
      const double value = color->GetComponent(i, components < 3 ? 0 : c) * scale;
      planes.Channels[c][i] = alpha == 0.0 ? 0.0 : value * alpha;
    }
    planes.Channels[3][i] = alpha;
    planes.Opaque = planes.Opaque && alpha == 1.0;
  }
  return planes;
}

bool IsFinite(const penumbra::Planes& planes)
{
  for (const std::vector<double>& channel : planes.Channels)
  {
    for (double value : channel)
    {
      if (!std::isfinite(value))
      {
        return false;
      }
    }
  }
  return true;
}

penumbra::Mask ReadMask(vtkImageData* image)
{
  const penumbra::Planes planes = ReadPlanes(image);
  penumbra::Mask mask(planes.Channels[0].size());
  for (std::size_t i = 0; i < mask.size(); ++i)
  {
    mask[i] =
      planes.Channels[0][i] > 0.0 || planes.Channels[1][i] > 0.0 || planes.Channels[2][i] > 0.0;
  }
  return mask;
}

// Sets pixels that do not count to black in every image.
void Apply(const penumbra::Mask& mask, penumbra::Planes& planes)
{
  for (std::size_t i = 0; i < mask.size(); ++i)
  {
    for (int c = 0; c < 4 && !mask[i]; ++c)
    {
      planes.Channels[c][i] = c < 3 ? 0.0 : 1.0;
    }
  }
}

// Returns `value` divided by its limit; a limit of 0 requires equality.
double Share(double value, double limit)
{
  return value == 0.0 ? 0.0 : value / limit;
}

double Measure(vtkPenumbraImageComparison* limits, int metric, const penumbra::Planes& a,
  const penumbra::Planes& b, const penumbra::Mask& mask)
{
  using Comparison = vtkPenumbraImageComparison;
  switch (metric)
  {
    case Comparison::MAXIMUM:
      return penumbra::LargestDifference(a, b);
    case Comparison::SSIM:
      return penumbra::StructuralDissimilarity(a, b, mask);
    case Comparison::PIXELS:
      return penumbra::FractionOfDifferentPixels(a, b, mask);
    case Comparison::TILE_RMSE:
      return penumbra::WorstTileRootMeanSquare(a, b);
    case Comparison::TILE_PIXELS:
      return penumbra::WorstTileFractionOfDifferentPixels(a, b);
    case Comparison::EXCESS:
      return std::max({ Share(penumbra::WorstTileRootMeanSquare(a, b), limits->GetTolerance()),
        Share(penumbra::FractionOfDifferentPixels(a, b, mask), limits->GetPixelLimit()),
        Share(penumbra::WorstTileFractionOfDifferentPixels(a, b), limits->GetTilePixelLimit()) });
    default:
      return penumbra::RootMeanSquare(a, b, mask);
  }
}

}

struct vtkPenumbraImageComparison::Internals
{
  vtkSmartPointer<vtkImageData> Image;
  vtkSmartPointer<vtkImageData> MaskImage;
  std::vector<vtkSmartPointer<vtkImageData>> Baselines;
  std::string ErrorText;
  int BestBaseline = -1;
  penumbra::Planes ImagePlanes;
  penumbra::Planes BestPlanes;
  penumbra::Mask Mask;

  std::string FindFaults() const;
};

// Returns the reason why the images cannot be compared regardless of their values, or an empty
// string.
std::string vtkPenumbraImageComparison::Internals::FindFaults() const
{
  if (!this->Image || this->Baselines.empty())
  {
    return "an image and at least one baseline are needed";
  }
  std::vector<vtkImageData*> others(this->Baselines.begin(), this->Baselines.end());
  if (this->MaskImage)
  {
    others.push_back(this->MaskImage);
  }
  std::string fault = FindInconsistency(this->Image);
  for (vtkImageData* other : others)
  {
    if (fault.empty())
    {
      fault = FindInconsistency(other);
    }
    if (fault.empty() && SizeText(this->Image) != SizeText(other))
    {
      fault = std::string(other == this->MaskImage ? "the mask differs" : "the images differ") +
        " in size: " + SizeText(this->Image) + " and " + SizeText(other);
    }
  }
  return fault;
}

vtkStandardNewMacro(vtkPenumbraImageComparison);

vtkPenumbraImageComparison::vtkPenumbraImageComparison()
  : Implementation(new Internals)
{
}

vtkPenumbraImageComparison::~vtkPenumbraImageComparison() = default;

const char* vtkPenumbraImageComparison::GetMetricName(int metric)
{
  static const char* const names[NUMBER_OF_METRICS] = { "rmse", "max", "ssim", "pixels",
    "tile-rmse", "tile-pixels", "excess" };
  return metric >= 0 && metric < NUMBER_OF_METRICS ? names[metric] : nullptr;
}

void vtkPenumbraImageComparison::SetImage(vtkImageData* image)
{
  this->Implementation->Image = image;
  this->Modified();
}

void vtkPenumbraImageComparison::AddBaseline(vtkImageData* baseline)
{
  this->Implementation->Baselines.emplace_back(baseline);
  this->Modified();
}

void vtkPenumbraImageComparison::RemoveAllBaselines()
{
  this->Implementation->Baselines.clear();
  this->Modified();
}

void vtkPenumbraImageComparison::SetMask(vtkImageData* mask)
{
  this->Implementation->MaskImage = mask;
  this->Modified();
}

bool vtkPenumbraImageComparison::Compare()
{
  Internals& self = *this->Implementation;
  self.BestBaseline = -1;
  self.ErrorText = self.FindFaults();
  if (!self.ErrorText.empty())
  {
    return false;
  }
  self.Mask = self.MaskImage ? ReadMask(self.MaskImage) : penumbra::Mask();
  if (!self.Mask.empty() && std::find(self.Mask.begin(), self.Mask.end(), true) == self.Mask.end())
  {
    self.ErrorText = "the mask excludes all pixels";
    return false;
  }

  self.ImagePlanes = ReadPlanes(self.Image);
  Apply(self.Mask, self.ImagePlanes);
  bool finite = IsFinite(self.ImagePlanes);
  double best = 0.0;
  for (std::size_t i = 0; i < self.Baselines.size() && finite; ++i)
  {
    penumbra::Planes planes = ReadPlanes(self.Baselines[i]);
    Apply(self.Mask, planes);
    finite = IsFinite(planes);
    const double value = Measure(this, this->Metric, self.ImagePlanes, planes, self.Mask);
    if (self.BestBaseline < 0 || value < best)
    {
      best = value;
      self.BestBaseline = static_cast<int>(i);
      self.BestPlanes = std::move(planes);
    }
  }
  if (!finite)
  {
    self.BestBaseline = -1;
    self.ErrorText = "an image has values that are not finite";
  }
  return finite;
}

const char* vtkPenumbraImageComparison::GetErrorText()
{
  return this->Implementation->ErrorText.c_str();
}

int vtkPenumbraImageComparison::GetBestBaseline()
{
  return this->Implementation->BestBaseline;
}

double vtkPenumbraImageComparison::GetValue(int metric)
{
  const Internals& self = *this->Implementation;
  return self.BestBaseline < 0
    ? std::nan("")
    : Measure(this, metric, self.ImagePlanes, self.BestPlanes, self.Mask);
}

bool vtkPenumbraImageComparison::IsNear()
{
  return this->GetValue(EXCESS) <= 1.0;
}

vtkSmartPointer<vtkImageData> vtkPenumbraImageComparison::MakeDifference(double factor)
{
  const Internals& self = *this->Implementation;
  if (self.BestBaseline < 0)
  {
    return nullptr;
  }
  const penumbra::Planes& a = self.ImagePlanes;
  const penumbra::Planes& b = self.BestPlanes;
  auto difference = vtkSmartPointer<vtkImageData>::New();
  difference->SetDimensions(a.Width, a.Height, 1);
  vtkNew<vtkFloatArray> color;
  color->SetName("Color");
  color->SetNumberOfComponents(4);
  color->SetNumberOfTuples(difference->GetNumberOfPoints());
  for (vtkIdType i = 0; i < color->GetNumberOfTuples(); ++i)
  {
    const double alpha = std::abs(a.Channels[3][i] - b.Channels[3][i]);
    for (int c = 0; c < 3; ++c)
    {
      const double channel = std::abs(a.Channels[c][i] - b.Channels[c][i]);
      color->SetComponent(i, c, factor * (channel + alpha));
    }
    color->SetComponent(i, 3, 1.0);
  }
  difference->GetPointData()->SetScalars(color);
  return difference;
}

const char* vtkPenumbraImageComparison::GetMetricAsString()
{
  return GetMetricName(this->Metric);
}

void vtkPenumbraImageComparison::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Tolerance: " << this->Tolerance << "\n";
  os << indent << "PixelLimit: " << this->PixelLimit << "\n";
  os << indent << "TilePixelLimit: " << this->TilePixelLimit << "\n";
  os << indent << "Metric: " << this->GetMetricAsString() << "\n";
  os << indent << "Baselines: " << this->Implementation->Baselines.size() << "\n";
  os << indent << "BestBaseline: " << this->Implementation->BestBaseline << "\n";
}
