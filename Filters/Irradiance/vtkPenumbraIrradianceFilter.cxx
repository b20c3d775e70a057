// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkPenumbraIrradianceFilter.h"

#include "Baking.h"
#include "Blocks.h"
#include "MeshSites.h"
#include "RayGatherer.h"
#include "RayScene.h"

#include "vtkCellData.h"
#include "vtkCompositeDataSet.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkFloatArray.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPenumbraBruteForceSource.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkSMPTools.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <new>

namespace
{

using namespace penumbra;

constexpr double DefaultRadiusShare = 0.1;

/// What stands for a pixel on a mesh, of the distance of neighbouring points: a record must reach
/// its neighbours to be worth anything, and no further than some dozens of them.
constexpr float PixelOfSpacing = .5f;

/// Surfaces of scans are rough: what of the tolerance bends and turns may take, how many of those
/// pixels a record may reach, and how far off its surface. Measured on a scan of 104 thousand points.
constexpr double BendShare = .5;
constexpr double TurnShare = .1;
constexpr double MostPixels = 16.0;
constexpr double OffSurface = .05;

/// The noise of one record may be above the tolerance, since several are blended; brute force tells
/// an error above its true one. Measured there, too.
constexpr double NoiseOfRecords = 1.4;
constexpr double NoiseOfAnswers = 1.3;

/// Of brute force for a point: neighbours' errors do not average out as those in a pixel do.
constexpr int LeastRays = 128;

void AddStatistic(vtkFieldData* statistics, const std::string& name, double value)
{
  vtkNew<vtkDoubleArray> array;
  array->SetName(name.c_str());
  array->InsertNextValue(value);
  statistics->AddArray(array);
}

/// One value for every point or cell, 0 where nothing asked.
vtkSmartPointer<vtkFloatArray> ArrayOf(
  const MeshSites& mesh, const BakedValues& baked, vtkIdType size)
{
  auto array = vtkSmartPointer<vtkFloatArray>::New();
  array->SetName("AmbientOcclusion");
  array->SetNumberOfTuples(size);
  array->Fill(0.0);
  for (std::size_t i = 0; i < mesh.Ids.size(); ++i)
  {
    array->SetValue(mesh.Ids[i], glm::clamp(baked.Values[i].Mean.x, 0.f, 1.f));
  }
  return array;
}

}

vtkStandardNewMacro(vtkPenumbraIrradianceFilter);

vtkPenumbraIrradianceFilter::vtkPenumbraIrradianceFilter()
  : Statistics(vtkSmartPointer<vtkFieldData>::New()),
    EstimatedError(std::nan(""))
{
}

vtkPenumbraIrradianceFilter::~vtkPenumbraIrradianceFilter() = default;

vtkFieldData* vtkPenumbraIrradianceFilter::GetStatistics()
{
  return this->Statistics;
}

int vtkPenumbraIrradianceFilter::FillInputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkPointSet");
  info->Append(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkCompositeDataSet");
  return 1;
}

int vtkPenumbraIrradianceFilter::RequestData(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  this->Statistics->Initialize();
  this->EstimatedError = std::nan("");
  try
  {
    vtkSMPTools::LocalScope(
      vtkSMPTools::Config(this->NumberOfThreads), [&]() { this->Execute(inputs[0], outputs); });
  }
  catch (const std::bad_alloc&)
  {
    vtkErrorMacro("Out of memory: give a smaller mesh.");
    return 0;
  }
  catch (const std::exception& error)
  {
    vtkErrorMacro(<< error.what());
    return 0;
  }
  return 1;
}

void vtkPenumbraIrradianceFilter::Execute(
  vtkInformationVector* inputs, vtkInformationVector* outputs)
{
  vtkDataObject* output = vtkDataObject::GetData(outputs);
  const int pieces = outputs->GetInformationObject(0)->Get(
    vtkStreamingDemandDrivenPipeline::UPDATE_NUMBER_OF_PIECES());
  if (pieces > 1)
  {
    vtkWarningMacro(
      "This is one of " << pieces << " pieces: what the others hold does not block it.");
  }
  if (auto* composite = vtkCompositeDataSet::GetData(inputs))
  {
    const Blocks blocks(composite);
    if (blocks.GetNumberOfOthers() > 0)
    {
      vtkWarningMacro(<< blocks.GetNumberOfOthers() << " blocks are no meshes: they take no part.");
    }
    vtkPointSet* joined = blocks.GetJoined();
    const auto baked = vtkSmartPointer<vtkPointSet>::Take(joined->NewInstance());
    baked->ShallowCopy(joined);
    this->BakeOnto(joined, baked);
    blocks.Distribute(baked, vtkCompositeDataSet::SafeDownCast(output));
  }
  else
  {
    vtkPointSet* input = vtkPointSet::GetData(inputs);
    output->ShallowCopy(input);
    this->BakeOnto(input, vtkPointSet::SafeDownCast(output));
  }
  for (int i = 0; i < this->Statistics->GetNumberOfArrays(); ++i)
  {
    output->GetFieldData()->AddArray(this->Statistics->GetAbstractArray(i));
  }
}

void vtkPenumbraIrradianceFilter::BakeOnto(vtkPointSet* input, vtkPointSet* output)
{
  MeshChoices choices;
  choices.OfCells = this->OnCells;
  choices.ComputeNormals = this->ComputeNormals;
  choices.PointRadius = this->PointRadius;
  MeshSites mesh = FindMeshSites(input, choices);
  for (Site& site : mesh.Sites)
  {
    site.Pixel *= PixelOfSpacing;
  }
  if (mesh.Unused > 0 || mesh.NotFinite > 0)
  {
    vtkWarningMacro(<< mesh.Unused << (this->OnCells ? " cells" : " points")
                    << " are of no surface and " << mesh.NotFinite
                    << " are not finite or have no normal: their value is 0.");
  }

  const RayScene rays(mesh.Blocking, this->NumberOfThreads);
  const double radius = this->Radius > 0.0 ? this->Radius : DefaultRadiusShare * mesh.Diagonal;
  const OcclusionGatherer gatherer(rays, static_cast<float>(radius * mesh.Blocking.Scale));
  PlacementSettings settings;
  settings.Tolerance = BendShare * this->Tolerance;
  settings.MostPixels = MostPixels;
  settings.OffSurface = OffSurface;
  settings.Side = Placement::SideFor(NoiseOfRecords * this->Tolerance);
  RecordTree tree;
  tree.Initialize(glm::vec3(0.f), .5f);
  tree.SetNormalAngle(Placement::NormalAngleFor(TurnShare * this->Tolerance));
  Placement places(gatherer, settings, tree);
  vtkNew<vtkPenumbraBruteForceSource> source;
  source->SetMinimumRays(LeastRays);
  source->Begin(rays, radius, NoiseOfAnswers * this->Tolerance);
  const Scene& scene = mesh.Blocking;
  const auto bruteForce = [&](const Site& site, long long& count) {
    const glm::dvec3 world = glm::dvec3(site.Position) / scene.Scale + scene.Origin;
    const glm::dvec3 normal(site.Normal);
    const auto answer = source->Occlusion(&world.x, &normal.x);
    count += answer.Rays;
    return BakedValue{ glm::vec3(static_cast<float>(answer.Value)),
      static_cast<float>(answer.Error) };
  };
  const auto progress = [this](double share) {
    this->UpdateProgress(share);
    return this->GetAbortExecute() != 0;
  };
  BakedValues baked;
  if (!Bake(mesh.Sites, mesh.Spacing, this->Method == AUTOMATIC, places, tree, bruteForce, progress,
        baked))
  {
    return;
  }

  vtkDataSetAttributes* attributes = this->OnCells
    ? static_cast<vtkDataSetAttributes*>(output->GetCellData())
    : static_cast<vtkDataSetAttributes*>(output->GetPointData());
  const vtkIdType size = this->OnCells ? input->GetNumberOfCells() : input->GetNumberOfPoints();
  attributes->AddArray(ArrayOf(mesh, baked, size));

  double square = 0.0;
  for (const BakedValue& value : baked.Values)
  {
    square += static_cast<double>(value.Error) * value.Error;
  }
  this->EstimatedError =
    baked.Values.empty() ? 0.0 : std::sqrt(square / static_cast<double>(baked.Values.size()));
  const std::string what = this->OnCells ? "Cells/" : "Points/";
  vtkFieldData* s = this->Statistics;
  AddStatistic(s, what + "Total", static_cast<double>(size));
  AddStatistic(s, what + "Interpolated", static_cast<double>(baked.Interpolated));
  AddStatistic(s, what + "BruteForce", static_cast<double>(baked.BruteForce));
  AddStatistic(s, what + "Unused", static_cast<double>(mesh.Unused));
  AddStatistic(s, what + "NotFinite", static_cast<double>(mesh.NotFinite));
  AddStatistic(s, "Cache/Records", static_cast<double>(tree.GetRecords().size()));
  AddStatistic(s, "Cache/Bytes", static_cast<double>(tree.GetBytes()));
  AddStatistic(s, "Rays/Gather", static_cast<double>(places.GetRays()));
  AddStatistic(s, "Rays/Occlusion", static_cast<double>(baked.BruteForceRays));
  AddStatistic(s, "Rays/Total", static_cast<double>(places.GetRays() + baked.BruteForceRays));
}

void vtkPenumbraIrradianceFilter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Tolerance: " << this->Tolerance << "\n";
  os << indent << "Radius: " << this->Radius << "\n";
  os << indent << "OnCells: " << this->OnCells << "\n";
  os << indent << "ComputeNormals: " << this->ComputeNormals << "\n";
  os << indent << "PointRadius: " << this->PointRadius << "\n";
  os << indent << "Method: " << this->Method << "\n";
  os << indent << "NumberOfThreads: " << this->NumberOfThreads << "\n";
  os << indent << "EstimatedError: " << this->EstimatedError << "\n";
}
