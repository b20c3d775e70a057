// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "Frames.h"

#include "Scenes/TestScene.h"

#include "vtkAlgorithm.h"
#include "vtkNew.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkRenderWindow.h"
#include "vtkRenderer.h"
#include "vtkUnsignedCharArray.h"

#include <cmath>

namespace penumbra
{

Frame ByRays(vtkRenderer* renderer, int width, int height, const Choice& choose)
{
  Frame frame{ width, height, {} };
  for (const glm::dvec3& color : Cast(renderer, width, height, choose).Colors)
  {
    frame.Values.push_back(color.y);
  }
  return frame;
}

Frame ByOpenGL(vtkRenderer* renderer, int width, int height, int samples)
{
  vtkNew<vtkRenderWindow> window;
  window->SetOffScreenRendering(1);
  window->SetMultiSamples(samples);
  window->SetSize(width, height);
  window->AddRenderer(renderer);
  window->Render();
  vtkNew<vtkUnsignedCharArray> bytes;
  window->GetPixelData(0, 0, width - 1, height - 1, 0, bytes);
  window->RemoveRenderer(renderer);
  Frame frame{ width, height, {} };
  for (vtkIdType i = 0; i < bytes->GetNumberOfTuples(); ++i)
  {
    frame.Values.push_back(bytes->GetTypedComponent(i, 1) / 255.0);
  }
  return frame;
}

vtkSmartPointer<vtkPolyData> DataOf(vtkAlgorithm* source)
{
  source->Update();
  return vtkPolyData::SafeDownCast(source->GetOutputDataObject(0));
}

vtkSmartPointer<vtkPolyData> Deformed(
  vtkPolyData* mesh, const std::function<glm::dvec3(glm::dvec3)>& transform)
{
  auto result = vtkSmartPointer<vtkPolyData>::New();
  result->DeepCopy(mesh);
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (vtkIdType i = 0; i < mesh->GetNumberOfPoints(); ++i)
  {
    double x[3];
    mesh->GetPoint(i, x);
    const glm::dvec3 transformed = transform({ x[0], x[1], x[2] });
    points->InsertNextPoint(transformed.x, transformed.y, transformed.z);
  }
  result->SetPoints(points);
  return result;
}

Frame Amplified(const Frame& frame, double gain)
{
  Frame result = frame;
  for (double& value : result.Values)
  {
    value = std::abs(value) * gain;
  }
  return result;
}

}
