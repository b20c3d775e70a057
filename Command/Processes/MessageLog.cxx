// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "MessageLog.h"

#include "vtkObjectFactory.h"
#include "vtkOutputWindow.h"
#include "vtkSmartPointer.h"

#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <mutex>
#include <new>
#include <regex>
#include <utility>

#include <fcntl.h>
#include <unistd.h>

namespace
{

std::string Path;
int Terminal = STDERR_FILENO;
std::mutex MessagesMutex;
std::vector<std::string> Errors;
std::vector<std::string> Warnings; // of Penumbra's classes

void Record(const char* text, std::vector<std::string>& messages)
{
  const std::lock_guard<std::mutex> lock(MessagesMutex);
  messages.push_back(penumbra::StripMessagePrefix(text));
}

std::vector<std::string> Take(std::vector<std::string>& messages)
{
  const std::lock_guard<std::mutex> lock(MessagesMutex);
  return std::exchange(messages, {});
}

class LogWindow : public vtkOutputWindow
{
public:
  static LogWindow* New();
  vtkTypeMacro(LogWindow, vtkOutputWindow);

  void DisplayText(const char* text) override
  {
    // Failing to write the log is not an error.
    [[maybe_unused]] const auto written =
      write(STDERR_FILENO, text, std::char_traits<char>::length(text));
  }
  void DisplayErrorText(const char* text) override
  {
    Record(text, Errors);
    this->DisplayText(text);
  }
  void DisplayWarningText(const char* text) override
  {
    if (std::strstr(text, "\nvtkPenumbra"))
    {
      Record(text, Warnings);
    }
    this->DisplayText(text);
  }
  void DisplayGenericWarningText(const char* text) override { this->DisplayText(text); }
  void DisplayDebugText(const char* text) override { this->DisplayText(text); }
};
vtkStandardNewMacro(LogWindow);

std::string ChoosePath()
{
  if (const char* path = std::getenv("PENUMBRA_LOG"))
  {
    return path;
  }
  const char* state = std::getenv("XDG_STATE_HOME");
  const char* home = std::getenv("HOME");
  if (state && *state)
  {
    return std::string(state) + "/penumbra/log";
  }
  return home && *home ? std::string(home) + "/.local/state/penumbra/log" : "/dev/null";
}

// Opens the log for appending; truncates it if it exceeds one megabyte.
int OpenLogFile(const std::string& path)
{
  std::error_code ignored;
  const std::filesystem::path file(path);
  if (file.has_parent_path())
  {
    std::filesystem::create_directories(file.parent_path(), ignored);
  }
  const bool full = std::filesystem::is_regular_file(file, ignored) &&
    std::filesystem::file_size(file, ignored) > 1000000;
  return open(path.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC | (full ? O_TRUNC : O_APPEND), 0666);
}

/// Replaces objects, such as "vtkMapper (0x61c0)", by words.
std::string ReplaceObjects(const std::string& message)
{
  static const std::pair<std::regex, const char*> rules[] = {
    { std::regex("Algorithm vtk\\w+ ?\\(0x[0-9a-f]+\\) returned failure for request: .*"),
      "the file could not be read completely" },
    { std::regex("Input port \\d+ of algorithm vtk\\w+ ?\\(0x[0-9a-f]+\\) has 0 connections but is "
                 "not optional"),
      "an object has no geometry" },
    { std::regex("vtk\\w+ ?\\(0x[0-9a-f]+\\)"), "an object" },
    { std::regex(" ?\\(?\\b0x[0-9a-f]{6,}\\b\\)?"), "" },
  };
  std::string words = message;
  for (const auto& [pattern, replacement] : rules)
  {
    words = std::regex_replace(words, pattern, replacement);
  }
  return words;
}

}

namespace penumbra
{

// VTK formats messages as "ERROR: In file.cxx, line 1\nvtkClass (0x1): message\n\n". The message may name further
// objects, which users of a program do not know.
std::string StripMessagePrefix(const std::string& text)
{
  std::size_t begin = text.find("): ");
  begin = begin == std::string::npos ? text.find('\n') : begin + 2;
  begin = begin == std::string::npos ? 0 : begin;
  begin = text.find_first_not_of(" \n\t", begin);
  if (begin == std::string::npos)
  {
    return "unknown error";
  }
  std::string message = text.substr(begin, text.find('\n', begin) - begin);
  message.erase(message.find_last_not_of(" .\t\r") + 1);
  return ReplaceObjects(message);
}

void OpenLog()
{
  vtkOutputWindow::SetInstance(vtkSmartPointer<LogWindow>::New());
  Path = ChoosePath();
  if (Path == "-")
  {
    Path.clear();
    return;
  }
  int log = OpenLogFile(Path);
  if (log < 0)
  {
    Path.clear();
    log = open("/dev/null", O_WRONLY | O_CLOEXEC);
  }
  Terminal = fcntl(STDERR_FILENO, F_DUPFD_CLOEXEC, 3);
  dup2(log, STDERR_FILENO);
  close(log);
}

std::string LogPath()
{
  return Path;
}

std::vector<std::string> TakeErrors()
{
  return Take(Errors);
}

std::vector<std::string> TakeWarnings()
{
  return Take(Warnings);
}

void RequireMemory(const std::vector<std::string>& errors)
{
  for (const std::string& error : errors)
  {
    if (error.find("Unable to allocate") != std::string::npos ||
      error.find("ut of memory") != std::string::npos)
    {
      throw std::bad_alloc();
    }
  }
}

std::string LineOf(const std::string& line)
{
  std::string text = "penumbra: " + line;
  for (char& character : text)
  {
    if (static_cast<unsigned char>(character) < ' ')
    {
      character = ' ';
    }
  }
  return text + '\n';
}

void PrintMessage(const std::string& line)
{
  const std::string text = LineOf(line);
  [[maybe_unused]] const auto written = write(Terminal, text.data(), text.size());
}

int TerminalDescriptor()
{
  return Terminal;
}

}
