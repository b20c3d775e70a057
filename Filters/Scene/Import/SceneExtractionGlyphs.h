// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Glyph mappers: one shape at every point of a data set, turned, scaled and coloured by arrays.
#ifndef penumbra_SceneExtractionGlyphs_h
#define penumbra_SceneExtractionGlyphs_h

#include "Tessellation/SceneExtractionItem.h"

#include <string>
#include <vector>

class vtkDataSet;
class vtkGlyph3DMapper;

namespace penumbra
{

class ScalarMapper;

/// One piece with copies for every shape that `mapper` sets at points of `data`, in `look`.
std::vector<DrawItem> MakeGlyphs(vtkGlyph3DMapper* mapper, vtkDataSet* data,
  const DrawItem& prototype, ScalarMapper* scalars, std::vector<std::string>& warnings);

/// Adds all that is drawn of `piece`, at every place it is copied to; copies of one kind become one
/// surface, and their cells are the points they stand at.
void AddDrawItem(const DrawItem& item, double pixelsPerPoint, Scene& scene);

}
#endif
