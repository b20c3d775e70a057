// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// The items of a VTK collection, for range-based loops.
#ifndef penumbra_CollectionItems_h
#define penumbra_CollectionItems_h

#include "vtkCollection.h"

#include <vector>

namespace penumbra
{

/// Returns the items of a collection, which are of type T. A copy, because VTK 9.2 fills a collection
/// again in each call of vtkRenderer::GetActors().
template <typename T, typename Pointer = T*>
std::vector<Pointer> GetItems(vtkCollection* collection)
{
  std::vector<Pointer> items;
  vtkCollectionSimpleIterator position;
  collection->InitTraversal(position);
  while (vtkObject* item = collection->GetNextItemAsObject(position))
  {
    items.push_back(static_cast<T*>(item));
  }
  return items;
}

}
#endif
