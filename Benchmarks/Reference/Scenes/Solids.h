// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Simple surfaces whose occlusion is known in closed form, added to a ray scene.
#ifndef penumbra_Solids_h
#define penumbra_Solids_h

#include "Scene.h"

namespace penumbra
{

void AddRectangle(Scene& scene, glm::vec3 corner, glm::vec3 side, glm::vec3 other);

/// The square of half side `size` about the origin in the plane z = 0.
void AddFloor(Scene& scene, float size);

/// Six rectangles.
void AddBox(Scene& scene, glm::vec3 low, glm::vec3 high);

/// A disc of radius r about (0, 0, z), of 720 triangles.
void AddDisc(Scene& scene, float r, float z);

/// A sphere of radius r about c, with so many rings of as many corners.
void AddSphere(Scene& scene, glm::dvec3 c, double r, unsigned int rings = 200);

/// A perspective camera at `eye`, to which the origin of the scene (of Scale 1) moves, as it does when
/// scenes are extracted; `angle` in degrees, upright.
void LookAt(Scene& scene, glm::dvec3 eye, glm::dvec3 target, double angle, int width, int height);

}
#endif
