// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "Building.h"

#include "Solids.h"

namespace penumbra
{
namespace
{

constexpr float DoorLow = 2.6f; ///< along the wall
constexpr float DoorHigh = 3.5f;
constexpr float DoorHeight = 2.1f;
constexpr unsigned int RingsOfBall = 32;

/// Adds a wall from `corner` along `side` (unit vector); if `open`, with a doorway.
void AddWall(Scene& scene, glm::vec3 corner, glm::vec3 side, bool open)
{
  const glm::vec3 up(0.f, 0.f, 1.f);
  if (!open)
  {
    AddRectangle(scene, corner, RoomSize * side, RoomHeight * up);
    return;
  }
  AddRectangle(scene, corner, DoorLow * side, RoomHeight * up);
  AddRectangle(scene, corner + DoorHigh * side, (RoomSize - DoorHigh) * side, RoomHeight * up);
  AddRectangle(scene, corner + DoorLow * side + DoorHeight * up, (DoorHigh - DoorLow) * side,
    (RoomHeight - DoorHeight) * up);
}

void Furnish(Scene& scene, glm::vec3 corner)
{
  AddBox(scene, corner + glm::vec3(.8f, .9f, .7f), corner + glm::vec3(2.4f, 1.9f, .8f));
  for (const glm::vec3 middle :
    { glm::vec3(1.2f, 1.3f, 1.1f), glm::vec3(3.2f, 3.3f, .5f), glm::vec3(.6f, 3.2f, .4f) })
  {
    AddSphere(scene, glm::dvec3(corner + middle), .3, RingsOfBall);
  }
}

}

void AddBuilding(Scene& scene, int along, int storeys)
{
  const glm::vec3 x(1.f, 0.f, 0.f);
  const glm::vec3 y(0.f, 1.f, 0.f);
  const float width = RoomSize * static_cast<float>(along);
  for (int storey = 0; storey <= storeys; ++storey)
  {
    const float z = RoomHeight * static_cast<float>(storey);
    AddRectangle(scene, { 0.f, 0.f, z }, width * x, width * y);
    for (int i = 0; storey < storeys && i <= along; ++i)
    {
      for (int j = 0; j < along; ++j)
      {
        const bool inside = i > 0 && i < along;
        const float a = RoomSize * static_cast<float>(i);
        const float b = RoomSize * static_cast<float>(j);
        AddWall(scene, { a, b, z }, y, inside);
        AddWall(scene, { b, a, z }, x, inside);
        if (i < along)
        {
          Furnish(scene, { a, b, z });
        }
      }
    }
  }
}

}
