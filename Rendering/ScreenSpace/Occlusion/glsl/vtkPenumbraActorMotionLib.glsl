// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Motion of the surface at a pixel since the previous frame, if actors have moved.
uniform sampler2D movedActors;  // a: number of the visible actor / 255; 0: it has not moved
uniform sampler2D actorMotions; // one row per actor: the four columns of its matrix

// Returns the number of the moved actor at a pixel, or 0 if its surface has not moved.
float actorAt(vec2 pixel)
{
  return floor(255.0 * texture(movedActors, pixel * pixelSize).a + 0.5);
}

// Returns the matrix from eye coordinates to those of the previous frame for an actor.
mat4 actorMotion(float actor)
{
  mat4 motion = toPreviousEye;
  // The loop lets pixels without motion skip the fetches; with a branch, some drivers execute both
  // sides.
  int last = actor > 0.5 ? 4 : 0;
  for (int i = 0; i < last; ++i)
  {
    motion[i] = texelFetch(actorMotions, ivec2(i, int(actor) - 1), 0);
  }
  return motion;
}
