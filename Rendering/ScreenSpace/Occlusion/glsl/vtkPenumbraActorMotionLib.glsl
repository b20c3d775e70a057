// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// How what a pixel shows came from its place in the previous picture, where actors have moved.
uniform sampler2D movedActors;  // a: number of the actor that is seen, in 255ths; 0: at rest
uniform sampler2D actorMotions; // row by row the columns of their matrices

// The number of the actor that a pixel shows, 0 where nothing has moved.
float actorAt(vec2 pixel)
{
  return floor(255.0 * texture(movedActors, pixel * pixelSize).a + 0.5);
}

mat4 motionOf(float actor)
{
  mat4 motion = toPreviousEye;
  // A loop: pixels at rest leave it at once, where both sides of a branch would be executed.
  int last = actor > 0.5 ? 4 : 0;
  for (int i = 0; i < last; ++i)
  {
    motion[i] = texelFetch(actorMotions, ivec2(i, int(actor) - 1), 0);
  }
  return motion;
}
