// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// A sphere on a floor, whose ambient occlusion has a closed form, and access to what the filter
// baked.
#ifndef penumbra_SphereOnFloor_h
#define penumbra_SphereOnFloor_h

#include "vtkPenumbraIrradianceFilter.h"

#include "vtkAppendPolyData.h"
#include "vtkDataArray.h"
#include "vtkFieldData.h"
#include "vtkNew.h"
#include "vtkPlaneSource.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"
#include "vtkSphereSource.h"

#include <cmath>

namespace penumbra_testing
{

/// Returns a square with sides of 12 and normals.
inline vtkSmartPointer<vtkPlaneSource> MakeFloor(int side)
{
  auto floor = vtkSmartPointer<vtkPlaneSource>::New();
  floor->SetOrigin(-6.0, -6.0, 0.0);
  floor->SetPoint1(6.0, -6.0, 0.0);
  floor->SetPoint2(-6.0, 6.0, 0.0);
  floor->SetResolution(side, side);
  floor->Update();
  return floor;
}

/// Returns a unit sphere with normals that touches the floor.
inline vtkSmartPointer<vtkSphereSource> MakeSphere()
{
  auto sphere = vtkSmartPointer<vtkSphereSource>::New();
  sphere->SetRadius(1.0);
  sphere->SetCenter(0.0, 0.0, 1.0);
  sphere->SetThetaResolution(64);
  sphere->SetPhiResolution(64);
  sphere->Update();
  return sphere;
}

inline vtkSmartPointer<vtkPolyData> MakeSphereOnFloor(int side)
{
  vtkNew<vtkAppendPolyData> append;
  append->AddInputData(MakeFloor(side)->GetOutput());
  append->AddInputData(MakeSphere()->GetOutput());
  append->Update();
  return append->GetOutput();
}

/// Returns the RMSE over the points of the floor. The sphere occludes (1 + rho^2)^(-3/2).
inline double ComputeFloorRmse(vtkPointSet* baked)
{
  vtkDataArray* values = baked->GetPointData()->GetArray("AmbientOcclusion");
  double square = 0.0;
  vtkIdType count = 0;
  for (vtkIdType i = 0; i < baked->GetNumberOfPoints(); ++i)
  {
    double x[3];
    baked->GetPoint(i, x);
    if (x[2] == 0.0 && std::hypot(x[0], x[1]) > .1)
    {
      const double reference = std::pow(1.0 + x[0] * x[0] + x[1] * x[1], -1.5);
      square += std::pow(values->GetComponent(i, 0) - reference, 2.0);
      ++count;
    }
  }
  return std::sqrt(square / static_cast<double>(count));
}

inline double GetStatistic(vtkPenumbraIrradianceFilter* filter, const char* name)
{
  return filter->GetStatistics()->GetArray(name)->GetComponent(0, 0);
}

inline vtkPolyData* GetPolyData(vtkPenumbraIrradianceFilter* filter)
{
  return vtkPolyData::SafeDownCast(filter->GetOutput());
}

}
#endif
