// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Replaces vtkPenumbraActorMotionLib if only the camera has moved.
float actorAt(vec2 pixel)
{
  return 0.0;
}

mat4 actorMotion(float actor)
{
  return toPreviousEye;
}
