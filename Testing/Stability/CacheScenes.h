// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// What the scenarios of the cache share.
#ifndef penumbra_stability_CacheScenes_h
#define penumbra_stability_CacheScenes_h

#include "Metrics.h"

#include <functional>
#include <glm/glm.hpp>
#include <limits>
#include <vector>

class vtkPenumbraIrradianceProvider;

namespace penumbra
{

class RayScene;
struct Scene;

constexpr double Infinity = std::numeric_limits<double>::infinity();

/// What is asked of a source at a place that the picture sees.
using PointEvaluator = std::function<double(glm::dvec3 position, glm::dvec3 normal)>;

double Ask(const vtkPenumbraIrradianceProvider* source, glm::dvec3 position, glm::dvec3 normal);

/// 1 - answers at what the middle of every second pixel sees, 1 elsewhere; `error`: RMS of what they
/// differ from the truth.
Frame Picture(
  const RayScene& rays, const PointEvaluator& ask, const PointEvaluator& truth, double& error);

/// The same of the occlusion that a source knows.
Frame Picture(const RayScene& rays, const vtkPenumbraIrradianceProvider* source,
  const PointEvaluator& truth, double& error);

/// The same, where no truth is known.
Frame Picture(const RayScene& rays, const vtkPenumbraIrradianceProvider* source);

/// An endless floor under a unit sphere that touches it, in a picture of `size` x `size`.
void ArrangeContact(Scene& scene, double height, int size);

/// A floor, a wall upon it, and to the left of that a low lid: a dark room and a bright one.
void ArrangeTwoRooms(Scene& scene);

/// The largest error of a source along a line of the floor of those rooms, on both sides of the wall.
double WorstBesideWall(const RayScene& rays, const vtkPenumbraIrradianceProvider* source);

}
#endif
