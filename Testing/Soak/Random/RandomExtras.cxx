// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "RandomExtras.h"

#include "RandomMeshes.h"

#include "vtkActor.h"
#include "vtkDataArray.h"
#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkLookupTable.h"
#include "vtkMatrix4x4.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkPolyDataMapper.h"
#include "vtkPolyDataNormals.h"
#include "vtkProperty.h"
#include "vtkRenderer.h"
#include "vtkTexture.h"

#include <string>

namespace penumbra_soak
{
namespace
{

/// Shears or reflects an actor about its center, and scales it by up to 1e3 in one direction and back in another.
void SetMatrix(Random& random, vtkActor* actor)
{
  const double* center = actor->GetCenter();
  const double factor = random.Chance(0.2) ? random.Scale(1e-3, 1e3) : 1.0;
  const double diagonal[3] = { factor, random.Chance(0.4) ? -1.0 : 1.0,
    random.Chance(0.2) ? -1.0 : 1.0 };
  vtkNew<vtkMatrix4x4> matrix;
  for (int i = 0; i < 3; ++i)
  {
    double moved = 0.0;
    for (int k = 0; k < 3; ++k)
    {
      matrix->SetElement(i, k, i == k ? diagonal[i] : k > i ? random.Between(-0.7, 0.7) : 0.0);
      moved += matrix->GetElement(i, k) * center[k];
    }
    matrix->SetElement(i, 3, center[i] - moved);
  }
  actor->SetUserMatrix(matrix);
}

/// Scalars over several decades with a logarithmic table, or few values with a categorical one.
void SetTable(Random& random, vtkPolyDataMapper* mapper, vtkPolyData* data, bool logarithmic)
{
  vtkNew<vtkFloatArray> values;
  values->SetName("extras");
  vtkNew<vtkLookupTable> table;
  table->SetNumberOfTableValues(logarithmic ? 256 : 5);
  for (vtkIdType i = 0; i < data->GetNumberOfPoints(); ++i)
  {
    values->InsertNextValue(
      static_cast<float>(logarithmic ? random.Scale(1e-4, 1e4) : random.Below(6)));
  }
  data->GetPointData()->SetScalars(values);
  if (logarithmic)
  {
    table->SetScaleToLog10();
    table->SetTableRange(1e-3, 1e3);
  }
  table->Build();
  for (int i = 0; i < 5 && !logarithmic; ++i)
  {
    table->SetAnnotation(vtkVariant(i), std::to_string(i));
    const glm::dvec3 color = random.Color();
    table->SetTableValue(i, color.r, color.g, color.b, 1.0);
  }
  table->SetIndexedLookup(!logarithmic);
  mapper->SetLookupTable(table);
  mapper->SetUseLookupTableScalarRange(true);
  mapper->SetScalarModeToUsePointData();
  mapper->SetColorModeToMapScalars();
  mapper->SetInterpolateScalarsBeforeMapping(random.Chance(0.5));
  mapper->ScalarVisibilityOn();
}

/// A texture whose alpha varies.
vtkSmartPointer<vtkTexture> MakeTranslucentTexture(Random& random)
{
  vtkNew<vtkImageData> image;
  image->SetDimensions(16, 16, 1);
  image->AllocateScalars(VTK_UNSIGNED_CHAR, 4);
  for (int i = 0; i < 256; ++i)
  {
    for (int c = 0; c < 4; ++c)
    {
      image->SetScalarComponentFromDouble(i % 16, i / 16, 0, c, random.Below(256));
    }
  }
  auto texture = vtkSmartPointer<vtkTexture>::New();
  texture->SetInputData(image);
  texture->SetInterpolate(random.Chance(0.5));
  return texture;
}

}

void AddRandomExtras(Random& random, vtkRenderer* renderer, double unit, RandomProp& prop)
{
  auto* actor = vtkActor::SafeDownCast(prop.Prop);
  auto* mapper = actor ? vtkPolyDataMapper::SafeDownCast(actor->GetMapper()) : nullptr;
  vtkPolyData* data = mapper ? mapper->GetInput() : nullptr;
  if (!data || data->GetNumberOfPoints() == 0)
  {
    return;
  }
  const auto choose = [&](double probability, const char* name) {
    const bool chosen = random.Chance(probability);
    prop.Description += chosen ? std::string(", ") + name : std::string();
    return chosen;
  };
  if (choose(0.2, "matrix"))
  {
    SetMatrix(random, actor);
  }
  if (choose(0.2, "interpolated normals") && data->GetNumberOfPolys() > 0)
  {
    vtkNew<vtkPolyDataNormals> normals;
    normals->SetInputData(data);
    normals->SplittingOff();
    normals->Update();
    data->ShallowCopy(normals->GetOutput());
    actor->GetProperty()->SetInterpolationToPhong();
  }
  const bool logarithmic = choose(0.12, "logarithmic table");
  if (logarithmic || choose(0.12, "categorical table"))
  {
    SetTable(random, mapper, data, logarithmic);
  }
  if (data->GetPointData()->GetTCoords() && choose(0.3, "texture with alpha"))
  {
    actor->SetTexture(MakeTranslucentTexture(random));
    prop.Translucent = true;
  }
  if (choose(0.1, "small emitter"))
  {
    actor->SetScale(unit * random.Scale(0.02, 0.2));
    actor->GetProperty()->SetAmbient(random.Scale(1.0, 50.0));
    prop.Arbitrary = true; // VTK clamps
  }
  if (choose(0.1, "copy in one place"))
  {
    vtkNew<vtkActor> copy;
    copy->ShallowCopy(actor);
    vtkNew<vtkProperty> property;
    property->DeepCopy(actor->GetProperty());
    const glm::dvec3 color = random.Color();
    property->SetColor(color.r, color.g, color.b);
    copy->SetProperty(property);
    renderer->AddViewProp(copy);
  }
}

}
