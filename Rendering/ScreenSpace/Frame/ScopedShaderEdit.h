// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// For tests only: replaces one piece of shader text while it exists, to measure the effect of that
// line of the shader.
#ifndef penumbra_ScopedShaderEdit_h
#define penumbra_ScopedShaderEdit_h

#include "vtkPenumbraRenderingScreenSpaceModule.h" // for export macro, which tests need

#include <string>

namespace penumbra
{

/// Edits all stages that contain `part`. Edits nest and must end in reverse order. Use it on the
/// thread that renders.
class VTKPENUMBRARENDERINGSCREENSPACE_EXPORT ScopedShaderEdit
{
public:
  ScopedShaderEdit(std::string part, std::string replacement);
  ~ScopedShaderEdit();
  ScopedShaderEdit(const ScopedShaderEdit&) = delete;
  void operator=(const ScopedShaderEdit&) = delete;

  /// Applies all current edits to a source.
  static std::string Apply(std::string source);

private:
  const std::string Part;
  const std::string Replacement;
  const ScopedShaderEdit* const Outer;
};

}
#endif
