// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Name of the cell array of a subdivided surface that holds the face of a cell, or the cell in two
// dimensions, of which each triangle is a part. No edges are drawn between parts of one face. The name
// is the one that vtkRecoverGeometryWireframe requires before VTK 9.3.
#ifndef penumbra_CurvedFaceIds_h
#define penumbra_CurvedFaceIds_h

namespace penumbra
{

constexpr const char* CurvedFaceIds = "vtkOriginalFaceIds";

}
#endif
