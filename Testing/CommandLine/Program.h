// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Runs the real program and returns its output.
#ifndef penumbra_testing_Program_h
#define penumbra_testing_Program_h

#include "Json.h"

#include <string>
#include <vector>

namespace penumbra_testing
{

struct ProgramResult
{
  int Status = -1; ///< exit status; minus the number of the signal that ended it
  std::string Output;
  std::string Errors;
};

/// A temporary folder for the files of one test, removed by the destructor.
class Folder
{
public:
  explicit Folder(const std::string& name);
  ~Folder();

  Folder(const Folder&) = delete;
  void operator=(const Folder&) = delete;

  std::string operator/(const std::string& file) const { return this->Path + "/" + file; }
  std::vector<std::string> List() const; ///< sorted names, including hidden files

  const std::string Path;
};

/// Runs penumbra ARGUMENTS... `setting`: NAME=VALUE for its environment, or empty.
ProgramResult RunProgram(
  const std::vector<std::string>& arguments, const std::string& setting = std::string());

/// Runs a shell script, for limits and redirections; $PENUMBRA is the path of the program.
ProgramResult RunShell(const std::string& script);

/// Quotes an argument for a shell; the text must not contain quotes.
std::string Quote(const std::string& text);

/// Path of the program.
std::string ProgramPath();

/// Path of the folder of the sources.
std::string SourceFolder();

int CountLines(const std::string& text);

/// `errors` without the warnings that the tolerance was not reached.
std::string WithoutToleranceWarnings(const std::string& errors);

void WriteText(const std::string& path, const std::string& text);
std::string ReadText(const std::string& path);
Json ReadJson(const std::string& path);

}
#endif
