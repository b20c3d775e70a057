// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Runs an importer of VTK without a graphics context.
#ifndef penumbra_ImporterScene_h
#define penumbra_ImporterScene_h

class vtkImporter;
class vtkRenderer;

namespace penumbra
{

/// Runs `importer` and returns the renderer that it fills. The importer keeps it alive.
vtkRenderer* RunImporter(vtkImporter* importer);

}
#endif
