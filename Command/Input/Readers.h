// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// The table of input formats: extensions, name, reader.
#ifndef penumbra_Readers_h
#define penumbra_Readers_h

#include "vtkSmartPointer.h"

#include <optional>
#include <string>
#include <vector>

class vtkAlgorithm;
class vtkDataObject;

namespace penumbra
{

struct Appearance;

struct ReaderRow
{
  std::vector<std::string> Extensions; ///< lower case, with the dot
  std::string Format;
  std::string ReaderClass;
  vtkSmartPointer<vtkAlgorithm> (*Make)(const std::string& path); ///< null: Read
  vtkSmartPointer<vtkDataObject> (*Read)(const std::string& path) = nullptr;
  /// Corrects what was read, and appends warnings without the name of the file; null: nothing to correct. `reader`:
  /// the algorithm of Make, or null.
  void (*Complete)(vtkAlgorithm* reader, const std::string& path, vtkDataObject* data,
    std::vector<std::string>& warnings) = nullptr;
  /// Returns a temporary file to read instead, or an empty path; null: reads the file. May set the
  /// Copy of an appearance that is not null, and append warnings without the name of the file.
  std::string (*Prepare)(
    const std::string& path, Appearance* appearance, std::vector<std::string>& warnings) = nullptr;
  /// Returns whether the contents are of this format; null: the extension decides.
  bool (*Recognizes)(const std::string& path) = nullptr;
  /// Reads the appearance of the surfaces `data`, see Appearance.h; null: the format has none.
  vtkSmartPointer<vtkDataObject> (*Import)(
    const std::string& path, vtkDataObject* data, Appearance& appearance) = nullptr;
};

const std::vector<ReaderRow>& Readers();

/// Reads a file, at a time if it has time steps; none: the first. Appends warnings without the name of the file.
/// Throws CommandError, naming the file, if it cannot be read completely.
vtkSmartPointer<vtkDataObject> ReadFile(
  const std::string& path, std::optional<double> time, std::vector<std::string>& warnings);

/// Reads a file as ReadFile() and its appearance. Returns the data sets to which
/// Appearance::Actors belong.
vtkSmartPointer<vtkDataObject> ReadScene(
  const std::string& path, std::optional<double> time, Appearance& appearance);

/// Returns whether files of the format of `path` may have lights and cameras.
bool MayHaveLights(const std::string& path);

/// Returns the times of the steps of a file or of a file series in ascending order. Throws
/// CommandError, naming the file, if they cannot be read.
std::vector<double> ReadTimes(const std::string& path);

}
#endif
