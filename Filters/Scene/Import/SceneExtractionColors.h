// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// What mappers make of scalars, and textures.
#ifndef penumbra_SceneExtractionColors_h
#define penumbra_SceneExtractionColors_h

#include "Tessellation/SceneExtractionItem.h"

#include "vtkMapper.h"
#include "vtkNew.h"

#include <memory>
#include <string>
#include <vector>

class vtkDataSet;
class vtkTexture;

namespace penumbra
{

/// Maps scalars as a mapper of the user's would, on any data set, and leaves that mapper alone.
class ScalarMapper : public vtkMapper
{
public:
  static ScalarMapper* New();
  vtkTypeMacro(ScalarMapper, vtkMapper);

  void Render(vtkRenderer*, vtkActor*) override {}

  /// The colours of `data` under the settings of this mapper (see ShallowCopy()).
  Coloring Map(vtkDataSet* data);

  /// The array of `data` that `algorithm` was told to process as its input array `which`.
  vtkDataArray* FindArray(vtkAlgorithm* algorithm, int which, vtkDataSet* data);

protected:
  int FillInputPortInformation(int port, vtkInformation* info) override;
};

/// Null where there is no picture, with a warning where it cannot be used.
std::shared_ptr<const Texture> MakeTexture(
  vtkTexture* texture, const std::string& name, std::vector<std::string>& warnings);

}
#endif
