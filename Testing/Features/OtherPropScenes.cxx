// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Scenes of mappers and props other than vtkPolyDataMapper and its actors.
#include "FeatureProps.h"
#include "SceneList.h"

#include "vtkActor.h"
#include "vtkActor2D.h"
#include "vtkAxisActor2D.h"
#include "vtkCamera.h"
#include "vtkCaptionActor2D.h"
#include "vtkCellArray.h"
#include "vtkCoordinate.h"
#include "vtkCornerAnnotation.h"
#include "vtkCubeAxesActor.h"
#include "vtkDoubleArray.h"
#include "vtkImageData.h"
#include "vtkImageMapper.h"
#include "vtkLODProp3D.h"
#include "vtkLabelPlacementMapper.h"
#include "vtkLabeledDataMapper.h"
#include "vtkLegendBoxActor.h"
#include "vtkLegendScaleActor.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPointGaussianMapper.h"
#include "vtkPointSetToLabelHierarchy.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkPolyDataMapper.h"
#include "vtkPolyDataMapper2D.h"
#include "vtkProp3DFollower.h"
#include "vtkProperty.h"
#include "vtkProperty2D.h"
#include "vtkSkybox.h"
#include "vtkStringArray.h"
#include "vtkTextMapper.h"
#include "vtkTextProperty.h"
#include "vtkTexture.h"

// Some distributions of VTK omit these classes.
#if __has_include("vtkOpenGLSphereMapper.h") && __has_include("vtkOpenGLStickMapper.h")
#include "vtkFloatArray.h"
#include "vtkOpenGLSphereMapper.h"
#include "vtkOpenGLStickMapper.h"
#define PENUMBRA_HAS_IMPOSTERS
#endif

#include <cmath>
#include <string>

using penumbra::Feature;

namespace
{

/// Shader code of a disc, and of one whose brightness is 1 - d^2 at the distance d from its center.
const char* const DiscCode = "//VTK::Color::Impl\n"
                             "float dist = dot(offsetVCVSOutput.xy, offsetVCVSOutput.xy);\n"
                             "if (dist > 1.0) { discard; }\n";
const char* const SphereCode = "//VTK::Color::Impl\n"
                               "float dist = dot(offsetVCVSOutput.xy, offsetVCVSOutput.xy);\n"
                               "if (dist > 1.0) { discard; } else {\n"
                               "float scale = (1.0 - dist);\n"
                               "ambientColor *= scale; diffuseColor *= scale; }\n";

/// Adds splats that are drawn back to front, because VTK does not sort them.
vtkPointGaussianMapper* AddSplats(Renderer renderer, const char* code, bool emissive, bool arrays)
{
  vtkSmartPointer<vtkPolyData> data = MakePointGrid();
  vtkNew<vtkDoubleArray> scale;
  scale->SetName("Scale");
  vtkNew<vtkDoubleArray> color;
  for (vtkIdType i = 0; i < data->GetNumberOfPoints(); ++i)
  {
    scale->InsertNextValue(0.4 + 0.04 * static_cast<double>(i));
    color->InsertNextValue(static_cast<double>(i % 5));
    double x[3];
    data->GetPoint(i, x);
    data->GetPoints()->SetPoint(i, x[0], x[1], 0.05 * static_cast<double>(i));
  }
  data->GetPointData()->AddArray(scale);
  vtkNew<vtkPointGaussianMapper> mapper;
  mapper->SetInputData(data);
  mapper->SetScaleFactor(0.4);
  mapper->SetEmissive(emissive);
  if (code)
  {
    mapper->SetSplatShaderCode(code);
  }
  if (arrays)
  {
    data->GetPointData()->SetScalars(color);
    mapper->SetScalarRange(0.0, 4.0);
    mapper->SetScaleArray("Scale");
    mapper->SetOpacityArray("Scale");
    mapper->SetOpacityArrayComponent(0);
  }
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  actor->GetProperty()->SetColor(0.9, 0.6, 0.3);
  renderer->AddActor(actor);
  renderer->ResetCamera();
  return mapper;
}

#ifdef PENUMBRA_HAS_IMPOSTERS
/// Adds the points of a grid with the arrays Radius, Size and Axis, drawn by `mapper`.
void AddImposters(Renderer renderer, vtkPolyDataMapper* mapper, bool scalars)
{
  vtkSmartPointer<vtkPolyData> data = MakePointGrid();
  vtkNew<vtkFloatArray> radii;
  radii->SetName("Radius");
  vtkNew<vtkFloatArray> sizes;
  sizes->SetName("Size");
  sizes->SetNumberOfComponents(3);
  vtkNew<vtkFloatArray> axes;
  axes->SetName("Axis");
  axes->SetNumberOfComponents(3);
  vtkNew<vtkDoubleArray> color;
  for (vtkIdType i = 0; i < data->GetNumberOfPoints(); ++i)
  {
    const double angle = 0.7 * static_cast<double>(i);
    radii->InsertNextValue(0.2f + 0.015f * static_cast<float>(i));
    sizes->InsertNextTuple3(0.5 + 0.03 * static_cast<double>(i), 0.15, 0.0);
    axes->InsertNextTuple3(0.8 * std::cos(angle), 0.8 * std::sin(angle), i % 2 == 0 ? 0.6 : -0.6);
    color->InsertNextValue(static_cast<double>(i % 5));
  }
  data->GetPointData()->AddArray(radii);
  data->GetPointData()->AddArray(sizes);
  data->GetPointData()->AddArray(axes);
  if (scalars)
  {
    data->GetPointData()->SetScalars(color);
    mapper->SetScalarRange(0.0, 4.0);
  }
  mapper->SetInputData(data);
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  actor->GetProperty()->SetColor(0.9, 0.6, 0.3);
  actor->GetProperty()->SetSpecular(0.4);
  actor->GetProperty()->SetSpecularPower(20.0);
  actor->RotateX(25.0);
  renderer->AddActor(actor);
  renderer->ResetCamera();
}
#endif

/// Adds spheres and sticks, which VTK draws as imposters.
void AddImposterScenes([[maybe_unused]] SceneList& add)
{
#ifdef PENUMBRA_HAS_IMPOSTERS
  for (const bool arrays : { false, true })
  {
    add(Feature::Imposters, [arrays](Renderer r, Window) {
      vtkNew<vtkOpenGLSphereMapper> mapper;
      if (arrays)
      {
        mapper->SetScaleArray("Radius");
      }
      AddImposters(r, mapper, arrays);
    });
  }
  for (const bool parallel : { false, true })
  {
    add(Feature::Imposters, [parallel](Renderer r, Window) {
      vtkNew<vtkOpenGLStickMapper> mapper;
      mapper->SetScaleArray("Size");
      mapper->SetOrientationArray("Axis");
      AddImposters(r, mapper, true); // VTK needs colors
      r->GetActiveCamera()->SetParallelProjection(parallel);
    });
  }
#endif
}

void AddMappers(SceneList& add)
{
  AddImposterScenes(add);
  for (const bool arrays : { false, true })
  {
    add(Feature::PointSplats,
      [arrays](Renderer r, Window) { AddSplats(r, SphereCode, false, arrays); });
    add(Feature::PointSplats,
      [arrays](Renderer r, Window) { AddSplats(r, DiscCode, false, arrays); });
    add(Feature::PointSplats,
      [arrays](Renderer r, Window) { AddSplats(r, nullptr, true, arrays)->SetScaleFactor(0.2); });
  }
  add(Feature::PointSplats,
    [](Renderer r, Window) { AddSplats(r, nullptr, false, false)->SetScaleFactor(0.1); });
  add(Feature::PointSplats, [](Renderer r, Window) {
    AddSplats(r, SphereCode, false, false);
    vtkActor* sphere = Add(r, MakeSphere());
    sphere->SetPosition(1.0, 1.0, 0.2);
  });
}

/// Adds a 2-D actor with a mapper at a pixel of the window.
vtkActor2D* Add2D(Renderer renderer, vtkMapper2D* mapper, int x, int y)
{
  vtkNew<vtkActor2D> actor;
  actor->SetMapper(mapper);
  actor->SetPosition(x, y);
  renderer->AddViewProp(actor);
  return actor;
}

/// Adds a star with ten corners, a circle of lines and points in the plane of the window.
void AddPolygons2D(Renderer renderer)
{
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> polygons;
  vtkNew<vtkCellArray> lines;
  vtkNew<vtkCellArray> vertices;
  polygons->InsertNextCell(10);
  lines->InsertNextCell(10);
  for (int i = 0; i < 10; ++i)
  {
    const double radius = i % 2 == 0 ? 40.0 : 20.0;
    const double angle = 0.2 + 0.6283185307179586 * i;
    const vtkIdType corner =
      points->InsertNextPoint(radius * std::cos(angle), radius * std::sin(angle), 0.0);
    const vtkIdType end =
      points->InsertNextPoint(55.0 * std::cos(angle), 55.0 * std::sin(angle), 0.0);
    polygons->InsertCellPoint(corner);
    lines->InsertCellPoint(end);
    vertices->InsertNextCell(1, &end);
  }
  vtkNew<vtkPolyData> data;
  data->SetPoints(points);
  data->SetPolys(polygons);
  data->SetLines(lines);
  data->SetVerts(vertices);
  vtkNew<vtkPolyDataMapper2D> mapper;
  mapper->SetInputData(data);
  vtkActor2D* actor = Add2D(renderer, mapper, 80, 80);
  actor->GetProperty()->SetColor(0.9, 0.6, 0.3);
  actor->GetProperty()->SetLineWidth(3.f);
  actor->GetProperty()->SetPointSize(7.f);
}

/// Adds points of the world that are colored by scalars, and a rectangle with colored corners.
void AddColors2D(Renderer renderer)
{
  Add(renderer, MakeSphere());
  vtkSmartPointer<vtkPolyData> plane = MakePlane(4);
  AddElevation(plane);
  vtkNew<vtkCoordinate> world;
  world->SetCoordinateSystemToWorld();
  vtkNew<vtkPolyDataMapper2D> mapper;
  mapper->SetInputData(plane);
  mapper->SetTransformCoordinate(world);
  Add2D(renderer, mapper, 0, 0)->GetProperty()->SetOpacity(0.6);
}

void AddActors2D(SceneList& add)
{
  add(
    Feature::Actors2D, [](Renderer r, Window) { AddPolygons2D(r); }, 0.01);
  add(
    Feature::Actors2D, [](Renderer r, Window) { AddColors2D(r); }, 0.01);
  add(Feature::Actors2D, [](Renderer r, Window) {
    vtkNew<vtkTextMapper> mapper;
    mapper->SetInput("Text mapper");
    StyleText(mapper->GetTextProperty());
    Add2D(r, mapper, 10, 60);
  });
  add(Feature::Labels, [](Renderer r, Window) {
    Add(r, MakePointGrid());
    vtkNew<vtkLabeledDataMapper> mapper;
    mapper->SetInputData(MakePointGrid());
    Add2D(r, mapper, 0, 0);
    r->ResetCamera();
  });
  for (const int shape : { vtkLabelPlacementMapper::NONE, vtkLabelPlacementMapper::ROUNDED_RECT })
  {
    add(Feature::Labels, [shape](Renderer r, Window w) {
      vtkSmartPointer<vtkPolyData> data = MakePointGrid();
      vtkNew<vtkStringArray> names;
      names->SetName("Names");
      for (int i = 0; i < 16; ++i)
      {
        names->InsertNextValue("Point " + std::to_string(i));
      }
      data->GetPointData()->AddArray(names);
      Add(r, data);
      vtkNew<vtkPointSetToLabelHierarchy> hierarchy;
      hierarchy->SetInputData(data);
      hierarchy->SetLabelArrayName("Names");
      vtkNew<vtkLabelPlacementMapper> mapper;
      mapper->SetInputConnection(hierarchy->GetOutputPort());
      mapper->SetShape(shape);
      mapper->SetBackgroundColor(0.2, 0.5, 0.2);
      Add2D(r, mapper, 0, 0);
      r->ResetCamera();
      w->Render(); // VTK places labels only in windows that have rendered
    });
  }
  for (const bool stretched : { false, true })
  {
    add(Feature::Actors2D, [stretched](Renderer r, Window) {
      vtkNew<vtkImageMapper> mapper;
      mapper->SetInputData(MakeImage(50, 40));
      mapper->SetColorWindow(200.0);
      mapper->SetColorLevel(100.0);
      mapper->SetRenderToRectangle(stretched);
      vtkActor2D* actor = Add2D(r, mapper, 20, 30);
      actor->SetPosition2(0.7, 0.5);
    });
  }
  add(
    Feature::Captions,
    [](Renderer r, Window) {
      Add(r, MakeSphere());
      vtkNew<vtkCaptionActor2D> caption;
      caption->SetCaption("Caption");
      caption->SetAttachmentPoint(0.2, 0.1, 0.45);
      caption->SetPosition(15, 30);
      caption->SetWidth(0.4);
      caption->SetHeight(0.15);
      caption->ThreeDimensionalLeaderOff();
      r->AddViewProp(caption);
    },
    0.01);
  add(
    Feature::Legends,
    [](Renderer r, Window) {
      vtkNew<vtkLegendBoxActor> legend;
      legend->SetNumberOfEntries(2);
      double colors[2][3] = { { 0.9, 0.6, 0.3 }, { 0.3, 0.8, 0.4 } };
      vtkSmartPointer<vtkPolyData> symbols[2] = { MakePlane(), MakePlane() };
      legend->SetEntry(0, symbols[0], "First", colors[0]);
      legend->SetEntry(1, symbols[1], "Second", colors[1]);
      legend->GetPositionCoordinate()->SetValue(0.1, 0.2);
      legend->GetPosition2Coordinate()->SetValue(0.8, 0.5);
      legend->UseBackgroundOn();
      legend->SetBackgroundColor(0.1, 0.1, 0.3);
      r->AddViewProp(legend);
    },
    0.01);
  add(
    Feature::Axes2D,
    [](Renderer r, Window) {
      vtkNew<vtkAxisActor2D> axis;
      axis->GetPositionCoordinate()->SetCoordinateSystemToNormalizedViewport();
      axis->GetPosition2Coordinate()->SetCoordinateSystemToNormalizedViewport();
      axis->SetPoint1(0.15, 0.5);
      axis->SetPoint2(0.9, 0.5);
      axis->SetRange(0.0, 10.0);
      axis->SetTitle("Axis");
      r->AddViewProp(axis);
    },
    0.01);
  add(
    Feature::Axes2D,
    [](Renderer r, Window) {
      Add(r, MakeSphere());
      r->GetActiveCamera()->ParallelProjectionOn();
      r->ResetCamera();
      vtkNew<vtkLegendScaleActor> scale;
      r->AddViewProp(scale);
    },
    0.02);
  add(
    Feature::CornerTexts,
    [](Renderer r, Window) {
      vtkNew<vtkCornerAnnotation> corner;
      corner->SetText(0, "Lower left");
      corner->SetText(3, "Upper right");
      corner->SetMaximumFontSize(18);
      r->AddViewProp(corner);
    },
    0.01);
}

/// Adds a skybox. Each face of the cube has another size, so that their order matters.
vtkSkybox* AddSkybox(Renderer renderer, bool cube)
{
  Add(renderer, MakeSphere());
  vtkNew<vtkTexture> texture;
  texture->InterpolateOn();
  texture->SetCubeMap(cube);
  for (int face = 0; face < (cube ? 6 : 1); ++face)
  {
    const int size = cube ? 16 + 8 * face : 64;
    vtkSmartPointer<vtkImageData> image = MakeImage(cube ? 64 : 128, 64);
    for (int j = 0; cube && j < size; ++j)
    {
      for (int i = 0; i < size; ++i)
      {
        *static_cast<unsigned char*>(image->GetScalarPointer(i, j, 0)) =
          static_cast<unsigned char>(40 * face);
      }
    }
    texture->SetInputDataObject(face, image);
  }
  vtkNew<vtkSkybox> skybox;
  skybox->SetTexture(texture);
  skybox->SetProjection(cube ? vtkSkybox::Cube : vtkSkybox::Sphere);
  renderer->AddActor(skybox);
  renderer->GetActiveCamera()->SetPosition(1.0, 0.8, 2.0);
  renderer->ResetCamera();
  renderer->GetActiveCamera()->SetViewAngle(90.0);
  return skybox;
}

void AddSkyboxes(SceneList& add)
{
  for (const bool cube : { false, true })
  {
    for (int view = 0; view < 6; ++view)
    {
      add(
        Feature::Skyboxes,
        [cube, view](Renderer r, Window) {
          vtkSkybox* skybox = AddSkybox(r, cube);
          skybox->SetGammaCorrect(view % 2 == 1);
          r->GetActiveCamera()->Azimuth(60.0 * view);
          r->GetActiveCamera()->Elevation(60.0 - 24.0 * view);
          if (view == 2)
          {
            r->SetEnvironmentUp(0.0, 0.0, 1.0);
            r->SetEnvironmentRight(0.0, 1.0, 0.0);
          }
          if (view == 3)
          {
            r->GetActiveCamera()->ParallelProjectionOn();
          }
          r->ResetCameraClippingRange();
        },
        0.01);
    }
  }
}

void AddCompoundProps(SceneList& add)
{
  for (const bool automatic : { false, true })
  {
    add(Feature::LevelsOfDetail, [automatic](Renderer r, Window) {
      vtkNew<vtkLODProp3D> details;
      int ids[2];
      for (int i = 0; i < 2; ++i)
      {
        vtkNew<vtkPolyDataMapper> mapper;
        mapper->SetInputData(i == 0 ? MakeSphere(6) : MakeSphere());
        vtkNew<vtkProperty> property;
        property->SetColor(0.9, 0.6, 0.3 * i);
        ids[i] = details->AddLOD(mapper, property, 0.01 + 0.01 * i);
        details->SetLODLevel(ids[i], 1.0 - i);
      }
      details->SetAutomaticLODSelection(automatic);
      details->SetSelectedLODID(ids[0]);
      details->SetScale(1.0, 0.7, 1.0);
      details->RotateZ(30.0);
      r->AddViewProp(details);
      Look(r);
    });
  }
  add(Feature::PropFollowers, [](Renderer r, Window) {
    vtkSmartPointer<vtkActor> plane = Add(r, MakePlane());
    r->RemoveActor(plane);
    vtkNew<vtkProp3DFollower> follower;
    follower->SetProp3D(plane);
    follower->SetCamera(r->GetActiveCamera());
    follower->SetPosition(0.5, 0.2, 0.0);
    r->AddViewProp(follower);
    Add(r, MakeCube());
    Look(r);
  });
  add(
    Feature::CubeAxes2D,
    [](Renderer r, Window) {
      vtkNew<vtkCubeAxesActor> axes;
      Add(r, MakePlane());
      axes->SetBounds(-0.5, 0.5, -0.5, 0.5, 0.0, 0.0);
      axes->SetXTitle("Width");
      axes->SetYTitle("Height");
      axes->SetUse2DMode(true);
      axes->ZAxisVisibilityOff();
      axes->SetCamera(r->GetActiveCamera());
      r->AddActor(axes);
      r->GetActiveCamera()->ParallelProjectionOn();
      r->ResetCamera();
      r->GetActiveCamera()->Zoom(0.7);
    },
    0.02);
}

}

void AddOtherProps(SceneList& add)
{
  AddSkyboxes(add);
  AddCompoundProps(add);
  AddActors2D(add);
  AddMappers(add);
}
