// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "RenderOptions.h"

#include "Colormaps.h"
#include "Falloffs.h"
#include "Files/ImageFiles.h"
#include "Input/EnvironmentFile.h"
#include "Input/ReadLimit.h"
#include "Processes/CommandError.h"
#include "Processes/Worker.h"

#include "vtkPenumbraKernels.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace penumbra
{

namespace
{

const Range Unit{ 0.0, 1.0 };
// Lengths whose squares are finite and not 0.
const Range ShadingPoint{ -1e100, 1e100 };
const Range Length{ 1e-100, 1e100 };

/// A flag that turns something off.
CLI::Option* AddNegation(
  CLI::App& app, const std::string& name, bool& target, const std::string& description)
{
  const auto store = [&target](std::int64_t uses) { target = uses <= 0; };
  return app.add_flag_function(name, store, description);
}

void DeclareOutput(CLI::App& app, RenderOptions& options)
{
  app.add_option("FILE", options.Files, "Meshes to draw; `penumbra list` names the formats")
    ->required()
    ->type_name("");
  app
    .add_option("--output", options.Output,
      "Picture: .png .jpg .jpeg .tif .tiff .bmp (8 bit) or .vti (floats, depth, normals, ids); "
      "with "
      "{name} in it, one picture for each file")
    ->required()
    ->type_name("PATH")
    ->take_last()
    ->group("Output");
  const auto storeResolution = [&options](const std::string& text) {
    const Range sides{ 1.0, 65535.0 };
    const std::vector<double> numbers = ParseNumbers("--resolution", text, 2, 2, sides);
    if (numbers[0] != std::floor(numbers[0]) || numbers[1] != std::floor(numbers[1]))
    {
      throw CLI::ValidationError("--resolution", "'" + text + "' is not two whole numbers");
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
    "Dots per inch, written into the file; widths are in points of 1/72 inch", 1, 9600)
    ->group("Output");
  app
    .add_option("--statistics", options.Statistics,
      "Write rays, error, times and memory to this file; {name} as in --output")
    ->type_name("FILE.json")
    ->take_last()
    ->group("Output");
  AddChoice(app, "--progress", options.Progress, { "auto", "bar", "plain", "none" },
    "How progress is shown on stderr; auto: a bar on a terminal")
    ->group("Output");
  AddInteger(app, "--jobs", options.Jobs, "Pictures made at a time, with {name}", 1, 1024)
    ->group("Output");
}

void DeclareEngine(CLI::App& app, RenderOptions& options)
{
  AddChoice(app, "--engine", options.Engine, { "ray", "raster" },
    "ray: the ray caster, no display and no OpenGL needed; raster: VTK's OpenGL")
    ->group("Engine");
  AddNumber(app, "--tolerance", options.Tolerance, "X",
    "Error accepted: RMSE of any 16x16 pixels, colours from 0 to 1; raster: of "
    "--ambient-occlusion, "
    "0.01 unless given",
    { 1e-6, 1.0 })
    ->each([&options](const std::string&) { options.HasTolerance = true; })
    ->group("Engine");
  AddInteger(
    app, "--max-level", options.MaximumLevel, "Deepest subdivision of a pixel (ray): 2^-N", 0, 6)
    ->group("Engine");
  AddNegation(app, "--no-small-objects", options.FindSmallObjects,
    "Do not look for objects between the rays (ray)")
    ->group("Engine");
  AddInteger(app, "--threads", options.Threads, "Threads, 0: all; the picture is the same", 0, 1024)
    ->group("Engine");
  AddReadLimitOption(app)->group("Engine");
  AddChoice(app, "--window,--rendering-backend", options.Window, { "osmesa", "egl", "x", "auto" },
    "OpenGL window (raster); auto: the first that works")
    ->group("Engine");
}

void DeclareCamera(CLI::App& app, CameraOptions& camera)
{
  AddTriple(app, "--camera-position", camera.Position, "Where the eye is; default: all is in view",
    ShadingPoint);
  AddTriple(app, "--camera-focal-point", camera.FocalPoint,
    "What it looks at; default: the centre of the bounds", ShadingPoint);
  AddDirection(app, "--camera-view-up", camera.ViewUp, "What is up; default: 0,1,0");
  AddDirection(app, "--camera-direction", camera.Direction,
    "Where it looks, all in view; default: 0,0,-1; not used with --camera-position");
  AddNumber(
    app, "--camera-view-angle", camera.ViewAngle, "DEG", "Vertical angle of view", { 1e-6, 179.0 });
  AddNumber(app, "--camera-zoom-factor", camera.ZoomFactor, "F",
    "Closer than the view of all by this factor; not used with --camera-position", Length);
  AddNumber(app, "--camera-azimuth-angle", camera.Azimuth, "DEG",
    "Then turn around the focal point, to the right");
  AddNumber(app, "--camera-elevation-angle", camera.Elevation, "DEG",
    "Then turn around the focal point, upwards");
  app.add_flag("--camera-orthographic", camera.Orthographic, "Parallel projection");
  AddNumber(app, "--camera-parallel-scale", camera.ParallelScale, "S",
    "Half the height of the view in world units; default: all is in view", Length);
  for (CLI::Option* option : app.get_options(
         [](const CLI::Option* one) { return one->get_name().rfind("--camera-", 0) == 0; }))
  {
    option->group("Camera");
  }
}

void DeclareLook(CLI::App& app, RenderOptions& options)
{
  const std::string look = "Look";
  AddColor(app, "--color", options.Color, "Colour of the surface; default: 1,1,1")->group(look);
  AddNumber(app, "--opacity", options.Opacity, "A", "Opacity of the surface", Unit)->group(look);
  AddColor(app, "--background-color", options.BackgroundColor, "Default: 0,0,0")->group(look);
  AddNegation(app, "--no-background", options.Background,
    "Leave the background out: alpha is the covered share (.png .tif .vti)")
    ->group(look);
  AddNegation(app, "--no-lighting,--unlit", options.Lighting, "Plain colours, no light")
    ->group(look);
  const auto storeLights = [&options](const std::vector<std::string>& texts) {
    options.Lights.clear();
    for (const std::string& text : texts)
    {
      std::vector<double> numbers = ParseNumbers("--light-position", text, 3, 4, ShadingPoint);
      numbers.resize(4, 1.0);
      options.Lights.push_back({ numbers[0], numbers[1], numbers[2], numbers[3] });
    }
  };
  app
    .add_option_function<std::vector<std::string>>("--light-position", storeLights,
      "A light instead of the headlight; w = 0: it shines from that direction; repeatable")
    ->type_name("X,Y,Z[,W]")
    ->allow_extra_args(false)
    ->group(look);
  AddNumber(app, "--light-intensity", options.LightIntensity, "I", "Of every light", { 0.0, 1e6 })
    ->group(look);
  AddNumber(app, "--feature-angle", options.FeatureAngle, "DEG",
    "Compute smooth normals, edges sharper than this stay; default: the file's normals, else flat",
    { 0.0, 180.0 })
    ->group(look);
  app.add_flag("-e,--show-edges,--edges", options.ShowEdges, "Draw the edges of the cells")
    ->group(look);
  AddChoice(app, "--representation", options.Representation, { "surface", "wireframe", "points" },
    "What of the mesh is drawn")
    ->group(look);
  AddNumber(
    app, "--line-width", options.LineWidth, "PT", "Width of lines and edges", { 0.0, 1000.0, true })
    ->group(look);
  AddNumber(app, "--point-size", options.PointSize, "PT", "Size of points", { 0.0, 1000.0, true })
    ->group(look);
}

void DeclareColoring(CLI::App& app, ColoringOptions& coloring)
{
  const std::string group = "Colouring by data";
  app.add_flag("-s,--scalar-coloring", coloring.Enabled, "Colour by an array of the file")
    ->group(group);
  app
    .add_option("--coloring-array", coloring.Array,
      "Which array; turns colouring on; default: the file's scalars, else its first array")
    ->type_name("NAME")
    ->take_last()
    ->group(group);
  AddInteger(app, "--coloring-component", coloring.Component,
    "Which component; -1: the magnitude, -2: the values are the colours themselves", -2, 1000000)
    ->group(group);
  const auto storeRange = [&coloring](const std::string& text) {
    coloring.Range = ParseNumbers("--coloring-range", text, 2, 2, {});
    if (coloring.Range[0] > coloring.Range[1])
    {
      throw CLI::ValidationError(
        "--coloring-range", "'" + text + "' has its ends in the wrong order");
    }
  };
  app
    .add_option_function<std::string>("--coloring-range", storeRange,
      "Values of the first and the last colour; default: the data's")
    ->type_name("A,B")
    ->take_last()
    ->group(group);
  app.add_flag("--coloring-by-cells", coloring.ByCells, "An array of the cells, not of the points")
    ->group(group);
  AddChoice(app, "--colormap", coloring.Colormap, ColormapNames(), "Colours")
    ->type_name("NAME")
    ->group(group);
  app.add_flag("-b,--coloring-scalar-bar", coloring.ScalarBar, "Draw the colours' legend")
    ->group(group);
}

void DeclareShafts(CLI::App& app, ShaftOptions& shafts)
{
  const std::string group = "Effects";
  app
    .add_flag("--light-shafts", shafts.Enabled,
      "Fog in which --light-position makes light and shadow visible")
    ->group(group);
  AddNumber(app, "--shafts-scattering", shafts.Scattering, "S",
    "Share of light scattered per world unit; default: a quarter over the bounds' diagonal",
    { 0.0, Infinity })
    ->default_str("")
    ->group(group);
  AddNumber(app, "--shafts-extinction", shafts.Extinction, "S",
    "Share of light lost per world unit, scattering included; default: scattering alone",
    { 0.0, Infinity })
    ->default_str("")
    ->group(group);
  const auto storePhase = [&shafts](const std::string& text) {
    shafts.Phase = text.substr(0, 3) == "hg:" ? "hg" : text;
    if (shafts.Phase == "hg")
    {
      shafts.Asymmetry = ParseNumbers("--shafts-phase", text.substr(3), 1, 1, { -0.999, 0.999 })[0];
    }
    else if (text != "isotropic" && text != "rayleigh")
    {
      throw CLI::ValidationError(
        "--shafts-phase", "'" + text + "' is not one of isotropic, rayleigh, hg:G");
    }
  };
  app
    .add_option_function<std::string>("--shafts-phase", storePhase,
      "Where light is scattered; hg: Henyey and Greenstein's, G from -.999 (back) to .999 "
      "(forward)")
    ->type_name("isotropic|rayleigh|hg:G")
    ->default_str("isotropic")
    ->take_last()
    ->group(group);
}

void DeclareLight(CLI::App& app, LightOptions& light)
{
  const std::string group = "Effects";
  app
    .add_flag("--indirect", light.Indirect,
      "Add the light from surface to surface and from the environment (ray)")
    ->group(group);
  AddTriple(app, "--environment-color", light.EnvironmentColor,
    "Radiance from where nothing is; default: the background's colour", { 0.0, 1e6 })
    ->group(group);
  AddEnvironmentOptions(app, light.EnvironmentFile, light.EnvironmentUp, group);
  AddNumber(app, "--albedo", light.Albedo, "A",
    "Share of the indirect light that a white surface throws back", Unit)
    ->group(group);
  AddInteger(
    app, "--bounces", light.Bounces, "Reflections up to the eye's, which is the last", 1, 64)
    ->group(group);
}

void RequireShafts(const CLI::App& app, const ShaftOptions& shafts)
{
  for (const char* name : { "--shafts-scattering", "--shafts-extinction", "--shafts-phase" })
  {
    if (!shafts.Enabled && app.count(name) > 0)
    {
      throw CommandError(BadInput, std::string(name) + " needs --light-shafts; give both");
    }
  }
  if (shafts.Extinction < shafts.Scattering)
  {
    throw CommandError(BadInput,
      "--shafts-extinction: less than --shafts-scattering; what is scattered is lost, too");
  }
}

void RequireColoring(const CLI::App& app, const RenderOptions& options)
{
  for (const char* name : { "--coloring-component", "--coloring-range", "--coloring-by-cells",
         "--colormap", "--coloring-scalar-bar" })
  {
    if (!options.Coloring.Enabled && app.count(name) > 0)
    {
      throw CommandError(BadInput, std::string(name) + " needs --scalar-coloring; give both");
    }
  }
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
      "Darken what sees little of the sky: rgb * (1 - strength * occlusion)")
    ->group(group);
  AddNumber(app, "--ambient-occlusion-radius", options.AmbientOcclusionRadius, "R",
    "Reach of an occluder in world units, inf (ray): all; default: a tenth of the bounds' diagonal",
    { 0.0, Infinity, true, true })
    ->default_str("")
    ->group(group);
  AddChoice(app, "--ambient-occlusion-falloff", options.AmbientOcclusionFalloff, FalloffNames(),
    "How an occluder counts less with its distance: not, or 1 - t/R, 1 - (t/R)^2, 1 - sqrt(t/R) "
    "(ray)")
    ->group(group);
  AddNumber(app, "--ambient-occlusion-strength", options.AmbientOcclusionStrength, "S",
    "Default: 1, on surfaces coloured by data 0.6", Unit)
    ->group(group);
  AddNumber(app, "--ambient-occlusion-light-awareness", options.AmbientOcclusionLightAwareness, "A",
    "How far bright colours are spared: the strength falls by this times brightness (raster)", Unit)
    ->group(group);
  AddChoice(app, "--ambient-occlusion-kernel", options.AmbientOcclusionKernel, KernelNames(),
    "How occlusion is found: by true rays or from the depth buffer (raster)")
    ->group(group);
  AddChoice(app, "--gatherer", options.Gatherer, { "rays", "cube-map" },
    "How occlusion and indirect light look around: by rays or by OpenGL (ray)")
    ->group(group);
  AddInteger(app, "--frames", options.Frames,
    "Successive frames of a still camera, 0: until converged (raster)", 0, 100000)
    ->group(group);
  AddChoice(app, "--cache", options.Cache, { "world", "screen" },
    "Where occlusion and indirect light are interpolated: between any places, or over the picture "
    "(ray)")
    ->group(group);
  app.add_flag("--shadows", options.Shadows, "Hard shadows of the lights (ray)")->group(group);
}

/// What the picture would have to show and that engine cannot. Options that only say how the other engine
/// works are idle, see FindIgnoredOptions().
void RequireEngine(const CLI::App& app, const RenderOptions& options)
{
  if (options.Engine == "ray")
  {
    return;
  }
  for (const std::string name : { "--shadows", "--indirect", "--ambient-occlusion-falloff" })
  {
    if (app.count(name) > 0)
    {
      throw CommandError(
        BadInput, name + " is not possible with --engine raster; use --engine ray");
    }
  }
  if (std::isinf(options.AmbientOcclusionRadius))
  {
    throw CommandError(BadInput,
      "--ambient-occlusion-radius: inf is not possible with --engine raster; use --engine ray");
  }
}

}

void DeclareRenderOptions(CLI::App& app, RenderOptions& options)
{
  DeclareOutput(app, options);
  DeclareEngine(app, options);
  DeclareCamera(app, options.Camera);
  DeclareLook(app, options);
  DeclareColoring(app, options.Coloring);
  DeclareEffects(app, options);
  DeclareLight(app, options.Light);
  DeclareShafts(app, options.Shafts);
}

void CheckRenderOptions(const CLI::App& app, const RenderOptions& options)
{
  CheckPictureExtension(options.Output, "--output");
  RequireEngine(app, options);
  RequireColoring(app, options);
  RequireShafts(app, options.Shafts);
  if (!options.Background && !SupportsAlpha(options.Output))
  {
    throw CommandError(BadInput,
      "--no-background: " + options.Output + " cannot hold transparency; use .png, .tif or .vti");
  }
  const double bytesPerPixel = 32.0;
  const double needed = bytesPerPixel * options.Resolution[0] * options.Resolution[1];
  if (needed > static_cast<double>(MachineMemory()))
  {
    throw CommandError(BadInput,
      "--resolution: the picture needs more memory than the machine has; "
      "make it smaller");
  }
  const Vector3& up = options.Camera.ViewUp.value_or(Vector3{ 0, 1, 0 });
  if (std::hypot(up[0], up[1], up[2]) == 0.0)
  {
    throw CommandError(BadInput, "--camera-view-up: 0,0,0 is no direction; give another");
  }
  const Vector3& direction = options.Camera.Direction.value_or(Vector3{ 0, 0, -1 });
  if (std::hypot(direction[0], direction[1], direction[2]) == 0.0)
  {
    throw CommandError(BadInput, "--camera-direction: 0,0,0 is no direction; give another");
  }
  if (options.Camera.Position && options.Camera.Position == options.Camera.FocalPoint)
  {
    throw CommandError(
      BadInput, "--camera-focal-point: it is the same as --camera-position; move one of them");
  }
  const Vector3& upwards = options.Light.EnvironmentUp.value_or(Vector3{ 0, 1, 0 });
  if (std::hypot(upwards[0], upwards[1], upwards[2]) == 0.0)
  {
    throw CommandError(BadInput, "--hdri-up: 0,0,0 is no direction; give another");
  }
  for (const std::array<double, 4>& light : options.Lights)
  {
    const double length = std::max({ std::abs(light[0]), std::abs(light[1]), std::abs(light[2]) });
    if (light[3] < 0.0 || (light[3] == 0.0 && length == 0.0) ||
      (light[3] > 0.0 && length > light[3] * ShadingPoint.Maximum))
    {
      throw CommandError(BadInput, "--light-position: w must be 0, with a direction, or positive");
    }
  }
}

std::vector<std::string> FindIgnoredOptions(const CLI::App& app, const RenderOptions& options)
{
  const bool ray = options.Engine == "ray";
  const bool orthographic = options.Camera.Orthographic;
  const bool placed = options.Camera.Position.has_value();
  const bool lights = options.Lighting && !options.Lights.empty();
  const struct
  {
    const char* Option;
    bool Idle;
    const char* Why;
  } rows[] = {
    { "--tolerance", !ray && !options.AmbientOcclusion,
      "with --engine raster without --ambient-occlusion" },
    { "--max-level", !ray, "with --engine raster" },
    { "--no-small-objects", !ray, "with --engine raster" },
    { "--ambient-occlusion-radius", !options.AmbientOcclusion && !HoldsArrays(options.Output),
      "without --ambient-occlusion" },
    { "--ambient-occlusion-falloff", !options.AmbientOcclusion && !HoldsArrays(options.Output),
      "without --ambient-occlusion" },
    { "--ambient-occlusion-falloff", std::isinf(options.AmbientOcclusionRadius),
      "with --ambient-occlusion-radius inf" },
    { "--ambient-occlusion-strength", !options.AmbientOcclusion, "without --ambient-occlusion" },
    { "--ambient-occlusion-light-awareness", !options.AmbientOcclusion,
      "without --ambient-occlusion" },
    { "--ambient-occlusion-light-awareness", options.AmbientOcclusion && ray, "with --engine ray" },
    { "--ambient-occlusion-kernel", !options.AmbientOcclusion, "without --ambient-occlusion" },
    { "--ambient-occlusion-kernel", options.AmbientOcclusion && ray, "with --engine ray" },
    { "--cache", !ray, "with --engine raster" },
    { "--cache", ray && !options.AmbientOcclusion && !options.Light.Indirect,
      "without --ambient-occlusion or --indirect" },
    { "--gatherer", !ray, "with --engine raster" },
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
    { "--camera-zoom-factor", placed, "with --camera-position" },
    { "--camera-direction", placed,
      "with --camera-position, unless the eye is in the centre of the bounds" },
    { "--light-position", !options.Lighting, "with --no-lighting" },
    { "--shadows", !lights, "without --light-position: the headlight casts none" },
    { "--window", ray && options.Gatherer == "rays", "with --engine ray" },
  };
  std::vector<std::string> sentences;
  for (const auto& row : rows)
  {
    if (row.Idle && app.count(row.Option) > 0)
    {
      sentences.push_back(std::string(row.Option) + " has no effect " + row.Why);
    }
  }
  return sentences;
}

}
