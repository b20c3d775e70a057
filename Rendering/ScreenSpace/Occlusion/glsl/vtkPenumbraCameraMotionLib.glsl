// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Instead of vtkPenumbraActorMotionLib: nothing but the eye has moved.
float actorAt(vec2 pixel)
{
  return 0.0;
}

mat4 motionOf(float actor)
{
  return toPreviousEye;
}
