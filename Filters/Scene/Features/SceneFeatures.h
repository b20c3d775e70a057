// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Table of VTK's rendering features and how scene extraction handles each. It is the only source of
// the warnings, of the page Documentation/reference/VTKFeatures.md, and of the test that compares
// each feature with VTK's image.
#ifndef penumbra_SceneFeatures_h
#define penumbra_SceneFeatures_h

#include "vtkPenumbraFiltersSceneModule.h" // for export macro, which tests need

#include <string>
#include <vector>

namespace penumbra
{

/// Features of VTK's renderer, in the order of the table.
enum class Feature
{
  Polygons,
  TriangleStrips,
  LinesAndVertices,
  Interpolation,
  Specular,
  Representations,
  VertexAndEdgeVisibility,
  ScalarColoring,
  CellScalars,
  DirectScalars,
  Opacity,
  BackfaceProperty,
  Culling,
  ClippingPlanes,
  CoincidentTopology,
  Assemblies,
  Glyphs,
  Blocks,
  BlockTextures,
  GhostCells,
  PointShape,
  LineJoin,
  PointsAsSpheres,
  LinesAsTubes,
  PhysicallyBased,
  NormalTexture,
  MaterialTexture,
  EmissiveTexture,
  Anisotropy,
  ClearCoat,
  MultiTexturing,
  Textures,
  TextureWrap,
  TextureTransform,
  TextureMipmap,
  TextureColorSpace,
  TextureSeams,
  TextureCubeMap,
  ForceOpaque,
  ForceTranslucent,
  CustomShaders,
  PhysicalCoordinates,
  CoordinateSystems,
  Selection,
  DerivedMappers,
  PointSplats,
  SplatShaders,
  Imposters,
  ShaderMappers,
  ImageSlices,
  ObliqueImageSlices,
  TextActors,
  ScalarBars,
  BillboardText,
  Text3D,
  AxesActors,
  CubeAxes,
  CubeAxes2D,
  AxisActors,
  Skyboxes,
  LevelsOfDetail,
  PropFollowers,
  Actors2D,
  Labels,
  VisiblePoints,
  FilteredVisiblePoints,
  Captions,
  Legends,
  Axes2D,
  CornerTexts,
  Widgets,
  LightActors,
  Charts,
  ChartTextures,
  OtherProps,
  Volumes,
  Cameras,
  CameraTransforms,
  CameraShear,
  ClippingRange,
  StereoEyes,
  Stereo,
  Lights,
  Background,
  BackgroundAlpha,
  BackgroundGradients,
  BackgroundImage,
  Layers,
  DepthPeeling,
  HiddenLineRemoval,
  RenderPass,
  RendererOcclusion,
  RendererShadows,
  ImageBasedLighting,
  NumberOfFeatures
};

/// Row of the table.
struct FeatureRow
{
  enum class Levels
  {
    Drawn,        ///< as VTK draws it
    Approximated, ///< drawn differently
    Refused       ///< not drawn, or the setting is ignored
  };
  Feature Key;
  Levels Level;
  const char* Name; ///< classes and methods of VTK
  /// Sentence about the difference to VTK's image. It is the text of the warning, unless the
  /// feature is drawn; empty if there is no difference.
  const char* Difference;
  const char* Remedy; ///< sentence that follows in the warning; may be empty
};

/// Returns the table. Row i describes Feature i.
VTKPENUMBRAFILTERSSCENE_EXPORT const std::vector<FeatureRow>& GetFeatureTable();

/// Adds the warning of a feature to `warnings`. `prop` names what uses it; empty for the renderer.
VTKPENUMBRAFILTERSSCENE_EXPORT void WarnFeature(
  Feature feature, const std::string& prop, std::vector<std::string>& warnings);

/// Merges warnings that differ only in the name of the prop, so that each cause has one warning.
std::vector<std::string> MergeWarnings(const std::vector<std::string>& warnings);

}
#endif
