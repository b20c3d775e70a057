// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Blocks of a composite data set merged into one mesh, so that they occlude each other.
#ifndef penumbra_CompositeMesh_h
#define penumbra_CompositeMesh_h

#include "vtkSmartPointer.h"
#include "vtkType.h"

class vtkCompositeDataSet;
class vtkPointSet;

namespace penumbra
{

class CompositeMesh
{
public:
  /// Merges all blocks that are vtkPointSets and skips the others.
  explicit CompositeMesh(vtkCompositeDataSet* data);

  /// Returns the points and cells of all merged blocks, in the order of the blocks.
  vtkPointSet* GetMerged() const { return this->Merged; }

  vtkIdType GetNumberOfSkippedBlocks() const { return this->SkippedBlocks; }

  /// Fills `output` with copies of all blocks. Arrays of `baked`, a copy of the merged mesh, that
  /// the merged mesh lacks are split over the blocks.
  void Distribute(vtkPointSet* baked, vtkCompositeDataSet* output) const;

private:
  vtkCompositeDataSet* Data;
  vtkSmartPointer<vtkPointSet> Merged;
  vtkIdType SkippedBlocks = 0;
};

}
#endif
