// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "FeatureScenes.h"

#include "vtkActor.h"
#include "vtkAnnotatedCubeActor.h"
#include "vtkAssembly.h"
#include "vtkAxesActor.h"
#include "vtkBillboardTextActor3D.h"
#include "vtkCamera.h"
#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkCompositeDataDisplayAttributes.h"
#include "vtkCompositePolyDataMapper.h"
#include "vtkConeSource.h"
#include "vtkCubeAxesActor.h"
#include "vtkCubeSource.h"
#include "vtkCylinderSource.h"
#include "vtkFloatArray.h"
#include "vtkGlyph3DMapper.h"
#include "vtkImageActor.h"
#include "vtkImageData.h"
#include "vtkImageProperty.h"
#include "vtkImageSlice.h"
#include "vtkImageSliceMapper.h"
#include "vtkInformation.h"
#include "vtkInformationDoubleVectorKey.h"
#include "vtkLight.h"
#include "vtkLookupTable.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkNew.h"
#include "vtkPlane.h"
#include "vtkPlaneSource.h"
#include "vtkPointData.h"
#include "vtkPointSource.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkPolyDataMapper.h"
#include "vtkProperty.h"
#include "vtkScalarBarActor.h"
#include "vtkSphereSource.h"
#include "vtkStripper.h"
#include "vtkTextActor.h"
#include "vtkTextActor3D.h"
#include "vtkTextProperty.h"
#include "vtkTexture.h"
#include "vtkUnsignedCharArray.h"
#include "vtkVersionMacros.h"

#if VTK_VERSION_NUMBER < VTK_VERSION_CHECK(9, 3, 0)
#include "vtkCompositePolyDataMapper2.h"
#endif

#include <cmath>

using penumbra::Feature;

namespace
{

template <typename Source>
vtkSmartPointer<vtkPolyData> Make(Source* source)
{
  source->Update();
  return source->GetOutput();
}

vtkSmartPointer<vtkPolyData> MakeSphere(int resolution = 24)
{
  vtkNew<vtkSphereSource> sphere;
  sphere->SetThetaResolution(resolution);
  sphere->SetPhiResolution(resolution);
  return Make(sphere.Get());
}

vtkSmartPointer<vtkPolyData> MakeCube()
{
  vtkNew<vtkCubeSource> cube;
  return Make(cube.Get());
}

vtkSmartPointer<vtkPolyData> MakePlane(int resolution = 1)
{
  vtkNew<vtkPlaneSource> plane;
  plane->SetResolution(resolution, resolution);
  return Make(plane.Get());
}

/// Adds an actor that shows `data`, in a warm color.
vtkActor* Add(vtkRenderer* renderer, vtkPolyData* data)
{
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(data);
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  actor->GetProperty()->SetColor(0.9, 0.6, 0.3);
  renderer->AddActor(actor);
  return actor;
}

/// Turns the camera to an oblique view of everything.
void Look(vtkRenderer* renderer)
{
  renderer->GetActiveCamera()->SetPosition(1.0, 0.8, 2.0);
  renderer->GetActiveCamera()->SetFocalPoint(0.0, 0.0, 0.0);
  renderer->ResetCamera();
}

void AddElevation(vtkPolyData* data)
{
  vtkNew<vtkFloatArray> scalars;
  for (vtkIdType i = 0; i < data->GetNumberOfPoints(); ++i)
  {
    scalars->InsertNextValue(static_cast<float>(data->GetPoint(i)[1] + 0.5));
  }
  data->GetPointData()->SetScalars(scalars);
}

vtkSmartPointer<vtkImageData> MakeImage(int width, int height, int components = 3)
{
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(width, height, 1);
  image->AllocateScalars(VTK_UNSIGNED_CHAR, components);
  for (int j = 0; j < height; ++j)
  {
    for (int i = 0; i < width; ++i)
    {
      const bool odd = (i * 8 / width + j * 8 / height) % 2 == 1;
      auto* c = static_cast<unsigned char*>(image->GetScalarPointer(i, j, 0));
      const int color[4] = { odd ? 230 : 40, 255 * i / width, 255 * j / height, odd ? 255 : 120 };
      for (int k = 0; k < components; ++k)
      {
        c[k] = static_cast<unsigned char>(color[k]);
      }
    }
  }
  return image;
}

vtkTexture* AddTexture(vtkActor* actor, vtkImageData* image)
{
  vtkNew<vtkTexture> texture;
  texture->SetInputData(image);
  texture->InterpolateOn();
  actor->SetTexture(texture);
  actor->GetProperty()->SetColor(1.0, 1.0, 1.0);
  return texture;
}

/// Adds a rectangle whose texture coordinates reach from -1 to 2.
vtkActor* AddWrapped(vtkRenderer* renderer)
{
  vtkSmartPointer<vtkPolyData> plane = MakePlane();
  vtkDataArray* coordinates = plane->GetPointData()->GetTCoords();
  for (vtkIdType i = 0; i < 4; ++i)
  {
    coordinates->SetTuple2(
      i, 3.0 * coordinates->GetComponent(i, 0) - 1.0, 3.0 * coordinates->GetComponent(i, 1) - 1.0);
  }
  return Add(renderer, plane);
}

vtkSmartPointer<vtkPolyData> MakePolyline()
{
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> lines;
  lines->InsertNextCell(9);
  for (int i = 0; i < 9; ++i)
  {
    lines->InsertCellPoint(points->InsertNextPoint(0.2 * i, i % 2 == 0 ? 0.0 : 0.6, 0.0));
  }
  auto data = vtkSmartPointer<vtkPolyData>::New();
  data->SetPoints(points);
  data->SetLines(lines);
  return data;
}

vtkSmartPointer<vtkPolyData> MakePointGrid()
{
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> vertices;
  for (int i = 0; i < 16; ++i)
  {
    vertices->InsertNextCell(1);
    vertices->InsertCellPoint(points->InsertNextPoint(i % 4, i / 4, 0.0));
  }
  auto data = vtkSmartPointer<vtkPolyData>::New();
  data->SetPoints(points);
  data->SetVerts(vertices);
  return data;
}

void AddBlocks(vtkRenderer* renderer)
{
  vtkNew<vtkMultiBlockDataSet> blocks;
  for (unsigned int i = 0; i < 4; ++i)
  {
    vtkNew<vtkSphereSource> sphere;
    sphere->SetCenter(1.2 * (i % 2), 1.2 * (i / 2), 0.0);
    sphere->SetThetaResolution(24);
    sphere->SetPhiResolution(24);
    blocks->SetBlock(i, Make(sphere.Get()));
  }
#if VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 3, 0)
  vtkNew<vtkCompositePolyDataMapper> mapper;
#else
  vtkNew<vtkCompositePolyDataMapper2> mapper;
#endif
  mapper->SetInputDataObject(blocks);
  vtkNew<vtkCompositeDataDisplayAttributes> attributes;
  mapper->SetCompositeDataDisplayAttributes(attributes);
  const double blue[3] = { 0.2, 0.4, 0.9 };
  attributes->SetBlockColor(blocks->GetBlock(1), blue);
  attributes->SetBlockVisibility(blocks->GetBlock(2), false);
  attributes->SetBlockOpacity(blocks->GetBlock(3), 0.4);
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  renderer->AddActor(actor);
}

#if VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 3, 0)
void AddTexturedBlock(vtkRenderer* renderer)
{
  vtkNew<vtkMultiBlockDataSet> blocks;
  blocks->SetBlock(0, MakePlane());
  vtkNew<vtkCompositeDataDisplayAttributes> attributes;
  vtkNew<vtkCompositePolyDataMapper> mapper;
  mapper->SetInputDataObject(blocks);
  mapper->SetCompositeDataDisplayAttributes(attributes);
  auto texture = vtkSmartPointer<vtkTexture>::New();
  texture->SetInputData(MakeImage(32, 32));
  texture->InterpolateOn();
  attributes->SetBlockTexture(blocks->GetBlock(0), texture);
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  renderer->AddActor(actor);
}
#endif

void AddGhosts(vtkRenderer* renderer)
{
  vtkSmartPointer<vtkPolyData> plane = MakePlane(8);
  vtkNew<vtkUnsignedCharArray> ghosts;
  ghosts->SetName(vtkDataSetAttributes::GhostArrayName());
  for (vtkIdType i = 0; i < plane->GetNumberOfCells(); ++i)
  {
    ghosts->InsertNextValue(i % 3 == 0 ? vtkDataSetAttributes::HIDDENCELL
        : i % 3 == 1                   ? vtkDataSetAttributes::DUPLICATECELL
                                       : 0);
  }
  plane->GetCellData()->AddArray(ghosts);
  Add(renderer, plane);
}

void AddPhysicallyBased(vtkRenderer* renderer, bool texture, bool headlight)
{
  vtkNew<vtkPlaneSource> source;
  for (int i = 0; i < 9; ++i)
  {
    vtkNew<vtkSphereSource> sphere;
    sphere->SetCenter(1.1 * (i % 3), 1.1 * (i / 3), 0.0);
    sphere->SetThetaResolution(48);
    sphere->SetPhiResolution(48);
    vtkActor* actor = Add(renderer, Make(sphere.Get()));
    if (texture && i % 2 == 0)
    {
      actor->GetMapper()->RemoveAllInputs();
      source->SetOrigin(1.1 * (i % 3) - 0.5, 1.1 * (i / 3) - 0.5, 0.0);
      source->SetPoint1(1.1 * (i % 3) + 0.5, 1.1 * (i / 3) - 0.5, 0.0);
      source->SetPoint2(1.1 * (i % 3) - 0.5, 1.1 * (i / 3) + 0.5, 0.0);
      vtkNew<vtkPolyData> plane;
      plane->DeepCopy(Make(source.Get()));
      vtkPolyDataMapper::SafeDownCast(actor->GetMapper())->SetInputData(plane);
      vtkNew<vtkTexture> image;
      image->SetInputData(MakeImage(64, 64));
      image->InterpolateOn();
      image->UseSRGBColorSpaceOn();
      actor->GetProperty()->SetBaseColorTexture(image);
      actor->GetProperty()->SetColor(1.0, 1.0, 1.0);
    }
    actor->GetProperty()->SetInterpolationToPBR();
    actor->GetProperty()->SetMetallic(0.5 * (i % 3));
    actor->GetProperty()->SetRoughness(0.1 + 0.4 * (i / 3));
  }
  if (!headlight)
  {
    vtkNew<vtkLight> light;
    light->SetPosition(3.0, 5.0, 6.0);
    light->SetFocalPoint(1.0, 1.0, 0.0);
    light->SetColor(1.0, 0.9, 0.8);
    renderer->AddLight(light);
    vtkNew<vtkLight> positional;
    positional->SetPositional(true);
    positional->SetConeAngle(90.0);
    positional->SetPosition(-2.0, 1.0, 3.0);
    positional->SetIntensity(0.6);
    renderer->AddLight(positional);
  }
}

void AddSlice(vtkRenderer* renderer, bool cropped)
{
  vtkNew<vtkImageData> volume;
  volume->SetDimensions(20, 16, 12);
  volume->SetSpacing(1.0, 1.2, 0.8);
  volume->AllocateScalars(VTK_FLOAT, 1);
  for (int k = 0; k < 12; ++k)
  {
    for (int j = 0; j < 16; ++j)
    {
      for (int i = 0; i < 20; ++i)
      {
        volume->SetScalarComponentFromDouble(
          i, j, k, 0, 50.0 + 40.0 * std::sin(0.7 * i) * std::cos(0.5 * j + 0.3 * k));
      }
    }
  }
  for (int axis = 0; axis < (cropped ? 1 : 3); ++axis)
  {
    vtkNew<vtkImageSliceMapper> mapper;
    mapper->SetInputData(volume);
    mapper->SetOrientation(axis);
    mapper->SetSliceNumber(5 + axis);
    if (cropped)
    {
      mapper->SetOrientationToZ();
      mapper->CroppingOn();
      mapper->SetCroppingRegion(3, 15, 2, 12, 0, 11);
      mapper->BorderOn();
    }
    vtkNew<vtkImageSlice> slice;
    slice->SetMapper(mapper);
    slice->GetProperty()->SetColorWindow(80.0);
    slice->GetProperty()->SetColorLevel(50.0);
    if (cropped)
    {
      vtkNew<vtkLookupTable> table;
      table->SetRange(10.0, 90.0);
      table->Build();
      slice->GetProperty()->SetLookupTable(table);
      slice->GetProperty()->UseLookupTableScalarRangeOn();
      slice->GetProperty()->SetInterpolationTypeToNearest();
    }
    renderer->AddViewProp(slice);
  }
  Look(renderer);
}

void AddAxesLayer(vtkRenderWindow* window, vtkProp* prop)
{
  vtkNew<vtkRenderer> layer;
  layer->SetLayer(1);
  layer->InteractiveOff();
  layer->SetViewport(0.0, 0.0, 0.4, 0.4);
  layer->AddViewProp(prop);
  layer->GetActiveCamera()->SetPosition(1.0, 0.8, 2.0);
  layer->ResetCamera();
  window->SetNumberOfLayers(2);
  window->AddRenderer(layer);
}

void AddText(vtkTextProperty* property)
{
  property->SetFontSize(24);
  property->SetColor(1.0, 1.0, 0.6);
}

void SetGradient(vtkRenderer* renderer)
{
  renderer->GradientBackgroundOn();
  renderer->SetBackground(0.1, 0.2, 0.6);
  renderer->SetBackground2(0.9, 0.8, 0.3);
  Add(renderer, MakeSphere());
}

}

std::vector<FeatureScene> MakeFeatureScenes()
{
  std::vector<FeatureScene> scenes;
  const auto add = [&](Feature key, auto&& build, double different = 0.002) {
    scenes.push_back({ key,
      [build](vtkRenderer* renderer, vtkRenderWindow* window) {
        (void)window;
        build(renderer, window);
      },
      different });
  };
  using Renderer = vtkRenderer*;
  using Window = vtkRenderWindow*;

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
  add(Feature::Blocks, [](Renderer r, Window) {
    AddBlocks(r);
    r->SetUseDepthPeeling(true);
  });
#if VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 3, 0)
  add(Feature::BlockTextures, [](Renderer r, Window) { AddTexturedBlock(r); });
#endif
  add(Feature::GhostCells, [](Renderer r, Window) { AddGhosts(r); });
  add(Feature::PointShape, [](Renderer r, Window) {
    vtkActor* actor = Add(r, MakePointGrid());
    actor->GetProperty()->SetPointSize(17.f);
#if VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 4, 0)
    actor->GetProperty()->SetPoint2DShape(vtkProperty::Point2DShapeType::Round);
#endif
  });
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
  add(
    Feature::PhysicallyBased, [](Renderer r, Window) { AddPhysicallyBased(r, false, true); },
    0.004);
  add(Feature::PhysicallyBased, [](Renderer r, Window) { AddPhysicallyBased(r, true, false); });
  add(Feature::Textures,
    [](Renderer r, Window) { AddTexture(Add(r, MakePlane()), MakeImage(32, 32)); });
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
    AddText(text->GetTextProperty());
    r->AddViewProp(text);
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
      AddText(text->GetTextProperty());
      r->AddViewProp(text);
    },
    0.01);
  add(
    Feature::Text3D,
    [](Renderer r, Window) {
      vtkNew<vtkTextActor3D> text;
      text->SetInput("Text 3D");
      AddText(text->GetTextProperty());
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
    texture->SetInputData(MakeImage(50, 40));
    texture->InterpolateOn();
    r->SetBackgroundTexture(texture);
    r->TexturedBackgroundOn();
    Add(r, MakeSphere());
  });
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
  add(Feature::HiddenLineRemoval, [](Renderer r, Window) {
    r->SetUseHiddenLineRemoval(true);
    Add(r, MakeCube())->GetProperty()->SetRepresentationToWireframe();
    Look(r);
  });
  add(Feature::ForceOpaque, [](Renderer r, Window) {
    vtkActor* actor = Add(r, MakeCube());
    actor->GetProperty()->SetOpacity(0.4);
    actor->ForceOpaqueOn();
    Look(r);
  });
  add(Feature::PhysicallyBasedDetails, [](Renderer r, Window) {
    vtkActor* actor = Add(r, MakeSphere(48));
    actor->GetProperty()->SetInterpolationToPBR();
    actor->GetProperty()->SetCoatStrength(1.0);
  });
  return scenes;
}
