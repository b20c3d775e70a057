// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Detection of truncated files, for formats whose VTK readers accept them.
#ifndef penumbra_Truncation_h
#define penumbra_Truncation_h

#include <string>

namespace penumbra
{

/// Returns the kind of item that is missing at the end of the file at `path`, in the singular
/// ("value"). Empty if the file is complete or of unknown structure. Checks legacy .vtk,
/// .nrrd, .nhdr, .tec, .tp, .inp, .slc, and text geometries of EnSight. A text file that is cut
/// within its last number or between sections counts as complete.
std::string FindTruncation(const std::string& path);

}
#endif
