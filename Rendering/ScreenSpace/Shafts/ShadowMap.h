// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Shadow map of a light: the depths of the opaque props, rendered by VTK with a camera at the light
// (Williams 1978). It contains occluders that the view hides or that are outside of it.
#ifndef penumbra_ShadowMap_h
#define penumbra_ShadowMap_h

#include "ShadowCasters.h"
#include "ShaftLights.h"

#include "vtkSmartPointer.h"

#include <vector>

class vtkOpenGLFramebufferObject;
class vtkOpenGLRenderWindow;
class vtkTextureObject;
class vtkWindow;

namespace penumbra
{

/// Sets HasShadowMap of every light for which one map contains all props that it illuminates: a
/// directional light, a spotlight, or a positional light outside of the bounds of the scene.
/// Returns false if a light has no map.
bool AssignShadowMaps(std::vector<ShaftLight>& lights, const double bounds[6]);

class ShadowMap
{
public:
  /// Renders the map unless it is up to date. `view`: the view of the image. `size`: texels per
  /// side. Returns false if OpenGL reports an incomplete framebuffer.
  bool Update(vtkRenderer* renderer, const ShadowCasters& casters, const ShaftLight& light,
    const ScreenTransform& view, int size);

  /// Returns whether the last Update() rendered the map.
  bool IsNew() const { return this->New; }

  /// Depths, with 2 x 2 filtered comparison.
  vtkTextureObject* GetDepths() const { return this->Depths; }

  /// Sets the uniforms of vtkPenumbraShaftMapLib.glsl for rays of `view`.
  void SetUniforms(vtkShaderProgram* program, const ScreenTransform& view) const;

  void ReleaseGraphicsResources(vtkWindow* window);

private:
  void Allocate(vtkOpenGLRenderWindow* window, int size);
  void DrawCasters(vtkRenderer* renderer, const ShadowCasters& casters) const;

  vtkSmartPointer<vtkTextureObject> Depths;
  vtkSmartPointer<vtkTextureObject> Color; ///< required by the framebuffer; nothing is written
  vtkSmartPointer<vtkOpenGLFramebufferObject> Framebuffer;
  Matrix WorldToLight{};
  Matrix Projection{};
  long long Version = -1; ///< of the casters
  bool New = false;
};

}
#endif
