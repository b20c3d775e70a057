// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// State that a pass keeps for each renderer and eye. A renderer may be deleted at any time, and a new
// one may get its address.
#ifndef penumbra_RendererMap_h
#define penumbra_RendererMap_h

#include "vtkRenderer.h"
#include "vtkWeakPointer.h"

#include <iterator>
#include <map>
#include <utility>

namespace penumbra
{

template <typename State>
class RendererMap
{
public:
  /// Returns the state of a renderer, a new one if there is none. Drops those of deleted renderers.
  State& Get(vtkRenderer* renderer, int eye = 0)
  {
    for (auto entry = this->Entries.begin(); entry != this->Entries.end();)
    {
      entry = entry->second.Renderer ? std::next(entry) : this->Entries.erase(entry);
    }
    Entry& entry = this->Entries[{ renderer, eye }];
    entry.Renderer = renderer;
    return entry.Value;
  }

  /// Returns the state of a renderer, or null if there is none.
  const State* Find(vtkRenderer* renderer, int eye = 0) const
  {
    const auto entry = this->Entries.find({ renderer, eye });
    return entry != this->Entries.end() && entry->second.Renderer ? &entry->second.Value : nullptr;
  }

  State* Find(vtkRenderer* renderer, int eye = 0)
  {
    return const_cast<State*>(std::as_const(*this).Find(renderer, eye));
  }

  /// Calls visit(state) for all states.
  template <typename Visit>
  void VisitAll(const Visit& visit)
  {
    for (auto& [key, entry] : this->Entries)
    {
      visit(entry.Value);
    }
  }

  void Clear() { this->Entries.clear(); }

private:
  struct Entry
  {
    vtkWeakPointer<vtkRenderer> Renderer; ///< null after it was deleted
    State Value;
  };

  std::map<std::pair<vtkRenderer*, int>, Entry> Entries;
};

}
#endif
