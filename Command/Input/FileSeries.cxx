// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "FileSeries.h"

#include "Files/FileExtension.h"
#include "Files/JsonObject.h"
#include "Processes/CommandError.h"
#include "Processes/MessageLog.h"

#include "vtkSmartPointer.h"
#include "vtkXMLDataElement.h"
#include "vtkXMLUtilities.h"

#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>

namespace penumbra
{

namespace
{

using FilesByTime = std::map<double, std::vector<std::string>>;

[[noreturn]] void Fail(const std::string& path, const std::string& reason)
{
  throw CommandError(BadInput, path + ": the file is damaged or not a time series: " + reason);
}

void Add(const std::string& path, const std::string& file, double time, FilesByTime& steps)
{
  if (!std::isfinite(time))
  {
    Fail(path, "the time of " + file + " is not finite");
  }
  steps[time].push_back((std::filesystem::path(path).parent_path() / file).string());
}

vtkSmartPointer<vtkXMLDataElement> ReadXml(const std::string& path)
{
  const auto root =
    vtkSmartPointer<vtkXMLDataElement>::Take(vtkXMLUtilities::ReadElementFromFile(path.c_str()));
  TakeErrors();
  return root;
}

FilesByTime ReadCollection(const std::string& path)
{
  const vtkSmartPointer<vtkXMLDataElement> root = ReadXml(path);
  vtkXMLDataElement* collection = root ? root->FindNestedElementWithName("Collection") : nullptr;
  if (!collection)
  {
    Fail(path, "it is not complete XML with the element Collection");
  }
  FilesByTime steps;
  for (int i = 0; i < collection->GetNumberOfNestedElements(); ++i)
  {
    vtkXMLDataElement* entry = collection->GetNestedElement(i);
    const char* file = entry->GetAttribute("file");
    if (std::strcmp(entry->GetName(), "DataSet") != 0)
    {
      continue;
    }
    if (!file)
    {
      Fail(path, "an element DataSet names no file");
    }
    double time = 0.0;
    if (entry->GetAttribute("timestep") && !entry->GetScalarAttribute("timestep", time))
    {
      Fail(path, "the time of " + std::string(file) + " is not a number");
    }
    Add(path, file, time, steps);
  }
  return steps;
}

void AddPieces(
  vtkXMLDataElement* element, const std::filesystem::path& folder, std::vector<std::string>& pieces)
{
  for (const char* attribute : { "file", "Source" })
  {
    if (const char* name = element->GetAttribute(attribute))
    {
      pieces.push_back((folder / name).string());
    }
  }
  for (int i = 0; i < element->GetNumberOfNestedElements(); ++i)
  {
    AddPieces(element->GetNestedElement(i), folder, pieces);
  }
}

FilesByTime ReadJsonSeries(const std::string& path)
{
  FilesByTime steps;
  std::ifstream file(path, std::ios::binary);
  try
  {
    const std::string text{ std::istreambuf_iterator<char>(file), {} };
    for (const auto& [name, time] : ParseJsonSeries(text))
    {
      Add(path, name, time, steps);
    }
  }
  catch (const CommandError&)
  {
    throw;
  }
  catch (const std::runtime_error& error)
  {
    Fail(path, error.what());
  }
  return steps;
}

}

bool IsFileSeries(const std::string& path)
{
  const std::string extension = LowerExtension(path);
  return extension == ".pvd" || extension == ".series";
}

std::vector<SeriesStep> ReadFileSeries(const std::string& path)
{
  const FilesByTime files =
    LowerExtension(path) == ".pvd" ? ReadCollection(path) : ReadJsonSeries(path);
  if (files.empty())
  {
    throw CommandError(BadInput, path + ": the time series lists no file; export it again");
  }
  std::vector<SeriesStep> steps;
  for (const auto& [time, parts] : files)
  {
    steps.push_back({ time, parts });
  }
  return steps;
}

std::vector<std::string> FindPieces(const std::string& path)
{
  std::vector<std::string> pieces;
  const std::string extension = LowerExtension(path);
  const bool isList = extension.compare(0, 3, ".vt") == 0 || extension.compare(0, 4, ".pvt") == 0;
  const vtkSmartPointer<vtkXMLDataElement> root = isList ? ReadXml(path) : nullptr;
  if (root)
  {
    AddPieces(root, std::filesystem::path(path).parent_path(), pieces);
  }
  return pieces;
}

}
