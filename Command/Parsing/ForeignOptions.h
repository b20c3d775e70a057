// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Options of F3D that this program does not have.
#ifndef penumbra_ForeignOptions_h
#define penumbra_ForeignOptions_h

#include <string>

namespace penumbra
{

/// Returns what to use instead of an option of F3D; empty: it is not one of them.
std::string FindReplacement(const std::string& option);

/// Returns the first short option of a group, such as "-sbx", that FindReplacement() accepts, or the
/// group.
std::string FindShortOption(const std::string& cluster);

}
#endif
