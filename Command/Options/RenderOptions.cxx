// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "RenderOptions.h"

#include "Colormaps.h"
#include "Input/EnvironmentFile.h"
#include "Input/ReadLimit.h"
#include "Processes/CommandError.h"
#include "SharedOptions.h"

#include "vtkPenumbraKernels.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace penumbra
{

namespace
{

const Range Unit{ 0.0, 1.0 };
// Lengths whose squares are finite and nonzero in double precision.
const Range Length{ 1e-100, 1e100 };

/// Adds a flag that sets `target` to false.
CLI::Option* AddNegation(
  CLI::App& app, const std::string& name, bool& target, const std::string& description)
{
  const auto store = [&target](std::int64_t uses) { target = uses <= 0; };
  return app.add_flag_function(name, store, description);
}

void DeclareOutput(CLI::App& app, RenderOptions& options)
{
  app.add_option("FILE", options.Files, "Meshes to render; `penumbra list` prints the formats")
    ->required()
    ->type_name("");
  app
    .add_option("--output", options.Output,
      "Image: .png .jpg .jpeg .tif .tiff .bmp (8 bits per channel), .vti (floats, depth, "
      "normals, ids), or vector graphics: .svg .pdf (ray); {name} renders one image per file")
    ->required()
    ->type_name("PATH")
    ->take_last()
    ->group("Output");
  const auto storeResolution = [&options](const std::string& text) {
    const Range sides{ 1.0, 65535.0 };
    const std::vector<double> numbers = ParseNumbers("--resolution", text, 2, 2, sides);
    if (numbers[0] != std::floor(numbers[0]) || numbers[1] != std::floor(numbers[1]))
    {
      throw CLI::ValidationError("--resolution", "'" + text + "' is not two integers");
    }
    options.Resolution = { static_cast<int>(numbers[0]), static_cast<int>(numbers[1]) };
  };
  app
    .add_option_function<std::string>("--resolution", storeResolution, "Width and height in pixels")
    ->type_name("W,H")
    ->default_str("1000,600")
    ->take_last()
    ->group("Output");
  AddInteger(app, "--dpi", options.DotsPerInch,
    "Dots per inch, stored in the file; widths are in points of 1/72 inch", 1, 9600)
    ->group("Output");
  AddStatisticsOption(app, options.Statistics,
    "Write ray counts, estimated error, times and memory to this file; {name} as in --output")
    ->group("Output");
  AddProgressOption(app, options.Progress)->group("Output");
  AddInteger(
    app, "--jobs", options.Jobs, "Number of images rendered at the same time, with {name}", 1, 1024)
    ->group("Output");
}

void DeclareEngine(CLI::App& app, RenderOptions& options)
{
  AddChoice(app, "--engine", options.Engine, { "ray", "raster" },
    "ray: ray caster, needs neither a display nor OpenGL; raster: VTK's OpenGL renderer")
    ->group("Engine");
  AddNumber(app, "--tolerance", options.Tolerance, "X",
    "Accepted RMSE of any 16x16 pixels, for colors in [0, 1]; raster: of --ambient-occlusion, "
    "default 0.01",
    { 1e-6, 1.0 })
    ->each([&options](const std::string&) { options.HasTolerance = true; })
    ->group("Engine");
  AddNumber(app, "--light-tolerance", options.LightTolerance, "Y",
    "The same for what occlusion, indirect light, penumbrae and shafts add; 0: 2.56 X; raster: "
    "instead of --tolerance",
    { 0.0, 1.0 })
    ->group("Engine");
  AddInteger(app, "--max-level", options.MaximumLevel,
    "Deepest subdivision of a pixel (ray); subpixels have side 2^-N", 0, 6)
    ->group("Engine");
  AddNegation(app, "--no-small-objects", options.FindSmallObjects,
    "Do not search for objects between the camera rays (ray)")
    ->group("Engine");
  AddInteger(app, "--threads", options.Threads,
    "Number of threads, 0: all; the image does not depend on it", 0, 1024)
    ->group("Engine");
  AddReadLimitOption(app)->group("Engine");
  AddChoice(app, "--window,--rendering-backend", options.Window, { "osmesa", "egl", "x", "auto" },
    "OpenGL window (raster); auto: the first that works")
    ->group("Engine");
}

void DeclareCamera(CLI::App& app, CameraOptions& camera)
{
  AddTriple(app, "--camera-position", camera.Position,
    "Position of the camera; default: fits the bounds", Coordinate);
  AddTriple(app, "--camera-focal-point", camera.FocalPoint,
    "Focal point; default: the center of the bounds", Coordinate);
  AddDirection(app, "--camera-view-up", camera.ViewUp, "Up direction; default: 0,1,0");
  AddDirection(app, "--camera-direction", camera.Direction,
    "View direction, at a distance that fits the bounds; default: 0,0,-1; ignored with "
    "--camera-position");
  AddNumber(
    app, "--camera-view-angle", camera.ViewAngle, "DEG", "Vertical view angle", { 1e-6, 179.0 });
  AddNumber(app, "--camera-zoom-factor", camera.ZoomFactor, "F",
    "Move the camera closer by this factor; ignored with --camera-position", Length);
  AddNumber(app, "--camera-azimuth-angle", camera.Azimuth, "DEG",
    "Rotate the camera around the focal point to the right, after placing it");
  AddNumber(app, "--camera-elevation-angle", camera.Elevation, "DEG",
    "Rotate the camera around the focal point upward, after placing it");
  app.add_flag("--camera-orthographic", camera.Orthographic, "Parallel projection");
  AddNumber(app, "--camera-parallel-scale", camera.ParallelScale, "S",
    "Half the height of the view in world units; default: fits the bounds", Length);
  for (CLI::Option* option : app.get_options(
         [](const CLI::Option* one) { return one->get_name().rfind("--camera-", 0) == 0; }))
  {
    option->group("Camera");
  }
}

void DeclareAppearance(CLI::App& app, RenderOptions& options)
{
  const std::string group = "Appearance";
  AddColor(app, "--color", options.Color, "Color of the surfaces; default: 1,1,1")->group(group);
  AddNumber(app, "--opacity", options.Opacity, "A", "Opacity of the surfaces", Unit)->group(group);
  AddColor(app, "--background-color", options.BackgroundColor, "Background color; default: 0,0,0")
    ->group(group);
  AddNegation(app, "--no-background", options.Background,
    "Transparent background: alpha is the coverage (.png .tif .vti)")
    ->group(group);
  AddNegation(app, "--no-lighting,--unlit", options.Lighting, "Colors without shading")
    ->group(group);
  AddLightPositionOption(app, options.Lights,
    "Light that replaces the headlight; w = 0: directional light from that direction; repeatable")
    ->group(group);
  AddNumber(
    app, "--light-intensity", options.LightIntensity, "I", "Intensity of every light", { 0.0, 1e6 })
    ->group(group);
  AddNumber(app, "--feature-angle", options.FeatureAngle, "DEG",
    "Compute smooth normals; edges sharper than this angle stay sharp; default: the file's "
    "normals, else flat",
    { 0.0, 180.0 })
    ->group(group);
  app.add_flag("-e,--show-edges,--edges", options.ShowEdges, "Draw the cell edges")->group(group);
  AddChoice(app, "--representation", options.Representation, { "surface", "wireframe", "points" },
    "Representation of the mesh")
    ->group(group);
  AddNumber(
    app, "--line-width", options.LineWidth, "PT", "Width of lines and edges", { 0.0, 1000.0, true })
    ->group(group);
  AddNumber(app, "--point-size", options.PointSize, "PT", "Size of points", { 0.0, 1000.0, true })
    ->group(group);
  AddInteger(app, "--maximum-paths", options.MaximumPaths,
    "Most paths of surfaces in .svg and .pdf; above, and if triangles cannot show the scene, they "
    "are an image; 0: always an image",
    0, 1000000)
    ->group(group);
  AddNumber(app, "--outline-width", options.OutlineWidth, "PT",
    "Draw visible silhouettes, boundaries and creases in .svg and .pdf, 0: none", { 0.0, 1000.0 })
    ->group(group);
  AddNumber(app, "--point-radius", options.PointRadius, "R",
    "Draw points as spheres of this radius in world units (ray)", { 0.0, 1e30, true })
    ->default_str("")
    ->group(group);
  AddNumber(app, "--line-radius", options.LineRadius, "R",
    "Draw lines as tubes of this radius in world units, with round joints and ends (ray)",
    { 0.0, 1e30, true })
    ->default_str("")
    ->group(group);
}

void DeclareColoring(CLI::App& app, ColoringOptions& coloring)
{
  const std::string group = "Coloring by data";
  app.add_flag("-s,--scalar-coloring", coloring.Enabled, "Color by an array of the file")
    ->group(group);
  app
    .add_option("--coloring-array", coloring.Array,
      "Name of the array; implies --scalar-coloring; default: the file's scalars, else its first "
      "array")
    ->type_name("NAME")
    ->take_last()
    ->group(group);
  AddInteger(app, "--coloring-component", coloring.Component,
    "Component of the array; -1: magnitude, -2: the values are colors", -2, 1000000)
    ->group(group);
  const auto storeRange = [&coloring](const std::string& text) {
    coloring.Range = ParseNumbers("--coloring-range", text, 2, 2, {});
    if (coloring.Range[0] > coloring.Range[1])
    {
      throw CLI::ValidationError(
        "--coloring-range", "'" + text + "' has a minimum above its maximum");
    }
  };
  app
    .add_option_function<std::string>("--coloring-range", storeRange,
      "Values mapped to the first and the last color; default: the data range")
    ->type_name("A,B")
    ->take_last()
    ->group(group);
  app
    .add_flag("--coloring-by-cells", coloring.ByCells, "Use a cell array instead of a point array")
    ->group(group);
  AddChoice(app, "--colormap", coloring.Colormap, ColormapNames(), "Colormap")
    ->type_name("NAME")
    ->group(group);
  app.add_flag("-b,--coloring-scalar-bar", coloring.ScalarBar, "Draw the scalar bar")->group(group);
}

void DeclareLight(CLI::App& app, LightOptions& light)
{
  const std::string group = "Effects";
  app
    .add_flag("--indirect", light.Indirect,
      "Add diffuse light from other surfaces and from the environment (ray)")
    ->group(group);
  AddTriple(app, "--environment-color", light.EnvironmentColor,
    "Radiance of rays that hit nothing; default: the background color", { 0.0, 1e6 })
    ->group(group);
  AddEnvironmentOptions(app, light.EnvironmentFile, light.EnvironmentUp, group);
  AddNumber(app, "--albedo", light.Albedo, "A",
    "Fraction of indirect light that a white surface reflects", Unit)
    ->group(group);
  AddInteger(app, "--bounces", light.Bounces,
    "Diffuse reflections, including the one toward the camera", 1, 64)
    ->group(group);
}

std::vector<std::string> KernelNames()
{
  std::vector<std::string> names = { "automatic", "traced" };
  for (int kernel = 0; kernel < vtkPenumbraKernels::GetNumberOfKernels(); ++kernel)
  {
    names.emplace_back(vtkPenumbraKernels::GetName(kernel));
  }
  return names;
}

void DeclareEffects(CLI::App& app, RenderOptions& options)
{
  const std::string group = "Effects";
  app
    .add_flag("-q,--ambient-occlusion", options.AmbientOcclusion,
      "Ambient occlusion: rgb * (1 - strength * occlusion)")
    ->group(group);
  const auto requestArray = [&options](const std::string&) { options.OcclusionArray = true; };
  AddOcclusionRadiusOption(
    app, "--ambient-occlusion-radius", options.AmbientOcclusionRadius, "inf (ray)")
    ->each(requestArray)
    ->group(group);
  AddFalloffOption(app, "--ambient-occlusion-falloff", options.AmbientOcclusionFalloff, " (ray)")
    ->each(requestArray)
    ->group(group);
  AddNumber(app, "--ambient-occlusion-strength", options.AmbientOcclusionStrength, "S",
    "Strength of the darkening; default: 1, on surfaces colored by data 0.6", Unit)
    ->group(group);
  AddNumber(app, "--ambient-occlusion-light-awareness", options.AmbientOcclusionLightAwareness, "A",
    "Reduce the darkening of bright colors: strength * (1 - A * max(r, g, b)) (raster)", Unit)
    ->group(group);
  AddChoice(app, "--ambient-occlusion-kernel", options.AmbientOcclusionKernel, KernelNames(),
    "Kernel; traced: rays, others: depth buffer (raster)")
    ->group(group);
  AddGathererOption(app, options.Gatherer, " (ray)")->group(group);
  AddInteger(app, "--frames", options.Frames,
    "Number of frames accumulated with a static camera, 0: until converged (raster)", 0, 100000)
    ->group(group);
  AddChoice(app, "--cache", options.Cache, { "world", "screen" },
    "Interpolate occlusion and indirect light in world space or over the image (ray)")
    ->group(group);
  app.add_flag("--shadows", options.Shadows, "Shadows of the lights (ray)")->group(group);
  AddLightRadiusOption(app, options.LightRadius, "; implies --shadows (ray)")->group(group);
  AddLightAngleOption(app, options.LightAngle, "; implies --shadows (ray)")->group(group);
}

}

void DeclareRenderOptions(CLI::App& app, RenderOptions& options)
{
  DeclareOutput(app, options);
  DeclareEngine(app, options);
  DeclareCamera(app, options.Camera);
  DeclareAppearance(app, options);
  DeclareColoring(app, options.Coloring);
  DeclareEffects(app, options);
  DeclareLight(app, options.Light);
  DeclareShaftOptions(app, options.Shafts);
}

}
