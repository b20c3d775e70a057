// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "PointQueries.h"

#include "Surface.h"

#include <fstream>

namespace penumbra
{

void WritePlaces(const std::string& path, const PointQueryScene& scene)
{
  const Scene& drawn = *scene.Drawn;
  std::vector<double> numbers = { 0.0, static_cast<double>(scene.Questions.size()), scene.Sky,
    static_cast<double>(scene.Bounces) };
  const auto add = [&numbers](glm::dvec3 v) { numbers.insert(numbers.end(), { v.x, v.y, v.z }); };
  for (const Surface& surface : drawn.Surfaces)
  {
    const Material& material = surface.Front;
    for (const glm::uvec3& triangle : surface.Triangles)
    {
      for (int corner = 0; corner < 3; ++corner)
      {
        add(glm::dvec3(surface.Positions[triangle[corner]]) / drawn.Scale + drawn.Origin);
      }
      add(scene.Albedo * glm::dvec3(material.DiffuseColor));
      add(glm::dvec3(material.Ambient * material.AmbientColor));
      numbers.front() += 1.0;
    }
  }
  for (const PointQuery& question : scene.Questions)
  {
    add(question.Position);
    add(question.Normal);
  }
  std::ofstream file(path, std::ios::binary);
  file.write(reinterpret_cast<const char*>(numbers.data()),
    static_cast<std::streamsize>(numbers.size() * sizeof(double)));
}

PointQueryResult RunPlaces(
  const Peer& peer, const std::string& scene, const std::string& setting, std::size_t places)
{
  const ScriptAnswer told = RunScript(peer, scene, setting, 3 * places);
  PointQueryResult answer;
  answer.Seconds = told.Seconds;
  answer.RaysPerPlace = told.Count;
  for (std::size_t i = 0; i < told.Values.size(); i += 3)
  {
    answer.Light.emplace_back(told.Values[i], told.Values[i + 1], told.Values[i + 2]);
  }
  return answer;
}

}
