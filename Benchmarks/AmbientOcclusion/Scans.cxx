// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "Benchmark.h"
#include "Meshes.h"

#include "vtkNew.h"
#include "vtkPolyData.h"
#include "vtkTransform.h"

#include <algorithm>

namespace penumbra
{

namespace
{

/// With its largest extent as given, centred at x, y, standing on z = 0.
vtkSmartPointer<vtkPolyData> Placed(
  vtkPolyData* mesh, bool yIsUp, double extent, double x, double y)
{
  vtkNew<vtkTransform> upright;
  if (yIsUp)
  {
    upright->RotateX(90.0); // (x, y, z) -> (x, -z, y)
  }
  vtkSmartPointer<vtkPolyData> standing = Moved(mesh, upright);
  double bounds[6];
  standing->GetBounds(bounds);
  const double scale =
    extent / std::max({ bounds[1] - bounds[0], bounds[3] - bounds[2], bounds[5] - bounds[4] });
  vtkNew<vtkTransform> placed;
  placed->Translate(x, y, 0.0);
  placed->Scale(scale, scale, scale);
  placed->Translate(-(bounds[0] + bounds[1]) / 2.0, -(bounds[2] + bounds[3]) / 2.0, -bounds[4]);
  return Moved(standing, placed);
}

}

SceneUnderOcclusion Scans(const std::string& folder)
{
  SceneUnderOcclusion scene{ "Scans", vtkSmartPointer<vtkRenderer>::New(), .25 };
  const auto read = [&](const char* name) { return ReadOff(folder + "/" + name); };
  Show(scene.Renderer, Placed(read("ChineseDragon-10kv.off"), false, 2.2, .2, 0.0));
  Show(scene.Renderer, Placed(read("armadillo.off"), true, 1.6, -1.2, .6));
  Show(scene.Renderer, Placed(read("refined_elephant.off"), true, 1.3, 1.3, -.6));
  ShowPlane(scene.Renderer, -3.0, 3.0, 0.0);
  const double eye[3] = { .5, -4.2, 2.2 };
  const double target[3] = { 0.0, 0.0, .5 };
  Look(scene.Renderer, eye, target, 35.0);
  return scene;
}

}
