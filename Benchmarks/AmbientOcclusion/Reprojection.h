// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// How steady a picture in motion is: the same surface points looked at in frame after frame.
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

  /// One more frame: what the camera saw, row after row; eye depths are infinite where nothing is seen.
  void Add(vtkCamera* camera, std::vector<float> values, std::vector<float> depths);

  /// RMS, over points of the first frame that all frames see, of the standard deviation over frames.
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
