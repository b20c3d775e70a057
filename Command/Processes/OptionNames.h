// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Messages of the modules, which name properties of classes, in words of the program.
#ifndef penumbra_OptionNames_h
#define penumbra_OptionNames_h

#include <string>
#include <vector>

class vtkObject;

namespace penumbra
{

/// Returns a message of a module with the options of this program instead of the properties and
/// functions of classes.
std::string NameOptions(std::string message);

/// Throws if VTK has reported errors since TakeErrors(): CommandError with `what` and the first of them in these
/// words, or std::bad_alloc.
void ThrowErrors(const std::string& what);

/// Appends the warnings of an object to `warnings`, in these words, until the observer that it returns is
/// removed.
unsigned long CollectWarnings(vtkObject* object, std::vector<std::string>& warnings);

}
#endif
