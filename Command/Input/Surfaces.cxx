// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "Surfaces.h"

#include "DataSetValidation.h"
#include "FileSeries.h"
#include "Files/InputFiles.h"
#include "Files/Report.h"
#include "Geometry/CurvedCells.h"
#include "GridOffset.h"
#include "Processes/CommandError.h"
#include "Processes/Worker.h"
#include "ReadLimit.h"
#include "Readers.h"
#include "TimeSteps.h"

#include "vtkActor.h"
#include "vtkCamera.h"
#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkDataSet.h"
#include "vtkDataSetAttributes.h"
#include "vtkGeometryFilter.h"
#include "vtkIdList.h"
#include "vtkIdTypeArray.h"
#include "vtkImageData.h"
#include "vtkLight.h"
#include "vtkMatrix3x3.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkReverseSense.h"
#include "vtkVertexGlyphFilter.h"

#include <algorithm>
#include <cmath>
#include <new>
#include <numeric>
#include <set>
#include <sstream>

namespace penumbra
{

namespace
{

constexpr int HiddenCells = vtkDataSetAttributes::DUPLICATECELL | vtkDataSetAttributes::HIDDENCELL;

vtkSmartPointer<vtkPolyData> MakeMesh(vtkDataSet* data)
{
  vtkPolyData* mesh = vtkPolyData::SafeDownCast(data);
  if (mesh && mesh->GetNumberOfCells() > 0)
  {
    return mesh;
  }
  if (data->GetNumberOfCells() == 0)
  {
    vtkNew<vtkVertexGlyphFilter> vertices; // Point clouds are rendered as vertices.
    vertices->SetInputData(data);
    vertices->Update();
    return vertices->GetOutput();
  }
  const bool hasIds = data->GetCellData()->HasArray(OriginalCellIds); // of the cells before cuts
  if (auto curved = ExtractCurvedSurface(data, hasIds ? nullptr : OriginalCellIds))
  {
    return curved;
  }
  vtkNew<vtkGeometryFilter> geometry;
  geometry->SetInputData(data);
  if (!hasIds)
  {
    geometry->PassThroughCellIdsOn();
    geometry->SetOriginalCellIdsName(OriginalCellIds);
  }
  geometry->Update();
  auto* image = vtkImageData::SafeDownCast(data);
  if (image && image->GetDirectionMatrix()->Determinant() < 0.0)
  {
    vtkNew<vtkReverseSense> outward; // Left-handed axes turn the surface inside out.
    outward->SetInputConnection(geometry->GetOutputPort());
    outward->Update();
    return outward->GetOutput();
  }
  return geometry->GetOutput();
}

bool IsFinite(vtkPoints* points, vtkIdType id)
{
  double x[3];
  points->GetPoint(id, x);
  return std::isfinite(x[0]) && std::isfinite(x[1]) && std::isfinite(x[2]);
}

std::vector<bool> FindFinitePoints(vtkPoints* points, vtkIdType& dropped)
{
  const vtkIdType count = points ? points->GetNumberOfPoints() : 0;
  std::vector<bool> finite(count);
  dropped = 0;
  for (vtkIdType i = 0; i < count; ++i)
  {
    finite[i] = IsFinite(points, i);
    dropped += !finite[i];
  }
  return finite;
}

// Adds an array of the cell ids.
void AddCellIds(vtkDataSet* data)
{
  vtkNew<vtkIdTypeArray> ids;
  ids->SetName(OriginalCellIds);
  ids->SetNumberOfValues(data->GetNumberOfCells());
  std::iota(ids->GetPointer(0), ids->GetPointer(0) + ids->GetNumberOfValues(), vtkIdType(0));
  data->GetCellData()->AddArray(ids);
}

// Returns whether `ghosts`, which may be null, marks a cell or point as one of `kinds`.
bool IsGhost(vtkDataArray* ghosts, vtkIdType id, int kinds)
{
  return ghosts && id < ghosts->GetNumberOfTuples() &&
    (static_cast<int>(ghosts->GetComponent(id, 0)) & kinds) != 0;
}

// Marks hidden points as not finite. Returns whether a cell or point is hidden or a duplicate, as in vtkGeometryFilter.
bool FindHidden(vtkPolyData* mesh, std::vector<bool>& finite)
{
  const char* name = vtkDataSetAttributes::GhostArrayName();
  vtkDataArray* ofPoints = mesh->GetPointData()->GetArray(name);
  vtkDataArray* ofCells = mesh->GetCellData()->GetArray(name);
  bool isAny = false;
  for (std::size_t i = 0; ofPoints && i < finite.size(); ++i)
  {
    const bool isHidden =
      IsGhost(ofPoints, static_cast<vtkIdType>(i), vtkDataSetAttributes::HIDDENPOINT);
    finite[i] = finite[i] && !isHidden;
    isAny = isAny || isHidden;
  }
  for (vtkIdType i = 0; ofCells && !isAny && i < mesh->GetNumberOfCells(); ++i)
  {
    isAny = IsGhost(ofCells, i, HiddenCells);
  }
  return isAny;
}

// Returns the mesh without unused points, hidden cells and the cells that use a hidden or non-finite point.
vtkSmartPointer<vtkPolyData> DropCells(vtkPolyData* mesh, const std::vector<bool>& finite)
{
  vtkDataArray* ghosts = mesh->GetCellData()->GetArray(vtkDataSetAttributes::GhostArrayName());
  vtkNew<vtkPolyData> kept;
  kept->DeepCopy(mesh);
  if (!kept->GetCellData()->HasArray(OriginalCellIds))
  {
    AddCellIds(kept);
  }
  kept->BuildCells();
  vtkNew<vtkIdList> corners;
  for (vtkIdType cell = 0; cell < kept->GetNumberOfCells(); ++cell)
  {
    if (IsGhost(ghosts, cell, HiddenCells))
    {
      kept->DeleteCell(cell);
      continue;
    }
    kept->GetCellPoints(cell, corners);
    for (vtkIdType i = 0; i < corners->GetNumberOfIds(); ++i)
    {
      if (!finite[corners->GetId(i)])
      {
        kept->DeleteCell(cell);
        break;
      }
    }
  }
  kept->RemoveDeletedCells();
  return RemoveUnusedPoints(kept);
}

/// Returns the distance of coordinates if they are of single precision and it is visible, else 0.
double FindRoundingStepOfPoints(vtkPolyData* mesh)
{
  double bounds[6];
  mesh->GetBounds(bounds);
  return mesh->GetPoints() && mesh->GetPoints()->GetDataType() == VTK_FLOAT
    ? FindRoundingStep(bounds)
    : 0.0;
}

vtkIdType CountShortPolygons(vtkPolyData* mesh)
{
  vtkCellArray* const polygons = mesh->GetPolys();
  vtkIdType count = 0;
  for (vtkIdType i = 0; i < polygons->GetNumberOfCells(); ++i)
  {
    count += polygons->GetCellSize(i) < 3 ? 1 : 0;
  }
  return count;
}

/// Returns the name of the file, and of the data set if there are several.
std::string NameSource(const std::string& path, std::size_t dataSet, std::size_t dataSets)
{
  return dataSets > 1
    ? path + " (part " + std::to_string(dataSet + 1) + " of " + std::to_string(dataSets) + ")"
    : path;
}

Surfaces ExtractSurfaces(
  vtkDataObject* data, Appearance appearance, const CutList& cuts, const std::string& path)
{
  Surfaces surfaces;
  std::string missing;
  bool wasCut = false;
  std::set<std::string> others;
  const std::vector<vtkDataSet*> dataSets = FindDataSets(data, &others);
  if (dataSets.empty() && !others.empty())
  {
    throw CommandError(BadInput,
      path + ": a " + *others.begin() +
        " cannot be rendered; convert it to polygons or an unstructured grid");
  }
  for (const std::string& other : others)
  {
    appearance.Warnings.push_back(
      "blocks of the class " + other + " cannot be rendered and were skipped");
  }
  appearance.Actors.resize(dataSets.size());
  for (std::size_t i = 0; i < dataSets.size(); ++i)
  {
    vtkDataSet* dataSet = dataSets[i];
    const std::string inconsistency = FindInconsistency(dataSet);
    if (!inconsistency.empty())
    {
      throw CommandError(BadInput, path + ": the file is damaged: " + inconsistency);
    }
    const GridOffset offset(dataSet);
    vtkSmartPointer<vtkDataSet> rest = offset.ToOrigin(dataSet);
    if (!cuts.Cuts.empty())
    {
      const bool isCloud = dataSet->GetNumberOfCells() == 0;
      std::string missingHere;
      if (isCloud)
      {
        rest = MakeMesh(rest);
      }
      const auto marked = vtkSmartPointer<vtkDataSet>::Take(rest->NewInstance());
      marked->ShallowCopy(rest);
      AddCellIds(marked);
      rest = ApplyCuts(marked, offset.ToOrigin(cuts), missingHere);
      missing = missingHere.empty() ? missing : missingHere;
      wasCut = wasCut || missingHere.empty();
    }
    vtkSmartPointer<vtkPolyData> mesh = offset.FromOrigin(MakeMesh(rest));
    vtkIdType dropped = 0;
    std::vector<bool> finite = FindFinitePoints(mesh->GetPoints(), dropped);
    surfaces.Points += mesh->GetNumberOfPoints();
    surfaces.DroppedPoints += dropped;
    if (FindHidden(mesh, finite) || dropped > 0)
    {
      mesh = DropCells(mesh, finite);
    }
    if (mesh->GetNumberOfCells() > 0 && mesh->GetNumberOfPoints() > 0)
    {
      surfaces.RoundingStep = std::max(surfaces.RoundingStep, FindRoundingStepOfPoints(mesh));
      surfaces.HasArea = surfaces.HasArea || !HasOnlyZeroArea(mesh);
      surfaces.Polygons += mesh->GetNumberOfPolys();
      surfaces.ShortPolygons += CountShortPolygons(mesh);
      surfaces.Meshes.push_back(mesh);
      surfaces.Names.push_back(NameSource(path, i, dataSets.size()));
      surfaces.Actors.push_back(appearance.Actors[i]);
    }
  }
  surfaces.Lights = appearance.Lights;
  surfaces.Cameras = appearance.Cameras;
  surfaces.Warnings = appearance.Warnings;
  if (!missing.empty() && !wasCut)
  {
    throw CommandError(BadInput,
      path + ": --contour or --threshold: the file does not have " +
        (missing == "any" ? "an array" : "the array '" + missing + "'"));
  }
  return surfaces;
}

/// Returns the warning of meshes of which nothing is visible from any side.
std::string DescribeZeroArea(const std::vector<vtkSmartPointer<vtkPolyData>>& meshes)
{
  const bool onlyLines = std::all_of(meshes.begin(), meshes.end(),
    [](vtkPolyData* mesh) { return mesh->GetNumberOfLines() == mesh->GetNumberOfCells(); });
  return onlyLines
    ? "the lines have no length: the points of every line coincide; export the mesh again"
    : "the surface has no area: the corners of every polygon coincide or are on one line; "
      "export the mesh again";
}

// Returns the files to read, those of one step if the file is a series.
std::vector<std::string> FindFiles(const std::string& path, std::optional<double> time)
{
  if (!IsFileSeries(path))
  {
    return { path };
  }
  const std::vector<double> times = ReadTimes(path);
  return ReadFileSeries(path)[time ? FindStep(times, *time) : 0].Files;
}

Surfaces ReadOneFile(const std::string& path, const InputOptions& options)
{
  const ReadLimit limit(path);
  try
  {
    Appearance appearance;
    const vtkSmartPointer<vtkDataObject> data = options.Materials
      ? ReadScene(path, options.Time, appearance)
      : ReadFile(path, options.Time, appearance.Warnings);
    return ExtractSurfaces(data, appearance, options.Cuts, path);
  }
  catch (const CommandError&)
  {
    throw;
  }
  catch (const std::bad_alloc&)
  {
    // A file that is small compared with the memory should not exhaust it: treat it as damaged.
    if (!limit.IsByFile() && InputBytes(path) > MachineMemory() / 64)
    {
      throw;
    }
    throw CommandError(BadInput,
      path +
        ": the file is damaged: reading it requests more memory than a file of its size can need");
  }
  catch (const std::exception& error)
  {
    throw CommandError(BadInput, path + ": the file is damaged: " + error.what());
  }
}

}

const char* const CurvedFaces = CurvedFaceIds;

void Surfaces::Append(const Surfaces& other)
{
  const auto append = [](auto& all, const auto& more) {
    all.insert(all.end(), more.begin(), more.end());
  };
  append(this->Files, other.Files);
  append(this->Meshes, other.Meshes);
  append(this->Names, other.Names);
  append(this->Actors, other.Actors);
  append(this->Lights, other.Lights);
  append(this->Cameras, other.Cameras);
  append(this->Warnings, other.Warnings);
  this->Points += other.Points;
  this->DroppedPoints += other.DroppedPoints;
  this->Polygons += other.Polygons;
  this->ShortPolygons += other.ShortPolygons;
  this->RoundingStep = std::max(this->RoundingStep, other.RoundingStep);
  this->HasArea = this->HasArea || other.HasArea;
}

Surfaces ReadSurfaces(const std::string& path, const InputOptions& options)
{
  RecordInput(path);
  Surfaces surfaces;
  for (const std::string& file : FindFiles(path, options.Time))
  {
    try
    {
      surfaces.Append(ReadOneFile(file, options));
    }
    catch (const CommandError& error)
    {
      if (file == path)
      {
        throw;
      }
      throw CommandError(error.ExitStatus, path + ": " + error.what());
    }
  }
  surfaces.Files = { path };
  if (surfaces.DroppedPoints > 0)
  {
    surfaces.Warnings.push_back(std::to_string(surfaces.DroppedPoints) + " of " +
      std::to_string(surfaces.Points) +
      " points are not finite; they and the cells that use them were skipped");
  }
  if (surfaces.ShortPolygons > 0)
  {
    surfaces.Warnings.push_back(std::to_string(surfaces.ShortPolygons) + " of " +
      std::to_string(surfaces.Polygons) +
      " polygons have fewer than three corners and are not drawn");
  }
  if (surfaces.RoundingStep > 0.0)
  {
    std::ostringstream text;
    text << "coordinates of single precision are rounded to multiples of " << surfaces.RoundingStep
         << "; subtract an offset from them before they are stored, or store them in double "
            "precision";
    surfaces.Warnings.push_back(text.str());
  }
  if (!surfaces.Meshes.empty() && !surfaces.HasArea)
  {
    surfaces.Warnings.push_back(DescribeZeroArea(surfaces.Meshes));
  }
  NameFile(path, surfaces.Warnings);
  if (surfaces.Meshes.empty() && surfaces.DroppedPoints > 0)
  {
    throw CommandError(
      BadInput, path + ": no cell has only finite coordinates; export the mesh again");
  }
  if (surfaces.Meshes.empty() && !options.AllowEmpty)
  {
    throw CommandError(BadInput,
      path +
        (options.Cuts.Cuts.empty()
            ? ": the mesh is empty; choose a file that contains cells or points"
            : ": --slice, --clip, --contour or --threshold leaves nothing; choose other values"));
  }
  return surfaces;
}

}
