// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "Solids.h"

#include "Surface.h"

#include <glm/gtc/constants.hpp>

#include <cmath>

namespace penumbra
{
namespace
{
constexpr double Pi = glm::pi<double>();
}

void AddRectangle(Scene& scene, glm::vec3 corner, glm::vec3 side, glm::vec3 other)
{
  Surface surface;
  surface.Positions = { corner, corner + side, corner + side + other, corner + other };
  surface.Triangles = { { 0, 1, 2 }, { 0, 2, 3 } };
  scene.Surfaces.push_back(surface);
}

void AddFloor(Scene& scene, float size)
{
  AddRectangle(scene, { -size, -size, 0.f }, { 2.f * size, 0.f, 0.f }, { 0.f, 2.f * size, 0.f });
}

void AddBox(Scene& scene, glm::vec3 low, glm::vec3 high)
{
  const glm::vec3 size = high - low;
  for (int axis = 0; axis < 3; ++axis)
  {
    glm::vec3 side(0.f);
    glm::vec3 other(0.f);
    glm::vec3 across(0.f);
    across[axis] = size[axis];
    side[(axis + 1) % 3] = size[(axis + 1) % 3];
    other[(axis + 2) % 3] = size[(axis + 2) % 3];
    AddRectangle(scene, low, other, side);
    AddRectangle(scene, low + across, side, other);
  }
}

void AddDisc(Scene& scene, float r, float z)
{
  Surface surface;
  const unsigned int sides = 720;
  surface.Positions.emplace_back(0.f, 0.f, z);
  for (unsigned int i = 0; i < sides; ++i)
  {
    const double angle = 2.0 * Pi * i / sides;
    surface.Positions.emplace_back(r * std::cos(angle), r * std::sin(angle), z);
    surface.Triangles.emplace_back(0, 1 + i, 1 + (i + 1) % sides);
  }
  scene.Surfaces.push_back(surface);
}

void AddSphere(Scene& scene, glm::dvec3 c, double r, unsigned int rings)
{
  Surface surface;
  for (unsigned int i = 0; i <= rings; ++i)
  {
    for (unsigned int j = 0; j < rings; ++j)
    {
      const double theta = Pi * i / rings;
      const double phi = 2.0 * Pi * j / rings;
      const glm::dvec3 direction(
        std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta));
      surface.Positions.emplace_back(c + r * direction);
      if (i > 0)
      {
        const unsigned int next = (j + 1) % rings;
        surface.Triangles.emplace_back((i - 1) * rings + j, i * rings + j, i * rings + next);
        surface.Triangles.emplace_back(
          (i - 1) * rings + j, i * rings + next, (i - 1) * rings + next);
      }
    }
  }
  scene.Surfaces.push_back(surface);
}

void LookAt(Scene& scene, glm::dvec3 eye, glm::dvec3 target, double angle, int width, int height)
{
  for (Surface& surface : scene.Surfaces)
  {
    for (glm::vec3& position : surface.Positions)
    {
      position = glm::dvec3(position) + scene.Origin - eye;
    }
  }
  scene.Origin = eye;
  Camera& camera = scene.ViewCamera;
  camera.Forward = glm::normalize(target - eye);
  camera.Right = glm::normalize(glm::cross(camera.Forward, glm::dvec3(0.0, 0.0, 1.0)));
  camera.Up = glm::cross(camera.Right, camera.Forward);
  camera.Width = width;
  camera.Height = height;
  camera.PixelSize = 2.0 * std::tan(angle * Pi / 360.0) / height;
  camera.Center = glm::dvec2(width, height) * .5;
}

}
