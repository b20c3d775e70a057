// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// The one record of the files that the program reads: no output replaces any of them.
#ifndef penumbra_InputFiles_h
#define penumbra_InputFiles_h

#include <string>

namespace penumbra
{

/// Record that the file at `path` is read, and the files that it refers to: pieces, blocks, data beside
/// a header, the folder of an OpenFOAM case. Every reader calls it; a command calls it for all of its
/// inputs before it creates an output, so that the refusal precedes the work.
void RecordInput(const std::string& path);

/// Is the file at `path` a recorded one, by whatever name or link?
bool IsInput(const std::string& path);

/// Bytes of `path` and the files that it refers to.
unsigned long long InputBytes(const std::string& path);

}
#endif
