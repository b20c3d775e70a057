// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ImposterSettings.h"

#include "vtkMapper.h"

// Some distributions of VTK omit these classes.
#if __has_include("vtkOpenGLSphereMapper.h") && __has_include("vtkOpenGLStickMapper.h")
#include "vtkOpenGLSphereMapper.h"
#include "vtkOpenGLStickMapper.h"
#define PENUMBRA_HAS_IMPOSTERS
#endif

namespace penumbra
{

#ifdef PENUMBRA_HAS_IMPOSTERS
namespace
{

std::string ToString(const char* text)
{
  return text ? text : "";
}

// VTK has no getters for the names of the arrays. These classes are never created: they make the
// protected members accessible.
struct SphereMapper : vtkOpenGLSphereMapper
{
  static std::string GetScaleArray(vtkOpenGLSphereMapper* mapper)
  {
    return ToString(mapper->*(&SphereMapper::ScaleArray));
  }
};
struct StickMapper : vtkOpenGLStickMapper
{
  static std::string GetScaleArray(vtkOpenGLStickMapper* mapper)
  {
    return ToString(mapper->*(&StickMapper::ScaleArray));
  }
  static std::string GetOrientationArray(vtkOpenGLStickMapper* mapper)
  {
    return ToString(mapper->*(&StickMapper::OrientationArray));
  }
};

}
#endif

bool ReadImposterSettings(
  [[maybe_unused]] vtkMapper* mapper, [[maybe_unused]] ImposterSettings& settings)
{
#ifdef PENUMBRA_HAS_IMPOSTERS
  if (mapper->IsA("vtkOpenGLPolyDataMapper") && mapper->IsA("vtkOpenGLSphereMapper"))
  {
    auto* spheres = static_cast<vtkOpenGLSphereMapper*>(mapper);
    settings = { false, spheres->GetRadius(), SphereMapper::GetScaleArray(spheres), "" };
    return true;
  }
  if (mapper->IsA("vtkOpenGLPolyDataMapper") && mapper->IsA("vtkOpenGLStickMapper"))
  {
    auto* sticks = static_cast<vtkOpenGLStickMapper*>(mapper);
    settings = { true, 0.0, StickMapper::GetScaleArray(sticks),
      StickMapper::GetOrientationArray(sticks) };
    return true;
  }
#endif
  return false;
}

}
