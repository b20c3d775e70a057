// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "Readers.h"

#include "FileSeries.h"
#include "Files/FileExtension.h"
#include "Files/TemporaryFile.h"
#include "Formats/MeshArrays.h"
#include "Formats/MeshReaders.h"
#include "Formats/XdmfCopy.h"
#include "Import/Appearance.h"
#include "Import/GltfCopy.h"
#include "Processes/CommandError.h"
#include "Processes/MessageLog.h"
#include "TimeSteps.h"
#include "Truncation/Truncation.h"
#include "VolumeOrientation.h"
#include "WindingCorrection.h"

#include "vtkAVSucdReader.h"
#include "vtkAlgorithm.h"
#include "vtkBYUReader.h"
#include "vtkDEMReader.h"
#include "vtkDataObject.h"
#include "vtkExodusIIReader.h"
#include "vtkFLUENTReader.h"
#include "vtkFacetReader.h"
#include "vtkFieldData.h"
#include "vtkGAMBITReader.h"
#include "vtkGLTFReader.h"
#include "vtkGenericDataObjectReader.h"
#include "vtkGenericEnSightReader.h"
#include "vtkNIFTIImageReader.h"
#include "vtkOpenFOAMReader.h"
#include "vtkSLCReader.h"
#include "vtkStringArray.h"
#include "vtkTecplotReader.h"
#include "vtkXMLImageDataReader.h"
#include "vtkXMLMultiBlockDataReader.h"
#include "vtkXMLPImageDataReader.h"
#include "vtkXMLPPolyDataReader.h"
#include "vtkXMLPRectilinearGridReader.h"
#include "vtkXMLPStructuredGridReader.h"
#include "vtkXMLPUnstructuredGridReader.h"
#include "vtkXMLPartitionedDataSetCollectionReader.h"
#include "vtkXMLPartitionedDataSetReader.h"
#include "vtkXMLPolyDataReader.h"
#include "vtkXMLRectilinearGridReader.h"
#include "vtkXMLStructuredGridReader.h"
#include "vtkXMLUnstructuredGridReader.h"

#ifdef PENUMBRA_HAS_IOCGNSReader
#include "vtkCGNSReader.h"
#endif
#ifdef PENUMBRA_HAS_IOHDF
#include "vtkHDFReader.h"
#endif
#ifdef PENUMBRA_HAS_IOXdmf2
#include "vtkXdmfReader.h"
#endif

#include <filesystem>

namespace penumbra
{

namespace
{

using Algorithm = vtkSmartPointer<vtkAlgorithm>;

template <typename Reader>
Algorithm Make(const std::string& path)
{
  auto reader = vtkSmartPointer<Reader>::New();
  reader->SetFileName(path.c_str());
  return reader;
}

Algorithm MakeByu(const std::string& path)
{
  auto reader = vtkSmartPointer<vtkBYUReader>::New();
  reader->SetGeometryFileName(path.c_str());
  return reader;
}

Algorithm MakeEnSight(const std::string& path)
{
  auto reader = vtkSmartPointer<vtkGenericEnSightReader>::New();
  reader->SetCaseFileName(path.c_str());
  reader->ReadAllVariablesOn();
  return reader;
}

Algorithm MakeExodus(const std::string& path)
{
  auto reader = vtkSmartPointer<vtkExodusIIReader>::New();
  reader->SetFileName(path.c_str());
  reader->UpdateInformation();
  reader->SetAllArrayStatus(vtkExodusIIReader::NODAL, 1);
  reader->SetAllArrayStatus(vtkExodusIIReader::ELEM_BLOCK, 1);
  return reader;
}

#ifdef PENUMBRA_HAS_IOCGNSReader
Algorithm MakeCgns(const std::string& path)
{
  auto reader = vtkSmartPointer<vtkCGNSReader>::New();
  reader->SetFileName(path.c_str());
  reader->UpdateInformation();
  reader->EnableAllPointArrays();
  reader->EnableAllCellArrays();
  return reader;
}
#endif

Algorithm MakeFoam(const std::string& path)
{
  const std::filesystem::path folder = std::filesystem::path(path).parent_path();
  if (!std::filesystem::exists(folder / "constant") &&
    std::filesystem::exists(folder / "processor0"))
  {
    throw CommandError(BadInput, path + ": the case is decomposed; run reconstructPar");
  }
  return Make<vtkOpenFOAMReader>(path);
}

// The steps of a series are read by the readers of their files, see ReadFileSeries().
Algorithm MakeSeries(const std::string& path)
{
  throw CommandError(
    BadInput, path + ": a time series is not supported here; name one of its files");
}

/// Moves the array UnreadContent to the warnings.
void WarnOfUnread(
  vtkAlgorithm*, const std::string&, vtkDataObject* data, std::vector<std::string>& warnings)
{
  vtkFieldData* const fields = data->GetFieldData();
  auto* const unread = vtkStringArray::SafeDownCast(fields->GetAbstractArray(UnreadContent));
  for (vtkIdType i = 0; unread && i < unread->GetNumberOfValues(); ++i)
  {
    warnings.push_back(unread->GetValue(i));
  }
  fields->RemoveArray(UnreadContent);
}

#define PENUMBRA_READER(reader) #reader, Make < reader>

std::vector<ReaderRow> MakeTable()
{
  return {
    { { ".stl" }, "Stereolithography", "Penumbra", nullptr, ReadStl, WarnOfUnread },
    { { ".ply" }, "Stanford polygons", "Penumbra", nullptr, ReadPly },
    { { ".obj" }, "Wavefront", "Penumbra", nullptr, ReadObj, WarnOfUnread, nullptr, nullptr,
      ImportObj },
    { { ".off" }, "Object File Format", "Penumbra", nullptr, ReadOff },
    { { ".gltf", ".glb" }, "glTF", PENUMBRA_READER(vtkGLTFReader), nullptr, CorrectWindings,
      CopyGltf, nullptr, ImportGltf },
    { { ".3ds" }, "3D Studio", "vtk3DSImporter", nullptr, Read3ds, nullptr, nullptr, nullptr,
      Import3ds },
    { { ".wrl", ".vrml" }, "VRML 2", "vtkVRMLImporter", nullptr, ReadVrml, nullptr, nullptr,
      nullptr, ImportVrml },
    { { ".vtk" }, "VTK legacy", PENUMBRA_READER(vtkGenericDataObjectReader) },
    { { ".vtp" }, "VTK polygons", PENUMBRA_READER(vtkXMLPolyDataReader) },
    { { ".vtu" }, "VTK unstructured grid", PENUMBRA_READER(vtkXMLUnstructuredGridReader) },
    { { ".vti" }, "VTK image", PENUMBRA_READER(vtkXMLImageDataReader) },
    { { ".vts" }, "VTK structured grid", PENUMBRA_READER(vtkXMLStructuredGridReader) },
    { { ".vtr" }, "VTK rectilinear grid", PENUMBRA_READER(vtkXMLRectilinearGridReader) },
    { { ".vtm", ".vtmb" }, "VTK multi-block", PENUMBRA_READER(vtkXMLMultiBlockDataReader) },
    { { ".pvd", ".series" }, "Time series of files", "Penumbra", MakeSeries },
    { { ".vtpd" }, "VTK partitioned", PENUMBRA_READER(vtkXMLPartitionedDataSetReader) },
    { { ".vtpc" }, "VTK partitioned collection",
      PENUMBRA_READER(vtkXMLPartitionedDataSetCollectionReader) },
    { { ".pvtp" }, "VTK polygons in pieces", PENUMBRA_READER(vtkXMLPPolyDataReader) },
    { { ".pvtu" }, "VTK unstructured grid in pieces",
      PENUMBRA_READER(vtkXMLPUnstructuredGridReader) },
    { { ".pvti" }, "VTK image in pieces", PENUMBRA_READER(vtkXMLPImageDataReader) },
    { { ".pvts" }, "VTK structured grid in pieces", PENUMBRA_READER(vtkXMLPStructuredGridReader) },
    { { ".pvtr" }, "VTK rectilinear grid in pieces",
      PENUMBRA_READER(vtkXMLPRectilinearGridReader) },
#ifdef PENUMBRA_HAS_IOHDF
    { { ".vtkhdf" }, "VTK HDF", PENUMBRA_READER(vtkHDFReader) },
#endif
    { { ".e", ".ex2", ".exo", ".exii", ".g" }, "Exodus II", "vtkExodusIIReader", MakeExodus },
    { { ".case", ".encas" }, "EnSight", "vtkGenericEnSightReader", MakeEnSight },
    { { ".foam" }, "OpenFOAM", "vtkOpenFOAMReader", MakeFoam },
    { { ".cas" }, "Fluent", PENUMBRA_READER(vtkFLUENTReader) },
#ifdef PENUMBRA_HAS_IOCGNSReader
    { { ".cgns" }, "CGNS", "vtkCGNSReader", MakeCgns },
#endif
    { { ".tec", ".tp" }, "Tecplot ASCII", PENUMBRA_READER(vtkTecplotReader) },
    { { ".inp" }, "Abaqus", "Penumbra", nullptr, ReadAbaqus, nullptr, nullptr, IsAbaqus },
    { { ".inp" }, "AVS UCD", PENUMBRA_READER(vtkAVSucdReader) },
    { { ".neu" }, "GAMBIT", PENUMBRA_READER(vtkGAMBITReader) },
#ifdef PENUMBRA_HAS_IOXdmf2
    { { ".xdmf", ".xmf" }, "XDMF 2", PENUMBRA_READER(vtkXdmfReader), nullptr, nullptr, CopyXdmf },
#endif
    { { ".byu" }, "Movie.BYU", "vtkBYUReader", MakeByu },
    { { ".facet" }, "Facet", PENUMBRA_READER(vtkFacetReader) },
    { { ".pts" }, "Points", "Penumbra", nullptr, ReadPts },
    { { ".mha", ".mhd" }, "MetaImage", "vtkMetaImageReader", MakeMetaImageReader, nullptr,
      OrientMetaImage },
    { { ".nrrd", ".nhdr" }, "NRRD", "vtkNrrdReader", MakeNrrdReader, nullptr, OrientNrrd },
    { { ".nii", ".nii.gz" }, "NIfTI", PENUMBRA_READER(vtkNIFTIImageReader), nullptr, OrientNifti },
    { { ".slc" }, "SLC volume", PENUMBRA_READER(vtkSLCReader) },
    { { ".dem" }, "USGS digital elevation", PENUMBRA_READER(vtkDEMReader) },
  };
}

#undef PENUMBRA_READER

void CheckFile(const std::string& path)
{
  namespace fs = std::filesystem;
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (!fs::exists(status))
  {
    throw CommandError(BadInput, path + ": no such file; check the name");
  }
  if (fs::is_directory(status))
  {
    throw CommandError(BadInput, path + ": the path is a folder; name the files in it");
  }
  if (!fs::is_regular_file(status))
  {
    throw CommandError(BadInput, path + ": not a regular file; copy it to a regular file");
  }
  std::FILE* file = std::fopen(path.c_str(), "rb");
  if (!file)
  {
    throw CommandError(BadInput, path + ": cannot be opened; check its permissions");
  }
  std::fclose(file);
  // The contents of a .foam file do not matter: it names the folder of a case.
  if (fs::file_size(path, error) == 0 && LowerExtension(path) != ".foam")
  {
    throw CommandError(BadInput, path + ": the file is empty; export it again");
  }
}

/// Returns null if the extension is unknown.
const ReaderRow* TryFindReader(const std::string& path)
{
  const std::string name = LowerCase(std::filesystem::path(path).filename().string());
  for (const ReaderRow& row : Readers())
  {
    for (const std::string& extension : row.Extensions)
    {
      // A name that consists of the extension only has none.
      if (name.size() > extension.size() &&
        name.compare(name.size() - extension.size(), extension.size(), extension) == 0 &&
        (!row.Recognizes || row.Recognizes(path)))
      {
        return &row;
      }
    }
  }
  return nullptr;
}

const ReaderRow& FindReader(const std::string& path)
{
  if (const ReaderRow* row = TryFindReader(path))
  {
    return *row;
  }
  CheckFile(path);
  throw CommandError(BadInput,
    path + ": unknown extension '" + LowerExtension(path) +
      "'; `penumbra list` prints the supported ones");
}

[[noreturn]] void FailReading(
  const std::string& path, const ReaderRow& row, const std::string& reason)
{
  throw CommandError(BadInput, path + ": the file is damaged or not " + row.Format + ": " + reason);
}

vtkSmartPointer<vtkDataObject> ReadData(const std::string& path, std::optional<double> time,
  Appearance* appearance, std::vector<std::string>& warnings);

/// If the file at `path` lists files of blocks or pieces, throws the error of the first one that cannot be read.
void FailReadingPieces(const std::string& path)
{
  for (const std::string& piece : FindPieces(path))
  {
    try
    {
      CheckFile(piece);
      if (TryFindReader(piece) && FindPieces(piece).empty()) // else it may list itself
      {
        std::vector<std::string> ignored;
        ReadData(piece, std::nullopt, nullptr, ignored);
      }
    }
    catch (const CommandError& error)
    {
      throw CommandError(error.ExitStatus, path + ": " + error.what());
    }
  }
}

/// Reads a file; `appearance`: null if it is not read.
vtkSmartPointer<vtkDataObject> ReadData(const std::string& path, std::optional<double> time,
  Appearance* appearance, std::vector<std::string>& warnings)
{
  const ReaderRow& row = FindReader(path);
  CheckFile(path);
  const std::string missing = FindTruncation(path);
  if (!missing.empty())
  {
    ThrowTruncated(path, missing);
  }
  if (row.Read)
  {
    const vtkSmartPointer<vtkDataObject> data = row.Read(path);
    if (row.Complete)
    {
      row.Complete(nullptr, path, data, warnings);
    }
    return data;
  }
  TakeErrors();
  const TemporaryFile copy(row.Prepare ? row.Prepare(path, appearance, warnings) : std::string());
  const Algorithm reader = row.Make(copy.Path.empty() ? path : copy.Path);
  if (time)
  {
    UpdateAtTime(reader, *time);
  }
  else
  {
    reader->Update();
  }
  vtkSmartPointer<vtkDataObject> data = reader->GetOutputDataObject(0);
  const std::vector<std::string> errors = TakeErrors();
  RequireMemory(errors);
  if (!errors.empty())
  {
    FailReadingPieces(path);
    FailReading(path, row, errors.front());
  }
  if (reader->GetErrorCode() != 0 || !data)
  {
    FailReading(path, row, "the reader reported no reason");
  }
  if (row.Complete)
  {
    row.Complete(reader, path, data, warnings);
  }
  return data;
}

}

const std::vector<ReaderRow>& Readers()
{
  static const std::vector<ReaderRow> table = MakeTable();
  return table;
}

std::vector<double> ReadTimes(const std::string& path)
{
  const ReaderRow& row = FindReader(path);
  CheckFile(path);
  if (IsFileSeries(path))
  {
    std::vector<double> times;
    for (const SeriesStep& step : ReadFileSeries(path))
    {
      times.push_back(step.Time);
    }
    return times;
  }
  TakeErrors();
  std::vector<std::string> ignored;
  const TemporaryFile copy(row.Prepare ? row.Prepare(path, nullptr, ignored) : std::string());
  const std::vector<double> times = UpdateTimes(row.Make(copy.Path.empty() ? path : copy.Path));
  const std::vector<std::string> errors = TakeErrors();
  if (!errors.empty())
  {
    FailReading(path, row, errors.front());
  }
  return times;
}

bool MayHaveLights(const std::string& path)
{
  const ReaderRow& row = FindReader(path);
  return row.Import && row.Import != ImportObj;
}

vtkSmartPointer<vtkDataObject> ReadScene(
  const std::string& path, std::optional<double> time, Appearance& appearance)
{
  const vtkSmartPointer<vtkDataObject> data =
    ReadData(path, time, &appearance, appearance.Warnings);
  const ReaderRow& row = FindReader(path);
  return row.Import ? row.Import(path, data, appearance) : data;
}

vtkSmartPointer<vtkDataObject> ReadFile(
  const std::string& path, std::optional<double> time, std::vector<std::string>& warnings)
{
  return ReadData(path, time, nullptr, warnings);
}

}
