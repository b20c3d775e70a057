// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// A scene of points and lines that are rendered as spheres and tubes.
#ifndef penumbra_RoundScene_h
#define penumbra_RoundScene_h

#include "vtkActor.h"
#include "vtkCamera.h"
#include "vtkCellArray.h"
#include "vtkDataArray.h"
#include "vtkFieldData.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPenumbraRayCaster.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkPolyDataMapper.h"
#include "vtkProperty.h"
#include "vtkRenderer.h"
#include "vtkSmartPointer.h"

#include <glm/glm.hpp>

#include <vector>

namespace penumbra_testing
{

inline constexpr int Side = 256;

/// A camera at the origin that looks along -z, in the coordinates of the closed forms of the tests.
inline constexpr double ViewAngle = 40.0;

inline vtkSmartPointer<vtkPolyData> MakeCells(
  const std::vector<glm::dvec3>& points, const std::vector<std::vector<vtkIdType>>& lines)
{
  auto data = vtkSmartPointer<vtkPolyData>::New();
  vtkNew<vtkPoints> positions;
  positions->SetDataTypeToDouble();
  vtkNew<vtkCellArray> cells;
  for (const glm::dvec3& p : points)
  {
    const vtkIdType id = positions->InsertNextPoint(p.x, p.y, p.z);
    if (lines.empty())
    {
      cells->InsertNextCell(1, &id);
    }
  }
  for (const std::vector<vtkIdType>& line : lines)
  {
    cells->InsertNextCell(static_cast<vtkIdType>(line.size()), line.data());
  }
  data->SetPoints(positions);
  lines.empty() ? data->SetVerts(cells) : data->SetLines(cells);
  return data;
}

/// A white scene on black.
struct RoundScene
{
  vtkNew<vtkRenderer> Renderer;
  vtkNew<vtkPenumbraRayCaster> Caster;
  vtkActor* Actor = nullptr;

  explicit RoundScene(vtkPolyData* data, bool lit = false)
  {
    this->Actor = this->Add(data, lit);
    vtkCamera* camera = this->Renderer->GetActiveCamera();
    camera->SetPosition(0.0, 0.0, 0.0);
    camera->SetFocalPoint(0.0, 0.0, -1.0);
    camera->SetViewUp(0.0, 1.0, 0.0);
    camera->SetViewAngle(ViewAngle);
    camera->SetClippingRange(0.01, 1000.0);
    this->Caster->SetRenderer(this->Renderer);
    this->Caster->SetResolution(Side, Side);
  }

  vtkActor* Add(vtkPolyData* data, bool lit)
  {
    vtkNew<vtkPolyDataMapper> mapper;
    mapper->SetInputData(data);
    vtkNew<vtkActor> actor;
    actor->SetMapper(mapper);
    actor->GetProperty()->SetLighting(lit);
    this->Renderer->AddActor(actor);
    return actor;
  }

  std::vector<double> RenderRed()
  {
    this->Caster->Update();
    vtkDataArray* colors = this->Caster->GetOutput()->GetPointData()->GetArray("Color");
    std::vector<double> red;
    for (vtkIdType i = 0; i < colors->GetNumberOfTuples(); ++i)
    {
      red.push_back(colors->GetComponent(i, 0) * colors->GetComponent(i, 3));
    }
    return red;
  }

  double Statistic(const char* name)
  {
    return this->Caster->GetStatistics()->GetArray(name)->GetComponent(0, 0);
  }
};

inline const std::vector<glm::dvec3> FiveCenters = { { 0.0, 0.0, -6.0 }, { 1.1, 0.9, -5.0 },
  { -1.4, 1.2, -7.0 }, { -1.3, -1.2, -5.5 }, { 1.2, -1.0, -6.5 } };

}
#endif
