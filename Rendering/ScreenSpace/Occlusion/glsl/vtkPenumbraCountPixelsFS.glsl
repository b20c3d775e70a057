//VTK::System::Dec
//VTK::Output::Dec
// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Counts the pixels of a block of 16 x 16 by the fate of their history in the last frame.
//VTK::Penumbra::ViewLib
uniform sampler2D eyeDepths;
uniform sampler2D history;       // r: sum, g: number of samples
uniform sampler2D movedActors;   // a: not 0 if the actor of the pixel has moved
uniform ivec2 imageSize;         // without margin
uniform ivec2 imageOrigin;       // of the image without margin
uniform float newWeight;         // samples per pixel in the last frame
uniform float invalidatedWeight; // weight up to which a history with new samples was limited
uniform float convergedWeight;
uniform float hasMovedActors;    // 1, or 0 if movedActors is not valid

const int blockSide = 16;

void main()
{
  vec4 fates = vec4(0.0); // pixels with a surface; of these: kept, disoccluded, invalidated
  vec2 others = vec2(0.0); // reprojected with their actor, converged
  ivec2 start = blockSide * ivec2(gl_FragCoord.xy);
  for (int i = 0; i < blockSide * blockSide; ++i)
  {
    ivec2 pixel = start + ivec2(i % blockSide, i / blockSide);
    bool isInside = all(lessThan(pixel, imageSize));
    pixel += imageOrigin;
    if (isInside && texelFetch(eyeDepths, pixel, 0).r < 0.5 * farAway)
    {
      float weight = texelFetch(history, pixel, 0).g;
      bool hasNew = newWeight > 0.0;
      bool hasHistory = weight > newWeight;
      bool isFull = weight > invalidatedWeight;
      fates += vec4(1.0, !hasNew || isFull, hasNew && !hasHistory, hasNew && hasHistory && !isFull);
      bool hasMoved = hasMovedActors > 0.5 && texelFetch(movedActors, pixel, 0).a > 0.0;
      others += vec2(hasMoved && hasHistory, weight >= convergedWeight);
    }
  }
  gl_FragData[0] = fates;
  gl_FragData[1] = vec4(others, 0.0, 1.0);
}
