// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Temporal stability of images in motion: compares the same surface points in consecutive frames.
#ifndef penumbra_Reprojection_h
#define penumbra_Reprojection_h

#include <glm/glm.hpp>

#include <vector>

class vtkCamera;

namespace penumbra
{

class Reprojection
{
public:
  Reprojection(int width, int height);

  /// Adds a frame as seen by the camera, row by row. Eye depths are infinite in the background.
  void Add(vtkCamera* camera, std::vector<float> values, std::vector<float> depths);

  /// RMS, over the points of the first frame that are visible in all frames, of the standard
  /// deviation over frames.
  double StandardDeviation() const;

private:
  struct Frame
  {
    glm::dmat4 WorldToClip;
    std::vector<float> Values;
    std::vector<float> Depths;
  };

  glm::dvec4 Position(const Frame& frame, int i, int j) const;
  double ValueAt(const Frame& frame, glm::dvec4 position) const;

  int Width;
  int Height;
  std::vector<Frame> Frames;
};

}
#endif
