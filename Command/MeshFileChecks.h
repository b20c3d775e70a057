// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// What VTK's readers overlook: files that end early or hold more than the reader took.
#ifndef penumbra_MeshFileChecks_h
#define penumbra_MeshFileChecks_h

#include <string>

class vtkDataObject;

namespace penumbra
{

/// Throws Failure when `data`, as read from `path`, is less than the file's header promises.
void CheckAgainstHeader(const std::string& path, vtkDataObject* data);

}
#endif
