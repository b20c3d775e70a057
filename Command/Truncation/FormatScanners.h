// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Scanners of file formats: each reads the file at `path` from its beginning and throws TruncatedFile if it
// ends too early, or UnknownStructure if the structure is unknown.
#ifndef penumbra_FormatScanners_h
#define penumbra_FormatScanners_h

#include <string>

namespace penumbra
{

class FileCursor;

void ScanLegacyVTK(FileCursor& file, const std::string& path);

/// .nrrd and .nhdr, with a separate data file.
void ScanNrrd(FileCursor& file, const std::string& path);

/// AVS .inp, text and binary.
void ScanUcd(FileCursor& file, const std::string& path);

/// .slc: a volume in slices.
void ScanSlc(FileCursor& file, const std::string& path);

/// Tecplot text files, first zone.
void ScanTecplot(FileCursor& file, const std::string& path);

/// An EnSight case and its geometry as text.
void ScanEnSight(FileCursor& file, const std::string& path);

}
#endif
