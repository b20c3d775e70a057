// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkSMPenumbraRenderViewProxy
 * @brief   Client-side proxy of vtkPenumbraRenderView that captures screenshots without tiles.
 *
 * ParaView renders screenshots larger than the view in tiles. Screen-space effects would show seams
 * between them. This proxy resizes the view to the size of the image while it is captured. Images
 * with a side larger than LargestSide pixels are still rendered in tiles.
 *
 * ParaView derives the class name from the XML element `PenumbraRenderViewProxy`.
 */
#ifndef vtkSMPenumbraRenderViewProxy_h
#define vtkSMPenumbraRenderViewProxy_h

#include "vtkPenumbraRenderingParaViewModule.h" // for export macro
#include "vtkSMRenderViewProxy.h"

class VTKPENUMBRARENDERINGPARAVIEW_EXPORT vtkSMPenumbraRenderViewProxy : public vtkSMRenderViewProxy
{
public:
  static vtkSMPenumbraRenderViewProxy* New();
  vtkTypeMacro(vtkSMPenumbraRenderViewProxy, vtkSMRenderViewProxy);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /** Maximum width and height of an image that is captured without tiles, in pixels. */
  static constexpr int LargestSide = 8192;

protected:
  vtkSMPenumbraRenderViewProxy() = default;
  ~vtkSMPenumbraRenderViewProxy() override = default;

  vtkImageData* CaptureWindowInternal(int magnificationX, int magnificationY) override;
  bool IsContextReadyForRendering() override;

private:
  vtkSMPenumbraRenderViewProxy(const vtkSMPenumbraRenderViewProxy&) = delete;
  void operator=(const vtkSMPenumbraRenderViewProxy&) = delete;

  bool Warned = false;
};

#endif
