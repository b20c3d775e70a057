// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// The table of input formats: extensions, name, VTK reader.
#ifndef penumbra_Readers_h
#define penumbra_Readers_h

#include "vtkSmartPointer.h"

#include <string>
#include <vector>

class vtkAlgorithm;
class vtkDataObject;

namespace penumbra
{

struct ReaderRow
{
  std::vector<std::string> Extensions; ///< lower case, with the dot
  std::string Format;
  std::string ReaderClass;
  vtkSmartPointer<vtkAlgorithm> (*Make)(const std::string& path);
};

const std::vector<ReaderRow>& Readers();

/// Reads a file. Throws CommandError, naming the file, if it cannot be read completely.
vtkSmartPointer<vtkDataObject> ReadFile(const std::string& path);

}
#endif
