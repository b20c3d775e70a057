// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Maps scalars to colors and converts textures.
#ifndef penumbra_SceneExtractionColors_h
#define penumbra_SceneExtractionColors_h

#include "Tessellation/SceneExtractionItem.h"

#include "vtkMapper.h"
#include "vtkNew.h"

#include <memory>
#include <string>
#include <vector>

class vtkDataSet;
class vtkProp;
class vtkProperty;
class vtkTexture;

namespace penumbra
{

/// Maps scalars with the settings of another mapper, on any data set, without modifying that
/// mapper.
class ScalarMapper : public vtkMapper
{
public:
  static ScalarMapper* New();
  vtkTypeMacro(ScalarMapper, vtkMapper);

  void Render(vtkRenderer*, vtkActor*) override {}

  /// Returns the colors of `data` for the settings of this mapper (see ShallowCopy()).
  Coloring Map(vtkDataSet* data);

  /// Returns the array of `data` that is set as input array `which` of `algorithm`.
  vtkDataArray* FindArray(vtkAlgorithm* algorithm, int which, vtkDataSet* data);

protected:
  int FillInputPortInformation(int port, vtkInformation* info) override;
};

/// Converts a texture. Returns null if it has no input, or with a warning if it is not supported.
std::shared_ptr<const Texture> MakeTexture(
  vtkTexture* texture, const std::string& name, std::vector<std::string>& warnings);

/// Converts the image of a texture at one of its input ports, such as a face of a cube map. Returns
/// null, with a warning, if it is missing or empty.
std::shared_ptr<Texture> MakeTextureFace(
  vtkTexture* texture, int port, const std::string& name, std::vector<std::string>& warnings);

/// Converts texels with 1 to 4 components (luminance, luminance and alpha, RGB, RGBA), bottom row
/// first. Returns null if there are too few.
std::shared_ptr<Texture> MakeTexture(vtkUnsignedCharArray* colors, int width, int height);

/// Returns the textures of a physically based material besides its base color; null if it has none.
std::shared_ptr<const MaterialTextures> MakeMaterialTextures(
  vtkProperty* property, const std::string& name, std::vector<std::string>& warnings);

/// Returns `data` with texture coordinates that are transformed by the texture transform of `prop`,
/// or `data` if there is none.
vtkSmartPointer<vtkPolyData> TransformTextureCoordinates(vtkPolyData* data, vtkProp* prop);

/// Returns `data` with texture coordinates whose polygons do not cross from 1 to 0 in the seamless
/// directions of `mapper` (vtkPolyDataMapper::SeamlessU and SeamlessV). Points of the seam are
/// duplicated. Returns `data` if there is nothing to do.
/// Source: Tarini, Cylindrical and Toroidal Parameterizations Without Vertex Seams, JGT 16(3),
/// 2012.
vtkSmartPointer<vtkPolyData> UnwrapTextureCoordinates(vtkPolyData* data, vtkMapper* mapper);

}
#endif
