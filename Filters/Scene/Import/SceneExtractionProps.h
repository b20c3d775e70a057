// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Converts props that are not polygons of a mapper: image slices and text become textured
// rectangles, axes become their parts.
#ifndef penumbra_SceneExtractionProps_h
#define penumbra_SceneExtractionProps_h

#include "SceneExtraction.h"
#include "Tessellation/SceneExtractionItem.h"

#include <string>
#include <vector>

class vtkLODProp3D;
class vtkProp;
class vtkProp3D;
class vtkPropCollection;
class vtkRenderer;

namespace penumbra
{

/// Adds the props that `prop` consists of to `parts`. Returns false if it is not a compound prop.
bool CollectParts(vtkProp* prop, vtkPropCollection* parts);

/// Returns the part of `prop` that the application selected, or else the first enabled one of the
/// lowest level; null if there is none.
vtkProp3D* FindBestLevel(vtkLODProp3D* prop);

/// Converts a vtkTextActor3D or a vtkImageSlice with vtkImageSliceMapper to a textured rectangle.
/// `item` has no data if there is nothing to draw. Returns false for other props.
bool MakeTexturedProp(
  vtkProp* prop, const glm::dmat4& toWorld, DrawItem& item, std::vector<std::string>& warnings);

/// Returns true if MakeBillboards() draws this prop.
bool IsBillboard(vtkProp* prop);

/// Returns the visible billboard texts of `renderer`, which are aligned with the pixels of
/// scene.ViewCamera. The first has the ObjectId `firstObject`.
std::vector<DrawItem> MakeBillboards(
  vtkRenderer* renderer, int dpi, int firstObject, const Scene& scene);

}
#endif
