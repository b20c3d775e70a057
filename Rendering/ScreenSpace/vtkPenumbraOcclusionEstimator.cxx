// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkPenumbraOcclusionEstimator.h"

#include <map>
#include <string>

namespace
{

std::map<std::string, vtkPenumbraOcclusionEstimator::Factory>& Factories()
{
  static std::map<std::string, vtkPenumbraOcclusionEstimator::Factory> factories;
  return factories;
}

}

void vtkPenumbraOcclusionEstimator::Register(const char* name, Factory factory)
{
  Factories()[name] = factory;
}

bool vtkPenumbraOcclusionEstimator::IsRegistered(const char* name)
{
  return name && Factories().count(name) > 0;
}

vtkPenumbraOcclusionEstimator* vtkPenumbraOcclusionEstimator::New(const char* name)
{
  return IsRegistered(name) ? Factories()[name]() : nullptr;
}
