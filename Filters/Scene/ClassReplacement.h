// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Replaces classes that a prop creates for its parts, so that it can render into a SizeOnlyWindow.
#ifndef penumbra_ClassReplacement_h
#define penumbra_ClassReplacement_h

#include "vtkObjectFactory.h"

namespace penumbra
{

/// Registers a function that creates the objects of a VTK class. It takes precedence over VTK's
/// modules; if it returns null, VTK creates the object.
///
/// Register each class once. All registrations last until the process ends.
void ReplaceClass(
  const char* className, const char* replacement, vtkObjectFactory::CreateFunction create);

}
#endif
