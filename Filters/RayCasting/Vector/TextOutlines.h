// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Letters as outlines of VTK's fonts, for files whose fonts lack them.
#ifndef penumbra_TextOutlines_h
#define penumbra_TextOutlines_h

#include "Overlay.h"

#include <cstdint>
#include <string>
#include <vector>

namespace penumbra
{

/// Removes the first character of UTF-8 text at `i` and returns it; invalid bytes are returned as
/// 0xfffd.
std::uint32_t TakeCharacter(const std::string& text, std::size_t& i);

/// A part of an outline.
struct OutlineCommand
{
  enum Kinds
  {
    Move,
    Line,
    Cubic ///< two control points and the end
  };
  Kinds Kind;
  glm::dvec2 Points[3]; ///< Move and Line: only the first one
};

/**
 * Returns the outlines of text, to be filled with the nonzero rule, in units of its font size, with
 * the start of the base line at (0, 0). Throws std::runtime_error, which names the character, if the
 * font lacks one.
 */
std::vector<OutlineCommand> MakeTextOutlines(const OverlayShape& text);

}
#endif
