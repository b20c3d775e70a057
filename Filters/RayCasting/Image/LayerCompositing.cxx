// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "LayerCompositing.h"

#include "CollectionItems.h"

#include "vtkDataArray.h"
#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkPointData.h"
#include "vtkPropCollection.h"
#include "vtkRenderWindow.h"
#include "vtkRenderer.h"
#include "vtkRendererCollection.h"

#include <algorithm>
#include <cmath>

namespace penumbra
{
namespace
{

bool HasVisibleProps(vtkRenderer* renderer)
{
  const std::vector<vtkProp*> props = GetItems<vtkProp>(renderer->GetViewProps());
  return std::any_of(
    props.begin(), props.end(), [](vtkProp* prop) { return prop->GetVisibility() != 0; });
}

/// Returns the other renderers of the window of `renderer` that are drawn, overlap it and satisfy
/// `accepts`.
template <typename Predicate>
std::vector<vtkRenderer*> FindOverlapping(vtkRenderer* renderer, const Predicate& accepts)
{
  std::vector<vtkRenderer*> layers;
  vtkRenderWindow* window = renderer ? renderer->GetRenderWindow() : nullptr;
  if (!window)
  {
    return layers;
  }
  const auto overlaps = [&](vtkRenderer* other) {
    const double* a = renderer->GetViewport();
    const double* b = other->GetViewport();
    return a[0] < b[2] && b[0] < a[2] && a[1] < b[3] && b[1] < a[3];
  };
  for (vtkRenderer* other : GetItems<vtkRenderer>(window->GetRenderers()))
  {
    if (other != renderer && other->GetDraw() && overlaps(other) && accepts(other))
    {
      layers.push_back(other);
    }
  }
  return layers;
}

/// Composites a pixel of 4 floats over another one, and stores the result in `result`.
void CompositePixel(const float* over, const float* under, float* result)
{
  const float below = (1.f - over[3]) * under[3];
  const float alpha = over[3] + below;
  for (int k = 0; k < 3; ++k)
  {
    result[k] = alpha > 0.f ? (over[3] * over[k] + below * under[k]) / alpha : result[k];
  }
  result[3] = alpha;
}

}

std::vector<vtkRenderer*> FindLayersAbove(vtkRenderer* renderer)
{
  std::vector<vtkRenderer*> layers = FindOverlapping(renderer, [renderer](vtkRenderer* other) {
    return other->GetLayer() > renderer->GetLayer() && HasVisibleProps(other);
  });
  std::stable_sort(layers.begin(), layers.end(),
    [](vtkRenderer* a, vtkRenderer* b) { return a->GetLayer() < b->GetLayer(); });
  return layers;
}

std::vector<vtkRenderer*> FindLayersBelow(vtkRenderer* renderer)
{
  if (!renderer || !renderer->GetPreserveColorBuffer())
  {
    return {};
  }
  std::vector<vtkRenderer*> layers = FindOverlapping(
    renderer, [renderer](vtkRenderer* other) { return other->GetLayer() < renderer->GetLayer(); });
  std::stable_sort(layers.begin(), layers.end(),
    [](vtkRenderer* a, vtkRenderer* b) { return a->GetLayer() > b->GetLayer(); });
  return layers;
}

LayerRectangle FindLayerRectangle(
  vtkRenderer* renderer, vtkRenderer* layer, const int resolution[2])
{
  const double* whole = renderer->GetViewport();
  const double* part = layer->GetViewport();
  LayerRectangle rectangle;
  for (int k = 0; k < 2; ++k)
  {
    const double scale = resolution[k] / (whole[k + 2] - whole[k]);
    rectangle.Low[k] = static_cast<int>(std::lround((part[k] - whole[k]) * scale));
    rectangle.Size[k] =
      static_cast<int>(std::lround((part[k + 2] - whole[k]) * scale)) - rectangle.Low[k];
  }
  return rectangle;
}

void CompositeLayer(vtkImageData* layer, const int low[2], bool isAbove, vtkImageData* image)
{
  auto* from = vtkFloatArray::SafeDownCast(layer->GetPointData()->GetArray("Color"));
  auto* to = vtkFloatArray::SafeDownCast(image->GetPointData()->GetArray("Color"));
  vtkDataArray* fromErrors = layer->GetPointData()->GetArray("EstimatedError");
  vtkDataArray* toErrors = image->GetPointData()->GetArray("EstimatedError");
  if (!from || !to || !fromErrors || !toErrors)
  {
    return;
  }
  const int* size = layer->GetDimensions();
  const int* extent = image->GetExtent();
  for (int j = std::max(low[1], extent[2]); j <= std::min(low[1] + size[1] - 1, extent[3]); ++j)
  {
    for (int i = std::max(low[0], extent[0]); i <= std::min(low[0] + size[0] - 1, extent[1]); ++i)
    {
      int index[3] = { i, j, 0 };
      int source[3] = { i - low[0], j - low[1], 0 };
      const vtkIdType p = layer->ComputePointId(source);
      const vtkIdType q = image->ComputePointId(index);
      const float* theirs = from->GetPointer(4 * p);
      float* ours = to->GetPointer(4 * q);
      const double theirError = fromErrors->GetComponent(p, 0);
      const double ourError = toErrors->GetComponent(q, 0);
      toErrors->SetComponent(q, 0,
        isAbove ? std::hypot(theirError, (1.0 - theirs[3]) * ourError)
                : std::hypot(ourError, (1.0 - ours[3]) * theirError));
      CompositePixel(isAbove ? theirs : ours, isAbove ? ours : theirs, ours);
    }
  }
}

}
