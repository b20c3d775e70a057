// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Runs the real program and tells what came of it.
#ifndef penumbra_testing_Program_h
#define penumbra_testing_Program_h

#include <nlohmann/json.hpp>

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

/// A folder of one test's own, removed when the test is over; all that it writes lies there.
class Folder
{
public:
  explicit Folder(const std::string& name);
  ~Folder();

  Folder(const Folder&) = delete;
  void operator=(const Folder&) = delete;

  std::string operator/(const std::string& file) const { return this->Path + "/" + file; }
  std::vector<std::string> List() const; ///< names in it, hidden ones too, sorted

  const std::string Path;
};

/// penumbra ARGUMENTS... `setting`: NAME=VALUE for its environment, or empty.
ProgramResult RunProgram(
  const std::vector<std::string>& arguments, const std::string& setting = std::string());

/// The program by way of a shell, for limits and redirections; $PENUMBRA is the program.
ProgramResult RunShell(const std::string& script);

/// For a shell; no text with quotes.
std::string Quote(const std::string& text);

/// Path of the program.
std::string ProgramPath();

int CountLines(const std::string& text);

/// `errors` without the warnings that the tolerance was not reached.
std::string WithoutToleranceWarnings(const std::string& errors);

void WriteText(const std::string& path, const std::string& text);
std::string ReadText(const std::string& path);
nlohmann::json ReadJson(const std::string& path);

/// What `penumbra compare A B --json` reports.
nlohmann::json Compare(const std::string& a, const std::string& b);

}
#endif
