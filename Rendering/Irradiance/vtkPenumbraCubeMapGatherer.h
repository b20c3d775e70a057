// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkPenumbraCubeMapGatherer
 * @brief   Looks around by rasterising into half a cube, through OpenGL [IC].
 *
 * Give it to vtkPenumbraIrradianceCache::SetGatherer(). From every record five pictures are drawn: one
 * along the normal, four half ones to the sides, each only of what is not wholly out of its sight. Rays
 * stop at the first thing they meet, pictures do not: in large scenes that are mostly hidden rays are
 * faster, see Documentation/reference/vtkPenumbraCubeMapGatherer.md.
 *
 * A window that nobody sees is opened, in a thread of its own: by VTK_DEFAULT_OPENGL_WINDOW, OSMesa, EGL
 * or X. Without OpenGL the cache, and who asks it, end with an error.
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
  /** Texels along a cube's side, 8 to 1024, rounded down to an even number: 3 times its square are drawn for a record. Default: 64. */
  vtkSetClampMacro(Resolution, int, 8, 1024);
  vtkGetMacro(Resolution, int);
  ///@}

  VTK_WRAPEXCLUDE std::unique_ptr<penumbra::Gatherer> Make(
    const penumbra::RayGatherer& seen) override;

  /** `CubeMaps/Total`, and `CubeMaps/Triangles` drawn into all of their faces. */
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
