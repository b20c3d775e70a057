// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Standard input as an input file and standard output as an output file, both named "-".
#ifndef penumbra_StandardStreams_h
#define penumbra_StandardStreams_h

#include <string>

namespace penumbra
{

constexpr const char* StandardStream = "-";

/// A temporary folder for copies of the streams; the destructor removes it.
class StreamFolder
{
public:
  StreamFolder() = default;
  ~StreamFolder();

  StreamFolder(const StreamFolder&) = delete;
  void operator=(const StreamFolder&) = delete;

  /// Copies standard input to a file whose extension follows from its contents, and returns the
  /// path. Throws CommandError if the format is unknown.
  std::string ReadInput();

  /// Returns the path of a file for WriteOutput(). Throws CommandError if standard output is a
  /// terminal.
  std::string PrepareOutput();

  /// Copies the output file to standard output.
  void WriteOutput() const;

private:
  std::string Locate(const std::string& name);

  std::string Folder;
  std::string Output;
};

}
#endif
