// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Makes 2-D props render into an overlay instead of a window. VTK's props render their parts with
// vtkPolyDataMapper2D and vtkTexture; text is a textured rectangle. While a recorder exists, the
// props that its thread creates have parts that draw into the overlay and need no graphics context.
#ifndef penumbra_OverlayRecorder_h
#define penumbra_OverlayRecorder_h

#include "OverlayPainter.h"
#include "SizeOnlyWindow.h"

#include "vtkNew.h"
#include "vtkSmartPointer.h"

#include <functional>

class vtkActor2D;
class vtkImageMapper;
class vtkMapper2D;
class vtkPolyData;
class vtkPolyDataMapper2D;
class vtkSelectVisiblePoints;
class vtkTextProperty;
class vtkTexture;

namespace penumbra
{

class Overlay;
struct Scene;

/// Returns the position of an actor in pixels, rounded as VTK does.
glm::dvec2 ComputeViewportPosition(vtkActor2D* actor, vtkViewport* viewport);

/// Draws the 2-D props that are created and rendered during its life into an overlay. At most one
/// exists in a thread at a time.
class OverlayRecorder
{
public:
  /// @param skipsTextures If true, textured rectangles are omitted, and text actors draw their text
  /// without a texture.
  OverlayRecorder(vtkRenderer* renderer, int dpi, Scene& scene, bool skipsTextures = false);
  ~OverlayRecorder();
  OverlayRecorder(const OverlayRecorder&) = delete;
  OverlayRecorder& operator=(const OverlayRecorder&) = delete;

  /// Viewport to pass to the props.
  vtkRenderer* GetViewport() { return this->Layout; }

  /// Renders `prop`, which must have been created during the life of this recorder.
  void Render(vtkProp* prop);

  /// Returns a copy of a mapper that draws into the overlay, or null if it is not supported.
  static vtkSmartPointer<vtkMapper2D> CopyMapper(vtkMapper2D* mapper);

  Overlay& Image;
  const int DPI;
  const bool SkipsTextures;
  bool HasText = true;                  ///< false if VTK could not render some text
  vtkTexture* CurrentTexture = nullptr; ///< texture of the part that is being rendered
  /// Text whose image is the texture of the next polygons; null: none.
  const char* Text = nullptr;
  vtkTextProperty* TextStyle = nullptr; ///< of Text
  /// Returns the output of a filter of label points for the image; null if it has none.
  std::function<vtkSmartPointer<vtkPolyData>(vtkSelectVisiblePoints*)> SelectPoints;
  bool NeedsWindow = false; ///< true if label points depend on the last image of the window

  /// Returns the recorder of this thread, or null.
  static OverlayRecorder* GetCurrent();

private:
  vtkNew<SizeOnlyWindow> Window;
  vtkNew<SizeOnlyRenderer> Layout;
};

}
#endif
