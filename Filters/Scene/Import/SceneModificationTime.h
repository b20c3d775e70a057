// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Modification time of a scene: the latest time of all objects that SceneExtraction reads. The
// times of the renderer and its props do not include many of them.
#ifndef penumbra_SceneModificationTime_h
#define penumbra_SceneModificationTime_h

#include "vtkPenumbraFiltersSceneModule.h" // for export macro
#include "vtkType.h"

class vtkProp;
class vtkRenderer;

namespace penumbra
{

/// Returns the modification time of the scene, without executing the pipelines of its mappers.
VTKPENUMBRAFILTERSSCENE_EXPORT vtkMTimeType GetSceneMTime(vtkRenderer* renderer);

/// Same as GetSceneMTime(), but without the camera, the lights and the overlays.
VTKPENUMBRAFILTERSSCENE_EXPORT vtkMTimeType GetGeometryMTime(vtkRenderer* renderer);

/// Same as GetSceneMTime(), but of one prop and its parts.
vtkMTimeType GetPropMTime(vtkProp* prop);

}
#endif
