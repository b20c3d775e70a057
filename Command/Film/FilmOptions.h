// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// The options of `penumbra animate`.
#ifndef penumbra_FilmOptions_h
#define penumbra_FilmOptions_h

#include "Options/RenderOptions.h"

#include <string>
#include <utility>
#include <vector>

namespace penumbra
{

/// Displacement of the surfaces of one file over the film.
struct Movement
{
  int File = 0; ///< zero-based index
  Vector3 Displacement{};
};

/// First and last number of consecutive frames.
using FrameRange = std::pair<int, int>;

struct FilmOptions
{
  RenderOptions Render;
  int Frames = 0;               ///< 0: one per time step, else DefaultFrames
  std::vector<FrameRange> Part; ///< frames to render; empty: all
  double Orbit = Unset;         ///< degrees; unset: 360 if nothing else moves
  std::vector<Movement> Movements;
  bool TimeSeries = false; ///< each file is one time step
  bool Resume = false;
  std::string Prepare;     ///< file to write instead of images
  std::string Defaults;    ///< file that Prepare wrote
  std::string Description; ///< all options that affect an image, one per line
};

/// Declares the options on `app`; parsing fills `options`, which must outlive `app`.
void DeclareFilmOptions(const CommandLine& app, FilmOptions& options);

/// Throws CommandError if options contradict each other, and completes `options`. Call after
/// parsing.
void CheckFilmOptions(const CommandLine& app, FilmOptions& options);

}
#endif
