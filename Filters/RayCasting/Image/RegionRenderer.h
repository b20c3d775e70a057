// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Renders a region of the image in stages, from few rays to the tolerance. A limit may end the work at
// any time; the stages that are left can be done later.
#ifndef penumbra_RegionRenderer_h
#define penumbra_RegionRenderer_h

#include "CoarseImage.h"
#include "ImageRegion.h"
#include "Light/LightField.h"
#include "RegionTiles.h"
#include "vtkPenumbraFiltersRayCastingModule.h" // for export macro, which tests need

#include <memory>
#include <vector>

namespace penumbra
{

class VTKPENUMBRAFILTERSRAYCASTING_EXPORT RegionRenderer
{
public:
  /// Prepares the pixels [low, high), which must lie in the image of the camera. All other arguments
  /// must outlive this object. Only with a limit, a coarse image is traced first.
  RegionRenderer(const CameraRayTracer& tracer, const SceneEdges& sceneEdges,
    const RenderSettings& settings, glm::ivec2 low, glm::ivec2 high);
  ~RegionRenderer();
  RegionRenderer(const RegionRenderer&) = delete;
  RegionRenderer& operator=(const RegionRenderer&) = delete;

  /// Renders until the region is complete or the limit is reached. The next call continues. Every pixel
  /// has a color after the first call. The colors of the complete region do not depend on the number of
  /// calls, unless the limit of the integration ended the work on a tile. Throws Stopped if `progress`
  /// requests a stop. Returns true if the region is complete.
  bool Run(const ProgressCallback& progress);

  /// Returns the region as far as it is known.
  ImageRegion CopyResult() const;

  /// The same without a copy, after which Run() must not be called.
  ImageRegion TakeResult();

private:
  /// Ends of the stages as fractions of the work.
  struct Schedule
  {
    double Corners, Sites, Tiles;
  };

  bool TraceCorners(const ProgressCallback& progress);
  bool ResolvePenumbrae(const ProgressCallback& progress);
  bool RenderTiles(const ProgressCallback& progress);
  void BeginTiles(const ProgressCallback& progress);
  template <typename Work>
  bool ForStrips(
    std::vector<char>& done, double from, const ProgressCallback& progress, const Work& work);
  bool HasCorners(int x, int y) const;
  void FillPixels();
  void FillPixel(int x, int y);
  void Complete(ImageRegion& region) const;

  const CameraRayTracer& Tracer;
  const SceneEdges& Edges;
  RenderSettings Settings;
  const bool UsesCorners;
  const RegionTiles::Rectangle PixelsOfCorners;
  const Schedule Ends;
  ImageRegion Region; ///< without the light of Field
  CornerGrid Grid;
  std::unique_ptr<CoarseImage> Coarse;
  std::unique_ptr<LightField> Field;
  std::unique_ptr<RegionTiles> Tiles;
  std::vector<char> Traced;    ///< flags of the strips of the grid
  std::vector<char> Resolved;  ///< the same for penumbrae
  std::vector<int> Unfinished; ///< number of pixels of each tile
  std::vector<int> Order;      ///< of the tiles
  bool AreCornersComplete = false;
};

}
#endif
