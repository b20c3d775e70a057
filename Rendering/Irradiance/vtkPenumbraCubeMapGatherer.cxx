// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkPenumbraCubeMapGatherer.h"

#include "CubeMap/CubeMapGatherer.h"
#include "Statistics/Statistics.h"

#include "vtkObjectFactory.h"

vtkStandardNewMacro(vtkPenumbraCubeMapGatherer);

vtkPenumbraCubeMapGatherer::vtkPenumbraCubeMapGatherer() = default;
vtkPenumbraCubeMapGatherer::~vtkPenumbraCubeMapGatherer() = default;

std::unique_ptr<penumbra::Gatherer> vtkPenumbraCubeMapGatherer::Make(
  const penumbra::RayGatherer& rays)
{
  this->Counts = std::make_shared<penumbra::CubeMapCounts>();
  return std::make_unique<penumbra::CubeMapGatherer>(rays, this->Resolution / 2 * 2, this->Counts);
}

void vtkPenumbraCubeMapGatherer::Report(vtkFieldData* statistics) const
{
  const auto total = this->Counts ? this->Counts->CubeMaps.load() : 0;
  const auto triangles = this->Counts ? this->Counts->Triangles.load() : 0;
  penumbra::AddStatistic(statistics, "CubeMaps/Total", static_cast<double>(total));
  penumbra::AddStatistic(statistics, "CubeMaps/Triangles", static_cast<double>(triangles));
}

void vtkPenumbraCubeMapGatherer::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Resolution: " << this->Resolution << "\n";
}
