// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "PovRay.h"

#include "vtkCamera.h"
#include "vtkDataArray.h"
#include "vtkImageData.h"
#include "vtkMath.h"
#include "vtkNew.h"
#include "vtkPNGReader.h"
#include "vtkPointData.h"
#include "vtkRenderer.h"

#include <sys/resource.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iomanip>
#include <sstream>
#include <stdexcept>

namespace penumbra
{
namespace
{

std::string Vector(glm::dvec3 v)
{
  std::ostringstream text;
  text << std::setprecision(12) << '<' << v.x << ',' << v.y << ',' << v.z << '>';
  return text.str();
}

double ChildSeconds()
{
  rusage usage;
  getrusage(RUSAGE_CHILDREN, &usage);
  return usage.ru_utime.tv_sec + usage.ru_stime.tv_sec +
    1e-6 * (usage.ru_utime.tv_usec + usage.ru_stime.tv_usec);
}

/// Returns the number after `label`, searching from the first occurrence of `section`.
double NumberAfter(const std::string& text, const std::string& section, const std::string& label)
{
  std::size_t at = text.find(section);
  at = at == std::string::npos ? at : text.find(label, at);
  return at == std::string::npos ? 0.0 : std::atof(text.c_str() + at + label.size());
}

}

void WritePovRayScene(const std::string& path, vtkRenderer* renderer, const BruteForceScene& scene,
  int width, int height)
{
  vtkCamera* camera = renderer->GetActiveCamera();
  double upVTK[3];
  camera->GetViewUp(upVTK);
  const glm::dvec3 forward = scene.LightTravel;
  const glm::dvec3 right =
    glm::normalize(glm::cross(forward, glm::dvec3(upVTK[0], upVTK[1], upVTK[2])));
  const glm::dvec3 up = glm::cross(right, forward);
  const double side = 2.0 * std::tan(0.5 * vtkMath::RadiansFromDegrees(camera->GetViewAngle()));

  std::ofstream file(path);
  file << "#version 3.7;\nglobal_settings { assumed_gamma 1.0 }\nbackground { rgb "
       << Vector(scene.Background) << " }\ncamera { perspective location " << Vector(scene.Eye)
       << " right " << Vector(right * (side * width / height)) << " up " << Vector(up * side)
       << " direction " << Vector(forward) << " }\nlight_source { " << Vector(scene.Eye)
       << " rgb 1 parallel point_at " << Vector(scene.Eye + forward * camera->GetDistance())
       << " shadowless }\nmesh2 {\nvertex_vectors { " << scene.Positions.size();
  for (const glm::dvec3& position : scene.Positions)
  {
    file << ",\n" << Vector(position);
  }
  if (!scene.Normals.empty())
  {
    file << " }\nnormal_vectors { " << scene.Normals.size();
    for (const glm::dvec3& normal : scene.Normals)
    {
      file << ",\n" << Vector(normal);
    }
  }
  file << " }\nface_indices { " << scene.Triangles.size();
  for (const glm::uvec3& triangle : scene.Triangles)
  {
    file << ",\n<" << triangle.x << ',' << triangle.y << ',' << triangle.z << '>';
  }
  file << " }\npigment { rgb " << Vector(scene.Color) << " } finish { ambient 0 diffuse 1 }\n}\n";
}

const std::vector<PovRayStep>& PovRayLadder()
{
  static const std::vector<PovRayStep> ladder = { { 0.3, 2 }, { 0.1, 3 }, { 0.1, 4 }, { 0.03, 4 },
    { 0.03, 5 }, { 0.01, 5 }, { 0.01, 6 }, { 0.003, 6 } };
  return ladder;
}

PovRayAnswer RunPovRay(const std::string& program, const std::string& scene, int width, int height,
  const PovRayStep& step)
{
  const std::string image = scene + ".png";
  const std::string log = scene + ".log";
  std::ostringstream command;
  command << "'" << program << "' '+I" << scene << "' '+O" << image << "' +W" << width << " +H"
          << height << " +FN16 File_Gamma=1.0 ";
  if (step.Depth > 0)
  {
    command << "+AM2 +A" << step.Threshold << " +R" << step.Depth << " -J";
  }
  else
  {
    command << "-A";
  }
  command << " -D -V +WT1 >'" << log << "' 2>&1";
  PovRayAnswer answer;
  const double before = ChildSeconds();
  if (std::system(command.str().c_str()) != 0)
  {
    throw std::runtime_error("POV-Ray failed; see " + log);
  }
  answer.ProcessSeconds = ChildSeconds() - before;

  std::ifstream file(log);
  std::stringstream text;
  text << file.rdbuf();
  answer.TraceSeconds = NumberAfter(text.str(), "Trace Time:", "thread(s) with ");
  answer.RaysPerPixel =
    NumberAfter(text.str(), "Render Statistics", "Rays:") / (double(width) * height);

  vtkNew<vtkPNGReader> reader;
  reader->SetFileName(image.c_str());
  reader->Update();
  vtkDataArray* colors = reader->GetOutput()->GetPointData()->GetScalars();
  if (!colors || colors->GetNumberOfTuples() != static_cast<vtkIdType>(width) * height)
  {
    throw std::runtime_error("POV-Ray did not write the image " + image);
  }
  const double scale = 1.0 / colors->GetDataTypeMax();
  for (vtkIdType i = 0; i < colors->GetNumberOfTuples(); ++i)
  {
    answer.Colors.push_back(scale *
      glm::dvec3(
        colors->GetComponent(i, 0), colors->GetComponent(i, 1), colors->GetComponent(i, 2)));
  }
  return answer;
}

}
