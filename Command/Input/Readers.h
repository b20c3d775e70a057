// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// The one table of formats that the program reads: extension, name, VTK reader.
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

/// Everything in the file. Throws Failure, naming the file, when it cannot be read whole.
vtkSmartPointer<vtkDataObject> ReadFile(const std::string& path);

}
#endif
