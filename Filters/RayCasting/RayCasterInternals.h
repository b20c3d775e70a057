// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// State and execution of vtkPenumbraRayCaster: from the renderer or the data sets to the image.
#ifndef penumbra_RayCasterInternals_h
#define penumbra_RayCasterInternals_h

#include "vtkPenumbraRayCaster.h"

#include "Distribution/SceneDistribution.h"
#include "Execution/WorkLimit.h"
#include "Image/ImageRenderer.h"
#include "Import/SceneExtraction.h"
#include "LightSizes.h"
#include "PhaseTimer.h"
#include "Scene.h"
#include "Surface.h"

#include "vtkFieldData.h"
#include "vtkNew.h"
#include "vtkPenumbraBruteForceIrradiance.h"
#include "vtkPenumbraEnvironment.h"
#include "vtkPenumbraMedium.h"
#include "vtkPenumbraRayCasterConstants.h"
#include "vtkRenderer.h"
#include "vtkWeakPointer.h"

#include <chrono>
#include <cmath>
#include <functional>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace penumbra
{
class RenderJob;
struct JobSettings;
struct ToleranceReport;
}

struct vtkPenumbraRayCaster::Internals
{
  Internals();
  ~Internals();

  /// Maximum width and height of the image, in pixels.
  static constexpr int MaximumResolution = 65535;
  /// Default of LightTolerance as a multiple of Tolerance: 0.01 at 1/256.
  static constexpr double LightToleranceFactor = 2.56;
  /// An extracted scene with its ray tracing structures.
  struct PreparedScene
  {
    penumbra::Scene SceneData;
    penumbra::SceneRecord Record; ///< of the renderer, if the scene is kept
    std::unique_ptr<penumbra::RayScene> Rays;
    penumbra::SceneEdges Edges;
    /// Edges belong to the former camera and to the former surfaces of these changes.
    bool AreEdgesCurrent = true;
    std::vector<penumbra::SurfaceChange> ChangesSinceEdges;
  };

  struct GrowingState;

  /// Ambient occlusion that multiplies the colors.
  struct OcclusionSettings
  {
    bool On = false;
    double Radius = 0.0;     ///< world units; 0: from the bounds
    double Strength = -1.0;  ///< negative: depends on the surface
    bool OfRenderer = false; ///< replaces the screen-space ambient occlusion of the renderer
  };

  penumbra::RayCasterConstants Constants;
  vtkSmartPointer<vtkRenderer> Renderer;
  std::optional<bool> Shadows;          ///< if not set, as Renderer
  std::optional<bool> AmbientOcclusion; ///< if not set, as Renderer
  vtkSmartPointer<vtkPenumbraIrradianceProvider> IrradianceProvider =
    vtkSmartPointer<vtkPenumbraBruteForceIrradiance>::New();
  vtkSmartPointer<vtkPenumbraMedium> Medium;
  vtkSmartPointer<vtkPenumbraEnvironment> Environment;
  penumbra::LightSizes SizedLights;
  vtkNew<vtkFieldData> Statistics;
  std::optional<double> TotalRays; ///< of the last image; nothing: there is none
  double EstimatedError = std::nan("");
  double EstimatedLightError = std::nan("");
  double TileTolerance = 0.0;              ///< accepted error of a tile of the current image
  std::unique_ptr<PreparedScene> Prepared; ///< kept while an update requests only part of the image
  vtkMTimeType PreparedTime = 0;
  vtkWeakPointer<vtkRenderer> PreparedRenderer; ///< renderer of Prepared; null: data sets
  vtkMTimeType SettingsTime = 0;                ///< of the ray caster's own settings, for Prepared
  std::vector<double> DepthOffsets;             ///< of the mappers of the renderer
  penumbra::PhaseTimes PhaseSeconds{};
  int Extractions = 0;          ///< number of scenes extracted by the last execution
  int ChangedSurfaces = 0;      ///< number of surfaces of a kept scene that it extracted again
  std::set<std::string> Warned; ///< warnings of the scene that were reported
  bool IsComputingMTime = false;
  /// If set, called with the extracted scene before its edges and its BVH are built.
  std::function<void(penumbra::Scene&)> ChangeScene;
  /// If set, called with the tracer of the image when the image is complete.
  std::function<void(const penumbra::CameraRayTracer&, const penumbra::SceneEdges&)> InspectImage;

  /// The other ranks, while an image is rendered together with them; null: there are none.
  penumbra::SceneDistribution* Distribution = nullptr;
  std::shared_ptr<penumbra::Overlay> DistributedOverlay; ///< of this rank; or null

  std::chrono::steady_clock::time_point Start; ///< of the last execution
  double CallSeconds = 0.0;                    ///< time that RenderFor() may take
  std::unique_ptr<GrowingState> Growing;       ///< refers to Prepared; null: none

  OcclusionSettings FindOcclusion(vtkPenumbraRayCaster* self) const;
  void ResetResults();
  /// Marks the ray caster as modified by a setting that a kept scene does not depend on.
  void ModifyButKeepScene(vtkPenumbraRayCaster* self);
  /// Prepares the scene of the renderer or, without one, of `data`.
  void Prepare(vtkPenumbraRayCaster* self, const std::vector<vtkDataObject*>& data);
  void DropScene();
  /// Checks the settings and runs `work`, which returns false if it was stopped. Without an image,
  /// `image` is empty. Returns false, with an error, if the image cannot be rendered.
  bool Run(vtkPenumbraRayCaster* self, vtkImageData* image, const std::function<bool()>& work);
  /// Modification time of the scene and of the objects that the image depends on, without the
  /// settings of the ray caster.
  vtkMTimeType ComputeSceneTime(vtkPenumbraRayCaster* self);
  bool KeepsScene(vtkPenumbraRayCaster* self) const;
  bool UpdatePrepared(vtkPenumbraRayCaster* self, const penumbra::ExtractionOptions& options);
  /// Finds the edges that depend on the camera, unless they are current.
  void UpdateEdges(vtkPenumbraRayCaster* self, const penumbra::ProgressCallback& progress);
  penumbra::ExtractionOptions MakeExtractionOptions(vtkPenumbraRayCaster* self);
  void WarnOfScene(vtkPenumbraRayCaster* self, penumbra::Scene& scene);
  /// Emits a warning, unless it is empty or was emitted before.
  void WarnOnce(vtkPenumbraRayCaster* self, const std::string& warning);
  /// Reports progress unless an abort was requested. Returns true if the execution must stop.
  static bool ReportProgress(vtkPenumbraRayCaster* self, double fraction);
  static std::function<bool(double)> MakeProgress(
    vtkPenumbraRayCaster* self, const penumbra::RenderJob& job);
  bool Execute(vtkPenumbraRayCaster* self, vtkImageData* image);
  /// The same together with the other ranks.
  bool ExecuteDistributed(vtkPenumbraRayCaster* self, vtkImageData* image);
  bool RenderRegions(vtkPenumbraRayCaster* self, penumbra::RenderJob& job,
    std::vector<vtkSmartPointer<vtkImageData>>& parts, penumbra::ImageTotals& totals);
  /// Replaces the surfaces of the prepared scene by those of all ranks that this one needs.
  void ExchangeScene(vtkPenumbraRayCaster* self, penumbra::Scene& scene);
  /// Returns what all ranks must agree on.
  static penumbra::SettingList ListSettings(vtkPenumbraRayCaster* self);
  /// Continues the image of RenderFor(). Returns true if it is complete.
  bool Continue(vtkPenumbraRayCaster* self, vtkImageData* image);
  void BeginGrowing(vtkPenumbraRayCaster* self);
  /// Returns null if an abort was requested.
  std::unique_ptr<penumbra::RenderJob> BeginJob(vtkPenumbraRayCaster* self);
  /// Adds what rays of their own find in an image. Returns false if an abort was requested.
  bool FinishPixels(vtkPenumbraRayCaster* self, penumbra::RenderJob& job,
    penumbra::ImageTotals& totals, vtkImageData* image);
  /// Adds what follows the rendering of an image.
  void FinishImage(vtkPenumbraRayCaster* self, penumbra::RenderJob& job,
    const penumbra::ImageTotals& totals, vtkImageData* image);
  /// Return the number of rays, or nothing if there is no layer.
  std::optional<double> AddLayers(vtkPenumbraRayCaster* self, vtkImageData* image);
  std::optional<double> AddLayer(
    vtkPenumbraRayCaster* self, vtkRenderer* layer, bool isAbove, vtkImageData* image);
  double ComputeElapsedSeconds() const;
  /// Returns the time limit of the rest of the execution, or null if there is none.
  std::unique_ptr<penumbra::WorkLimit> MakeLimit(vtkPenumbraRayCaster* self) const;
  /// Runs FinishPixels() and FinishImage().
  bool FinishExecution(vtkPenumbraRayCaster* self, penumbra::RenderJob& job,
    penumbra::ImageTotals& totals, vtkImageData* image);
  void Report(const penumbra::ImageTotals& totals, vtkIdType pixels);
  void ReportLimit(
    const penumbra::ImageTotals& totals, const penumbra::ToleranceReport& tolerances, bool isEnded);
  /// Adds the statistics, the tolerances and the estimated errors to the field data of the image.
  void AddFieldData(vtkPenumbraRayCaster* self, vtkImageData* image);
  penumbra::JobSettings MakeJobSettings(vtkPenumbraRayCaster* self) const;
};

#endif
