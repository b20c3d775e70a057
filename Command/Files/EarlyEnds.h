// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Does a file hold all the values that its headers announce? For formats whose readers in VTK take what
// there is.
#ifndef penumbra_EarlyEnds_h
#define penumbra_EarlyEnds_h

#include <string>

namespace penumbra
{

/// What the file at `path` ends before the last of, in the singular ("value"); empty where it is whole or
/// nothing can be told. Legacy .vtk, .pts, .nrrd, .nhdr, .tec, .tp, .inp, .slc, and text geometries of
/// EnSight. A text cut within its last number, or where another section could have begun, is whole.
std::string FindEarlyEnd(const std::string& path);

/// Does a .tif of this machine's byte order hold its directory and all strips?
bool IsWholeTiff(const std::string& path);

}
#endif
