// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "Benchmark.h"
#include "Meshes.h"

#include "vtkPolyData.h"

namespace penumbra
{

OcclusionTestScene Scans(const std::string& folder)
{
  const auto read = [&](const char* name) { return ReadOff(folder + "/" + name); };
  return Scans(read("ChineseDragon-10kv.off"), read("armadillo.off"), read("refined_elephant.off"));
}

}
