// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// From a picture file to an environment that light comes from.
#ifndef penumbra_EnvironmentFile_h
#define penumbra_EnvironmentFile_h

#include "Parsing/Arguments.h"

#include "vtkSmartPointer.h"

#include <optional>
#include <string>

class vtkPenumbraEnvironment;

namespace penumbra
{

/// Radiance's .hdr or any picture that the program reads; `up`: where its upper border lies. Throws
/// Failure, naming the file, when it cannot be read or is no picture of light.
vtkSmartPointer<vtkPenumbraEnvironment> ReadEnvironment(
  const std::string& path, const std::optional<Vector3>& up);

/// Declares the options that ask for it; `group`: of the help, or empty.
void AddEnvironmentOptions(
  CLI::App& app, std::string& path, std::optional<Vector3>& up, const std::string& group);

}
#endif
