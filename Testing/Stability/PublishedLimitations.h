// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Limitations of the five papers' methods: stated, printed or omitted there. At least one row of
// the catalogue names each as its source.
#ifndef penumbra_stability_PublishedLimitations_h
#define penumbra_stability_PublishedLimitations_h

#include <string>
#include <vector>

namespace penumbra
{

struct PublishedLimitation
{
  std::string Source; ///< as Scenario::Source
  std::string Remedy; ///< how Penumbra avoids it
};

/// Returns all limitations, grouped by paper.
const std::vector<PublishedLimitation>& PublishedWeaknesses();

}
#endif
