// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "WindingCorrection.h"

#include "vtkCellArray.h"
#include "vtkCompositeDataIterator.h"
#include "vtkCompositeDataSet.h"
#include "vtkDataArray.h"
#include "vtkFieldData.h"
#include "vtkIdList.h"
#include "vtkMath.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkReverseSense.h"
#include "vtkSmartPointer.h"

namespace penumbra
{

namespace
{

/// Returns whether the transform of the node mirrors the mesh.
bool IsMirrored(vtkPolyData* mesh)
{
  vtkDataArray* const matrix = mesh->GetFieldData()->GetArray("globalTransform");
  if (!matrix || matrix->GetNumberOfValues() < 16)
  {
    return false;
  }
  const int components = matrix->GetNumberOfComponents();
  double rows[3][3];
  for (int i = 0; i < 3; ++i)
  {
    for (int j = 0; j < 3; ++j)
    {
      rows[i][j] = matrix->GetComponent((4 * i + j) / components, (4 * i + j) % components);
    }
  }
  return vtkMath::Determinant3x3(rows[0], rows[1], rows[2]) < 0.0;
}

/// Returns whether most polygons, by area, face away from their point normals; without normals, whether
/// the mesh is mirrored.
bool FacesAway(vtkPolyData* mesh)
{
  vtkDataArray* normals = mesh->GetPointData()->GetNormals();
  if (mesh->GetNumberOfPolys() == 0)
  {
    return false;
  }
  if (!normals)
  {
    return IsMirrored(mesh);
  }
  double agreement = 0.0;
  vtkNew<vtkIdList> corners;
  for (vtkIdType cell = 0; cell < mesh->GetNumberOfPolys(); ++cell)
  {
    mesh->GetPolys()->GetCellAtId(cell, corners);
    const vtkIdType size = corners->GetNumberOfIds();
    const auto isValid = [&](vtkIdType i) {
      return corners->GetId(i) >= 0 && corners->GetId(i) < mesh->GetNumberOfPoints();
    };
    if (size < 3 || !isValid(0) || !isValid(1) || !isValid(2))
    {
      continue; // The data is validated later.
    }
    double x[3][3];
    for (vtkIdType i = 0; i < 3; ++i)
    {
      mesh->GetPoint(corners->GetId(i), x[i]);
    }
    double u[3];
    double v[3];
    double face[3];
    vtkMath::Subtract(x[1], x[0], u);
    vtkMath::Subtract(x[2], x[0], v);
    vtkMath::Cross(u, v, face);
    for (vtkIdType i = 0; i < 3; ++i)
    {
      agreement += vtkMath::Dot(face, normals->GetTuple3(corners->GetId(i)));
    }
  }
  return agreement < 0.0;
}

void CorrectWinding(vtkPolyData* mesh)
{
  if (mesh && FacesAway(mesh))
  {
    vtkNew<vtkPolyData> input;
    input->ShallowCopy(mesh);
    vtkNew<vtkReverseSense> reverse;
    reverse->SetInputData(input);
    reverse->Update();
    mesh->ShallowCopy(reverse->GetOutput());
  }
}

}

void CorrectWindings(
  vtkAlgorithm*, const std::string&, vtkDataObject* data, std::vector<std::string>&)
{
  CorrectWinding(vtkPolyData::SafeDownCast(data));
  if (auto* composite = vtkCompositeDataSet::SafeDownCast(data))
  {
    const auto iterator = vtkSmartPointer<vtkCompositeDataIterator>::Take(composite->NewIterator());
    for (iterator->InitTraversal(); !iterator->IsDoneWithTraversal(); iterator->GoToNextItem())
    {
      CorrectWinding(vtkPolyData::SafeDownCast(iterator->GetCurrentDataObject()));
    }
  }
}

}
