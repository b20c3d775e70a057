// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkPenumbraOcclusionEstimator.h"

#include <map>
#include <string>

namespace
{

std::map<std::string, vtkPenumbraOcclusionEstimator::Maker>& Makers()
{
  static std::map<std::string, vtkPenumbraOcclusionEstimator::Maker> makers;
  return makers;
}

}

void vtkPenumbraOcclusionEstimator::Register(const char* name, Maker maker)
{
  Makers()[name] = maker;
}

bool vtkPenumbraOcclusionEstimator::IsRegistered(const char* name)
{
  return name && Makers().count(name) > 0;
}

vtkPenumbraOcclusionEstimator* vtkPenumbraOcclusionEstimator::New(const char* name)
{
  return IsRegistered(name) ? Makers()[name]() : nullptr;
}
