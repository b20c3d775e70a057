// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Materials of Wavefront MTL files.
#ifndef penumbra_MtlFile_h
#define penumbra_MtlFile_h

#include <array>
#include <map>
#include <string>

namespace penumbra
{

/// A material as vtkOBJImporter reads it, except that ambient colors are not used, because a scene has
/// no ambient light, and that there are highlights only with a specular color and an exponent.
struct MtlMaterial
{
  std::array<double, 3> Diffuse{ 0.8, 0.8, 0.8 };
  std::array<double, 3> Specular{ 0.0, 0.0, 0.0 };
  std::array<double, 3> Emission{ 0.0, 0.0, 0.0 };
  double SpecularExponent = 0.0; ///< of Blinn's model
  double Opacity = 1.0;
  int Illumination = 2;
  std::string Texture;        ///< path of map_Kd; empty: none
  std::string OpacityTexture; ///< path of map_d, which is not drawn; empty: none
  std::array<double, 2> TextureScale{ 1.0, 1.0 };
  std::array<double, 2> TextureOffset{ 0.0, 0.0 };
};

using MtlMaterials = std::map<std::string, MtlMaterial>;

/// Adds the materials of the file at `path` to `materials`. Lines that cannot be parsed are skipped.
/// Returns false if the file cannot be read.
bool ReadMtl(const std::string& path, MtlMaterials& materials);

}
#endif
