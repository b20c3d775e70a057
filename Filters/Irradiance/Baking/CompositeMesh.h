// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// The blocks of a composite data set as one mesh, so that each may block all others.
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
  /// Those that are point sets; others take no part.
  explicit CompositeMesh(vtkCompositeDataSet* data);

  /// Points and cells of all blocks, one block after the other.
  vtkPointSet* GetMerged() const { return this->Joined; }

  vtkIdType GetNumberOfSkippedBlocks() const { return this->Others; }

  /// Fill `output` with copies of the blocks, each with its own part of the arrays that `baked`, a copy
  /// of the joined mesh, has got since.
  void Distribute(vtkPointSet* baked, vtkCompositeDataSet* output) const;

private:
  vtkCompositeDataSet* Data;
  vtkSmartPointer<vtkPointSet> Joined;
  vtkIdType Others = 0;
};

}
#endif
