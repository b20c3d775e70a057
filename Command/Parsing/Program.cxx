// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "Program.h"

#include "CommandLine.h"
#include "Processes/CommandError.h"
#include "Processes/MallocSettings.h"
#include "Processes/MessageLog.h"
#include "Processes/Worker.h"

#include "vtkVersion.h"

#include <csignal>
#include <map>
#include <string>

#include <fcntl.h>
#include <unistd.h>

namespace
{

using namespace penumbra;

// Opens /dev/null for each closed standard stream. Otherwise the next file opened would get its descriptor
// and messages would be written to an image. Writing to a closed standard output still fails.
void OccupyStandardStreams()
{
  for (const int stream : { STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO })
  {
    if (fcntl(stream, F_GETFD) < 0)
    {
      open("/dev/null", stream == STDERR_FILENO ? O_WRONLY : O_RDONLY);
    }
  }
}

int Run(int argc, char** argv, const std::vector<Subcommand>& subcommands)
{
  const Parser parser("penumbra",
    "Penumbra: images of simulation and scan data with exact edges, shadows, ambient occlusion, "
    "indirect light and light shafts, to an error that you choose",
    std::string("penumbra ") + PENUMBRA_VERSION + " (VTK " + vtkVersion::GetVTKVersion() + ")",
    "Exit status: 0 success, 1 comparison above its threshold, 2 invalid usage or input, 3 "
    "resource not available (OpenGL, memory).\nOptions of a subcommand: penumbra COMMAND --help");
  std::map<std::string, Action> actions;
  for (const Subcommand& subcommand : subcommands)
  {
    actions[subcommand.Name] = subcommand.Declare(parser.GetProgram());
  }
  const std::string chosen = parser.Parse(argc, argv);
  return chosen.empty() ? Done : actions.at(chosen)();
}

}

int penumbra::RunProgram(int argc, char** argv, const std::vector<Subcommand>& subcommands)
{
  OccupyStandardStreams();
  RetainFreedMemory();
  OpenLog();
  std::signal(SIGCHLD, SIG_DFL); // If ignored, waitpid() would not report exit statuses.
  std::signal(SIGXFSZ, SIG_IGN); // Writes beyond a quota then fail with an error code.
  try
  {
    return RunGuarded([&]() { return Run(argc, argv, subcommands); });
  }
  catch (const Cancelled& cancelled)
  {
    std::signal(cancelled.Signal, SIG_DFL);
    std::raise(cancelled.Signal); // The shell then reports the signal.
  }
  return Unavailable;
}
