// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ScopedShaderEdit.h"

#include <utility>

namespace penumbra
{

namespace
{

/// The edit that was made last.
thread_local const ScopedShaderEdit* Current = nullptr;

}

ScopedShaderEdit::ScopedShaderEdit(std::string part, std::string replacement)
  : Part(std::move(part)),
    Replacement(std::move(replacement)),
    Outer(Current)
{
  Current = this;
}

ScopedShaderEdit::~ScopedShaderEdit()
{
  Current = this->Outer;
}

std::string ScopedShaderEdit::Apply(std::string source)
{
  for (const ScopedShaderEdit* edit = Current; edit; edit = edit->Outer)
  {
    const std::size_t at = source.find(edit->Part);
    if (at != std::string::npos)
    {
      source.replace(at, edit->Part.size(), edit->Replacement);
    }
  }
  return source;
}

}
