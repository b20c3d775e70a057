// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// The table of Documentation/dev/Architecture.md: what each folder of the repository may include.
#ifndef penumbra_ModuleTable_h
#define penumbra_ModuleTable_h

#include "SourceFiles.h"

#include <algorithm>
#include <regex>
#include <string>
#include <utility>
#include <vector>

namespace penumbra_testing
{

/// A row of the table: a module or one of its rooms, the folders that it may include, and the
/// libraries that it may use in addition to VTK's data and RenderingCore. A row names earlier rows
/// only, so that no include goes back up. A header in the list is a public one of the same module
/// that includes no room.
struct Row
{
  std::string Folder;
  Names Folders;
  Names Libraries;
};

inline const std::vector<Row> Table = {
  { "Filters/Statistics", {}, {} },

  { "Filters/Medium", {}, {} },

  { "Filters/Comparison", {}, {} },

  { "Filters/Scene/Execution", {}, {} },
  // OpenGL: the classes of two mappers that have no other base class.
  { "Filters/Scene", { "Filters/Scene/Execution" }, { "GLM", "OpenGL" } },
  { "Filters/Scene/Environment", { "Filters/Scene/Execution" }, { "GLM" } },
  { "Filters/Scene/Features", {}, {} },
  { "Filters/Scene/Geometry", { "Filters/Scene", "Filters/Scene/Execution" }, { "GLM" } },
  { "Filters/Scene/Tessellation",
    { "Filters/Scene", "Filters/Scene/Execution", "Filters/Scene/Geometry" }, { "GLM" } },
  { "Filters/Scene/Annotation", { "Filters/Scene", "Filters/Scene/Features" }, { "GLM" } },
  { "Filters/Scene/Import",
    { "Filters/Scene", "Filters/Scene/Execution", "Filters/Scene/Environment",
      "Filters/Scene/Features", "Filters/Scene/Geometry", "Filters/Scene/Tessellation",
      "Filters/Scene/Annotation" },
    { "GLM" } },

  { "Filters/RayTracing/Embree", { "Filters/Scene", "Filters/Scene/Execution" },
    { "Embree", "GLM" } },
  { "Filters/RayTracing/Lights", { "Filters/Scene", "Filters/Scene/Execution" }, { "GLM" } },
  { "Filters/RayTracing/Shading",
    { "Filters/Scene", "Filters/Scene/Environment", "Filters/Scene/Geometry",
      "Filters/RayTracing/Embree", "Filters/RayTracing/Lights" },
    { "GLM" } },
  { "Filters/RayTracing/Media",
    { "Filters/Scene", "Filters/RayTracing/Lights", "Filters/RayTracing/Shading",
      "Filters/Medium" },
    { "GLM" } },
  { "Filters/RayTracing",
    { "Filters/Scene", "Filters/RayTracing/Embree", "Filters/RayTracing/Shading" }, { "GLM" } },

  { "Filters/RayCasting/Sampling",
    { "Filters/Scene", "Filters/RayTracing/Embree", "Filters/RayTracing/Shading",
      "Filters/RayTracing/Media", "Filters/RayTracing" },
    { "GLM" } },
  { "Filters/RayCasting/Light",
    { "Filters/Scene", "Filters/Scene/Execution", "Filters/RayTracing/Embree",
      "Filters/RayTracing/Shading", "Filters/RayCasting/Sampling" },
    { "GLM" } },
  { "Filters/RayCasting/Tiles",
    { "Filters/Scene", "Filters/Scene/Execution", "Filters/RayCasting/Sampling" }, { "GLM" } },
  { "Filters/RayCasting/Rasterization",
    { "Filters/Scene", "Filters/Scene/Execution", "Filters/RayTracing/Embree",
      "Filters/RayTracing/Shading", "Filters/RayCasting/Tiles" },
    { "GLM" } },
  { "Filters/RayCasting/Edges",
    { "Filters/Scene", "Filters/Scene/Execution", "Filters/RayCasting/Sampling",
      "Filters/RayCasting/Tiles" },
    { "GLM" } },
  { "Filters/RayCasting/Pixels",
    { "Filters/Scene", "Filters/Scene/Execution", "Filters/RayTracing/Embree",
      "Filters/RayCasting/Sampling", "Filters/RayCasting/Tiles", "Filters/RayCasting/Rasterization",
      "Filters/RayCasting/Edges", "vtkPenumbraRayCasterConstants.h" },
    { "GLM" } },
  { "Filters/RayCasting/Samples",
    { "Filters/Scene", "Filters/RayTracing/Shading", "Filters/RayCasting/Sampling",
      "Filters/RayCasting/Tiles", "Filters/RayCasting/Rasterization", "Filters/RayCasting/Edges",
      "Filters/RayCasting/Pixels" },
    { "GLM" } },
  { "Filters/RayCasting/Coverage",
    { "Filters/Scene", "Filters/RayCasting/Sampling", "Filters/RayCasting/Pixels",
      "Filters/RayCasting/Samples" },
    { "GLM" } },
  { "Filters/RayCasting/Image",
    { "Filters/Scene", "Filters/Scene/Execution", "Filters/RayTracing/Shading",
      "Filters/RayCasting/Sampling", "Filters/RayCasting/Light", "Filters/RayCasting/Tiles",
      "Filters/RayCasting/Edges", "Filters/RayCasting/Pixels", "Filters/RayCasting/Samples",
      "Filters/RayCasting/Coverage" },
    { "GLM" } },
  { "Filters/RayCasting/Vector",
    { "Filters/Scene", "Filters/Scene/Execution", "Filters/RayCasting/Sampling",
      "Filters/RayCasting/Edges" },
    { "GLM" } },
  { "Filters/RayCasting/Distribution", { "Filters/Scene/Execution", "Filters/RayCasting/Image" },
    {} },
  { "Filters/RayCasting",
    { "Filters/Statistics", "Filters/Medium", "Filters/Scene", "Filters/Scene/Features",
      "Filters/Scene/Import", "Filters/Scene/Execution", "Filters/RayTracing/Shading",
      "Filters/RayTracing/Media", "Filters/RayTracing", "Filters/RayCasting/Sampling",
      "Filters/RayCasting/Light", "Filters/RayCasting/Image", "Filters/RayCasting/Distribution",
      "Filters/RayCasting/Vector" },
    { "GLM" } },

  { "Filters/Irradiance/Gathering",
    { "Filters/Scene", "Filters/RayTracing/Embree", "Filters/RayTracing/Shading" }, { "GLM" } },
  { "Filters/Irradiance/Records",
    { "Filters/Scene", "Filters/Scene/Execution", "Filters/RayTracing/Embree",
      "Filters/RayTracing/Shading", "Filters/Irradiance/Gathering" },
    { "GLM" } },
  { "Filters/Irradiance/Distribution", { "Filters/Scene/Execution" }, { "GLM" } },
  { "Filters/Irradiance/Baking",
    { "Filters/Scene", "Filters/Scene/Geometry", "Filters/Scene/Execution",
      "Filters/Scene/Tessellation", "Filters/RayTracing/Embree", "Filters/RayTracing/Shading",
      "Filters/RayTracing", "Filters/Irradiance/Gathering", "Filters/Irradiance/Records" },
    { "GLM" } },
  { "Filters/Irradiance",
    { "Filters/Statistics", "Filters/Scene", "Filters/Scene/Execution", "Filters/RayTracing/Embree",
      "Filters/RayTracing/Shading", "Filters/RayTracing", "Filters/Irradiance/Gathering",
      "Filters/Irradiance/Records", "Filters/Irradiance/Distribution",
      "Filters/Irradiance/Baking" },
    { "GLM" } },

  { "Filters/Parallel/Messages", { "Filters/Scene", "Filters/Scene/Execution" }, { "GLM" } },
  { "Filters/Parallel/Shadows", { "Filters/Scene" }, { "GLM" } },
  { "Filters/Parallel",
    { "Filters/Parallel/Messages", "Filters/Parallel/Shadows", "Filters/Statistics",
      "Filters/Scene", "Filters/Scene/Geometry", "Filters/RayTracing/Embree",
      "Filters/RayCasting/Tiles", "Filters/RayCasting/Edges", "Filters/RayCasting/Image",
      "Filters/RayCasting/Distribution", "Filters/RayCasting", "Filters/Irradiance/Distribution",
      "Filters/Irradiance" },
    { "GLM" } },

  { "Rendering/ScreenSpace/Frame", {}, { "OpenGL" } },
  { "Rendering/ScreenSpace/Chain", { "Filters/Medium" }, { "OpenGL" } },
  { "Rendering/ScreenSpace/Occlusion",
    { "Rendering/ScreenSpace/Frame", "vtkPenumbraOcclusionConstants.h",
      "vtkPenumbraOcclusionEstimator.h" },
    { "OpenGL" } },
  { "Rendering/ScreenSpace/Shafts", { "Filters/Medium", "Rendering/ScreenSpace/Frame" },
    { "OpenGL" } },
  { "Rendering/ScreenSpace",
    { "Filters/Statistics", "Filters/Medium", "Rendering/ScreenSpace/Frame",
      "Rendering/ScreenSpace/Chain", "Rendering/ScreenSpace/Occlusion",
      "Rendering/ScreenSpace/Shafts" },
    { "OpenGL" } },

  { "Rendering/Irradiance/Traced",
    { "Filters/Scene", "Filters/Scene/Import", "Filters/Scene/Execution",
      "Filters/RayTracing/Embree", "Filters/RayTracing/Shading", "Filters/RayCasting/Light",
      "Rendering/ScreenSpace/Frame" },
    { "OpenGL", "GLM" } },
  { "Rendering/Irradiance/Splats", { "Filters/Irradiance/Records", "Rendering/ScreenSpace/Frame" },
    { "OpenGL", "GLM" } },
  { "Rendering/Irradiance/CubeMap",
    { "Filters/Scene", "Filters/RayTracing/Embree", "Filters/RayTracing/Shading",
      "Filters/Irradiance/Gathering", "Rendering/ScreenSpace/Frame" },
    { "OpenGL", "GLM" } },
  { "Rendering/Irradiance",
    { "Filters/Statistics", "Filters/Scene", "Filters/Scene/Import", "Filters/Scene/Execution",
      "Filters/RayTracing", "Filters/RayCasting", "Filters/Irradiance/Records",
      "Filters/Irradiance", "Rendering/ScreenSpace/Frame", "Rendering/ScreenSpace/Chain",
      "Rendering/ScreenSpace", "Rendering/Irradiance/Traced", "Rendering/Irradiance/Splats",
      "Rendering/Irradiance/CubeMap" },
    { "OpenGL", "GLM" } },

  { "Rendering/ParaView",
    { "Filters/Medium", "Filters/RayCasting", "Filters/Parallel", "Rendering/ScreenSpace/Frame",
      "Rendering/ScreenSpace/Chain", "Rendering/ScreenSpace" },
    { "OpenGL", "ParaView" } },

  { "Testing/Comparison", { "Filters/Comparison" }, { "GoogleTest" } },

  { "Command/Processes", {}, {} },
  { "Command/Files", { "Command/Processes" }, { "JSON" } },
  { "Command/Parsing", { "Command/Processes", "Command/Files" }, { "CLI11" } },
  { "Command/Truncation", { "Command/Files" }, {} },
  { "Command/Formats", { "Command/Processes", "Command/Files" }, {} },
  { "Command/Import", { "Command/Processes", "Command/Files", "Command/Formats", "Filters/Scene" },
    { "JSON" } },
  { "Command/Input",
    { "Command/Processes", "Command/Parsing", "Command/Files", "Command/Formats", "Command/Import",
      "Command/Truncation", "Filters/Scene/Geometry", "Filters/RayTracing" },
    {} },
  { "Command/Options",
    { "Filters/Medium", "Command/Processes", "Command/Parsing", "Command/Files", "Command/Input",
      "Filters/Scene", "Rendering/ScreenSpace" },
    {} },
  { "Command/Scene",
    { "Command/Processes", "Command/Files", "Command/Input", "Command/Options", "Filters/Scene" },
    {} },
  { "Command/Engines",
    { "Command/Processes", "Command/Files", "Command/Input", "Command/Options", "Command/Scene",
      "Filters/Medium", "Filters/Scene", "Filters/RayTracing", "Filters/RayCasting",
      "Filters/Irradiance", "Rendering/ScreenSpace", "Rendering/Irradiance" },
    { "OpenGL" } },
  { "Command/Film",
    { "Command/Processes", "Command/Files", "Command/Input", "Command/Options", "Command/Scene",
      "Command/Engines" },
    {} },
  { "Command",
    { "Command/Film", "Command/Processes", "Command/Parsing", "Command/Files", "Command/Formats",
      "Command/Input", "Command/Options", "Command/Scene", "Command/Engines", "Filters/RayTracing",
      "Filters/Comparison", "Filters/Irradiance", "Rendering/ScreenSpace", "Rendering/Irradiance" },
    { "OpenGL" } },
};

/// The library that a header or a VTK module belongs to; empty: VTK's data or the language's own.
inline std::string Library(const std::string& name)
{
  static const std::vector<std::pair<std::regex, std::string>> libraries = {
    { std::regex("embree[34]/.*"), "Embree" },
    { std::regex("glm/.*"), "GLM" },
    { std::regex("(vtkOpenGL|vtk_gl|vtkEGL|vtkOSOpenGL|vtkXOpenGL).*"), "OpenGL" },
    { std::regex("VTK::Rendering.*OpenGL2?"), "OpenGL" },
    { std::regex("CLI/.*"), "CLI11" },
    { std::regex("nlohmann/.*"), "JSON" },
    { std::regex("gtest/.*"), "GoogleTest" },
    { std::regex("ParaView::.*"), "ParaView" },
  };
  for (const auto& [pattern, library] : libraries)
  {
    if (std::regex_match(name, pattern))
    {
      return library;
    }
  }
  return {};
}

inline std::string ModuleName(const std::string& folder)
{
  std::string name = "Penumbra::" + folder;
  name.erase(std::remove(name.begin(), name.end(), '/'), name.end());
  return name;
}

inline bool IsModule(const Row& row)
{
  return fs::exists(Root / row.Folder / "vtk.module");
}

inline bool IsPublic(const fs::path& header)
{
  return header.extension() == ".h" && header.filename().string().rfind("vtkPenumbra", 0) == 0;
}

/// The row of a folder, or of its nearest parent that has one; null outside the table.
inline const Row* RowOf(fs::path folder)
{
  for (; folder.has_relative_path() && folder != Root; folder = folder.parent_path())
  {
    const std::string name = folder.lexically_relative(Root).generic_string();
    const auto row =
      std::find_if(Table.begin(), Table.end(), [&name](const Row& r) { return r.Folder == name; });
    if (row != Table.end())
    {
      return &*row;
    }
  }
  return nullptr;
}

/// The folder of the module that a row belongs to.
inline std::string ModuleOf(const Row& row)
{
  fs::path folder = row.Folder;
  while (folder.has_parent_path() && !fs::exists(Root / folder / "vtk.module"))
  {
    folder = folder.parent_path();
  }
  return folder.generic_string();
}

}
#endif
