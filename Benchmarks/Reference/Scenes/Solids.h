// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Simple surfaces with closed-form occlusion, added to a ray scene.
#ifndef penumbra_Solids_h
#define penumbra_Solids_h

#include "Scene.h"

namespace penumbra
{

void AddRectangle(Scene& scene, glm::vec3 corner, glm::vec3 side, glm::vec3 other);

/// Adds the square of half side `size` around the origin in the plane z = 0.
void AddFloor(Scene& scene, float size);

/// Adds a box of six rectangles.
void AddBox(Scene& scene, glm::vec3 low, glm::vec3 high);

/// Adds a disc of radius r around (0, 0, z), made of 720 triangles.
void AddDisc(Scene& scene, float r, float z);

/// Adds a sphere of radius r around c with the given number of rings and of corners per ring.
void AddSphere(Scene& scene, glm::dvec3 c, double r, unsigned int rings = 200);

/// Returns an upright perspective camera at `eye`. The scene's origin (with Scale 1) moves to the
/// camera, as scene extraction does. `angle` is in degrees.
void LookAt(Scene& scene, glm::dvec3 eye, glm::dvec3 target, double angle, int width, int height);

}
#endif
