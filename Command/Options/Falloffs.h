// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Names of how occluders count less with their distance.
#ifndef penumbra_Falloffs_h
#define penumbra_Falloffs_h

#include <algorithm>
#include <string>
#include <vector>

namespace penumbra
{

/// In the order of vtkPenumbraIrradianceProvider::Falloffs.
inline const std::vector<std::string>& FalloffNames()
{
  static const std::vector<std::string> names = { "none", "linear", "quadratic", "square-root" };
  return names;
}

inline int FalloffOf(const std::string& name)
{
  const std::vector<std::string>& names = FalloffNames();
  return static_cast<int>(std::find(names.begin(), names.end(), name) - names.begin());
}

}
#endif
