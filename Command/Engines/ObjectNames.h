// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Names of files in warnings of the modules, which number the objects of a scene.
#ifndef penumbra_ObjectNames_h
#define penumbra_ObjectNames_h

#include <string>

class vtkRenderer;

namespace penumbra
{

/// Returns a warning with the files of the actors of `renderer` instead of "Object N".
std::string NameObjects(const std::string& warning, vtkRenderer* renderer);

}
#endif
