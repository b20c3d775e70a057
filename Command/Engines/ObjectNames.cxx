// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ObjectNames.h"

#include "CollectionItems.h"

#include "Scene/SceneBuilder.h"

#include "vtkActor.h"
#include "vtkActorCollection.h"
#include "vtkFieldData.h"
#include "vtkMapper.h"
#include "vtkRenderer.h"
#include "vtkStringArray.h"

#include <algorithm>
#include <cstdlib>
#include <vector>

namespace penumbra
{

namespace
{

/// Returns the names of all actors in order; empty ones of actors without a file.
std::vector<std::string> FindNames(vtkRenderer* renderer)
{
  std::vector<std::string> names;
  for (vtkActor* actor : GetItems<vtkActor>(renderer->GetActors()))
  {
    vtkDataObject* data =
      actor->GetMapper() ? actor->GetMapper()->GetInputDataObject(0, 0) : nullptr;
    auto* name = data
      ? vtkStringArray::SafeDownCast(data->GetFieldData()->GetAbstractArray(SourceName))
      : nullptr;
    names.push_back(name && name->GetNumberOfValues() > 0 ? name->GetValue(0) : std::string());
  }
  return names;
}

}

std::string NameObjects(const std::string& warning, vtkRenderer* renderer)
{
  const std::string word = "Object ";
  if (warning.rfind(word, 0) != 0)
  {
    return warning;
  }
  const std::vector<std::string> names = FindNames(renderer);
  const std::size_t end = std::min(warning.find(": "), warning.size());
  std::string named;
  std::size_t copied = 0;
  for (std::size_t at = 0; at < end; at = warning.find(word, copied))
  {
    char* after = nullptr;
    const std::size_t id = std::strtoul(warning.c_str() + at + word.size(), &after, 10);
    const bool isKnown = id < names.size() && !names[id].empty();
    const auto next = static_cast<std::size_t>(after - warning.c_str());
    named += warning.substr(copied, at - copied);
    named += isKnown ? names[id] : warning.substr(at, next - at);
    copied = next;
  }
  return named + warning.substr(copied);
}

}
