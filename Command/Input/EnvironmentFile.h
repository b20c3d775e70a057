// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Reads environment images.
#ifndef penumbra_EnvironmentFile_h
#define penumbra_EnvironmentFile_h

#include "Parsing/Arguments.h"

#include "vtkSmartPointer.h"

#include <optional>
#include <string>

class vtkPenumbraEnvironment;

namespace penumbra
{

/// Reads a Radiance .hdr file or any supported image. `up`: direction of its upper edge. Throws
/// CommandError, naming the file, if it cannot be read or is not a valid environment.
vtkSmartPointer<vtkPenumbraEnvironment> ReadEnvironment(
  const std::string& path, const std::optional<Vector3>& up);

/// Adds --hdri-file and --hdri-up.
void AddEnvironmentOptions(const CommandLine& app, std::string& path, std::optional<Vector3>& up);

}
#endif
