// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkSMPenumbraRenderViewProxy
 * @brief   The client's side of vtkPenumbraRenderView: draws pictures larger than the view in one.
 *
 * ParaView draws a screenshot that is larger than the view in tiles, each of which sees no more than
 * itself: occlusion and light shafts would show seams. So the view is made as large as the picture while
 * that is taken; only where that is beyond LargestSide pixels tiles remain.
 *
 * The name is the one that ParaView looks for by the XML element `PenumbraRenderViewProxy`.
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

  /** Of a picture that is drawn in one, in pixels. */
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
