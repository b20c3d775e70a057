// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "Truncation.h"

#include "FileCursor.h"
#include "FormatScanners.h"

#include "Files/FileExtension.h"

#include <map>
#include <string>

namespace penumbra
{

namespace
{

using Scanner = void (*)(FileCursor& file, const std::string& path);

void Scan(const std::string& path)
{
  static const std::map<std::string, Scanner> scanners = { { ".vtk", ScanLegacyVTK },
    { ".nrrd", ScanNrrd }, { ".nhdr", ScanNrrd }, { ".inp", ScanUcd }, { ".slc", ScanSlc },
    { ".tec", ScanTecplot }, { ".tp", ScanTecplot }, { ".case", ScanEnSight },
    { ".encas", ScanEnSight } };
  const auto found = scanners.find(LowerExtension(path));
  if (found != scanners.end())
  {
    FileCursor file(path);
    found->second(file, path);
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
