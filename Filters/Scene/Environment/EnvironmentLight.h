// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Light that an image of the surroundings sheds on physically based materials, without occlusion:
// VTK's image-based lighting. The diffuse part is a polynomial of the normal (Ramamoorthi and
// Hanrahan, An Efficient Representation for Irradiance Environment Maps, 2001); the specular part
// is the split sum of Karis, Real Shading in Unreal Engine 4, 2013, at VTK's levels of roughness.
#ifndef penumbra_EnvironmentLight_h
#define penumbra_EnvironmentLight_h

#include "vtkPenumbraFiltersSceneModule.h" // for export macro, which tests need

#include <glm/glm.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <vector>

namespace penumbra
{

/// Image with radiances, bottom row first.
struct RadianceImage
{
  int Width = 0;
  int Height = 0;
  std::vector<glm::vec3> Texels;

  const glm::vec3& At(int column, int row) const
  {
    return this->Texels[static_cast<std::size_t>(row) * this->Width + column];
  }
};

class VTKPENUMBRAFILTERSSCENE_EXPORT EnvironmentLight
{
public:
  /// @param faces     Faces of a cube (+x, -x, +y, -y, +z, -z, oriented as in OpenGL), or one image
  ///                  of all directions, whose coordinates are longitude and latitude.
  /// @param fromScene Converts directions to the coordinates of the images.
  /// @param exponent  Power of the values of the images that is their radiance in the diffuse part.
  /// @param version   Version of the images, for the caller.
  EnvironmentLight(std::vector<RadianceImage> faces, const glm::dmat3& fromScene, float exponent,
    std::uint64_t version);

  /// Makes the tables that the functions below need, once.
  void Prepare();

  /// Returns the irradiance on a plane with the unit normal `normal`, divided by pi.
  glm::vec3 ComputeIrradiance(glm::vec3 normal) const;

  /// Returns the mean radiance of the directions that a microfacet surface of a roughness in [0, 1]
  /// reflects about the unit vector `direction`.
  glm::vec3 ComputeReflection(glm::vec3 direction, float roughness) const;

  /// Returns the factors of the Fresnel terms at normal and at grazing incidence in the part of a
  /// uniform radiance that a surface reflects. `cosine`: between normal and view, in [0, 1].
  glm::vec2 ComputeReflectance(float cosine, float roughness) const;

  std::uint64_t GetVersion() const { return this->Version; }
  const glm::dmat3& GetFromScene() const { return this->FromScene; }

private:
  glm::vec3 SampleImages(glm::vec3 direction) const;
  RadianceImage Reduce(float exponent) const;
  static RadianceImage Prefilter(const RadianceImage& source, int level);
  void FitIrradiance(const RadianceImage& image);
  void TabulateReflectance();

  static constexpr int Levels = 5; ///< of roughness, the first is SampleImages()

  std::vector<RadianceImage> Faces;
  glm::dmat3 FromScene;
  float Exponent;
  std::uint64_t Version;
  std::once_flag Prepared;
  std::array<RadianceImage, Levels> Prefiltered; ///< all directions; the first is empty
  std::array<glm::vec3, 9> Irradiance{};         ///< coefficients of the polynomial
  std::vector<glm::vec2> Reflectances;
};

}
#endif
