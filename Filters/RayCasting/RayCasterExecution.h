// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// An image of vtkPenumbraRayCaster that grows over several calls.
#ifndef penumbra_RayCasterExecution_h
#define penumbra_RayCasterExecution_h

#include "RayCasterInternals.h"

#include "Image/GrowingImage.h"
#include "RenderJob.h"
#include "ToleranceWarning.h"

#include "vtkImageData.h"

#include <memory>

/// An image that several calls of RenderFor() continue.
struct vtkPenumbraRayCaster::Internals::GrowingState
{
  std::unique_ptr<penumbra::RenderJob> Job;
  std::unique_ptr<penumbra::GrowingImage> Image; ///< null if it is complete
  vtkSmartPointer<vtkImageData> Final;           ///< the complete image
  vtkMTimeType SceneTime = 0;
};

#endif
