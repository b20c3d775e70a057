// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Destinations of messages: lines of the program go to stderr, output of VTK, OpenGL and other
// libraries goes to a log file.
#ifndef penumbra_MessageLog_h
#define penumbra_MessageLog_h

#include <string>
#include <vector>

namespace penumbra
{

/// Redirects file descriptor 2 and VTK's messages to the log. Call once, before any output.
/// The log is $PENUMBRA_LOG, else penumbra/log under $XDG_STATE_HOME or ~/.local/state;
/// PENUMBRA_LOG=- disables the redirection.
void OpenLog();

/// Path of the log; empty if there is none.
std::string LogPath();

/// Returns the errors of VTK since the last call without the prefix of VTK's macros.
std::vector<std::string> TakeErrors();

/// Returns the warnings that Penumbra's classes logged since the last call, without the prefix of VTK's macros.
std::vector<std::string> TakeWarnings();

/// Throws std::bad_alloc if an error reports a failed allocation.
void RequireMemory(const std::vector<std::string>& errors);

/// Returns the text of a message of VTK's macros without their prefix.
std::string StripMessagePrefix(const std::string& text);

/// Returns the text that PrintMessage() writes.
std::string LineOf(const std::string& line);

/// Prints "penumbra: " and one line on the original stderr. Line breaks are replaced by spaces.
void PrintMessage(const std::string& line);

/// File descriptor of the original stderr.
int TerminalDescriptor();

}
#endif
