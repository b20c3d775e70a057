// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// When a scene last changed: the latest time of everything that SceneExtraction reads, much of which
// neither the renderer nor its props answer for.
#ifndef penumbra_SceneModificationTime_h
#define penumbra_SceneModificationTime_h

#include "vtkPenumbraFiltersSceneModule.h" // for export macro
#include "vtkType.h"

class vtkRenderer;

namespace penumbra
{

/// Brings the pipelines that feed the scene up to date first.
VTKPENUMBRAFILTERSSCENE_EXPORT vtkMTimeType GetSceneMTime(vtkRenderer* renderer);

/// The same of what stands in the scene alone: the eye, the lights and overlays may have changed.
VTKPENUMBRAFILTERSSCENE_EXPORT vtkMTimeType GetGeometryMTime(vtkRenderer* renderer);

}
#endif
