// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Traverses the blocks of composite data sets with the attributes of a composite mapper:
// visibility, color, opacity and scalar mapping.
#ifndef penumbra_SceneExtractionBlocks_h
#define penumbra_SceneExtractionBlocks_h

#include "SceneExtractionColors.h"

#include "vtkType.h"

#include <functional>
#include <string>
#include <vector>

class vtkCompositeDataSet;
class vtkDataSet;

namespace penumbra
{

/// Receives a leaf, its draw item without data, and its scalar mapping, which may be null.
using BlockFunction = std::function<void(vtkDataSet*, const DrawItem&, ScalarMapper*)>;

/// Calls `callback` for every visible leaf that is a data set. The callback receives `prototype`
/// and a copy of `scalars` (may be null), modified by the block attributes of `mapper` (may be
/// null) for the leaf and its ancestors.
void ForEachBlock(vtkCompositeDataSet* data, vtkMapper* mapper, const DrawItem& prototype,
  ScalarMapper* scalars, std::vector<std::string>& warnings, const BlockFunction& callback);

/// Returns the modification time of the block attributes of `mapper` for `data`.
vtkMTimeType GetBlockMTime(vtkCompositeDataSet* data, vtkMapper* mapper);

}
#endif
