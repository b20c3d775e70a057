// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Rows of adjacent quadrilaterals, such as the swatches of a scalar bar, without seams.
#ifndef penumbra_PolygonRows_h
#define penumbra_PolygonRows_h

#include "Overlay.h"

#include <vector>

namespace penumbra
{

/**
 * Changes opaque quadrilaterals that follow each other, share an edge with the next one and continue
 * its sides: each extends to the end of its row, below all that follow. A reader that smooths edges
 * then shows no background between them. Rows along the axes start and end at the boundaries of
 * those pixels whose centers are inside, as the ray caster draws them; quadrilaterals without pixels
 * are removed.
 */
void ExtendRows(std::vector<OverlayShape>& shapes);

}
#endif
