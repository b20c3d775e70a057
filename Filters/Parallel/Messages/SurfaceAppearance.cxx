// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "SurfaceAppearance.h"

#include "Surface.h"

namespace penumbra
{
namespace
{

/// Calls bytes(members...) for the members of a material, which has padding bytes.
template <typename MaterialT, typename Bytes>
void VisitMaterial(MaterialT& m, Bytes& bytes)
{
  bytes(m.AmbientColor, m.DiffuseColor, m.SpecularColor, m.Ambient, m.Diffuse, m.Specular,
    m.SpecularPower, m.Opacity, m.Lighting, m.PhysicallyBased, m.Metallic, m.Roughness,
    m.BaseReflectance, m.EdgeTint, m.Anisotropy, m.AnisotropyRotation, m.NormalScale,
    m.OcclusionStrength, m.EmissiveFactor, m.CoatStrength, m.CoatRoughness, m.CoatReflectance,
    m.CoatColor, m.CoatNormalScale);
}

/// Calls bytes(members...) for the plain members of a surface.
template <typename SurfaceT, typename Bytes>
void VisitPlainMembers(SurfaceT& s, Bytes& bytes)
{
  bytes(s.ObjectId, s.Part, s.HasFlatEnds, s.NormalRule, s.TextureOnBackfaces, s.HasBackMaterial);
  VisitMaterial(s.Front, bytes);
  VisitMaterial(s.Back, bytes);
  bytes(s.Backfaces, s.Frontfaces, s.ScalarColoring, s.IsLineOrPoint, s.EdgeWidth, s.IsAdditive,
    s.ForceOpaque, s.HidesLines, s.DepthRank, s.HasHiddenLines);
}

/// Calls bytes(members...) for the members of a texture.
template <typename TextureT, typename Bytes>
void VisitTexture(TextureT& t, Bytes& bytes)
{
  bytes(t.Width, t.Height, t.Texels, t.IsSRGB, t.Interpolate, t.Wrap, t.BorderColor);
}

/// Calls visit(texture) for the textures of a surface, some of which may be null. `details` are those of
/// DetailTextures.
template <typename SurfaceT, typename DetailsT, typename Visit>
void VisitTextures(SurfaceT& s, DetailsT& details, const Visit& visit)
{
  visit(s.ColorTexture);
  visit(s.LitTexture);
  visit(s.BaseColorTexture);
  visit(details.Normal);
  visit(details.OcclusionRoughnessMetallic);
  visit(details.Emission);
  visit(details.Anisotropy);
  visit(details.CoatNormal);
}

/// Returns a hash of the contents of a texture; 0 for null.
std::uint64_t HashTexture(const std::shared_ptr<const Texture>& texture)
{
  if (!texture)
  {
    return 0;
  }
  ByteWriter bytes;
  AddTexture(*texture, bytes);
  std::uint64_t hash = 0xcbf29ce484222325ull;
  for (const char byte : bytes.Take())
  {
    hash = (hash ^ static_cast<unsigned char>(byte)) * 0x100000001b3ull;
  }
  return hash == 0 ? 1 : hash;
}

const MaterialTextures& GetDetails(const Surface& surface)
{
  static const MaterialTextures none;
  return surface.DetailTextures ? *surface.DetailTextures : none;
}

}

std::string DescribeAppearance(const Surface& surface)
{
  ByteWriter bytes;
  VisitPlainMembers(surface, bytes);
  bytes.Add(surface.DetailTextures != nullptr);
  VisitTextures(surface, GetDetails(surface),
    [&](const std::shared_ptr<const Texture>& texture) { bytes.Add(HashTexture(texture)); });
  for (const bool isUsed : { surface.Instances != nullptr, surface.Segments.empty(),
         surface.Normals.empty(), surface.TriangleNormals.empty(), surface.PointColors.empty(),
         surface.CellColors.empty(), surface.ColorCoordinates.empty(), surface.Tangents.empty(),
         surface.TextureCoordinates.empty() })
  {
    bytes.Add(isUsed);
  }
  const bool hasOneRadius = surface.Radii.size() == 1;
  bytes.Add(static_cast<char>(!surface.IsRound() ? 0 : hasOneRadius ? 1 : 2));
  bytes.Add(hasOneRadius ? surface.Radii[0] : 0.f);
  return bytes.Take();
}

Surface MakeEmptySurface(const std::string& appearance, const TextureMap& textures)
{
  static const auto texel = std::make_shared<const Texture>(Texture{ 1, 1, { glm::u8vec4(255) } });
  Surface surface;
  ByteReader bytes(appearance);
  VisitPlainMembers(surface, bytes);
  const bool hasDetails = bytes.Get<bool>();
  MaterialTextures details;
  VisitTextures(surface, details, [&](std::shared_ptr<const Texture>& texture) {
    const auto hash = bytes.Get<std::uint64_t>();
    const auto found = textures.find(hash);
    texture = hash == 0 ? nullptr : found != textures.end() ? found->second : texel;
  });
  if (hasDetails)
  {
    surface.DetailTextures = std::make_shared<const MaterialTextures>(details);
  }
  if (bytes.Get<bool>())
  {
    surface.Instances = std::make_shared<const SurfaceInstances>();
  }
  for (int array = 0; array < 8; ++array)
  {
    bytes.Get<bool>();
  }
  const auto radii = bytes.Get<char>();
  const auto radius = bytes.Get<float>();
  if (radii != 0)
  {
    surface.Radii.push_back(radius);
  }
  return surface;
}

void CollectTextures(const Surface& surface, TextureMap& textures)
{
  VisitTextures(surface, GetDetails(surface), [&](const std::shared_ptr<const Texture>& texture) {
    if (texture)
    {
      textures[HashTexture(texture)] = texture;
    }
  });
}

void AddTexture(const Texture& texture, ByteWriter& bytes)
{
  VisitTexture(texture, bytes);
}

std::shared_ptr<const Texture> GetTexture(ByteReader& bytes)
{
  auto texture = std::make_shared<Texture>();
  VisitTexture(*texture, bytes);
  return texture;
}

}
