// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkPenumbraDistributedRayCaster
 * @brief   Ray caster for data distributed over ranks; each rank renders a part of the image.
 *
 * Each rank extracts the surfaces of its own data. The image is divided among the ranks: each renders
 * rectangles of which it has most primitives. It receives the triangles, spheres, tubes, lines, points and
 * instances of other ranks that camera rays of these rectangles may meet, with their colors, textures and
 * opacity. With hard shadows, it also receives what may be between them and the lights. With soft shadows,
 * ambient occlusion, indirect light or a medium, it receives all of them; one warning says how many bytes
 * these are. The first rank composes the image, and every rank gets its
 * update extent. Overlays and layers are those of the first rank.
 *
 * Surfaces of one input, or of one prop of the renderer, that look alike are one surface, without edges
 * where points of the pieces coincide. Colors, estimated errors and statistics have the same bits as those of
 * one rank with the pieces appended in the order of the ranks, except for CellId, which is that of the piece.
 * Every rank has the statistics of the whole image, and of its own exchange:
 * `Exchange/SceneBytes` (received), `Exchange/WholeBytes` (of all surfaces), `Exchange/Primitives` (after the
 * exchange), `Exchange/WholePrimitives`, `Exchange/PixelBytes` and `Exchange/Rays` (traced by the rank).
 * `Rays/Repeated` counts the rays that are traced twice at the borders of rectangles.
 *
 * Every rank must execute the filter, with the same settings, camera and lights. If they differ, or if one
 * rank fails, all ranks end with its message. If a rank never executes, the others wait, because controllers have
 * no time limit: give one to the job. On a single rank, the filter is equivalent to its superclass.
 */
#ifndef vtkPenumbraDistributedRayCaster_h
#define vtkPenumbraDistributedRayCaster_h

#include "vtkPenumbraFiltersParallelModule.h" // for export macro
#include "vtkPenumbraRayCaster.h"
#include "vtkSmartPointer.h" // for members

class vtkMultiProcessController;

class VTKPENUMBRAFILTERSPARALLEL_EXPORT vtkPenumbraDistributedRayCaster
  : public vtkPenumbraRayCaster
{
public:
  static vtkPenumbraDistributedRayCaster* New();
  vtkTypeMacro(vtkPenumbraDistributedRayCaster, vtkPenumbraRayCaster);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /** Controller of the ranks; null: this one alone. Default: the global controller. */
  virtual void SetController(vtkMultiProcessController* controller);
  vtkMultiProcessController* GetController();
  ///@}

protected:
  vtkPenumbraDistributedRayCaster();
  ~vtkPenumbraDistributedRayCaster() override = default;

  int RequestData(
    vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

private:
  vtkPenumbraDistributedRayCaster(const vtkPenumbraDistributedRayCaster&) = delete;
  void operator=(const vtkPenumbraDistributedRayCaster&) = delete;

  vtkSmartPointer<vtkMultiProcessController> Controller;
  bool HasWarned = false; ///< that all surfaces are gathered
};

#endif
