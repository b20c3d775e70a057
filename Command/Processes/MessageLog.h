// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Where messages go. The terminal's stderr belongs to the program's own lines; what VTK, OpenGL
// and other libraries print goes to a log file.
#ifndef penumbra_MessageLog_h
#define penumbra_MessageLog_h

#include <string>
#include <vector>

namespace penumbra
{

/// Send file descriptor 2 and VTK's messages to the log. Call once, first.
/// The log is $PENUMBRA_LOG, else penumbra/log under $XDG_STATE_HOME or ~/.local/state;
/// PENUMBRA_LOG=- leaves stderr as it is.
void OpenLog();

/// Where the log is; empty when there is none.
std::string LogPath();

/// VTK's errors since the last call, one sentence each, without VTK's frame around them.
std::vector<std::string> TakeErrors();

/// Do VTK's errors say that memory ran out?
bool IndicatesOutOfMemory(const std::vector<std::string>& errors);

/// The sentence inside a message of VTK's macros.
std::string StripMessagePrefix(const std::string& text);

/// What Say() writes.
std::string LineOf(const std::string& line);

/// One line on the real stderr, after "penumbra: ". Line breaks in it become spaces.
void PrintMessage(const std::string& line);

/// The real stderr, for progress.
int TerminalDescriptor();

}
#endif
