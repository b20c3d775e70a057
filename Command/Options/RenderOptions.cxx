// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "RenderOptions.h"

#include "Input/EnvironmentFile.h"
#include "Input/ReadLimit.h"
#include "LookOptions.h"
#include "Parsing/ConfigurationFile.h"
#include "Processes/CommandError.h"
#include "SharedOptions.h"

#include "vtkPenumbraKernels.h"

namespace penumbra
{

namespace
{

const Range Unit{ 0.0, 1.0 };
// Lengths whose squares are finite and nonzero in double precision.
const Range Length{ 1e-100, 1e100 };

void DeclareOutput(const CommandLine& app, RenderOptions& options)
{
  app.AddTexts("FILE", options.Files, "Meshes to render; `penumbra list` prints the formats")
    .Required()
    .TypeName("");
  app.SetGroup("Output");
  app
    .AddText("--output", options.Output, "PATH",
      "Image: .png .jpg .jpeg .tif .tiff .bmp (8 bits per channel), .vti (floats, depth, "
      "normals, ids), or vector graphics: .svg .pdf (ray); {name} renders one image per file")
    .Required();
  const auto storeResolution = [&options](const std::string& text) {
    const std::vector<int> sides = ParseIntegers("--resolution", text, 2, 1, 65535);
    options.Resolution = { sides[0], sides[1] };
  };
  app.AddParsed("--resolution", storeResolution, "Width and height in pixels")
    .TypeName("W,H")
    .Default("1000,600");
  AddInteger(app, "--dpi", options.DotsPerInch,
    "Dots per inch, stored in the file; widths are in points of 1/72 inch", 1, 9600);
  AddStatisticsOption(app, options.Statistics,
    "Write ray counts, estimated error, times and memory to this file; {name} as in --output");
  app.AddText(ConfigurationOption, options.Configuration, "FILE",
    "JSON file with options by their long names; the command line has precedence");
  AddProgressOption(app, options.Progress);
  AddInteger(app, "--jobs", options.Jobs, "Number of images rendered at the same time, with {name}",
    1, 1024);
}

void DeclareEngine(const CommandLine& app, RenderOptions& options)
{
  app.SetGroup("Engine");
  AddChoice(app, "--engine", options.Engine, { "ray", "raster" },
    "ray: ray caster, needs neither a display nor OpenGL; raster: VTK's OpenGL renderer");
  AddNumber(app, "--tolerance", options.Tolerance, "X",
    "Accepted RMSE of any 16x16 pixels, for colors in [0, 1]; raster: of --ambient-occlusion, "
    "default 0.01",
    { 1e-6, 1.0 })
    .Each([&options](const std::string&) { options.HasTolerance = true; });
  AddNumber(app, "--light-tolerance", options.LightTolerance, "Y",
    "The same for what occlusion, indirect light, penumbrae and shafts add; 0: 2.56 X; raster: "
    "instead of --tolerance",
    { 0.0, 1.0 });
  AddNumber(app, "--time-limit", options.TimeLimit, "SECONDS",
    "Longest time for an image, which is then the best one so far (ray); 0: no limit",
    { 0.0, Infinity, false, true });
  AddInteger(app, "--max-level", options.MaximumLevel,
    "Deepest subdivision of a pixel (ray); subpixels have side 2^-N", 0, 6);
  app.AddNegation("--no-small-objects", options.FindSmallObjects,
    "Do not search for objects between the camera rays (ray)");
  AddInteger(app, "--threads", options.Threads,
    "Number of threads, 0: all; the image does not depend on it", 0, 1024);
  AddReadLimitOption(app);
  AddChoice(app, "--window,--rendering-backend", options.Window, { "osmesa", "egl", "x", "auto" },
    "OpenGL window (raster); auto: the first that works");
}

void DeclareCamera(const CommandLine& app, CameraOptions& camera)
{
  app.SetGroup("Camera");
  AddTriple(app, "--camera-position", camera.Position,
    "Position of the camera; default: fits the bounds", Coordinate);
  AddTriple(app, "--camera-focal-point", camera.FocalPoint,
    "Focal point; default: the center of the bounds", Coordinate);
  AddDirection(app, "--camera-view-up", camera.ViewUp, "Up direction; default: 0,1,0");
  AddDirection(app, "--up", camera.SceneUp,
    "Up direction of the scene, seen from the front: --camera-view-up, --hdri-up, and a "
    "--camera-direction that suits it");
  AddDirection(app, "--camera-direction", camera.Direction,
    "View direction, at a distance that fits the bounds; default: 0,0,-1; ignored with "
    "--camera-position");
  AddNumber(
    app, "--camera-view-angle", camera.ViewAngle, "DEG", "Vertical view angle", { 1e-6, 179.0 })
    .Each([&camera](const std::string&) { camera.HasViewAngle = true; });
  AddNumber(app, "--camera-zoom-factor", camera.ZoomFactor, "F",
    "Move the camera closer by this factor; ignored with --camera-position", Length)
    .Each([&camera](const std::string&) { camera.HasZoomFactor = true; });
  AddNumber(app, "--camera-azimuth-angle", camera.Azimuth, "DEG",
    "Rotate the camera around the focal point to the right, after placing it");
  AddNumber(app, "--camera-elevation-angle", camera.Elevation, "DEG",
    "Rotate the camera around the focal point upward, after placing it");
  app.AddFlag("--camera-orthographic", camera.Orthographic, "Parallel projection");
  AddNumber(app, "--camera-parallel-scale", camera.ParallelScale, "S",
    "Half the height of the view in world units; default: fits the bounds", Length);
  AddInteger(app, "--camera-index", camera.Index,
    "Camera of a glTF or 3DS file, counted from 0; other options replace its settings; -1: none",
    -1, 1000000);
}

void DeclareAppearance(const CommandLine& app, RenderOptions& options)
{
  app.SetGroup("Appearance");
  AddChoice(app, "--look", options.Look, LookNames(),
    "Background, lights, camera and effects that go together; other options replace its settings")
    .TypeName("NAME");
  app.AddNegation("--no-materials,--geometry-only", options.Materials,
    "Read surfaces only: no materials, textures, lights and cameras of the files");
  AddColor(app, "--color", options.Color,
    "Color of the surfaces; default: that of their material, else 1,1,1");
  AddNumber(app, "--opacity", options.Opacity, "A",
    "Opacity of the surfaces; multiplied by that of their material", Unit);
  AddColor(app, "--background-color", options.BackgroundColor, "Background color; default: 0,0,0");
  app.AddNegation("--no-background", options.Background,
    "Transparent background: alpha is the coverage (not .jpg and .bmp)");
  app.AddNegation("--no-lighting,--unlit", options.Lighting, "Colors without shading");
  AddLightPositionOption(app, options.Lights,
    "Light that replaces the headlight and the lights of the files; w = 0: directional light from "
    "that direction; repeatable");
  AddNumber(app, "--light-intensity", options.LightIntensity, "I", "Intensity of every light",
    { 0.0, 1e6 });
  AddNumber(app, "--feature-angle", options.FeatureAngle, "DEG",
    "Compute smooth normals; edges sharper than this angle stay sharp; default: the file's "
    "normals, else flat",
    { 0.0, 180.0 });
  app.AddFlag("-e,--show-edges,--edges", options.ShowEdges, "Draw the cell edges");
  AddChoice(app, "--representation", options.Representation, { "surface", "wireframe", "points" },
    "Representation of the mesh");
  AddNumber(app, "--line-width", options.LineWidth, "PT", "Width of lines and edges",
    { 0.0, 1000.0, true });
  AddNumber(app, "--point-size", options.PointSize, "PT", "Size of points", { 0.0, 1000.0, true });
  AddInteger(app, "--maximum-paths", options.MaximumPaths,
    "Most paths of surfaces in .svg and .pdf; above, and if triangles cannot show the scene, they "
    "are an image; 0: always an image",
    0, 1000000);
  AddNumber(app, "--outline-width", options.OutlineWidth, "PT",
    "Draw visible silhouettes, boundaries and creases in .svg and .pdf, 0: none", { 0.0, 1000.0 });
  AddNumber(app, "--point-radius", options.PointRadius, "R",
    "Draw points as spheres of this radius in world units (ray)", { 0.0, 1e30, true })
    .Default("");
  AddNumber(app, "--line-radius", options.LineRadius, "R",
    "Draw lines as tubes of this radius in world units, with round joints and ends (ray)",
    { 0.0, 1e30, true })
    .Default("");
}

void DeclareText(const CommandLine& app, RenderOptions& options)
{
  app.SetGroup("Time");
  app.AddText("--text", options.Text, "STRING",
    "Text in the upper left corner; {time} is replaced by the time of the image");
  app.AddFlag("-n,--filename", options.FileNameLabel, "Show the names of the files");
  app.AddFlag("--time-label", options.TimeLabel, "Show the time of the image");
}

void DeclareLight(const CommandLine& app, LightOptions& light)
{
  app.AddFlag("-f,--indirect,--hdri-ambient", light.Indirect,
    "Add diffuse light from other surfaces and from the environment (ray)");
  AddTriple(app, "--environment-color", light.EnvironmentColor,
    "Radiance of rays that hit nothing; default: the background color", { 0.0, 1e6 });
  AddEnvironmentOptions(app, light.EnvironmentFile, light.EnvironmentUp);
  AddNumber(app, "--albedo", light.Albedo, "A",
    "Fraction of indirect light that a white surface reflects", Unit);
  AddInteger(app, "--bounces", light.Bounces,
    "Diffuse reflections, including the one toward the camera", 1, 64);
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

void DeclareEffects(const CommandLine& app, RenderOptions& options)
{
  app.SetGroup("Effects");
  app.AddFlag("-q,--ambient-occlusion", options.AmbientOcclusion,
    "Ambient occlusion: rgb * (1 - strength * occlusion)");
  const auto requestArray = [&options](const std::string&) { options.OcclusionArray = true; };
  AddOcclusionRadiusOption(
    app, "--ambient-occlusion-radius", options.AmbientOcclusionRadius, "inf (ray)")
    .Each(requestArray);
  AddFalloffOption(app, "--ambient-occlusion-falloff", options.AmbientOcclusionFalloff, " (ray)")
    .Each(requestArray);
  AddNumber(app, "--ambient-occlusion-strength", options.AmbientOcclusionStrength, "S",
    "Strength of the darkening; default: 1, on surfaces colored by data 0.6", Unit);
  AddNumber(app, "--ambient-occlusion-light-awareness", options.AmbientOcclusionLightAwareness, "A",
    "Reduce the darkening of bright colors: strength * (1 - A * max(r, g, b)) (raster)", Unit);
  AddChoice(app, "--ambient-occlusion-kernel", options.AmbientOcclusionKernel, KernelNames(),
    "Kernel; traced: rays, others: depth buffer (raster)");
  AddGathererOption(app, options.Gatherer, " (ray)");
  AddInteger(app, "--frames", options.Frames,
    "Number of frames accumulated with a static camera, 0: until converged (raster)", 0, 100000);
  AddChoice(app, "--cache", options.Cache, { "auto", "world", "screen", "none" },
    "Interpolate occlusion and indirect light between records in world space or over the image; "
    "none: join the rays of neighboring pixels; auto: none, world with --gatherer cube-map (ray)");
  app.AddFlag("--shadows", options.Shadows, "Shadows of the lights (ray)");
  AddLightRadiusOption(app, options.LightRadius, "; implies --shadows (ray)");
  AddLightAngleOption(app, options.LightAngle, "; implies --shadows (ray)");
}

/// Options of F3D for what this program always does, hidden in the help.
void DeclareRedundant(const CommandLine& app, RenderOptions& options)
{
  app.SetGroup("");
  for (const char* name : { "-a,--anti-aliasing", "-p,--blending,--translucency-support",
         "-r,--raytracing", "-d,--raytracing-denoise,--denoise", "--no-config", "--dry-run" })
  {
    app.AddIgnored(name, options.RedundantMode);
  }
  const auto storeMode = [](const std::string& text) {
    if (text != "all")
    {
      throw InvalidValue("--multi-file-mode",
        "'" + text + "': all files are one scene, or {name} in --output makes one image per file");
    }
  };
  app.AddParsed("--multi-file-mode", storeMode, "");
  app.AddIgnored("--point-sprites", options.PointSprites);
  // The tolerance decides.
  const auto checkSamples = [](const std::string& text) {
    ParseInteger("--samples", text, 1, 1000000000);
  };
  app.AddParsed("--samples,--raytracing-samples", checkSamples, "");
}

}

void DeclareRenderOptions(const CommandLine& app, RenderOptions& options)
{
  DeclareOutput(app, options);
  DeclareEngine(app, options);
  DeclareCamera(app, options.Camera);
  DeclareAppearance(app, options);
  DeclareColoringOptions(app, options.Coloring);
  DeclareCutOptions(app, options.Cuts);
  DeclareTimeOptions(app, options.Time);
  DeclareText(app, options);
  DeclareEffects(app, options);
  DeclareLight(app, options.Light);
  DeclareShaftOptions(app, options.Shafts);
  DeclareRedundant(app, options);
}

}
