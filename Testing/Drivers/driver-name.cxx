// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Prints the renderer string of OpenGL in the default window of VTK, which names the driver, or nothing if
// no window can be created.
//
// With the argument --error, it calls OpenGL with an invalid value first. With --uninitialized, it compiles
// a shader that reads an uninitialized variable. run-on-driver has to find both in the output of the driver.
#include "vtkNew.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkOpenGLShaderCache.h"
#include "vtkOpenGLState.h"
#include "vtkRenderWindow.h"
#include "vtkRenderer.h"
#include "vtkShaderProgram.h"

#include <iostream>
#include <sstream>
#include <string>

namespace
{

std::string GetRenderer(vtkRenderWindow* window)
{
  const char* report = window->SupportsOpenGL() ? window->ReportCapabilities() : nullptr;
  std::istringstream lines(report ? report : "");
  const std::string title = "OpenGL renderer string:";
  for (std::string line; std::getline(lines, line);)
  {
    if (const auto at = line.find(title); at != std::string::npos)
    {
      return line.substr(line.find_first_not_of(' ', at + title.size()));
    }
  }
  return std::string();
}

void CompileUninitialized(vtkOpenGLRenderWindow* window)
{
  window->GetShaderCache()->ReadyShaderProgram(
    "//VTK::System::Dec\nin vec4 vertexMC;\nvoid main() { gl_Position = vertexMC; }\n",
    "//VTK::System::Dec\n//VTK::Output::Dec\n"
    "void main() { vec4 color; gl_FragData[0] = color; }\n",
    "");
}

}

int main(int argc, char** argv)
{
  vtkNew<vtkRenderWindow> window;
  window->SetOffScreenRendering(1);
  window->SetSize(8, 8);
  vtkNew<vtkRenderer> renderer;
  window->AddRenderer(renderer);
  window->Render();
  const std::string name = GetRenderer(window);
  const std::string option = argc > 1 ? argv[1] : "";
  auto* context = vtkOpenGLRenderWindow::SafeDownCast(window);
  if (!name.empty() && context && option == "--error")
  {
    context->GetState()->vtkglDepthFunc(0);
  }
  if (!name.empty() && context && option == "--uninitialized")
  {
    CompileUninitialized(context);
  }
  std::cout << name << "\n";
  return name.empty() ? 1 : 0;
}
