// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "VisiblePoints.h"

#include "Camera.h"
#include "Scene.h"

#include "vtkCamera.h"
#include "vtkCellArray.h"
#include "vtkDataSet.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkRenderer.h"
#include "vtkSelectVisiblePoints.h"

#include <cmath>

namespace penumbra
{
namespace
{

/// Values of a depth buffer, from 0 at the near end of the clipping range to 1 at the far end.
class DepthBuffer
{
public:
  explicit DepthBuffer(vtkCamera* camera)
    : Parallel(camera->GetParallelProjection() != 0)
  {
    camera->GetClippingRange(this->Near, this->Far);
  }

  double FindValue(double depth) const
  {
    if (std::isinf(depth))
    {
      return 1.0; // nothing is drawn
    }
    const double fraction = (depth - this->Near) / (this->Far - this->Near);
    return this->Parallel ? fraction : fraction * this->Far / depth;
  }

private:
  bool Parallel;
  double Near = 0.0;
  double Far = 1.0;
};

}

vtkSmartPointer<vtkPolyData> SelectVisiblePoints(vtkSelectVisiblePoints* filter, vtkCamera* camera,
  const Scene& scene, const DepthQuery& findDepths)
{
  if (filter->GetNumberOfInputConnections(0) == 0)
  {
    return nullptr;
  }
  filter->GetInputAlgorithm()->Update();
  vtkDataSet* input = vtkDataSet::SafeDownCast(filter->GetInputDataObject(0, 0));
  if (!input)
  {
    return nullptr;
  }
  glm::dvec2 low(0.0);
  glm::dvec2 high(scene.ViewCamera.Width, scene.ViewCamera.Height);
  if (filter->GetSelectionWindow())
  {
    const int* window = filter->GetSelection();
    const int* origin = filter->GetRenderer() ? filter->GetRenderer()->GetOrigin() : nullptr;
    const glm::dvec2 shift = origin ? glm::dvec2(origin[0], origin[1]) : glm::dvec2(0.0);
    low = glm::max(low, glm::dvec2(window[0], window[2]) - shift);
    high = glm::min(high, glm::dvec2(window[1], window[3]) - shift + 1.0);
  }
  const glm::dvec3 toEye = -filter->GetToleranceWorld() * scene.ViewCamera.Forward;
  std::vector<glm::dvec2> pixels;
  std::vector<double> depths;
  std::vector<vtkIdType> ids;
  for (vtkIdType i = 0; i < input->GetNumberOfPoints(); ++i)
  {
    double x[3];
    input->GetPoint(i, x);
    const glm::dvec3 point = scene.FromWorld(x) + scene.Scale * toEye;
    const double depth = scene.ViewCamera.Depth(point);
    const glm::dvec2 pixel = glm::floor(scene.ViewCamera.Project(point));
    if ((scene.ViewCamera.Parallel || depth > 0.0) && pixel.x >= low.x && pixel.y >= low.y &&
      pixel.x < high.x && pixel.y < high.y)
    {
      pixels.push_back(pixel + 0.5);
      depths.push_back(depth / scene.Scale);
      ids.push_back(i);
    }
  }
  const std::vector<double> surfaces =
    findDepths ? findDepths(scene, pixels) : std::vector<double>(pixels.size(), INFINITY);
  const DepthBuffer buffer(camera);
  std::vector<bool> visible(static_cast<std::size_t>(input->GetNumberOfPoints()), false);
  for (std::size_t i = 0; i < ids.size(); ++i)
  {
    visible[static_cast<std::size_t>(ids[i])] = buffer.FindValue(depths[i]) <
      buffer.FindValue(surfaces[i] / scene.Scale) + filter->GetTolerance();
  }
  auto output = vtkSmartPointer<vtkPolyData>::New();
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> vertices;
  output->SetPoints(points);
  output->SetVerts(vertices);
  output->GetPointData()->CopyAllocate(input->GetPointData());
  for (vtkIdType i = 0; i < input->GetNumberOfPoints(); ++i)
  {
    if (visible[static_cast<std::size_t>(i)] != (filter->GetSelectInvisible() != 0))
    {
      const vtkIdType id = points->InsertNextPoint(input->GetPoint(i));
      vertices->InsertNextCell(1, &id);
      output->GetPointData()->CopyData(input->GetPointData(), i, id);
    }
  }
  return output;
}

}
