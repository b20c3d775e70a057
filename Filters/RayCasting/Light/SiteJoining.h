// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Joins the values of neighboring sites by regression in windows that grow from
// level to level.
#ifndef penumbra_SiteJoining_h
#define penumbra_SiteJoining_h

#include "LightSite.h"

namespace penumbra
{

/// Largest distance, in pixels, of the sites that a joined estimate depends on.
int GetJoiningReach();

/// Computes the joined estimates of all sites.
template <int N>
void JoinSites(SiteGrid<N>& grid);

} // namespace penumbra
#endif
