// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Winding of polygons that a mirroring transform has reversed.
#ifndef penumbra_WindingCorrection_h
#define penumbra_WindingCorrection_h

#include <string>
#include <vector>

class vtkAlgorithm;
class vtkDataObject;

namespace penumbra
{

/// Reverses the polygons of each data set in which most of them face away from their point normals, or,
/// without normals, which the transform of its node mirrors. vtkGLTFReader leaves them as they are;
/// lighting would negate the normals, and materials hide the front faces.
void CorrectWindings(vtkAlgorithm* reader, const std::string& path, vtkDataObject* data,
  std::vector<std::string>& warnings);

}
#endif
