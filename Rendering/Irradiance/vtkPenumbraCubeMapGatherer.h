// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkPenumbraCubeMapGatherer
 * @brief   Gathers by rasterizing the scene into a hemicube with OpenGL [IC].
 *
 * Pass an instance to vtkPenumbraIrradianceCache::SetGatherer(). Each record renders the five faces
 * of a hemicube: one face along the normal and four half faces to the sides. Triangle clusters
 * outside of a face's frustum are culled. Rays are faster in large scenes with much hidden
 * geometry, because a ray stops at its first hit; see
 * Documentation/reference/vtkPenumbraCubeMapGatherer.md.
 *
 * The class creates an offscreen window in a separate thread, with VTK_DEFAULT_OPENGL_WINDOW,
 * OSMesa, EGL or X. If OpenGL is not available, the cache and the filter that uses it report an
 * error.
 */
#ifndef vtkPenumbraCubeMapGatherer_h
#define vtkPenumbraCubeMapGatherer_h

#include "vtkPenumbraGatherer.h"
#include "vtkPenumbraRenderingIrradianceModule.h" // for export macro

#include <memory>

namespace penumbra
{
struct CubeMapCounts;
}

class VTKPENUMBRARENDERINGIRRADIANCE_EXPORT vtkPenumbraCubeMapGatherer : public vtkPenumbraGatherer
{
public:
  static vtkPenumbraCubeMapGatherer* New();
  vtkTypeMacro(vtkPenumbraCubeMapGatherer, vtkPenumbraGatherer);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * Texels along one edge of the cube, rounded down to an even number. A record renders 3 *
   * Resolution^2 texels. Range: [8, 1024]. Default: 64.
   */
  vtkSetClampMacro(Resolution, int, 8, 1024);
  vtkGetMacro(Resolution, int);
  ///@}

  VTK_WRAPEXCLUDE std::unique_ptr<penumbra::Gatherer> Make(
    const penumbra::RayGatherer& rays) override;

  /**
   * Adds `CubeMaps/Total`, and `CubeMaps/Triangles`: the number of triangles rendered into all
   * faces.
   */
  void Report(vtkFieldData* statistics) const override;

protected:
  vtkPenumbraCubeMapGatherer();
  ~vtkPenumbraCubeMapGatherer() override;

private:
  vtkPenumbraCubeMapGatherer(const vtkPenumbraCubeMapGatherer&) = delete;
  void operator=(const vtkPenumbraCubeMapGatherer&) = delete;

  int Resolution = 64;
  std::shared_ptr<penumbra::CubeMapCounts> Counts;
};

#endif
