// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "Engine.h"
#include "Options/RenderOptions.h"
#include "Processes/CommandError.h"

#include "vtkNew.h"
#include "vtkRenderWindow.h"
#include "vtkRenderer.h"

#include <cstdlib>
#include <filesystem>
#include <iterator>
#include <stdexcept>

#include <sys/wait.h>
#include <unistd.h>

namespace penumbra
{

namespace
{

struct WindowKind
{
  const char* Name;
  const char* Class;
};

constexpr WindowKind Kinds[] = {
  { "osmesa", "vtkOSOpenGLRenderWindow" },
  { "egl", "vtkEGLRenderWindow" },
  { "x", "vtkXOpenGLRenderWindow" },
};

constexpr const char* WindowVariable = "VTK_DEFAULT_OPENGL_WINDOW";

// Returns the text after `key` in VTK's report, up to the end of the line.
std::string FindCapability(const std::string& report, const std::string& key)
{
  const std::size_t at = report.find(key);
  if (at == std::string::npos)
  {
    return std::string();
  }
  const std::size_t begin = report.find_first_not_of(' ', at + key.size());
  return report.substr(begin, report.find('\n', begin) - begin);
}

// Renders a small image; returns a description of the window, or an empty string if OpenGL fails.
std::string DescribeWindow()
{
  vtkNew<vtkRenderWindow> window;
  window->SetOffScreenRendering(1);
  window->SetShowWindow(false);
  window->SetSize(8, 8);
  vtkNew<vtkRenderer> renderer;
  window->AddRenderer(renderer);
  window->Render();
  if (!window->SupportsOpenGL())
  {
    return std::string();
  }
  const char* report = window->ReportCapabilities();
  const std::string capabilities = report ? report : "";
  return std::string(window->GetClassName()) + ", OpenGL " +
    FindCapability(capabilities, "OpenGL version string:") + ", " +
    FindCapability(capabilities, "OpenGL renderer string:");
}

// Throws if other threads exist: fork() would leave the locks that they hold locked in the child. Checked
// with AddressSanitizer only, because users may preload libraries that start threads.
void CheckIsOnlyThread()
{
#if defined(__SANITIZE_ADDRESS__)
  const std::filesystem::directory_iterator threads("/proc/self/task");
  if (std::distance(begin(threads), end(threads)) > 1)
  {
    throw std::logic_error("ChooseWindow() must be called before threads are started");
  }
#endif
}

// Tests a window in a separate process, because some versions of VTK exit if the window cannot be created.
// Returns a description, or an empty string on failure.
std::string TryWindow(const char* className)
{
  CheckIsOnlyThread();
  int descriptors[2];
  if (pipe(descriptors) != 0)
  {
    return std::string();
  }
  const pid_t child = fork();
  if (child == 0)
  {
    if (className)
    {
      setenv(WindowVariable, className, 1);
    }
    const std::string description = DescribeWindow();
    const auto written = write(descriptors[1], description.data(), description.size());
    _exit(written == static_cast<ssize_t>(description.size()) ? 0 : 1);
  }
  close(descriptors[1]);
  std::string description;
  char buffer[512];
  for (ssize_t count = 0; (count = read(descriptors[0], buffer, sizeof(buffer))) > 0;)
  {
    description.append(buffer, static_cast<std::size_t>(count));
  }
  close(descriptors[0]);
  int state = 0;
  const bool ended = child > 0 && waitpid(child, &state, 0) == child;
  return ended && WIFEXITED(state) && WEXITSTATUS(state) == 0 ? description : std::string();
}

// VTK may silently fall back to another class of window than the requested one.
bool IsOfClass(const std::string& description, const char* className)
{
  return description.rfind(className, 0) == 0;
}

}

std::vector<WindowReport> TryWindows()
{
  std::vector<WindowReport> reports;
  for (const WindowKind& kind : Kinds)
  {
    const std::string description = TryWindow(kind.Class);
    const bool works = IsOfClass(description, kind.Class);
    reports.push_back({ kind.Name, works, works ? description : "not available" });
  }
  return reports;
}

void ChooseWindow(
  const std::string& window, const std::string& option, const std::string& otherwise)
{
  if (window == "auto" && std::getenv(WindowVariable))
  {
    if (TryWindow(nullptr).empty())
    {
      throw CommandError(Unavailable,
        option + ": the window that $" + WindowVariable +
          " selects provides no OpenGL; unset the variable, or use " + otherwise);
    }
    return;
  }
  for (const WindowKind& kind : Kinds)
  {
    if ((window == "auto" || window == kind.Name) && IsOfClass(TryWindow(kind.Class), kind.Class))
    {
      setenv(WindowVariable, kind.Class, 1);
      return;
    }
  }
  throw CommandError(Unavailable,
    option + ": OpenGL is not available with --window " + window +
      "; install libosmesa6 or libegl1, start an X server, or use " + otherwise);
}

void ChooseWindowFor(const RenderOptions& options)
{
  if (options.Engine == "raster")
  {
    ChooseWindow(options.Window);
  }
  else if (options.Gatherer == "cube-map" && (options.AmbientOcclusion || options.Light.Indirect))
  {
    ChooseWindow(options.Window, "--gatherer cube-map", "--gatherer rays");
  }
}

}
