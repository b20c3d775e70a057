// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Converts glyph mappers: a shape at each point of a data set, rotated, scaled and colored by
// arrays.
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

/// Returns one draw item with instances for each shape that `mapper` places at points of `data`.
/// Items are copies of `prototype`.
std::vector<DrawItem> MakeGlyphs(vtkGlyph3DMapper* mapper, vtkDataSet* data,
  const DrawItem& prototype, ScalarMapper* scalars, std::vector<std::string>& warnings);

}
#endif
