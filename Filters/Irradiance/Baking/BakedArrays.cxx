// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "BakedArrays.h"

#include "Gathering/IrradianceConstants.h"

#include <algorithm>
#include <vector>

namespace penumbra
{

vtkSmartPointer<vtkFloatArray> CreateArray(const BakeInput& mesh, const BakedValues& baked,
  vtkIdType size, const char* name, int components, float scale)
{
  auto array = vtkSmartPointer<vtkFloatArray>::New();
  array->SetName(name);
  array->SetNumberOfComponents(components);
  array->SetNumberOfTuples(size);
  array->Fill(0.0);
  std::vector<float> sums(static_cast<std::size_t>(size), 0.f); // of the weights
  for (std::size_t i = 0; i < mesh.Ids.size(); ++i)
  {
    const vtkIdType id = mesh.Ids[i];
    const float weight = mesh.Weights.empty() ? 1.f : mesh.Weights[i];
    if (weight <= 0.f)
    {
      continue;
    }
    float& sum = sums[static_cast<std::size_t>(id)];
    sum += weight;
    for (int c = 0; c < components; ++c)
    {
      const float before = array->GetTypedComponent(id, c);
      const float value = scale * baked.Values[i].Mean[c];
      array->SetTypedComponent(id, c, before + weight / sum * (value - before));
    }
  }
  return array;
}

namespace
{

/// Returns true if a condition holds for nearly all values.
template <typename Condition>
bool HoldsForMost(const BakedValues& baked, const Condition& condition)
{
  const auto count = std::count_if(baked.Values.begin(), baked.Values.end(), condition);
  return count > 0 &&
    static_cast<double>(count) >=
    MinimumOccludedFraction * static_cast<double>(baked.Values.size());
}

}

bool IsBlocked(const BakedValues& baked)
{
  return HoldsForMost(
    baked, [](const BakedValue& value) { return value.Mean.x >= OccludedThreshold; });
}

bool IsBlack(const BakedValues& baked)
{
  return HoldsForMost(baked, [](const BakedValue& value) { return value.Mean == glm::vec3(0.f); });
}

}
