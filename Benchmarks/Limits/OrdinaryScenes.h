// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Scenes as applications show them: edges over surfaces, translucent wireframes, scalars with an
// opacity, textures at grazing angles.
#ifndef penumbra_OrdinaryScenes_h
#define penumbra_OrdinaryScenes_h

#include <functional>
#include <string>
#include <vector>

class vtkRenderer;

namespace penumbra
{

struct OrdinaryScene
{
  std::string Name;
  std::function<void(vtkRenderer*)> Build; ///< adds props and sets the camera
  std::function<void(vtkRenderer*)> Plain; ///< the same opaque and without lines
};

/// Size of their images in pixels.
constexpr int OrdinaryImageWidth = 480;
constexpr int OrdinaryImageHeight = 360;

/// Returns the scenes. `data`: folder of the meshes of the repository.
std::vector<OrdinaryScene> MakeOrdinaryScenes(const std::string& data);

}
#endif
