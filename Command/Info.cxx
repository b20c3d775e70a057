// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// penumbra info: prints versions, resources and the OpenGL windows that this machine supports.
#include "Engines/Engine.h"
#include "Parsing/CommandLine.h"
#include "Processes/CommandError.h"
#include "Processes/MessageLog.h"
#include "Processes/Worker.h"
#include "Subcommands.h"

#include "vtkSMPTools.h"
#include "vtkVersion.h"

#include <iomanip>
#include <iostream>

namespace penumbra
{

namespace
{

int Info()
{
  const std::vector<WindowReport> windows = TryWindows();
  std::cout << "penumbra   " << PENUMBRA_VERSION << "\n"
            << "VTK        " << vtkVersion::GetVTKVersion() << "\n"
            << "threads    " << vtkSMPTools::GetEstimatedNumberOfThreads() << " ("
            << vtkSMPTools::GetBackend() << ")\n"
            << "memory     " << std::fixed << std::setprecision(1) << MachineMemory() / 1073741824.0
            << " GiB\n"
            << "log        " << (LogPath().empty() ? "none" : LogPath()) << "\n"
            << "ray        works\n";
  for (const WindowReport& window : windows)
  {
    std::cout << std::left << "raster     " << std::setw(8) << window.Name << window.Description
              << "\n";
  }
  return Done;
}

}

Action DeclareInfo(const CommandLine& program)
{
  program.AddSubcommand("info", "Print what runs on this machine");
  return Info;
}

}
