// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Messages of the modules, which name properties of classes, in words of the program.
#ifndef penumbra_OptionNames_h
#define penumbra_OptionNames_h

#include <string>

namespace penumbra
{

/// Returns a message of a module with the options of this program instead of the properties and
/// functions of classes.
std::string NameOptions(std::string message);

}
#endif
