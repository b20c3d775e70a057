// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Options of the scalar bar.
#ifndef penumbra_ScalarBarOptions_h
#define penumbra_ScalarBarOptions_h

#include <optional>
#include <string>
#include <vector>

namespace penumbra
{

class CommandLine;

struct ScalarBarOptions
{
  std::optional<std::string> Title; ///< unset: the name of the array
  std::vector<double>
    Position; ///< of the lower left corner, fractions of the image; empty: at the right
  std::vector<double> Size; ///< fractions of the image; empty: by Position
  int Labels = 5;
  std::string Format = "%.4g";
};

/// Declares the options --scalar-bar-...; parsing fills `bar`.
void DeclareScalarBarOptions(const CommandLine& app, ScalarBarOptions& bar);

}
#endif
