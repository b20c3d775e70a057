// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "TriangleScene.h"

#include "vtkCamera.h"
#include "vtkRenderer.h"

#include <cmath>
#include <fstream>
#include <iomanip>
#include <sstream>

namespace penumbra
{

namespace
{

std::string List(glm::dvec3 v)
{
  std::ostringstream text;
  text << std::setprecision(12) << '[' << v.x << ',' << v.y << ',' << v.z << ']';
  return text.str();
}

/// Shades with a headlight parallel to the view that lights both sides.
glm::dvec3 ColorOf(const BruteForceScene& scene, const glm::uvec3& triangle)
{
  const glm::dvec3 a = scene.Positions[triangle.x];
  const glm::dvec3 across =
    glm::cross(scene.Positions[triangle.y] - a, scene.Positions[triangle.z] - a);
  const double size = glm::length(across);
  return size > 0.0 ? scene.Color * (std::abs(glm::dot(across, scene.LightTravel)) / size)
                    : glm::dvec3(0.0);
}

}

void WriteFaces(const std::string& path, vtkRenderer* renderer, const BruteForceScene& scene,
  int width, int height)
{
  vtkCamera* camera = renderer->GetActiveCamera();
  double up[3];
  camera->GetViewUp(up);
  std::ofstream file(path);
  file << "{\"size\": [" << width << ',' << height << "], \"eye\": " << List(scene.Eye)
       << ", \"forward\": " << List(scene.LightTravel)
       << ", \"up\": " << List({ up[0], up[1], up[2] }) << ", \"angle\": " << camera->GetViewAngle()
       << ",\n\"positions\": [";
  for (std::size_t i = 0; i < scene.Positions.size(); ++i)
  {
    file << (i > 0 ? ",\n" : "") << List(scene.Positions[i]);
  }
  file << "],\n\"triangles\": [";
  for (std::size_t i = 0; i < scene.Triangles.size(); ++i)
  {
    const glm::uvec3& triangle = scene.Triangles[i];
    file << (i > 0 ? ",\n[" : "[") << triangle.x << ',' << triangle.y << ',' << triangle.z << ']';
  }
  file << "],\n\"colors\": [";
  for (std::size_t i = 0; i < scene.Triangles.size(); ++i)
  {
    file << (i > 0 ? ",\n" : "") << List(ColorOf(scene, scene.Triangles[i]));
  }
  file << "]}\n";
}

PeerImage RunImageScript(
  const Peer& peer, const std::string& scene, const std::string& setting, int width, int height)
{
  const ScriptAnswer told =
    RunScript(peer, scene, setting, std::size_t{ 3 } * static_cast<std::size_t>(width) * height);
  const std::vector<float>& values = told.Values;
  PeerImage answer;
  answer.Seconds = told.Seconds;
  answer.SamplesPerPixel = told.Count;
  for (std::size_t i = 0; i < values.size(); i += 3)
  {
    answer.Colors.emplace_back(values[i], values[i + 1], values[i + 2]);
  }
  return answer;
}

}
