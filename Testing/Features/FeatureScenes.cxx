// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "FeatureScenes.h"

#include "FeatureMaterials.h"
#include "FeatureProps.h"
#include "FeatureRenderers.h"
#include "SceneList.h"

#include "vtkActor.h"
#include "vtkAnnotatedCubeActor.h"
#include "vtkAssembly.h"
#include "vtkAxesActor.h"
#include "vtkBillboardTextActor3D.h"
#include "vtkCamera.h"
#include "vtkCellData.h"
#include "vtkConeSource.h"
#include "vtkCoordinate.h"
#include "vtkCubeAxesActor.h"
#include "vtkCylinderSource.h"
#include "vtkFloatArray.h"
#include "vtkGlyph3DMapper.h"
#include "vtkImageActor.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkLight.h"
#include "vtkLookupTable.h"
#include "vtkMatrix4x4.h"
#include "vtkNew.h"
#include "vtkPlane.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkPolyDataMapper.h"
#include "vtkPropAssembly.h"
#include "vtkProperty.h"
#include "vtkScalarBarActor.h"
#include "vtkStripper.h"
#include "vtkTextActor.h"
#include "vtkTextActor3D.h"
#include "vtkTextProperty.h"
#include "vtkTexture.h"
#include "vtkUnsignedCharArray.h"
#include "vtkVersionMacros.h"

using penumbra::Feature;

namespace
{

/// Scenes of surfaces, lines and points, and of how their actors place, color and cut them.
void AddGeometry(SceneList& add)
{
  add(Feature::Polygons, [](Renderer r, Window) {
    Add(r, MakeSphere());
    Look(r);
  });
  add(Feature::TriangleStrips, [](Renderer r, Window) {
    vtkNew<vtkStripper> strips;
    strips->SetInputData(MakeSphere());
    Add(r, Make(strips.Get()));
    Look(r);
  });
  add(Feature::LinesAndVertices, [](Renderer r, Window) {
    Add(r, MakePolyline())->GetProperty()->SetLineWidth(2.f);
    vtkActor* points = Add(r, MakePointGrid());
    points->SetScale(0.3, -0.3, 1.0);
    points->GetProperty()->SetPointSize(5.f);
  });
  add(Feature::Interpolation, [](Renderer r, Window) {
    Add(r, MakeSphere(12))->GetProperty()->SetInterpolationToFlat();
    Look(r);
  });
  add(Feature::Specular, [](Renderer r, Window) {
    vtkActor* actor = Add(r, MakeSphere(48));
    actor->GetProperty()->SetSpecular(0.7);
    actor->GetProperty()->SetSpecularPower(20.0);
    actor->GetProperty()->SetAmbient(0.2);
    actor->GetProperty()->SetDiffuse(0.6);
    Look(r);
  });
  add(Feature::Representations, [](Renderer r, Window) {
    vtkActor* actor = Add(r, MakeCube());
    actor->GetProperty()->SetRepresentationToWireframe();
    actor->GetProperty()->LightingOff();
    actor->GetProperty()->SetLineWidth(3.f);
    Look(r);
  });
  add(
    Feature::VertexAndEdgeVisibility,
    [](Renderer r, Window) {
      vtkActor* actor = Add(r, MakeCube());
      actor->GetProperty()->EdgeVisibilityOn();
      actor->GetProperty()->SetLineWidth(3.f);
      actor->GetProperty()->VertexVisibilityOn();
      actor->GetProperty()->SetPointSize(9.f);
      Look(r);
    },
    0.02);
  add(
    Feature::VertexAndEdgeVisibility,
    [](Renderer r, Window) {
      vtkActor* actor = Add(r, MakeSphere(12));
      actor->GetProperty()->EdgeVisibilityOn();
      actor->GetProperty()->SetLineWidth(6.f); // edges hide no vertices, which are smaller
      actor->GetProperty()->VertexVisibilityOn();
      actor->GetProperty()->SetPointSize(4.f);
      Look(r);
    },
    0.04);
  add(Feature::ScalarColoring, [](Renderer r, Window) {
    vtkSmartPointer<vtkPolyData> data = MakeSphere();
    AddElevation(data);
    Add(r, data)->GetMapper()->InterpolateScalarsBeforeMappingOn();
    Look(r);
  });
  for (bool direct : { false, true })
  {
    add(direct ? Feature::DirectScalars : Feature::CellScalars, [direct](Renderer r, Window) {
      vtkSmartPointer<vtkPolyData> data = MakeSphere();
      vtkNew<vtkUnsignedCharArray> colors;
      colors->SetNumberOfComponents(3);
      vtkNew<vtkFloatArray> values;
      for (vtkIdType i = 0; i < data->GetNumberOfCells(); ++i)
      {
        colors->InsertNextTuple3(40.0 * (i % 6), 200.0, 30.0 * (i % 4));
        values->InsertNextValue(static_cast<float>(i % 7) / 7.f);
      }
      data->GetCellData()->SetScalars(values);
      if (direct)
      {
        data->GetCellData()->SetScalars(colors);
      }
      Add(r, data);
      Look(r);
    });
  }
  add(Feature::Opacity, [](Renderer r, Window) {
    r->SetUseDepthPeeling(true);
    r->SetMaximumNumberOfPeels(20);
    r->SetOcclusionRatio(0.0);
    Add(r, MakeCube())->GetProperty()->SetOpacity(0.4);
    Look(r);
  });
  add(Feature::BackfaceProperty, [](Renderer r, Window) {
    vtkNew<vtkCylinderSource> tube;
    tube->CappingOff();
    tube->SetResolution(24);
    vtkNew<vtkProperty> back;
    back->SetColor(0.2, 0.8, 0.4);
    Add(r, Make(tube.Get()))->SetBackfaceProperty(back);
    Look(r);
  });
  add(Feature::Culling, [](Renderer r, Window) {
    Add(r, MakeCube())->GetProperty()->FrontfaceCullingOn();
    Look(r);
  });
  add(Feature::ClippingPlanes, [](Renderer r, Window) {
    vtkNew<vtkPlane> plane;
    plane->SetNormal(1.0, 1.0, 0.2);
    Add(r, MakeSphere())->GetMapper()->AddClippingPlane(plane);
    Look(r);
  });
  add(Feature::Assemblies, [](Renderer r, Window) {
    vtkNew<vtkAssembly> assembly;
    for (int i = 0; i < 2; ++i)
    {
      vtkActor* part = Add(r, MakeCube());
      part->SetPosition(1.5 * i, 0.0, 0.0);
      part->RotateZ(30.0 * i);
      assembly->AddPart(part);
    }
    r->RemoveAllViewProps();
    assembly->RotateY(40.0);
    r->AddActor(assembly);
    Look(r);
  });
  add(Feature::Glyphs, [](Renderer r, Window) {
    vtkNew<vtkConeSource> cone;
    cone->SetRadius(0.3);
    vtkNew<vtkGlyph3DMapper> mapper;
    mapper->SetInputData(MakePointGrid());
    mapper->SetSourceData(Make(cone.Get()));
    vtkNew<vtkActor> actor;
    actor->SetMapper(mapper);
    r->AddActor(actor);
    Look(r);
  });
  add(Feature::Blocks, [](Renderer r, Window) { AddBlockWithoutScalars(r); });
  add(Feature::Blocks, [](Renderer r, Window) {
    AddBlocks(r);
    r->SetUseDepthPeeling(true);
  });
#if VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 3, 0)
  add(Feature::BlockTextures, [](Renderer r, Window) { AddTexturedBlock(r); });
#endif
  add(Feature::Assemblies, [](Renderer r, Window) { // coordinates are divided by the last element
    vtkNew<vtkMatrix4x4> matrix;
    matrix->SetElement(0, 3, 0.5);
    matrix->SetElement(1, 3, 0.3);
    matrix->SetElement(3, 3, 2.0);
    Add(r, MakePlane(4));
    vtkActor* half = Add(r, MakePlane(4));
    half->SetUserMatrix(matrix);
    half->SetPosition(0.0, 0.0, 0.2);
    half->GetProperty()->SetColor(0.2, 0.6, 0.9);
  });
  add(Feature::GhostCells, [](Renderer r, Window) { AddGhosts(r); });
  add(Feature::PointShape, [](Renderer r, Window) {
    vtkActor* actor = Add(r, MakePointGrid());
    actor->GetProperty()->SetPointSize(17.f);
#if VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 4, 0)
    actor->GetProperty()->SetPoint2DShape(vtkProperty::Point2DShapeType::Round);
#endif
  });
  add(
    Feature::LinesAsTubes,
    [](Renderer r, Window) { // a line without length, and one with
      vtkNew<vtkPoints> points;
      points->InsertNextPoint(0.2, 0.1, 0.0);
      points->InsertNextPoint(0.2, 0.1, 0.0);
      points->InsertNextPoint(-0.5, -0.4, 0.0);
      points->InsertNextPoint(0.5, -0.3, 0.0);
      vtkNew<vtkCellArray> lines;
      lines->InsertNextCell({ 0, 1 });
      lines->InsertNextCell({ 2, 3 });
      vtkNew<vtkPolyData> data;
      data->SetPoints(points);
      data->SetLines(lines);
      vtkActor* actor = Add(r, data);
      actor->GetProperty()->SetLineWidth(9.f);
      actor->GetProperty()->RenderLinesAsTubesOn();
    },
    0.01);
  add(
    Feature::LineJoin,
    [](Renderer r, Window) {
      vtkActor* actor = Add(r, MakePolyline());
      actor->GetProperty()->SetLineWidth(11.f);
#if VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 5, 0)
      actor->GetProperty()->SetLineJoin(vtkProperty::LineJoinType::MiterJoin);
#endif
    },
    0.01);
  // In parallel projection VTK's spheres are circles as well.
  add(Feature::PointsAsSpheres, [](Renderer r, Window) {
    vtkActor* actor = Add(r, MakePointGrid());
    actor->GetProperty()->SetPointSize(17.f);
    actor->GetProperty()->SetRenderPointsAsSpheres(true);
    r->GetActiveCamera()->SetParallelProjection(true);
    r->ResetCamera();
  });
  // The joints and ends, which VTK leaves open, are outside of the image.
  add(Feature::LinesAsTubes, [](Renderer r, Window) {
    vtkActor* actor = Add(r, MakePolyline());
    actor->GetProperty()->SetLineWidth(31.f);
    actor->GetProperty()->SetRenderLinesAsTubes(true);
    r->GetActiveCamera()->SetParallelProjection(true);
    r->ResetCamera();
    r->GetActiveCamera()->SetParallelScale(0.1);
  });
  add(Feature::LinesAsTubes, [](Renderer r, Window) { // with a texture
    vtkActor* actor = Add(r, MakePolyline());
    vtkPolyData* line = vtkPolyDataMapper::SafeDownCast(actor->GetMapper())->GetInput();
    vtkNew<vtkFloatArray> coordinates;
    coordinates->SetNumberOfComponents(2);
    for (vtkIdType i = 0; i < line->GetNumberOfPoints(); ++i)
    {
      coordinates->InsertNextTuple2(0.1 * static_cast<double>(i), 0.3);
    }
    line->GetPointData()->SetTCoords(coordinates);
    AddTexture(actor, MakeImage(32, 32));
    actor->GetProperty()->SetLineWidth(31.f);
    actor->GetProperty()->SetRenderLinesAsTubes(true);
    r->GetActiveCamera()->SetParallelProjection(true);
    r->ResetCamera();
    r->GetActiveCamera()->SetParallelScale(0.1);
  });
}

/// Scenes of physically based materials and textures.
void AddMaterials(SceneList& add)
{
  add(
    Feature::PhysicallyBased, [](Renderer r, Window) { AddPhysicallyBased(r, false, true); },
    0.004);
  add(Feature::PhysicallyBased, [](Renderer r, Window) { AddPhysicallyBased(r, true, false); });
#if VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 6, 0)
  for (const bool lighting : { true, false })
  {
    add(Feature::PhysicallyBased, [lighting](Renderer r, Window) { // mapped colors
      vtkActor* actor = Add(r, MakePlane());
      auto* mapper = vtkPolyDataMapper::SafeDownCast(actor->GetMapper());
      vtkPolyData* plane = mapper->GetInput();
      vtkNew<vtkUnsignedCharArray> colors;
      colors->SetNumberOfComponents(3);
      for (vtkIdType i = 0; i < plane->GetNumberOfPoints(); ++i)
      {
        colors->InsertNextTuple3(30 + 50 * (i % 5), 220 - 40 * (i % 4), 100);
      }
      plane->GetPointData()->SetScalars(colors);
      mapper->ScalarVisibilityOn();
      actor->GetProperty()->SetInterpolationToPBR();
      actor->GetProperty()->SetLighting(lighting);
    });
  }
#endif
#if VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 3, 0)
  add(Feature::PhysicallyBased, [](Renderer r, Window) { // VTK 9.2 draws linear colors
    vtkProperty* property = Add(r, MakePlane())->GetProperty();
    property->SetInterpolationToPBR();
    property->SetColor(0.6, 0.3, 0.1);
    property->LightingOff();
    property->VertexVisibilityOn();
    property->SetVertexColor(0.2, 0.5, 0.8);
    property->SetPointSize(12.f);
  });
#endif
  add(Feature::Textures,
    [](Renderer r, Window) { AddTexture(Add(r, MakePlane()), MakeImage(32, 32)); });
  add(Feature::Textures, [](Renderer r, Window) { // ignored by physically based materials
    vtkActor* actor = Add(r, MakePlane());
    AddTexture(actor, MakeImage(32, 32));
    actor->GetProperty()->SetInterpolationToPBR();
    actor->GetProperty()->SetColor(0.3, 0.7, 0.2);
  });
  for (int wrap :
    { vtkTexture::MirroredRepeat, vtkTexture::ClampToBorder, vtkTexture::ClampToEdge })
  {
    add(Feature::TextureWrap, [wrap](Renderer r, Window) {
      vtkTexture* texture = AddTexture(AddWrapped(r), MakeImage(32, 32));
      texture->SetWrap(wrap);
      texture->SetBorderColor(0.9f, 0.1f, 0.2f, 1.f);
    });
  }
  add(Feature::TextureTransform, [](Renderer r, Window) {
    vtkActor* actor = Add(r, MakePlane());
    AddTexture(actor, MakeImage(32, 32));
    double matrix[16] = { 1.5, 0.5, 0.0, 0.2, -0.5, 1.5, 0.0, 0.1, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0,
      0.0, 1.0 };
    vtkNew<vtkInformation> keys;
#if VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 6, 0)
    keys->Set(vtkProp::GENERAL_TEXTURE_TRANSFORM(), matrix, 16);
#else
    keys->Set(vtkProp::GeneralTextureTransform(), matrix, 16);
#endif
    actor->SetPropertyKeys(keys);
  });
  for (const bool seamlessV : { false, true })
  {
    add(Feature::TextureSeams, [seamlessV](Renderer r, Window) {
      vtkActor* actor = Add(r, MakeTube(seamlessV));
      AddTexture(actor, MakeImage(32, 32));
      auto* mapper = vtkPolyDataMapper::SafeDownCast(actor->GetMapper());
      mapper->SetSeamlessU(!seamlessV);
      mapper->SetSeamlessV(seamlessV);
      Look(r);
    });
  }
  add(Feature::TextureMipmap,
    [](Renderer r, Window) { AddTexture(Add(r, MakePlane()), MakeImage(512, 512))->MipmapOn(); });
  add(Feature::TextureColorSpace, [](Renderer r, Window) {
    AddTexture(Add(r, MakePlane()), MakeImage(32, 32))->UseSRGBColorSpaceOn();
  });
  add(Feature::ForceTranslucent, [](Renderer r, Window) {
    r->SetUseDepthPeeling(true);
    Add(r, MakeCube())->ForceTranslucentOn();
    Look(r);
  });
}

/// Scenes of image slices, text, scalar bars and axes.
void AddImagesAndAnnotations(SceneList& add)
{
  add(
    Feature::ImageSlices, [](Renderer r, Window) { AddSlice(r, false); }, 0.005);
  add(Feature::ImageSlices, [](Renderer r, Window) { AddSlice(r, true); });
  add(Feature::ImageSlices, [](Renderer r, Window) {
    vtkNew<vtkImageActor> actor;
    actor->SetInputData(MakeImage(20, 14));
    r->AddViewProp(actor);
  });
  add(Feature::TextActors, [](Renderer r, Window) {
    vtkNew<vtkTextActor> text;
    text->SetInput("Text actor");
    text->SetPosition(10, 20);
    StyleText(text->GetTextProperty());
    r->AddViewProp(text);
  });
  add(Feature::TextActors, [](Renderer r, Window) { // in an assembly
    vtkNew<vtkTextActor> text;
    text->SetInput("Part");
    text->GetPositionCoordinate()->SetCoordinateSystemToWorld();
    text->GetPositionCoordinate()->SetValue(-0.3, 0.1, 0.0);
    StyleText(text->GetTextProperty());
    vtkNew<vtkPropAssembly> assembly;
    vtkActor* plane = Add(r, MakePlane(2));
    assembly->AddPart(plane);
    r->RemoveActor(plane);
    assembly->AddPart(text);
    r->AddViewProp(assembly);
  });
  add(
    Feature::ScalarBars,
    [](Renderer r, Window) {
      vtkNew<vtkLookupTable> table;
      table->Build();
      vtkNew<vtkScalarBarActor> bar;
      bar->SetLookupTable(table);
      bar->SetTitle("Bar");
      r->AddViewProp(bar);
    },
    0.05);
  add(
    Feature::BillboardText,
    [](Renderer r, Window) {
      Add(r, MakeSphere());
      vtkNew<vtkBillboardTextActor3D> text;
      text->SetInput("Billboard");
      text->SetPosition(-0.4, 0.1, 0.6);
      StyleText(text->GetTextProperty());
      r->AddViewProp(text);
      vtkNew<vtkLight> light; // lights the text as well
      light->SetColor(1.0, 0.8, 0.2);
      light->SetPosition(2.0, 1.0, 5.0);
      r->AddLight(light);
    },
    0.01);
  add(
    Feature::Text3D,
    [](Renderer r, Window) {
      vtkNew<vtkTextActor3D> text;
      text->SetInput("Text 3D");
      StyleText(text->GetTextProperty());
      text->RotateX(30.0);
      r->AddViewProp(text);
    },
    0.01);
  add(
    Feature::AxesActors,
    [](Renderer r, Window) {
      vtkNew<vtkAxesActor> axes;
      r->AddActor(axes);
      Look(r);
    },
    0.02);
  add(
    Feature::AxesActors,
    [](Renderer r, Window) {
      vtkNew<vtkAnnotatedCubeActor> cube;
      r->AddActor(cube);
      Look(r);
    },
    0.02);
  add(
    Feature::CubeAxes,
    [](Renderer r, Window) {
      vtkNew<vtkCubeAxesActor> axes;
      Add(r, MakeSphere());
      axes->SetBounds(-0.5, 0.5, -0.5, 0.5, -0.5, 0.5);
      axes->SetXTitle("Width");
      axes->DrawXGridlinesOn();
      axes->DrawYGridlinesOn();
      axes->SetCamera(r->GetActiveCamera());
      r->AddActor(axes);
      Look(r);
    },
    0.02);
  add(
    Feature::CubeAxes,
    [](Renderer r, Window) { // along the z axis, whose labels have no direction then
      vtkNew<vtkCubeAxesActor> axes;
      Add(r, MakeSphere());
      axes->SetBounds(-0.5, 0.5, -0.5, 0.5, -0.5, 0.5);
      axes->SetCamera(r->GetActiveCamera());
      r->AddActor(axes);
      r->ResetCamera();
    },
    0.02);
}

/// Scenes of cameras, lights, backgrounds, layers and the options of renderers.
void AddViews(SceneList& add)
{
  add(Feature::Cameras, [](Renderer r, Window) {
    Add(r, MakeCube());
    r->GetActiveCamera()->ParallelProjectionOn();
    Look(r);
  });
  add(Feature::ClippingRange, [](Renderer r, Window) {
    vtkNew<vtkCylinderSource> tube;
    tube->SetResolution(32);
    Add(r, Make(tube.Get()));
    Look(r);
    const double distance = r->GetActiveCamera()->GetDistance();
    r->GetActiveCamera()->SetClippingRange(distance - 0.2, distance + 0.2);
  });
  add(
    Feature::Lights,
    [](Renderer r, Window) {
      Add(r, MakeSphere(48));
      vtkNew<vtkLight> light;
      light->SetPositional(true);
      light->SetConeAngle(20.0);
      light->SetPosition(1.0, 1.0, 2.0);
      r->AddLight(light);
    },
    0.01);
  add(Feature::Background, [](Renderer r, Window) {
    r->SetBackground(0.7, 0.3, 0.2);
    Add(r, MakeSphere());
  });
  add(Feature::BackgroundGradients, [](Renderer r, Window) { SetGradient(r); });
#if VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 3, 0)
  for (int mode = 1; mode < 4; ++mode)
  {
    add(Feature::BackgroundGradients, [mode](Renderer r, Window) {
      SetGradient(r);
      r->SetGradientMode(static_cast<vtkViewport::GradientModes>(mode));
    });
  }
#endif
  add(Feature::BackgroundImage, [](Renderer r, Window) {
    vtkNew<vtkTexture> texture;
    texture->SetInputData(MakeImage(50, 40)); // VTK interpolates it although Interpolate is off
    r->SetBackgroundTexture(texture);
    r->TexturedBackgroundOn();
    Add(r, MakeSphere());
  });
  add(
    Feature::Layers,
    [](Renderer r, Window w) {
      vtkNew<vtkRenderer> below;
      below->SetBackground(0.7, 0.3, 0.2);
      Add(below, MakeCube());
      Look(below);
      w->SetNumberOfLayers(2);
      r->SetLayer(1);
      w->AddRenderer(below);
      Add(r, MakeSphere())->GetProperty()->SetOpacity(0.6);
      vtkActor* solid = Add(r, MakeSphere());
      solid->SetPosition(0.9, 0.4, 0.0);
      r->ResetCamera();
    },
    0.01);
  add(
    Feature::Layers,
    [](Renderer r, Window w) {
      Add(r, MakeSphere());
      vtkNew<vtkAnnotatedCubeActor> cube;
      AddAxesLayer(w, cube);
    },
    0.01);
  add(
    Feature::DepthPeeling,
    [](Renderer r, Window) {
      r->SetUseDepthPeeling(true);
      Add(r, MakeSphere())->GetProperty()->SetOpacity(0.5);
      Add(r, MakeCube())->GetProperty()->SetOpacity(0.3);
      Look(r);
    },
    0.01);
#if VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 7, 0)
  add(Feature::PhysicalCoordinates, [](Renderer r, Window w) {
    w->SetPhysicalTranslation(-0.5, 0.2, 0.0);
    w->SetPhysicalScale(2.0);
    w->SetPhysicalViewDirection(0.6, 0.0, -0.8);
    Add(r, MakeSphere());
    vtkActor* actor = Add(r, MakeCube());
    actor->SetCoordinateSystemRenderer(r);
    actor->SetCoordinateSystemToPhysical();
    actor->SetScale(0.5);
    Look(r);
    r->GetActiveCamera()->Zoom(0.4);
  });
#endif
}

}

std::vector<FeatureScene> MakeFeatureScenes()
{
  SceneList list;
  AddGeometry(list);
  AddMaterials(list);
  AddImagesAndAnnotations(list);
  AddViews(list);
  AddMaterialScenes(list.Scenes);
  AddRendererScenes(list.Scenes);
  AddOtherProps(list);
  AddWidgets(list);
  AddCoincident(list);
  AddEdges(list);
  AddEnvironments(list);
  AddVisiblePoints(list);
  return list.Scenes;
}
