// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// What the five papers name, print or leave out that makes their methods fail. Each has a row of the
// catalogue at least, which names it as its source.
#ifndef penumbra_stability_PublishedLimitations_h
#define penumbra_stability_PublishedLimitations_h

#include <string>
#include <vector>

namespace penumbra
{

struct PublishedLimitation
{
  std::string Source; ///< as Scenario::Source
  std::string Remedy; ///< what settles it here
};

/// Paper by paper.
const std::vector<PublishedLimitation>& PublishedWeaknesses();

}
#endif
