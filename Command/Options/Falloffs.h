// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Names of the distance falloffs of ambient occlusion.
#ifndef penumbra_Falloffs_h
#define penumbra_Falloffs_h

#include <algorithm>
#include <string>
#include <vector>

namespace penumbra
{

/// Falloff names in the order of vtkPenumbraIrradianceProvider::Falloffs.
inline const std::vector<std::string>& FalloffNames()
{
  static const std::vector<std::string> names = { "none", "linear", "quadratic", "square-root" };
  return names;
}

/// Returns the falloff of a name of FalloffNames().
inline int FindFalloff(const std::string& name)
{
  const std::vector<std::string>& names = FalloffNames();
  return static_cast<int>(std::find(names.begin(), names.end(), name) - names.begin());
}

}
#endif
