// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// The header of an NRRD file: which axes are spatial, and where the samples are.
#ifndef penumbra_NrrdHeader_h
#define penumbra_NrrdHeader_h

#include <string>

namespace penumbra
{

struct NrrdHeader
{
  /// False: the header does not tell the axes of space from those of components.
  bool IsKnown = false;
  int Sizes[3] = { 1, 1, 1 }; ///< of the spatial axes
  int Components = 1;         ///< product of the axes before the spatial ones
  double Origin[3] = { 0.0, 0.0, 0.0 };
  double Steps[3][3] = { { 1.0, 0.0, 0.0 }, { 0.0, 1.0, 0.0 }, { 0.0, 0.0, 1.0 } };
};

NrrdHeader ReadNrrdHeader(const std::string& path);

}
#endif
