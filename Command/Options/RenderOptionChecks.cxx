// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Contradictions between options of `penumbra render`, and options without an effect.
#include "RenderOptions.h"

#include "Files/ImageFiles.h"
#include "Input/Readers.h"
#include "LookOptions.h"
#include "Processes/CommandConstants.h"
#include "Processes/CommandError.h"
#include "Processes/Worker.h"

#include "vtkMath.h"

#include <algorithm>
#include <cmath>

namespace penumbra
{

namespace
{

/// Throws CommandError for options whose effect the selected engine cannot render. Options that only
/// configure the other engine are ignored with a warning, see FindIgnoredOptions().
void RequireEngine(const CommandLine& app, const RenderOptions& options)
{
  if (options.Engine == "ray")
  {
    return;
  }
  for (const std::string name : { "--shadows", "--light-radius", "--light-angle", "--indirect",
         "--ambient-occlusion-falloff", "--point-radius", "--line-radius", "--shafts-density" })
  {
    if (app.Count(name) > 0)
    {
      throw CommandError(BadInput, name + " is not supported by --engine raster; use --engine ray");
    }
  }
  if (IsVectorGraphic(options.Output))
  {
    throw CommandError(BadInput,
      "--output " + options.Output +
        ": vector graphics are not supported by --engine raster; use --engine ray");
  }
  if (std::isinf(options.AmbientOcclusionRadius))
  {
    throw CommandError(BadInput,
      "--ambient-occlusion-radius: inf is not supported by --engine raster; use --engine ray");
  }
}

/// Sets the up direction and the view from the front that --up requests, as F3D.
void CompleteUp(RenderOptions& options)
{
  CameraOptions& camera = options.Camera;
  if (!camera.SceneUp)
  {
    return;
  }
  const Vector3& up = *camera.SceneUp;
  const bool isAlongX = up[1] == 0.0 && up[2] == 0.0;
  const Vector3 right = isAlongX ? Vector3{ 0, 1, 0 } : Vector3{ 1, 0, 0 };
  camera.ViewUp = camera.ViewUp.value_or(up);
  options.Light.EnvironmentUp = options.Light.EnvironmentUp.value_or(up);
  if (!camera.Direction && options.Look == "plain") // Other looks have a view that suits ViewUp.
  {
    Vector3 direction;
    vtkMath::Cross(up.data(), right.data(), direction.data());
    camera.Direction = direction;
  }
}

}

void CompleteRenderOptions(const CommandLine& app, RenderOptions& options)
{
  ColoringOptions& coloring = options.Coloring;
  coloring.Enabled = coloring.Enabled || !coloring.Array.empty();
  coloring.Component = coloring.ValuesAreColors ? -2 : coloring.Component;
  CompleteUp(options);
  ApplyLook(app, options);
}

void CheckRenderOptions(const CommandLine& app, const RenderOptions& options)
{
  CheckOutputExtension(options.Output, "--output");
  RequireEngine(app, options);
  if (app.Count("--point-sprites") > 0 && options.PointSprites != "none")
  {
    throw CommandError(BadInput,
      "--point-sprites: an option of F3D; use --representation points with --point-size or "
      "--point-radius");
  }
  CheckShaftOptions(options.Shafts);
  CheckTimeOptions(app);
  if (!options.Background && !SupportsAlpha(options.Output))
  {
    throw CommandError(BadInput,
      "--no-background: " + options.Output +
        " cannot hold transparency; use .png, .tif, .vti, .svg or .pdf");
  }
  const double needed = BytesPerPixel * options.Resolution[0] * options.Resolution[1];
  if (needed > static_cast<double>(MachineMemory()))
  {
    throw CommandError(BadInput,
      "--resolution: the image needs more memory than the machine has; choose a smaller one");
  }
  if (options.Camera.Position && options.Camera.Position == options.Camera.FocalPoint)
  {
    throw CommandError(
      BadInput, "--camera-focal-point must differ from --camera-position; move one of them");
  }
  RequireLightPositions(options.Lights);
  if (options.Camera.Index >= 0 && !options.Materials)
  {
    throw CommandError(
      BadInput, "--camera-index needs the cameras of the files; leave --no-materials out");
  }
}

std::vector<std::string> FindIgnoredOptions(const CommandLine& app, const RenderOptions& options)
{
  const bool ray = options.Engine == "ray";
  const bool orthographic = options.Camera.Orthographic;
  const bool placed = options.Camera.Position.has_value() || options.Camera.Index >= 0;
  // The lights of files are known later.
  const bool mayHaveLights = options.Materials && options.Lights.empty() &&
    std::any_of(options.Files.begin(), options.Files.end(), MayHaveLights);
  const bool hasLook = !FindLook(options.Look).Lights.empty();
  const bool lights = options.Lighting && (mayHaveLights || hasLook || !options.Lights.empty());
  const auto hasLight = [&](bool positional) {
    return options.Lighting &&
      (mayHaveLights || (hasLook && !positional && options.Lights.empty()) ||
        HasLight(options.Lights, positional));
  };
  const bool hasArea = ray && (options.LightRadius > 0.0 || options.LightAngle > 0.0);
  const bool bar = options.Coloring.ScalarBar;
  // `--contour` and `--threshold` use it as well.
  const bool usesCells = options.Coloring.Enabled || !options.Cuts.empty();
  const char* const withoutColoring = "without --scalar-coloring";
  const char* const withoutBar = "without --coloring-scalar-bar";
  std::vector<IgnoredOption> rows;
  for (const std::string& name : ShaftOptions::GetNames())
  {
    rows.push_back({ name.c_str(), !options.Shafts.Enabled, "without --light-shafts" });
  }
  rows.insert(rows.end(),
    {
      { "--tolerance", !ray && !options.AmbientOcclusion && !options.Shafts.Enabled,
        "with --engine raster without --ambient-occlusion or --light-shafts" },
      { "--light-tolerance",
        !options.AmbientOcclusion && !options.Light.Indirect && !options.Shafts.Enabled &&
          !hasArea && !HoldsArrays(options.Output),
        "without --ambient-occlusion, --indirect, --light-radius, --light-angle or "
        "--light-shafts" },
      { "--tolerance", !ray && options.LightTolerance > 0.0,
        "with --engine raster and --light-tolerance" },
      { "--shafts-estimator", ray, "with --engine ray" },
      { "--shafts-surface-light", !ray, "with --engine raster" },
      { "--shafts-behind-translucent", !ray, "with --engine raster, which always does so" },
      { "--max-level", !ray, "with --engine raster" },
      { "--time-limit", !ray, "with --engine raster" },
      { "--no-small-objects", !ray, "with --engine raster" },
      { "--point-size", options.PointRadius > 0.0, "with --point-radius" },
      { "--line-width", options.LineRadius > 0.0 && !options.ShowEdges, "with --line-radius" },
      { "--maximum-paths", !IsVectorGraphic(options.Output), "without .svg or .pdf in --output" },
      { "--outline-width", !IsVectorGraphic(options.Output), "without .svg or .pdf in --output" },
      { "--ambient-occlusion-radius", !options.AmbientOcclusion && !HoldsArrays(options.Output),
        "without --ambient-occlusion" },
      { "--ambient-occlusion-falloff", !options.AmbientOcclusion && !HoldsArrays(options.Output),
        "without --ambient-occlusion" },
      { "--ambient-occlusion-falloff", std::isinf(options.AmbientOcclusionRadius),
        "with --ambient-occlusion-radius inf" },
      { "--ambient-occlusion-strength", !options.AmbientOcclusion, "without --ambient-occlusion" },
      { "--ambient-occlusion-light-awareness", !options.AmbientOcclusion,
        "without --ambient-occlusion" },
      { "--ambient-occlusion-light-awareness", options.AmbientOcclusion && ray,
        "with --engine ray" },
      { "--ambient-occlusion-kernel", !options.AmbientOcclusion, "without --ambient-occlusion" },
      { "--ambient-occlusion-kernel", options.AmbientOcclusion && ray, "with --engine ray" },
      { "--cache", !ray, "with --engine raster" },
      { "--cache", ray && !options.AmbientOcclusion && !options.Light.Indirect,
        "without --ambient-occlusion or --indirect" },
      { "--gatherer", !ray, "with --engine raster" },
      { "--gatherer", ray && options.Cache == "none", "with --cache none" },
      { "--gatherer", ray && !options.AmbientOcclusion && !options.Light.Indirect,
        "without --ambient-occlusion or --indirect" },
      { "--environment-color", !options.Light.Indirect, "without --indirect" },
      { "--environment-color", !options.Light.EnvironmentFile.empty(), "with --hdri-file" },
      { "--hdri-file", !options.Light.Indirect, "without --indirect" },
      { "--hdri-up", options.Light.EnvironmentFile.empty(), "without --hdri-file" },
      { "--albedo", !options.Light.Indirect, "without --indirect" },
      { "--bounces", !options.Light.Indirect, "without --indirect" },
      { "--camera-parallel-scale", !orthographic, "without --camera-orthographic" },
      { "--camera-view-angle", orthographic, "with --camera-orthographic" },
      { "--camera-zoom-factor", placed, "with --camera-position or --camera-index" },
      { "--camera-direction", placed,
        "with --camera-position or --camera-index, unless the camera is at the center of the "
        "bounds" },
      { "--light-position", !options.Lighting, "with --no-lighting" },
      { "--indirect", !options.Lighting, "with --no-lighting" },
      { "--shadows", !options.Lighting, "with --no-lighting" },
      { "--shadows", !lights, "without --light-position: the headlight casts no shadows" },
      { "--light-radius", !hasLight(true), "without a positional --light-position" },
      { "--light-angle", !hasLight(false), "without a directional --light-position (w = 0)" },
      { "--blending", !ray, "with --engine raster, which blends in the order of the cells" },
      { "--raytracing", !ray, "with --engine raster" },
      { "--window", ray && options.Gatherer == "rays", "with --engine ray" },
      { "--shafts-base-height", !(options.Shafts.ScaleHeight > 0.0),
        "without --shafts-scale-height" },
      { "--shafts-up", !(options.Shafts.ScaleHeight > 0.0), "without --shafts-scale-height" },
      { "--coloring-component", !options.Coloring.Enabled, withoutColoring },
      { "--coloring-range", !options.Coloring.Enabled, withoutColoring },
      { "--coloring-by-cells", !usesCells, withoutColoring },
      { "--colormap", !options.Coloring.Enabled, withoutColoring },
      { "--coloring-scalar-bar", !options.Coloring.Enabled, withoutColoring },
      { "-y", !options.Coloring.Enabled, withoutColoring },
      { "--scalar-bar-title", !bar, withoutBar },
      { "--scalar-bar-position", !bar, withoutBar },
      { "--scalar-bar-size", !bar, withoutBar },
      { "--scalar-bar-labels", !bar, withoutBar },
      { "--scalar-bar-format", !bar, withoutBar },
    });
  return DescribeIgnored(app, rows);
}

}
