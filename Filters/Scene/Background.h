// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// What rays see that miss the scene.
#ifndef penumbra_Background_h
#define penumbra_Background_h

#include <glm/glm.hpp>

#include <memory>
#include <vector>

namespace penumbra
{

struct Texture;

/// Images of the surroundings, infinitely far away, as in vtkSkybox.
struct Sky
{
  /// Faces of a cube (+x, -x, +y, -y, +z, -z, oriented as in OpenGL), or one image of all
  /// directions, whose coordinates are longitude and latitude.
  std::vector<std::shared_ptr<const Texture>> Faces;
  glm::dmat3 FromScene{ 1.0 };   ///< converts directions to the coordinates of the images
  double Depth = 1.0;            ///< parallel projection: distance at which VTK samples the images
  bool IsGammaCorrected = false; ///< if true, colors are raised to the power 1 / 2.2
};

/// Color of rays that miss the scene: constant, a gradient, an image that fills the view, or a sky.
struct Background
{
  /// Direction of the gradient from First to Second, as vtkViewport::GradientModes.
  enum class Gradients
  {
    Vertical,
    Horizontal,
    RadialToSide,  ///< ellipse around the center that touches the sides
    RadialToCorner ///< ellipse around the center that touches the corners
  };
  Gradients Gradient = Gradients::Vertical;
  glm::vec4 First{ 0.f, 0.f, 0.f, 0.f };   ///< at the bottom, the left or the center
  glm::vec4 Second{ 0.f, 0.f, 0.f, 0.f };  ///< at the top, the right or the ellipse
  std::shared_ptr<const Texture> Image;    ///< if set, replaces the gradient
  std::shared_ptr<const Sky> Surroundings; ///< if set, replaces the image
};

}
#endif
