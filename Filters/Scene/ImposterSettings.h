// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Settings of vtkOpenGLSphereMapper and vtkOpenGLStickMapper, which draw imposters of spheres and
// cylinders.
#ifndef penumbra_ImposterSettings_h
#define penumbra_ImposterSettings_h

#include "vtkPenumbraFiltersSceneModule.h" // for export macro, which tests need

#include <string>

class vtkMapper;

namespace penumbra
{

/// Settings of a mapper of imposters.
struct ImposterSettings
{
  bool AreSticks = false;
  /// Radius of spheres in world units, if the data have no array of the name ScaleArray.
  double Radius = 0.3;
  /// Point array: radii of spheres; length, radius and an unused component of sticks. In world
  /// units, which the transform of the actor does not change. May be empty.
  std::string ScaleArray;
  std::string OrientationArray; ///< directions of sticks, 3 components; their length is a factor
};

/// Reads the settings of a vtkOpenGLSphereMapper or vtkOpenGLStickMapper. Returns false for other
/// mappers, and for these if Penumbra was compiled without their headers.
VTKPENUMBRAFILTERSSCENE_EXPORT bool ReadImposterSettings(
  vtkMapper* mapper, ImposterSettings& settings);

}
#endif
