// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// The options that cut data sets.
#ifndef penumbra_CutOptions_h
#define penumbra_CutOptions_h

#include "Input/Cuts.h"
#include "Parsing/Arguments.h"

#include <string>
#include <vector>

namespace penumbra
{

/// Declares the options on `app`; parsing appends to `cuts`, which must outlive `app`, in the order
/// of the command line.
void DeclareCutOptions(const CommandLine& app, std::vector<Cut>& cuts);

/// Returns the cuts as text, one per line.
std::string DescribeCuts(const std::vector<Cut>& cuts);

}
#endif
