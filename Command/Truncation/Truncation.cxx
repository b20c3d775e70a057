// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "Truncation.h"

#include "FileCursor.h"
#include "FormatScanners.h"

#include "Files/FileExtension.h"

#include <algorithm>
#include <iterator>

namespace penumbra
{

namespace
{

void Scan(const std::string& path)
{
  const std::string extension = LowerExtension(path);
  const char* known[] = { ".vtk", ".pts", ".nrrd", ".nhdr", ".inp", ".slc", ".tec", ".tp", ".case",
    ".encas" };
  if (std::find(std::begin(known), std::end(known), extension) == std::end(known))
  {
    return;
  }
  FileCursor file(path);
  if (extension == ".vtk")
  {
    ScanLegacyVTK(file);
  }
  else if (extension == ".pts")
  {
    ScanPts(file);
  }
  else if (extension == ".nrrd" || extension == ".nhdr")
  {
    ScanNrrd(file, path);
  }
  else if (extension == ".inp")
  {
    ScanUcd(file);
  }
  else if (extension == ".slc")
  {
    ScanSlc(file);
  }
  else if (extension == ".tec" || extension == ".tp")
  {
    ScanTecplot(file);
  }
  else
  {
    ScanEnSight(file, path);
  }
}

}

std::string FindTruncation(const std::string& path)
{
  try
  {
    Scan(path);
  }
  catch (const TruncatedFile& file)
  {
    return file.Item;
  }
  catch (const UnknownStructure&)
  {
    // The reader reports errors of unknown structures.
  }
  return std::string();
}

}
