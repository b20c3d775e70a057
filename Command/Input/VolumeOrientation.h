// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Position, spacing and axes of volumes, which the readers of VTK ignore or transpose. The
// coordinates are those that the file names: RAS of NIfTI, LPS of MetaImage, the space of NRRD.
#ifndef penumbra_VolumeOrientation_h
#define penumbra_VolumeOrientation_h

#include "vtkSmartPointer.h"

#include <string>
#include <vector>

class vtkAlgorithm;
class vtkDataObject;

namespace penumbra
{

/// Makes a reader that finds the axis of components by the header instead of its size.
vtkSmartPointer<vtkAlgorithm> MakeNrrdReader(const std::string& path);

/// Makes a reader. Throws CommandError for more than three dimensions, at which it crashes.
vtkSmartPointer<vtkAlgorithm> MakeMetaImageReader(const std::string& path);

/// Each sets origin, spacing and direction of `image`, as read by `reader` from `path`. Throws
/// CommandError if axes are parallel.
void OrientMetaImage(vtkAlgorithm* reader, const std::string& path, vtkDataObject* image,
  std::vector<std::string>& warnings);
void OrientNifti(vtkAlgorithm* reader, const std::string& path, vtkDataObject* image,
  std::vector<std::string>& warnings);
void OrientNrrd(vtkAlgorithm* reader, const std::string& path, vtkDataObject* image,
  std::vector<std::string>& warnings);

}
#endif
