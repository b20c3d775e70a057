// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "Program.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

extern char** environ;

namespace penumbra_testing
{

namespace
{

namespace fs = std::filesystem;

ProgramResult Spawn(
  const std::vector<std::string>& command, const std::vector<std::string>& settings)
{
  const std::string place = (fs::temp_directory_path() / "penumbra-tests").string();
  const std::string base = place + "/run-" + std::to_string(getpid());
  fs::create_directories(place);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  const int flags = O_WRONLY | O_CREAT | O_TRUNC;
  posix_spawn_file_actions_addopen(&actions, 0, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&actions, 1, (base + ".out").c_str(), flags, 0600);
  posix_spawn_file_actions_addopen(&actions, 2, (base + ".err").c_str(), flags, 0600);

  std::vector<char*> arguments;
  for (const std::string& argument : command)
  {
    arguments.push_back(const_cast<char*>(argument.c_str()));
  }
  arguments.push_back(nullptr);
  std::vector<std::string> environment(settings);
  for (char** entry = environ; *entry; ++entry)
  {
    environment.emplace_back(*entry); // The first entry of a name is used.
  }
  std::vector<char*> environmentPointers;
  for (std::string& entry : environment)
  {
    environmentPointers.push_back(&entry[0]);
  }
  environmentPointers.push_back(nullptr);

  ProgramResult outcome;
  pid_t child = 0;
  int state = 0;
  if (posix_spawn(&child, command[0].c_str(), &actions, nullptr, arguments.data(),
        environmentPointers.data()) == 0 &&
    waitpid(child, &state, 0) == child)
  {
    outcome.Status = WIFEXITED(state) ? WEXITSTATUS(state) : -WTERMSIG(state);
  }
  posix_spawn_file_actions_destroy(&actions);
  outcome.Output = ReadText(base + ".out");
  outcome.Errors = ReadText(base + ".err");
  fs::remove(base + ".out");
  fs::remove(base + ".err");
  return outcome;
}

// The log of the runs, separate from the user's log.
std::string LogSetting()
{
  return "PENUMBRA_LOG=" + (fs::temp_directory_path() / "penumbra-tests" / "log").string();
}

}

Folder::Folder(const std::string& name)
  : Path((fs::temp_directory_path() / "penumbra-tests" / (name + "-" + std::to_string(getpid())))
           .string())
{
  fs::remove_all(this->Path);
  fs::create_directories(this->Path);
}

Folder::~Folder()
{
  std::error_code ignored;
  fs::remove_all(this->Path, ignored);
}

std::vector<std::string> Folder::List() const
{
  std::vector<std::string> names;
  for (const fs::directory_entry& entry : fs::directory_iterator(this->Path))
  {
    names.push_back(entry.path().filename().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

std::string ProgramPath()
{
  return PENUMBRA_PROGRAM;
}

std::string SourceFolder()
{
  return PENUMBRA_SOURCE_DIR;
}

ProgramResult RunProgram(const std::vector<std::string>& arguments, const std::string& setting)
{
  std::vector<std::string> command = { ProgramPath() };
  command.insert(command.end(), arguments.begin(), arguments.end());
  std::vector<std::string> settings = { LogSetting() };
  if (!setting.empty())
  {
    settings.push_back(setting);
  }
  return Spawn(command, settings);
}

std::string Quote(const std::string& text)
{
  return "'" + text + "'";
}

ProgramResult RunShell(const std::string& script)
{
  return Spawn({ "/bin/bash", "-c", script }, { LogSetting(), "PENUMBRA=" + ProgramPath() });
}

std::string WithoutToleranceWarnings(const std::string& errors)
{
  std::istringstream lines(errors);
  std::string rest;
  for (std::string line; std::getline(lines, line);)
  {
    if (line.find("tolerance of") == std::string::npos ||
      line.find("not reached") == std::string::npos)
    {
      rest += line + "\n";
    }
  }
  return rest;
}

int CountLines(const std::string& text)
{
  return static_cast<int>(std::count(text.begin(), text.end(), '\n'));
}

void WriteText(const std::string& path, const std::string& text)
{
  std::ofstream(path, std::ios::binary) << text;
}

std::string ReadText(const std::string& path)
{
  std::ifstream file(path, std::ios::binary);
  return std::string(std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>());
}

Json ReadJson(const std::string& path)
{
  return Json::Parse(ReadText(path));
}

}
