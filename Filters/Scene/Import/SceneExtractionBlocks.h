// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// The blocks of composite data sets, with what a composite mapper says of each: visible or not,
// its own colour, opacity, array.
#ifndef penumbra_SceneExtractionBlocks_h
#define penumbra_SceneExtractionBlocks_h

#include "SceneExtractionColors.h"

#include "vtkType.h"

#include <functional>

class vtkCompositeDataSet;
class vtkDataSet;

namespace penumbra
{

using BlockFunction = std::function<void(vtkDataSet*, const DrawItem&, ScalarMapper*)>;

/// Calls `use` for every visible leaf that is a data set, with `look` and a copy of `scalars` (null
/// without one) changed by what `mapper` (may be null) says of the block or those above it.
void ForEachBlock(vtkCompositeDataSet* data, vtkMapper* mapper, const DrawItem& prototype,
  ScalarMapper* scalars, const BlockFunction& callback);

/// When what `mapper` says of the blocks of `data` last changed.
vtkMTimeType GetBlockMTime(vtkCompositeDataSet* data, vtkMapper* mapper);

/// Does `mapper` give blocks textures of their own?
bool HasBlockTextures(vtkMapper* mapper);

}
#endif
