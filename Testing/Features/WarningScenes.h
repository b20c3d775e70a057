// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// One scene per row of the table of VTK's rendering features that warns.
#ifndef WarningScenes_h
#define WarningScenes_h

#include "Features/SceneFeatures.h"

#include <functional>
#include <string>
#include <vector>

class vtkRenderer;

/// Scene that causes the warning of one row, and no other.
struct WarningScene
{
  penumbra::Feature Key;
  std::string Prop; ///< name of the prop in the warning; empty if the warning concerns the renderer
  std::function<void(vtkRenderer*)> Build; ///< of a renderer in a window
};

std::vector<WarningScene> MakeWarningScenes();

#endif
