// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// The set of input files, which no output may overwrite.
#ifndef penumbra_InputFiles_h
#define penumbra_InputFiles_h

#include <string>

namespace penumbra
{

/// Records the input file at `path` and the files that it refers to: pieces, blocks, data files of
/// a header, the folder of an OpenFOAM case. Every reader calls it. Commands call it for all inputs
/// before they create an output, so that a conflict is reported before any work.
void RecordInput(const std::string& path);

/// Returns whether `path` is a recorded file, also by another name or link.
bool IsInput(const std::string& path);

/// Returns the size in bytes of `path` and the files that it refers to.
unsigned long long InputBytes(const std::string& path);

/// Returns a text that changes if `path` or a file that it refers to changes.
std::string DescribeInput(const std::string& path);

}
#endif
