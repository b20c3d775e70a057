// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "BakedArrays.h"

#include "Execution/RankAgreement.h"
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

std::array<double, 3> CountMethods(const BakeInput& mesh, const BakedValues& baked, vtkIdType size)
{
  std::array<double, 3> counts{};
  std::vector<unsigned char> methods(static_cast<std::size_t>(size), 0); // plus 1
  for (std::size_t i = 0; i < baked.Methods.size(); ++i)
  {
    unsigned char& method = methods[static_cast<std::size_t>(mesh.Ids[i])];
    method = std::max(method, static_cast<unsigned char>(1 + static_cast<int>(baked.Methods[i])));
  }
  for (const unsigned char method : methods)
  {
    if (method > 0)
    {
      counts[method - 1] += 1.0;
    }
  }
  return counts;
}

namespace
{

/// Returns true, on the first rank, if a condition holds for nearly all values of all ranks.
template <typename Condition>
bool HoldsForMost(const BakedValues& baked, RankAgreement* ranks, const Condition& condition)
{
  const auto count = std::count_if(baked.Values.begin(), baked.Values.end(), condition);
  std::vector<double> counts = { static_cast<double>(count),
    static_cast<double>(baked.Values.size()) };
  if (ranks)
  {
    ranks->Sum(counts);
  }
  return (!ranks || ranks->IsFirst()) && counts[0] > 0.0 &&
    counts[0] >= MinimumOccludedFraction * counts[1];
}

}

std::string DescribeOccluded(const BakedValues& baked, RankAgreement* ranks)
{
  const auto isOccluded = [](const BakedValue& value) { return value.Mean.x >= OccludedThreshold; };
  return HoldsForMost(baked, ranks, isOccluded)
    ? "All points are occluded. Polygons and normals may face inward: reverse them, "
      "for example with vtkReverseSense, or with flip_faces() in PyVista."
    : "";
}

std::string DescribeBlack(const BakedValues& baked, RankAgreement* ranks)
{
  const auto isBlack = [](const BakedValue& value) { return value.Mean == glm::vec3(0.f); };
  return HoldsForMost(baked, ranks, isBlack)
    ? "No light of the environment reaches the points: the irradiance is 0. Set "
      "EnvironmentColor or Environment if it is black, reverse polygons and normals that "
      "face inward, for example with vtkReverseSense, or open closed surfaces."
    : "";
}

}
