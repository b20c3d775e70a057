// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// The options of `penumbra render` with their defaults.
#ifndef penumbra_RenderOptions_h
#define penumbra_RenderOptions_h

#include "ColoringOptions.h"
#include "CutOptions.h"
#include "Parsing/Arguments.h"
#include "ShaftOptions.h"
#include "SharedOptions.h"
#include "TimeOptions.h"

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace penumbra
{

struct CameraOptions
{
  std::optional<Vector3> Position;
  std::optional<Vector3> FocalPoint;
  std::optional<Vector3> ViewUp;
  std::optional<Vector3> SceneUp; ///< sets ViewUp and Direction that are not given
  std::optional<Vector3> Direction;
  double ViewAngle = 30.0;
  bool HasViewAngle = false; ///< --camera-view-angle is on the command line
  double ZoomFactor = 1.0;
  bool HasZoomFactor = false; ///< --camera-zoom-factor is on the command line
  double Azimuth = 0.0;
  double Elevation = 0.0;
  bool Orthographic = false;
  double ParallelScale = Unset;
  int Index = -1; ///< of the cameras of the files; -1: none of them
};

/// Indirect light and environment.
struct LightOptions
{
  bool Indirect = false;
  std::optional<Vector3> EnvironmentColor; ///< unset: the background color
  std::string EnvironmentFile;             ///< empty: uniform color
  std::optional<Vector3> EnvironmentUp;
  double Albedo = 0.5;
  int Bounces = 3;
};

struct RenderOptions
{
  std::vector<std::string> Files;
  std::string Output;
  std::string Engine = "ray";
  std::array<int, 2> Resolution{ 1000, 600 };
  double Tolerance = 1.0 / 256.0;
  bool HasTolerance = false;   ///< --tolerance is on the command line
  double LightTolerance = 0.0; ///< 0: from Tolerance
  double TimeLimit = 0.0;      ///< seconds for an image; 0: none
  int MaximumLevel = 3;
  bool FindSmallObjects = true;
  int Threads = 0;

  std::string Look = "plain"; ///< see LookOptions.h
  std::string RedundantMode;  ///< of options of F3D that request what is always done
  std::string PointSprites;   ///< of F3D; must be "none"
  std::string Configuration;  ///< path; the parser has inserted its options
  CameraOptions Camera;
  ColoringOptions Coloring;

  bool Materials = true; ///< with lights and cameras of the files
  std::optional<Vector3> Color;
  double Opacity = 1.0;
  std::optional<Vector3> BackgroundColor;
  bool Background = true;
  bool Lighting = true;
  LightPositions Lights;
  double LightIntensity = 1.0;
  double LightRadius = 0.0; ///< ray: of positional lights, world units
  double LightAngle = 0.0;  ///< ray: angular diameter of directional lights, degrees
  double FeatureAngle = Unset;
  bool ShowEdges = false;
  std::string Representation = "surface";
  double LineWidth = 1.0;   ///< points of 1/72 inch
  double PointSize = 1.0;   ///< points of 1/72 inch
  double PointRadius = 0.0; ///< ray, world units; 0: squares of PointSize
  double LineRadius = 0.0;  ///< ray, world units; 0: flat lines of LineWidth
  int DotsPerInch = 72;
  int MaximumPaths = 50000;  ///< of surfaces in vector graphics; 0: always an image
  double OutlineWidth = 0.0; ///< vector graphics, points of 1/72 inch; 0: no outlines

  bool AmbientOcclusion = false;
  double AmbientOcclusionRadius = 0.0;          ///< 0: a tenth of the bounds' diagonal
  std::string AmbientOcclusionFalloff = "none"; ///< ray
  bool OcclusionArray = false; ///< ray, .vti: compute occlusion even if colors do not show it
  double AmbientOcclusionStrength = Unset;
  double AmbientOcclusionLightAwareness = 0.0;      ///< raster
  std::string AmbientOcclusionKernel = "automatic"; ///< raster
  std::string Gatherer = "rays";                    ///< ray
  int Frames = 0; ///< raster, with a static camera; 0: until converged
  bool Shadows = false;
  std::string Cache = "auto"; ///< of occlusion and indirect light
  LightOptions Light;
  ShaftOptions Shafts;

  std::vector<Cut> Cuts; ///< in order

  TimeOptions Time;
  std::optional<double> ShownTime; ///< of the image; unset: the first step
  std::string TimeText;            ///< of ShownTime
  std::string Text;                ///< in the upper left corner; {time} is replaced
  bool TimeLabel = false;
  bool FileNameLabel = false;

  std::string Statistics;
  std::string Progress = "auto";
  std::string Window = "auto";
  int Jobs = 1;
};

/// Declares the options of `render` on `app`; parsing fills `options`, which must outlive `app`.
void DeclareRenderOptions(const CommandLine& app, RenderOptions& options);

/// Sets options that others imply, and those of the look. Call after parsing.
void CompleteRenderOptions(const CommandLine& app, RenderOptions& options);

/// Throws CommandError if options contradict each other. Call after parsing.
void CheckRenderOptions(const CommandLine& app, const RenderOptions& options);

/// Returns one warning for each option on the command line that has no effect. Call after parsing.
std::vector<std::string> FindIgnoredOptions(const CommandLine& app, const RenderOptions& options);

}
#endif
