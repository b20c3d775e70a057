// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// The measurements of `penumbra chart`: families of methods that compute the same quantity, each at
// a series of settings, on scenes with a known reference. Times are CPU seconds of one thread.
#ifndef penumbra_ChartFamilies_h
#define penumbra_ChartFamilies_h

#include "Peers.h"

#include "vtkSmartPointer.h"

#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

class vtkPolyData;

namespace penumbra
{

struct Measurement
{
  double Error = 0.0;
  double Seconds = 0.0;
  double Count = 0.0;
};

struct ChartStep
{
  std::string Scene;
  std::string Method;
  std::string Setting;
  double Asked; ///< requested tolerance; 0: none
  std::function<Measurement()> Measure;
};

struct ChartFamily
{
  std::string Name;
  std::string Title;
  std::string ErrorTitle; ///< title of the error axis
  std::string CountTitle;
  std::string Truth; ///< description of the reference in one line
  std::vector<ChartStep> Steps;
  /// Methods that an overview shows, each with its label there; empty: no overview.
  std::vector<std::pair<std::string, std::string>> Overview = {};
};

struct ChartMesh
{
  std::string Name;
  vtkSmartPointer<vtkPolyData> Mesh;
};

struct ChartRequest
{
  std::vector<ChartMesh> Meshes; ///< empty: the built-in scenes
  std::vector<Peer> Peers;       ///< installed peer programs
  bool Quick = false;            ///< small images, few steps
};

ChartFamily AntialiasingFamily(const ChartRequest& request);
ChartFamily OcclusionFamily(const ChartRequest& request);
ChartFamily IrradianceFamily(const ChartRequest& request);
ChartFamily ShaftFamily(const ChartRequest& request);

/// CPU seconds of this process so far.
double CpuSeconds();

/// A value that is computed on first use.
template <typename Value>
std::function<Value&()> Lazily(std::function<std::shared_ptr<Value>()> make)
{
  auto kept = std::make_shared<std::shared_ptr<Value>>();
  return [kept, make]() -> Value& {
    if (!*kept)
    {
      *kept = make();
    }
    return **kept;
  };
}

}
#endif
