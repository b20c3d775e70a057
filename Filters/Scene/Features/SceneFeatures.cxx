// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "SceneFeatures.h"

#include <algorithm>
#include <utility>

namespace penumbra
{
namespace
{

/// Maximum number of props that one warning names.
constexpr std::size_t MaximumNames = 3;

/// Splits a warning into the name of the prop and the text. The name may be empty.
std::pair<std::string, std::string> SplitWarning(const std::string& warning)
{
  const std::size_t end = warning.find(": ");
  const bool hasName = warning.rfind("Object ", 0) == 0 || warning.rfind("vtk", 0) == 0;
  return hasName && end != std::string::npos
    ? std::make_pair(warning.substr(0, end), warning.substr(end + 2))
    : std::make_pair(std::string(), warning);
}

std::string JoinNames(const std::vector<std::string>& names)
{
  std::string result;
  for (std::size_t i = 0; i < std::min(names.size(), MaximumNames); ++i)
  {
    result += (i > 0 ? ", " : "") + names[i];
  }
  if (names.size() > MaximumNames)
  {
    result += " and " + std::to_string(names.size() - MaximumNames) + " more";
  }
  return result;
}

}

const std::vector<FeatureRow>& GetFeatureTable()
{
  constexpr auto Drawn = FeatureRow::Levels::Drawn;
  constexpr auto Approximated = FeatureRow::Levels::Approximated;
  constexpr auto Refused = FeatureRow::Levels::Refused;
  static const std::vector<FeatureRow> table = {
    { Feature::Polygons, Drawn, "vtkActor, vtkPolyDataMapper, vtkDataSetMapper", "", "" },
    { Feature::TriangleStrips, Drawn, "vtkPolyData: Strips", "", "" },
    { Feature::LinesAndVertices, Drawn, "vtkPolyData: Lines, Verts", "", "" },
    { Feature::Interpolation, Drawn, "vtkProperty: VTK_FLAT, VTK_GOURAUD, VTK_PHONG",
      "Gouraud shading is Phong shading, as in VTK.", "" },
    { Feature::Specular, Drawn, "vtkProperty: Ambient, Diffuse, Specular, SpecularPower", "", "" },
    { Feature::Representations, Drawn, "vtkProperty: Representation, LineWidth, PointSize", "",
      "" },
    { Feature::VertexAndEdgeVisibility, Drawn, "vtkProperty: EdgeVisibility, VertexVisibility",
      "Edges have their full width at silhouettes and no highlights.", "" },
    { Feature::ScalarColoring, Drawn, "vtkMapper: scalars, lookup tables, texture maps", "", "" },
    { Feature::CellScalars, Drawn, "vtkMapper: scalars of cells", "", "" },
    { Feature::DirectScalars, Drawn, "vtkMapper: colors in unsigned char arrays", "", "" },
    { Feature::Opacity, Drawn, "vtkProperty: Opacity; translucent scalars",
      "Translucent layers are sorted exactly.", "" },
    { Feature::BackfaceProperty, Drawn, "vtkActor: BackfaceProperty", "", "" },
    { Feature::Culling, Drawn, "vtkProperty: BackfaceCulling, FrontfaceCulling",
      "Culled faces cast shadows and occlude, but neither block nor reflect indirect light.", "" },
    { Feature::ClippingPlanes, Drawn, "vtkMapper: ClippingPlanes", "", "" },
    { Feature::CoincidentTopology, Drawn,
      "vtkMapper: ResolveCoincidentTopology, offsets of polygons, lines and points; actors in one "
      "plane",
      "Without offsets, lines and points are in front of surfaces that contain them.", "" },
    { Feature::Assemblies, Drawn, "vtkAssembly, vtkFollower, user transforms", "", "" },
    { Feature::Glyphs, Drawn, "vtkGlyph3DMapper", "", "" },
    { Feature::Blocks, Drawn,
      "vtkCompositePolyDataMapper, vtkCompositePolyDataMapper2: visibility, color, opacity and "
      "scalars of blocks",
      "", "" },
    { Feature::BlockTextures, Drawn, "vtkCompositeDataDisplayAttributes: BlockTexture", "", "" },
    { Feature::GhostCells, Drawn, "cell array vtkGhostType",
      "Cells that are hidden or duplicates are drawn, as vtkPolyDataMapper does; surfaces of other "
      "data sets omit them.",
      "" },
    { Feature::PointShape, Drawn, "vtkProperty: Point2DShape", "", "" },
    { Feature::LineJoin, Drawn, "vtkProperty: LineJoin", "", "" },
    { Feature::PointsAsSpheres, Drawn, "vtkProperty: RenderPointsAsSpheres",
      "Spheres are solid; in perspective they are ellipses.", "" },
    { Feature::LinesAsTubes, Drawn, "vtkProperty: RenderLinesAsTubes",
      "Tubes are solid, with round joints and ends; VTK leaves both open.", "" },
    { Feature::PhysicallyBased, Drawn,
      "vtkProperty: VTK_PBR with metallic, roughness, base color texture", "", "" },
    { Feature::NormalTexture, Drawn, "vtkProperty: NormalTexture, NormalScale",
      "Ignored without tangents, as in VTK; see vtkPolyDataTangents.", "" },
    { Feature::MaterialTexture, Drawn, "vtkProperty: ORMTexture, OcclusionStrength", "", "" },
    { Feature::EmissiveTexture, Drawn, "vtkProperty: EmissiveTexture, EmissiveFactor", "", "" },
    { Feature::Anisotropy, Drawn, "vtkProperty: Anisotropy, AnisotropyRotation, AnisotropyTexture",
      "Ignored without tangents, as in VTK.", "" },
    { Feature::ClearCoat, Drawn,
      "vtkProperty: CoatStrength, CoatRoughness, CoatIOR, CoatColor, CoatNormalTexture", "", "" },
    { Feature::MultiTexturing, Refused, "vtkProperty: SetTexture() with other names",
      "textures of the property that have no physically based meaning are ignored.",
      "Use SetTexture() of the actor." },
    { Feature::Textures, Drawn, "vtkTexture: interpolation, color mapping, opacity", "", "" },
    { Feature::TextureWrap, Drawn, "vtkTexture: Wrap, BorderColor", "", "" },
    { Feature::TextureTransform, Drawn, "vtkProp: GENERAL_TEXTURE_TRANSFORM", "", "" },
    { Feature::TextureMipmap, Drawn, "vtkTexture: Mipmap",
      "Minified textures are integrated to the tolerance instead.", "" },
    { Feature::TextureColorSpace, Drawn, "vtkTexture: UseSRGBColorSpace", "", "" },
    { Feature::TextureSeams, Drawn, "vtkPolyDataMapper: SeamlessU, SeamlessV", "", "" },
    { Feature::TextureCubeMap, Refused, "vtkTexture: CubeMap",
      "the texture is ignored because it is a cube map or its image has no point scalars.",
      "Use a 2-D image." },
    { Feature::ForceOpaque, Drawn, "vtkActor: ForceOpaque",
      "Translucent cells are blended over those that are drawn before, in the order of actors and "
      "cells.",
      "" },
    { Feature::ForceTranslucent, Drawn, "vtkActor: ForceTranslucent", "", "" },
    { Feature::CustomShaders, Refused, "vtkShaderProperty", "custom shaders are ignored.",
      "Render with OpenGL, or use vtkProperty." },
    { Feature::PhysicalCoordinates, Drawn, "vtkProp3D: CoordinateSystem PHYSICAL",
      "Requires VTK 9.7; treated as world coordinates with older versions, with a warning.", "" },
    { Feature::CoordinateSystems, Drawn, "vtkProp3D: CoordinateSystem DEVICE",
      "As in VTK, world coordinates in windows without devices. Requires VTK 9.7; treated as world "
      "coordinates with older versions, with a warning.",
      "" },
    { Feature::Selection, Refused, "vtkMapper: Selection", "selected cells are not highlighted.",
      "Show the output of vtkExtractSelection with a second actor." },
    { Feature::DerivedMappers, Approximated, "other mappers derived from vtkPolyDataMapper",
      "the mapper is drawn as the polygons of its input.", "Use vtkPolyDataMapper." },
    { Feature::PointSplats, Drawn,
      "vtkPointGaussianMapper: Gaussians, spheres and discs; Emissive, arrays of scales and "
      "opacities",
      "Translucent splats are sorted exactly; VTK draws them in the order of the points.", "" },
    { Feature::SplatShaders, Approximated,
      "vtkPointGaussianMapper: other SplatShaderCode, Anisotropic",
      "the splats are drawn as round discs or Gaussians.",
      "Use the default splats, or the shader code of ParaView's spheres or discs." },
    { Feature::Imposters, Drawn, "vtkOpenGLSphereMapper, vtkOpenGLStickMapper",
      "Spheres and sticks are solid; translucent ones have one layer, where VTK blends both sides "
      "of "
      "spheres.",
      "" },
    { Feature::ShaderMappers, Refused,
      "vtkOpenGLSphereMapper, vtkOpenGLStickMapper, if the VTK that Penumbra was compiled with has "
      "no headers of them",
      "the prop is not supported and was skipped.", "Use vtkGlyph3DMapper." },
    { Feature::ImageSlices, Drawn, "vtkImageActor, vtkImageSlice with vtkImageSliceMapper", "",
      "" },
    { Feature::ObliqueImageSlices, Refused,
      "vtkImageSlice with vtkImageResliceMapper and other mappers",
      "the prop is not supported and was skipped.",
      "Use vtkImageReslice and vtkImageSliceMapper." },
    { Feature::TextActors, Drawn, "vtkTextActor", "", "" },
    { Feature::ScalarBars, Drawn, "vtkScalarBarActor", "", "" },
    { Feature::BillboardText, Drawn, "vtkBillboardTextActor3D", "", "" },
    { Feature::Text3D, Drawn, "vtkTextActor3D", "", "" },
    { Feature::AxesActors, Drawn, "vtkAxesActor, vtkAnnotatedCubeActor", "", "" },
    { Feature::CubeAxes, Drawn, "vtkCubeAxesActor", "Labels are always polygons.", "" },
    { Feature::CubeAxes2D, Drawn, "vtkCubeAxesActor: Use2DMode", "", "" },
    { Feature::AxisActors, Refused, "vtkAxisActor", "the prop is not supported and was skipped.",
      "Use vtkCubeAxesActor or vtkAxisActor2D." },
    { Feature::Skyboxes, Drawn, "vtkSkybox: cube and sphere projections", "", "" },
    { Feature::LevelsOfDetail, Drawn, "vtkLODProp3D",
      "The lowest level is drawn; the first one if several are equal.", "" },
    { Feature::PropFollowers, Drawn, "vtkProp3DFollower", "", "" },
    { Feature::Actors2D, Drawn,
      "vtkActor2D, vtkTexturedActor2D with vtkPolyDataMapper2D, vtkTextMapper, vtkImageMapper",
      "In front of the scene, without line stipples.", "" },
    { Feature::Labels, Drawn, "vtkActor2D with vtkLabeledDataMapper, vtkLabelPlacementMapper",
      "Labels are in front of the scene.", "" },
    { Feature::VisiblePoints, Drawn,
      "vtkSelectVisiblePoints before these mappers or vtkPointSetToLabelHierarchy",
      "Points are compared with the depths of surfaces along rays; the window need not have "
      "rendered.",
      "" },
    { Feature::FilteredVisiblePoints, Approximated,
      "vtkSelectVisiblePoints before other filters of labels",
      "the labels are those of the points that the last image of the window showed.",
      "Connect vtkSelectVisiblePoints to the mapper of the labels, or render the window first." },
    { Feature::Captions, Drawn, "vtkCaptionActor2D", "Leaders are in front of the scene.", "" },
    { Feature::Legends, Drawn, "vtkLegendBoxActor", "", "" },
    { Feature::Axes2D, Drawn, "vtkAxisActor2D, vtkLegendScaleActor", "", "" },
    { Feature::CornerTexts, Drawn, "vtkCornerAnnotation", "", "" },
    { Feature::Widgets, Drawn,
      "vtkSliderRepresentation2D, vtkTexturedButtonRepresentation2D, vtkLogoRepresentation, "
      "vtkCameraOrientationRepresentation",
      "Buttons at points of the scene are skipped, with a warning.", "" },
    { Feature::LightActors, Drawn, "vtkLightActor, vtkCameraActor", "", "" },
    { Feature::Charts, Drawn, "vtkContextActor with 2-D charts and other items",
      "In front of the scene, without antialiasing.", "" },
    { Feature::ChartTextures, Approximated,
      "vtkBrush: repeated textures; images that are not unsigned char",
      "textures of charts are stretched, or not drawn.", "Stretch textures of bytes." },
    { Feature::OtherProps, Refused, "other props, such as other 2-D actors and floors of vtkSkybox",
      "the prop is not supported and was skipped.", "Render with OpenGL, or hide the prop." },
    { Feature::Volumes, Refused, "vtkVolume", "the prop is not supported and was skipped.",
      "Use vtkContourFilter, or render with OpenGL." },
    { Feature::Cameras, Drawn,
      "vtkCamera: perspective, parallel and off-axis projections; ViewShear in perspective", "",
      "" },
    { Feature::CameraTransforms, Drawn,
      "vtkCamera: view and model transforms with shear, mirroring or non-uniform scale",
      "Shadows, ambient occlusion, cube axes and billboards are not distorted, with a warning.",
      "" },
    { Feature::CameraShear, Refused,
      "vtkCamera: UserTransform with shear, mirroring or non-uniform scale; ViewShear in parallel "
      "projection",
      "Shear, mirroring and non-uniform scale of the projection of the camera are ignored.",
      "Transform the actors." },
    { Feature::ClippingRange, Drawn,
      "vtkCamera: ClippingRange, without shadows, occlusion, indirect light or medium", "", "" },
    { Feature::StereoEyes, Drawn, "vtkRenderWindow: StereoType LEFT, RIGHT",
      "The window must have rendered once. Highlights are those that the eye sees.", "" },
    { Feature::Stereo, Refused, "vtkRenderWindow: other stereo types",
      "Stereo rendering with two eyes is not supported. Only one view is drawn.",
      "Render one image for each eye with the stereo types LEFT and RIGHT." },
    { Feature::Lights, Drawn, "vtkLight: headlights, camera lights, scene lights, cones", "", "" },
    { Feature::Background, Drawn, "vtkRenderer: Background", "", "" },
    { Feature::BackgroundAlpha, Drawn, "vtkRenderer: BackgroundAlpha",
      "An alpha of 0, which is VTK's default, means opaque. BackgroundOff() of the ray caster "
      "makes "
      "the background transparent.",
      "" },
    { Feature::BackgroundGradients, Drawn, "vtkRenderer: GradientBackground, GradientMode", "",
      "" },
    { Feature::BackgroundImage, Drawn, "vtkRenderer: TexturedBackground", "", "" },
    { Feature::Layers, Drawn,
      "vtkRenderWindow: renderers in layers above and below, orientation widgets", "", "" },
    { Feature::DepthPeeling, Drawn, "vtkRenderer: UseDepthPeeling",
      "Layers are always sorted exactly.", "" },
    { Feature::HiddenLineRemoval, Drawn, "vtkRenderer: UseHiddenLineRemoval", "", "" },
    { Feature::RenderPass, Refused, "vtkRenderer: Pass",
      "The render pass of the renderer is ignored.",
      "Render with OpenGL, or call SetAmbientOcclusion(true) or SetMedium() of "
      "vtkPenumbraRayCaster if the pass has these effects." },
    { Feature::RendererOcclusion, Approximated, "vtkRenderer: UseSSAO, SSAORadius",
      "Screen-space ambient occlusion of the renderer is replaced by ray-cast ambient occlusion of "
      "the same radius.",
      "Set AmbientOcclusion of vtkPenumbraRayCaster." },
    { Feature::RendererShadows, Drawn, "vtkRenderer: UseShadows",
      "Shadows are exact instead of filtered shadow maps, and lights without a cone cast shadows, "
      "too.",
      "" },
    { Feature::ImageBasedLighting, Drawn, "vtkRenderer: UseImageBasedLighting, EnvironmentTexture",
      "Nothing occludes the light of the environment. The argument isSRGB of "
      "SetEnvironmentTexture() is ignored.",
      "Set UseSRGBColorSpace of the texture instead of isSRGB." },
  };
  return table;
}

void WarnFeature(Feature feature, const std::string& prop, std::vector<std::string>& warnings)
{
  const FeatureRow& row = GetFeatureTable()[static_cast<std::size_t>(feature)];
  std::string warning = prop.empty() ? row.Difference : prop + ": " + row.Difference;
  if (*row.Remedy)
  {
    warning += std::string(" ") + row.Remedy;
  }
  warnings.push_back(warning);
}

std::vector<std::string> MergeWarnings(const std::vector<std::string>& warnings)
{
  std::vector<std::pair<std::string, std::vector<std::string>>> causes;
  for (const std::string& warning : warnings)
  {
    const auto [name, text] = SplitWarning(warning);
    const auto same = std::find_if(causes.begin(), causes.end(),
      [&text = text](const auto& cause) { return cause.first == text; });
    auto& cause =
      same == causes.end() ? causes.emplace_back(text, std::vector<std::string>()) : *same;
    if (!name.empty() &&
      std::find(cause.second.begin(), cause.second.end(), name) == cause.second.end())
    {
      cause.second.push_back(name);
    }
  }
  std::vector<std::string> merged;
  for (const auto& [text, names] : causes)
  {
    merged.push_back(names.empty() ? text : JoinNames(names) + ": " + text);
  }
  return merged;
}

}
