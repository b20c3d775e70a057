// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Compares scalar mapping and textures with VTK's rasterizer.
#include "ShadingOfActor.h"

#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkImageData.h"
#include "vtkLight.h"
#include "vtkLookupTable.h"
#include "vtkPlaneSource.h"
#include "vtkPointData.h"
#include "vtkPointDataToCellData.h"
#include "vtkPolyData.h"
#include "vtkProperty.h"
#include "vtkTexture.h"
#include "vtkUnsignedCharArray.h"

#include <cmath>

TEST_F(ActorShadingTest, MatchesVTKForPointColors)
{
  this->SetMesh(WithElevation(Sphere()));
  this->ExpectSameImage();
}

TEST_F(ActorShadingTest, MatchesVTKForCellColors)
{
  vtkNew<vtkPointDataToCellData> cells;
  cells->SetInputData(WithElevation(Sphere()));
  cells->PassPointDataOff();
  cells->Update();
  this->SetMesh(vtkPolyData::SafeDownCast(cells->GetOutput()));
  this->Property()->SetInterpolationToFlat();
  this->ExpectSameImage();
}

TEST_F(ActorShadingTest, MatchesVTKWithScalarsInterpolatedBeforeMapping)
{
  this->SetMesh(WithElevation(Sphere()));
  this->Mapper->InterpolateScalarsBeforeMappingOn();
  vtkNew<vtkLookupTable> table;
  table->SetNumberOfTableValues(256);
  table->Build();
  this->Mapper->SetLookupTable(table);
  this->ExpectSameImage();
}

TEST_F(ActorShadingTest, MatchesVTKForLogarithmicTableAndNaN)
{
  vtkSmartPointer<vtkPolyData> data = WithElevation(Sphere());
  data->GetPointData()->GetScalars()->SetComponent(5, 0, std::nan(""));
  this->SetMesh(data);
  vtkNew<vtkLookupTable> table;
  table->SetScaleToLog10();
  table->SetNanColor(.9, .1, .9, 1.0);
  this->Mapper->SetLookupTable(table);
  this->Mapper->SetScalarRange(.05, 1.0);
  this->ExpectSameImage();
}

TEST_F(ActorShadingTest, MatchesVTKForCategoricalColors)
{
  vtkSmartPointer<vtkPolyData> data = Sphere();
  vtkNew<vtkDoubleArray> kinds;
  kinds->SetName("kinds");
  for (vtkIdType i = 0; i < data->GetNumberOfCells(); ++i)
  {
    kinds->InsertNextValue(i % 5);
  }
  data->GetCellData()->SetScalars(kinds);
  this->SetMesh(data);
  vtkNew<vtkLookupTable> table;
  table->SetNumberOfTableValues(3);
  for (int i = 0; i < 3; ++i)
  {
    table->SetTableValue(i, i == 0, i == 1, i == 2);
    table->SetAnnotation(vtkVariant(2 * i), "kind");
  }
  table->SetIndexedLookup(true);
  this->Mapper->SetLookupTable(table);
  this->ExpectSameImage();
}

TEST_F(ActorShadingTest, MatchesVTKWithTexture)
{
  vtkNew<vtkPlaneSource> plane;
  plane->Update();
  this->SetMesh(plane->GetOutput());
  vtkNew<vtkImageData> image;
  image->SetDimensions(4, 3, 1);
  image->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
  for (vtkIdType i = 0; i < 36; ++i)
  {
    image->GetPointData()->GetScalars()->SetComponent(i / 3, i % 3, (i * 67) % 256);
  }
  vtkNew<vtkTexture> texture;
  texture->SetInputData(image);
  texture->InterpolateOn();
  this->Actor->SetTexture(texture);
  this->ExpectSameImage();
}

TEST_F(ActorShadingTest, MatchesVTKForRepeatedAndClampedTextureWithoutInterpolation)
{
  vtkNew<vtkPlaneSource> plane;
  plane->Update();
  vtkDataArray* coordinates = plane->GetOutput()->GetPointData()->GetTCoords();
  for (vtkIdType i = 0; i < 4; ++i)
  {
    coordinates->SetTuple2(i, 2.3 * (i % 2) - .7, 1.9 * (i / 2) - .4);
  }
  this->SetMesh(plane->GetOutput());
  vtkNew<vtkImageData> image;
  image->SetDimensions(3, 2, 1);
  image->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
  for (vtkIdType i = 0; i < 18; ++i)
  {
    image->GetPointData()->GetScalars()->SetComponent(i / 3, i % 3, (i * 67) % 256);
  }
  vtkNew<vtkTexture> texture;
  texture->SetInputData(image);
  this->Actor->SetTexture(texture);
  for (const bool repeat : { true, false })
  {
    texture->SetRepeat(repeat);
    texture->SetEdgeClamp(!repeat);
    // Pixel centers on the edge between two texels may take either color.
    const RasterComparison::Result result = this->Comparison.Compare();
    EXPECT_GE(result.Pixels, 1000);
    EXPECT_LE(result.Different, .02 * result.Pixels) << repeat;
  }
}

TEST_F(ActorShadingTest, MatchesVTKForDarkTexturesInSRGB)
{
  vtkNew<vtkPlaneSource> plane;
  plane->Update();
  this->SetMesh(plane->GetOutput());
  vtkNew<vtkImageData> image;
  image->SetDimensions(8, 1, 1);
  image->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
  for (int i = 0; i < 8; ++i)
  {
    for (int c = 0; c < 3; ++c)
    {
      image->SetScalarComponentFromDouble(i, 0, 0, c, (c + 1) * i); // at most 0.0065 if linear
    }
  }
  vtkNew<vtkTexture> texture;
  texture->SetInputData(image);
  texture->InterpolateOn();
  texture->UseSRGBColorSpaceOn();
  this->Property()->SetInterpolationToPBR();
  this->Property()->SetColor(0.0, 0.0, 0.0);
  this->Property()->SetEmissiveTexture(texture);
  vtkNew<vtkLight> black;
  black->SetIntensity(0.0);
  this->Renderer()->AddLight(black);
  this->ExpectSameImage();
}

TEST_F(ActorShadingTest, MatchesVTKForColorFromFieldData)
{
  vtkSmartPointer<vtkPolyData> data = Sphere();
  vtkNew<vtkDoubleArray> values;
  values->SetName("time");
  values->InsertNextValue(.1);
  values->InsertNextValue(.7);
  data->GetFieldData()->AddArray(values);
  this->SetMesh(data);
  this->Mapper->SetScalarModeToUseFieldData();
  this->Mapper->SelectColorArray("time");
  this->Mapper->SetFieldDataTupleId(1);
  this->ExpectSameImage();
}

TEST_F(ActorShadingTest, MatchesVTKForColorsStoredAsBytes)
{
  vtkSmartPointer<vtkPolyData> data = Sphere();
  vtkNew<vtkUnsignedCharArray> colors;
  colors->SetNumberOfComponents(3);
  for (vtkIdType i = 0; i < data->GetNumberOfPoints(); ++i)
  {
    colors->InsertNextTuple3((i * 37) % 256, (i * 91) % 256, (i * 13) % 256);
  }
  data->GetPointData()->SetScalars(colors);
  this->SetMesh(data);
  this->ExpectSameImage();
}
