// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// The parts of the light benchmark. Each adds its results to the table.
#ifndef penumbra_light_Benchmark_h
#define penumbra_light_Benchmark_h

#include "ResultTable.h"

#include "vtkPenumbraIrradianceProvider.h"
#include "vtkSmartPointer.h"

#include <ctime>
#include <string>

namespace penumbra
{

struct LightBenchmark
{
  std::string Data;             ///< folder with head.ply
  std::string Output;           ///< folder for results
  std::string PovRay;           ///< program; empty: no comparison with it
  std::string Width;            ///< of the images of the part "occlusion", in pixels; empty: 500
  std::string Mesh;             ///< part of the names of its meshes; empty: all
  std::string InverseTolerance; ///< of its images; empty: 256
  std::string Provider;         ///< of images: see MakeProvider()
  ResultTable Results;

  /// Tolerance of light relative to that of the image, see vtkPenumbraRayCaster::SetLightTolerance().
  static constexpr double LightFactor = 2.56;
};

/// Irradiance of the cache under skies of one color and under environment maps, one with a sun, in scenes
/// with colored walls, and images of these.
void MeasureSkies(LightBenchmark& benchmark);

/// Baked irradiance under the same skies, and under dark and bright ones.
void MeasureBakedSkies(LightBenchmark& benchmark);

/// A panel of 2 and of 2,000 triangles, and an emitter of 1e-4 of a wall, in a room.
void MeasureEmitters(LightBenchmark& benchmark);

/// Images of a room of 512 x 512 pixels: largest errors of tiles.
void MeasureBox(LightBenchmark& benchmark);

/// Penumbrae behind a half-plane and a disk against closed forms.
void MeasurePenumbrae(LightBenchmark& benchmark);

/// Time of the same penumbrae relative to that of POV-Ray's area light at equal error.
void ComparePenumbrae(LightBenchmark& benchmark);

/// Time of ambient occlusion of two gyroids relative to that of F3D, see Benchmarks/Peers.
void CompareWithF3D(LightBenchmark& benchmark);

/// Occlusion of a floor by translucent panes, by rays, cache, baking and the traced estimator.
void MeasurePanes(LightBenchmark& benchmark);

/// Ambient occlusion of meshes at the default settings: accuracy and cost of images.
void MeasureOcclusion(LightBenchmark& benchmark);
void MeasureIndirect(LightBenchmark& benchmark);

/// Returns the provider "automatic", which chooses between records and joined pixels, "joined", "cache" or
/// "brute-force". "": that of the program, "automatic" for indirect light (`isLight`), otherwise "joined".
vtkSmartPointer<vtkPenumbraIrradianceProvider> MakeProvider(const std::string& name, bool isLight);

/// CPU seconds of this process.
inline double Seconds()
{
  return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

/// Formats a number for a remark.
std::string Brief(double value);

}
#endif
