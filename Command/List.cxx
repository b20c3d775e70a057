// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// penumbra list: prints the formats, colormaps, engines and kernels of this version.
#include "Files/ImageFiles.h"
#include "Input/Readers.h"
#include "Options/Colormaps.h"
#include "Parsing/Arguments.h"
#include "Processes/CommandError.h"
#include "Subcommands.h"

#include "vtkPenumbraKernels.h"

#include <iomanip>
#include <iostream>

namespace penumbra
{

namespace
{

int List()
{
  std::cout << "Readers\n" << std::left;
  for (const ReaderRow& row : Readers())
  {
    std::cout << "  " << std::setw(26) << Join(row.Extensions, " ") << std::setw(38) << row.Format
              << row.ReaderClass << "\n";
  }
  std::cout << "\nImages\n  " << ImageExtensions() << "\n\nVector graphics\n  .svg .pdf"
            << "\n\nColormaps\n ";
  for (const std::string& name : ColormapNames())
  {
    std::cout << " " << name;
  }
  std::cout << "\n\nEngines\n"
               "  ray       antialiased ray casting; needs no OpenGL\n"
               "  raster    VTK's OpenGL, up to 8 samples per pixel\n"
               "\nKernels of --ambient-occlusion (raster)\n"
               "  automatic traced";
  for (int kernel = 0; kernel < vtkPenumbraKernels::GetNumberOfKernels(); ++kernel)
  {
    std::cout << " " << vtkPenumbraKernels::GetName(kernel);
  }
  std::cout << "\n"
               "\nWindows of the raster engine (`penumbra info` prints those that work here)\n"
               "  osmesa egl x\n";
  return Done;
}

}

Action DeclareList(const CommandLine& program)
{
  program.AddSubcommand("list", "List readers, image formats, colormaps and engines");
  return List;
}

}
