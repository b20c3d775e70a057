// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Draws what a half cube about a point sees of a scene, through a window of its own that nobody sees,
// and reads it back.
#ifndef penumbra_HemicubeRenderer_h
#define penumbra_HemicubeRenderer_h

#include "Hemicube.h"
#include "OpenGLThread.h"
#include "TriangleClusters.h"

#include <memory>
#include <vector>

namespace penumbra
{

/// What is seen first in a texel: the number of its triangle (see TriangleClusters), 0 for none, and its
/// distance along the face's axis.
struct HemicubeTexel
{
  float Number;
  float Depth;
};

class HemicubeRenderer
{
public:
  /// Throws std::runtime_error when there is no OpenGL. All arguments must outlive this object.
  HemicubeRenderer(const Scene& scene, const TriangleClusters& bundles, const Hemicube& cube);
  ~HemicubeRenderer();

  /// What is seen from `eye` within `reach`, the hemisphere about the third axis of `frame`; nothing
  /// nearer than `near`. Returns how many triangles were drawn. May be called by many threads at once,
  /// but one picture is drawn after the other.
  long long Draw(glm::vec3 eye, const glm::mat3& frame, float near, float reach,
    std::vector<HemicubeTexel>& texels);

private:
  void Open(const Scene& scene);
  void DrawFace(const Hemicube::Face& face, glm::vec3 eye, const glm::mat3& frame, float near,
    float reach, long long& triangles);

  struct Graphics;

  const TriangleClusters& Bundles;
  const Hemicube& Cube;
  std::unique_ptr<Graphics> OpenGL; ///< used by Thread alone while it runs
  OpenGLThread Thread;
};

}
#endif
