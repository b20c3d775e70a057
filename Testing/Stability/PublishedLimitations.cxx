// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "PublishedLimitations.h"

namespace penumbra
{

const std::vector<PublishedLimitation>& PublishedWeaknesses()
{
  static const std::vector<PublishedLimitation> weaknesses = {
    { "[TSSAO eq. 3] cosine applied twice",
      "directions are distributed as the cosine, and not weighted again" },
    { "[TSSAO eq. 3] estimates another D",
      "each kernel says which D is its own; what is shown by default has D = 1" },
    { "[TSSAO eq. 7] nearest history drifts", "occlusion is fetched between four pixels" },
    { "[TSSAO eq. 7] an index of samples that is rounded",
      "one index for all pixels, an integer outside of textures" },
    { "[TSSAO eq. 8] history of what was hidden", "history is kept where the depth agrees" },
    { "[TSSAO eq. 8] rejects planes at grazing angles",
      "the tolerance of depth follows the slope" },
    { "[TSSAO eq. 9] a neighbour moves", "neighbours are asked whether they have moved" },
    { "[TSSAO eq. 9] noise flashes up where history ends",
      "a changed neighbourhood leaves a least weight of history" },
    { "[TSSAO eq. 12] shows tessellation", "rays through the layer instead of patches" },
    { "[TSSAO] an exponential cap never stops flickering", "a still view converges and stops" },
    { "[TSSAO] moving actors", "history follows actors, and is checked" },
    { "[TSSAO] changed geometry", "history is checked surface by surface" },
    { "[TSSAO] camera cut", "history from elsewhere does not pass the check" },
    { "[TSSAO] resized window", "another size starts afresh" },
    { "[TSSAO] several viewports", "each view has its own history, and a margin" },
    { "[TSSAO] parallel projection", "positions by the camera's own kind of rays" },
    { "[TSSAO] the image border", "a margin is drawn around the picture" },
    { "[TSSAO] large scenes lose precision", "positions are relative to the eye" },
    { "[TSSAO] translucent props", "they are drawn over the darkened picture" },
    { "[TSSAO] volumes", "they are drawn over the darkened picture" },
    { "[TSSAO] dark halos", "rays through the layer see past what is far in front" },
    { "[ISAO eq. 1] no cosine, no D", "kernels that have both" },
    { "[ISAO] step 4 counts the wrong way", "points behind what is seen count" },
    { "[ISAO] the full sphere darkens an open plane", "offsets are reflected into the hemisphere" },
    { "[ISAO] distances in scene units", "distances are in radii, the radius from the bounds" },
    { "[ISAO] depth alone", "planes of the camera that follow what is in view" },
    { "[ISAO] one layer of depth", "many samples, and a thickness behind the layer" },
    { "[ISAO] surfaces bleed into one another", "the filter weighs by distance" },
    { "[Shafts] no depth along the way", "which distances are shadowed, from depth" },
    { "[Shafts] one layer of depth", "what is seen has a thickness" },
    { "[Shafts] the listing omits 1/n", "eq. 4, and a decay per 1/64 of the way" },
    { "[Shafts] shafts drawn over the foreground", "light ends at what is seen" },
    { "[Shafts] flicker at the image border", "a margin is drawn around the picture" },
    { "[Shafts] a light at right angles to the view", "a march without a pole there" },
    { "[Shafts] a light behind the view", "a march without a pole there" },
    { "[Shafts] directional lights only", "lamps by distances of their own" },
    { "[Shafts] translucent props", "they are drawn over the light" },
    { "[Shafts] several viewports", "each view has its own margin" },
    { "[Shafts] flickers in a still scene", "nothing is computed twice" },
    { "[Shafts 13.3.1] one light", "a pass for each, added" },
    { "[Shafts 13.8] chained passes are no long loop", "geometric distances of samples" },
    { "[IC] radius 0 on concave surfaces", "radii from the second derivative" },
    { "[IC] distant records overrule a contact shadow", "radii from the second derivative" },
    { "[IC] radii without bounds", "least and greatest radii in pixels" },
    { "[IC] radii that nothing nearby clamps", "radii from the second derivative" },
    { "[IC] the weight's root of less than 0", "1 - n.n is kept at 0 or more" },
    { "[IC] no gradients", "gradients of translation and rotation" },
    { "[IC] records in front of a surface", "records serve their own surface" },
    { "[IC] records leak through thin walls", "records know how far their surroundings are clear" },
    { "[IC] depends on the order of questions", "records are made before questions" },
    { "[IC] one reflection", "reflections before the last have records of their own" },
    { "[AA] case 4 is left out", "small objects are found without a ray that hits them" },
    { "[AA] drops sub-pixels of case 3 at L_max", "their corners' mean; borders from the mesh" },
    { "[AA] no borders inside an object", "refinement by estimated error, and edges of the mesh" },
    { "[AA] no exact coverage", "shares of pixels from the mesh's borders" },
  };
  return weaknesses;
}

}
