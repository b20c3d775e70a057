// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ChartPainter.h"

#include "Features/SceneFeatures.h"
#include "Overlay.h"
#include "OverlayDevice.h"
#include "Scene.h"
#include "SceneExtractionOverlay.h"

#include "vtkAbstractContextItem.h"
#include "vtkContextActor.h"
#include "vtkContextScene.h"
#include "vtkRenderer.h"
#include "vtkWindow.h"

#include <algorithm>

namespace penumbra
{
namespace
{

/// Returns the pixels of the image per unit of a scene that is laid out for the window.
double FindScale(vtkRenderer* renderer, int dpi, const Overlay& overlay)
{
  if (renderer->GetVTKWindow())
  {
    const int* size = renderer->GetSize();
    if (size[0] > 0 && size[1] > 0)
    {
      return std::min(static_cast<double>(overlay.GetWidth()) / size[0],
        static_cast<double>(overlay.GetHeight()) / size[1]);
    }
  }
  return dpi / 72.0;
}

/// Returns true if an item or one of its items is drawn in three dimensions.
bool HasDepth(vtkAbstractContextItem* item)
{
  if (item->IsA("vtkChartXYZ") || item->IsA("vtkPlot3D"))
  {
    return true;
  }
  for (vtkIdType i = 0; i < item->GetNumberOfItems(); ++i)
  {
    if (HasDepth(item->GetItem(i)))
    {
      return true;
    }
  }
  return false;
}

}

void PaintChart(vtkContextActor* actor, vtkRenderer* renderer, int dpi, Scene& scene)
{
  vtkContextScene* items = actor->GetScene();
  for (unsigned int i = 0; i < items->GetNumberOfItems(); ++i)
  {
    if (HasDepth(items->GetItem(i)))
    {
      WarnFeature(Feature::OtherProps, actor->GetClassName(), scene.Warnings);
      return;
    }
  }
  const double scale = FindScale(renderer, dpi, *scene.OverlayImage);
  if (PaintItems(items, *scene.OverlayImage, scale))
  {
    WarnFeature(Feature::ChartTextures, actor->GetClassName(), scene.Warnings);
  }
}

}
