// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "RandomProps.h"

#include "RandomMeshes.h"

#include "vtkActor.h"
#include "vtkAnnotatedCubeActor.h"
#include "vtkAssembly.h"
#include "vtkAxesActor.h"
#include "vtkBillboardTextActor3D.h"
#include "vtkConeSource.h"
#include "vtkGlyph3DMapper.h"
#include "vtkImageActor.h"
#include "vtkImageData.h"
#include "vtkLookupTable.h"
#include "vtkNew.h"
#include "vtkPlane.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkPolyDataMapper.h"
#include "vtkProperty.h"
#include "vtkRenderer.h"
#include "vtkScalarBarActor.h"
#include "vtkTextActor.h"
#include "vtkTextProperty.h"
#include "vtkTexture.h"

namespace penumbra_soak
{
namespace
{

void Append(std::string& description, const char* text, bool condition = true)
{
  description += condition ? std::string(", ") + text : std::string();
}

void SetColors(Random& random, vtkProperty* property, std::string& description)
{
  const glm::dvec3 color = random.Color();
  property->SetColor(color.r, color.g, color.b);
  property->SetAmbient(random.Chance(0.3) ? random.Unit() : 0.0);
  property->SetDiffuse(random.Chance(0.3) ? random.Unit() : 1.0);
  if (random.Chance(0.3))
  {
    property->SetSpecular(random.Unit());
    property->SetSpecularPower(random.Scale(1.0, 128.0));
    Append(description,
      ("specular " + std::to_string(property->GetSpecular()) + " power " +
        std::to_string(property->GetSpecularPower()))
        .c_str());
  }
  property->SetInterpolation(random.Pick({ VTK_FLAT, VTK_GOURAUD, VTK_PHONG, VTK_PHONG }));
  if (random.Chance(0.1))
  {
    property->SetInterpolationToPBR();
    property->SetMetallic(random.Unit());
    property->SetRoughness(random.Between(0.1, 1.0));
    Append(description, "physically based");
  }
  Append(description, "flat", property->GetInterpolation() == VTK_FLAT);
  property->SetLighting(random.Chance(0.85));
  Append(description, "unlit", !property->GetLighting());
}

void SetStyle(Random& random, vtkProperty* property, std::string& description)
{
  property->SetLineWidth(static_cast<float>(random.Scale(1.0, 6.0)));
  property->SetPointSize(static_cast<float>(random.Scale(1.0, 12.0)));
  if (random.Chance(0.2))
  {
    property->SetRepresentation(random.Pick({ VTK_POINTS, VTK_WIREFRAME, VTK_WIREFRAME }));
    Append(description, property->GetRepresentationAsString());
  }
  property->SetEdgeVisibility(random.Chance(0.12));
  Append(description, "edges", property->GetEdgeVisibility());
  property->SetVertexVisibility(random.Chance(0.06));
  Append(description, "vertices", property->GetVertexVisibility());
  property->SetRenderPointsAsSpheres(random.Chance(0.2));
  Append(description, "points as spheres", property->GetRenderPointsAsSpheres());
  property->SetRenderLinesAsTubes(random.Chance(0.2));
  Append(description, "lines as tubes", property->GetRenderLinesAsTubes());
  const int culling = random.Below(12);
  property->SetBackfaceCulling(culling == 0);
  property->SetFrontfaceCulling(culling == 1);
  Append(description, "back faces culled", culling == 0);
  Append(description, "front faces culled", culling == 1);
}

vtkSmartPointer<vtkTexture> MakeTexture(Random& random)
{
  auto texture = vtkSmartPointer<vtkTexture>::New();
  texture->SetInputData(MakeRandomImage(random));
  texture->SetInterpolate(random.Chance(0.5));
  texture->SetRepeat(random.Chance(0.5));
  texture->SetMipmap(random.Chance(0.2));
  texture->SetUseSRGBColorSpace(random.Chance(0.2));
  return texture;
}

void SetTransform(Random& random, vtkProp3D* prop, glm::dvec3 center, double unit, bool sheared)
{
  prop->SetPosition(center.x, center.y, center.z);
  prop->RotateWXYZ(random.Between(0.0, 360.0), random.Unit(), random.Unit(), random.Unit() + 0.01);
  const double size = unit * random.Scale(0.3, 2.0);
  glm::dvec3 scale(size);
  if (sheared)
  {
    scale *= glm::dvec3(random.Scale(0.3, 2.0), random.Scale(0.3, 2.0), random.Scale(0.3, 2.0));
    scale.x *= random.Chance(0.5) ? -1.0 : 1.0;
  }
  prop->SetScale(scale.x, scale.y, scale.z);
}

void AddMapperOptions(
  Random& random, vtkMapper* mapper, vtkPolyData* mesh, std::string& description)
{
  if (random.Chance(0.3))
  {
    AddRandomArrays(random, mesh);
    mapper->SetInterpolateScalarsBeforeMapping(random.Chance(0.5));
    mapper->SetScalarRange(0.0, random.Between(0.5, 1.0));
    mapper->SetColorMode(random.Pick({ VTK_COLOR_MODE_DEFAULT, VTK_COLOR_MODE_MAP_SCALARS }));
    vtkNew<vtkLookupTable> table;
    table->SetNumberOfTableValues(random.Pick({ 3, 16, 256 }));
    table->SetAlphaRange(random.Chance(0.2) ? 0.2 : 1.0, 1.0);
    table->Build();
    mapper->SetLookupTable(table);
    Append(description, "scalars");
    Append(description, "interpolated first", mapper->GetInterpolateScalarsBeforeMapping());
  }
  else
  {
    mapper->ScalarVisibilityOff();
  }
}

RandomProp MakeMeshActor(Random& random, bool difficult, glm::dvec3 center, double unit)
{
  RandomProp prop;
  const RandomMesh mesh = MakeRandomMesh(random, difficult);
  vtkNew<vtkPolyData> data;
  data->DeepCopy(mesh.Data);
  vtkNew<vtkActor> actor;
  prop.Description = mesh.Name;
  vtkProperty* property = actor->GetProperty();
  SetColors(random, property, prop.Description);
  SetStyle(random, property, prop.Description);
  // VTK draws the highlights of the surface on its edges, and leaves out the ambient color of physically based edges
  // and vertices.
  const bool isPhysicallyBased = property->GetInterpolation() == VTK_PBR;
  prop.Arbitrary = mesh.Arbitrary ||
    (property->GetEdgeVisibility() && (isPhysicallyBased || property->GetSpecular() > 0.0)) ||
    (property->GetVertexVisibility() && isPhysicallyBased);
  vtkNew<vtkPolyDataMapper> mapper;
  AddMapperOptions(random, mapper, data, prop.Description);
  mapper->SetInputData(data);
  actor->SetMapper(mapper);
  if (random.Chance(0.2))
  {
    property->SetOpacity(random.Between(0.05, 0.95));
    Append(prop.Description, "translucent");
  }
  if (data->GetPointData()->GetTCoords() && random.Chance(0.5))
  {
    actor->SetTexture(MakeTexture(random));
    Append(prop.Description, "texture");
  }
  if (random.Chance(0.1))
  {
    vtkNew<vtkProperty> back;
    const glm::dvec3 color = random.Color();
    back->SetColor(color.r, color.g, color.b);
    actor->SetBackfaceProperty(back);
    Append(prop.Description, "backface property");
    // VTK does not draw these back faces.
    prop.Arbitrary = prop.Arbitrary || property->GetInterpolation() == VTK_PBR;
  }
  const bool sheared = random.Chance(0.2);
  SetTransform(random, actor, center, unit, sheared);
  Append(prop.Description, "non-uniform scale", sheared);
  Append(prop.Description, "mirrored", actor->GetScale()[0] < 0.0);
  if (random.Chance(0.1))
  {
    vtkNew<vtkPlane> plane;
    const glm::dvec3 normal = random.Direction();
    plane->SetNormal(normal.x, normal.y, normal.z);
    plane->SetOrigin(center.x, center.y, center.z);
    mapper->AddClippingPlane(plane);
    Append(prop.Description, "clipping plane");
  }
  prop.Translucent = actor->HasTranslucentPolygonalGeometry() != 0;
  prop.Prop = actor;
  return prop;
}

RandomProp MakeGlyphs(Random& random, glm::dvec3 center, double unit)
{
  RandomProp prop;
  prop.Description = "glyphs";
  vtkNew<vtkPolyData> places;
  vtkNew<vtkPoints> points;
  for (int i = 0; i < 3 + random.Below(30); ++i)
  {
    const glm::dvec3 p = 0.6 * random.Vector();
    points->InsertNextPoint(p.x, p.y, p.z);
  }
  places->SetPoints(points);
  vtkNew<vtkConeSource> cone;
  cone->SetHeight(0.3);
  cone->SetRadius(0.1);
  cone->SetResolution(3 + random.Below(20));
  cone->Update();
  vtkNew<vtkGlyph3DMapper> mapper;
  mapper->SetInputData(places);
  mapper->SetSourceData(cone->GetOutput());
  mapper->ScalarVisibilityOff();
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  SetColors(random, actor->GetProperty(), prop.Description);
  SetTransform(random, actor, center, unit, false);
  prop.Prop = actor;
  return prop;
}

RandomProp MakeAssembly(Random& random, glm::dvec3 center, double unit)
{
  RandomProp prop;
  prop.Description = "assembly";
  vtkNew<vtkAssembly> assembly;
  for (int i = 0; i < 2 + random.Below(3); ++i)
  {
    const RandomProp part = MakeMeshActor(random, false, 0.5 * random.Vector(), 0.5);
    assembly->AddPart(vtkProp3D::SafeDownCast(part.Prop));
    prop.Description += " (" + part.Description + ")";
    prop.Translucent = prop.Translucent || part.Translucent;
  }
  SetTransform(random, assembly, center, unit, false);
  prop.Prop = assembly;
  return prop;
}

RandomProp MakeAnnotation(Random& random, vtkRenderer*, glm::dvec3 center, double unit)
{
  RandomProp prop;
  const int kind = random.Below(5);
  prop.NeedsCaster = kind != 0; // 2-D props
  switch (kind)
  {
    case 0:
    {
      prop.Description = "image actor";
      vtkNew<vtkImageActor> actor;
      actor->SetInputData(MakeRandomImage(random));
      SetTransform(random, actor, center, unit / 32.0, false);
      prop.Prop = actor;
      prop.Translucent = true;
      break;
    }
    case 1:
    {
      prop.Description = "text actor";
      vtkNew<vtkTextActor> actor;
      actor->SetInput("Text 8%");
      actor->SetPosition(random.Below(60), random.Below(80));
      actor->GetTextProperty()->SetFontSize(8 + random.Below(20));
      prop.Prop = actor;
      break;
    }
    case 2:
    {
      prop.Description = "scalar bar";
      vtkNew<vtkLookupTable> table;
      table->Build();
      vtkNew<vtkScalarBarActor> actor;
      actor->SetLookupTable(table);
      prop.Prop = actor;
      prop.Arbitrary = true; // text in few pixels
      break;
    }
    case 3:
    {
      prop.Description = "axes actor";
      vtkNew<vtkAxesActor> actor;
      actor->SetTotalLength(unit, unit, unit);
      prop.Prop = actor;
      break;
    }
    default:
    {
      prop.Description = "billboard text";
      vtkNew<vtkBillboardTextActor3D> actor;
      actor->SetInput("Text");
      actor->SetPosition(center.x, center.y, center.z);
      actor->GetTextProperty()->SetFontSize(8 + random.Below(20));
      prop.Prop = actor;
      break;
    }
  }
  return prop;
}

}

RandomProp MakeRandomProp(
  Random& random, vtkRenderer* renderer, bool difficult, glm::dvec3 center, double unit)
{
  const int kind = random.Below(20);
  return kind == 0 ? MakeGlyphs(random, center, unit)
    : kind == 1    ? MakeAssembly(random, center, unit)
    : kind == 2    ? MakeAnnotation(random, renderer, center, unit)
                   : MakeMeshActor(random, difficult, center, unit);
}

}
