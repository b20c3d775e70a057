// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// A coarse estimate of an image region from one ray for every 8 x 8 pixels, which a limit of the work
// leaves where nothing better is known.
#ifndef penumbra_CoarseImage_h
#define penumbra_CoarseImage_h

#include "Execution/ParallelFor.h"
#include "Light/LightField.h"
#include "Light/LightRays.h"
#include "Sampling/CameraRayTracer.h"

#include <vector>

namespace penumbra
{

class CoarseImage
{
public:
  /// Traces the rays for the pixels [low, high), and rays for the light at their hits if `light` is not
  /// null. Throws Stopped if `progress` requests a stop.
  CoarseImage(const CameraRayTracer& tracer, const LightEffects* light, glm::ivec2 low,
    glm::ivec2 high, const ProgressCallback& progress, RayCounts& counts);

  /// Values that are interpolated between rays, and their estimated errors.
  struct Value
  {
    glm::vec4 Color{ 0.f }; ///< premultiplied by alpha, without the light
    float Error = 0.f;
    glm::vec3 Factor{ 1.f };        ///< of the light
    float FactorError = 0.f;        ///< estimated error of the color that it causes
    float Occlusion = 0.f;          ///< mean of the surfaces
    glm::vec3 LargestChange{ 0.f }; ///< of a color by the light
    float MeanLargestChange = 0.f;  ///< over all rays, of the largest channel

    /// Returns the change of the final color of a pixel, premultiplied by alpha, with the estimated error `error`.
    LightField::Change FindChange(const glm::vec4& color, float error) const;
  };
  Value At(int x, int y) const;

private:
  struct Node
  {
    glm::vec4 Color{ 0.f };
    glm::vec3 Factor{ 1.f };
    glm::vec3 LargestChange{ 0.f };
    float Occlusion = 0.f;
    float Deviation = 0.f;       ///< squared, of the color from its neighbors
    float FactorDeviation = 0.f; ///< the same of the factor
  };

  glm::ivec2 GetPosition(glm::ivec2 node) const;
  const Node& GetNode(glm::ivec2 node) const
  {
    return this->Nodes[static_cast<std::size_t>(node.y) * this->Count.x + node.x];
  }
  void TracePacket(
    const CameraRayTracer& tracer, const LightEffects* light, int first, RayCounts& counts);
  void FindDeviations();

  glm::ivec2 Low;   ///< index of the first node in the whole image
  glm::ivec2 Last;  ///< position of the upper right corner of the image
  glm::ivec2 Count; ///< number of nodes
  std::vector<Node> Nodes;
  float MeanDeviation = 0.f;
  float MeanFactorDeviation = 0.f;
  float MeanLargestChange = 0.f;
};

}
#endif
