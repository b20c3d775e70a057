// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Fixtures of the irradiance cache's scenarios.
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

/// Computes a value at a visible surface point.
using PointEvaluator = std::function<double(glm::dvec3 position, glm::dvec3 normal)>;

double Ask(const vtkPenumbraIrradianceProvider* provider, glm::dvec3 position, glm::dvec3 normal);

/// Returns an image of 1 - value at the surface points seen by every second pixel, and 1 in the
/// background. `error` is set to the RMS difference from the reference.
Frame RenderFrame(const RayScene& rays, const PointEvaluator& evaluate,
  const PointEvaluator& reference, double& error);

/// The same for the occlusion that a provider computes.
Frame RenderFrame(const RayScene& rays, const vtkPenumbraIrradianceProvider* provider,
  const PointEvaluator& reference, double& error);

/// The same without a reference.
Frame RenderFrame(const RayScene& rays, const vtkPenumbraIrradianceProvider* provider);

/// A large floor under a unit sphere whose center is at `height`, seen by a camera of `size` x
/// `size` pixels. The sphere touches the floor at height 1.
void ArrangeContact(Scene& scene, double height, int size);

/// A floor with a thin wall, and a low ceiling to the left of it: a dark room and a bright one.
void ArrangeTwoRooms(Scene& scene);

/// Returns the largest error of a provider along a line of the floor of those rooms, on both sides
/// of the wall.
double WorstBesideWall(const RayScene& rays, const vtkPenumbraIrradianceProvider* provider);

}
#endif
