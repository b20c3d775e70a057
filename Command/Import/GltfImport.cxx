// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Appearance of glTF files. vtkGLTFReader reads their surfaces, deformed and transformed, and
// vtkGLTFImporter their materials.
#include "Appearance.h"

#include "CollectionItems.h"
#include "Files/TemporaryFile.h"
#include "Processes/MessageLog.h"
#include "TextureImages.h"

#include "vtkActor.h"
#include "vtkActorCollection.h"
#include "vtkCamera.h"
#include "vtkCompositeDataSet.h"
#include "vtkDataArray.h"
#include "vtkFieldData.h"
#include "vtkGLTFImporter.h"
#include "vtkInformation.h"
#include "vtkLight.h"
#include "vtkLightCollection.h"
#include "vtkMapper.h"
#include "vtkMath.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <string>

namespace penumbra
{

namespace
{

bool IsNode(vtkMultiBlockDataSet* parent, unsigned int block)
{
  const char* name = parent->HasMetaData(block)
    ? parent->GetMetaData(block)->Get(vtkCompositeDataSet::NAME())
    : nullptr;
  return name && std::string(name).rfind("Node_", 0) == 0;
}

/// Appends the data sets of a node in the order of the importer, which visits the last child first.
void CollectInImportOrder(vtkMultiBlockDataSet* node, std::vector<vtkDataSet*>& order)
{
  for (unsigned int block = 0; block < node->GetNumberOfBlocks(); ++block)
  {
    if (!IsNode(node, block))
    {
      const std::vector<vtkDataSet*> found = FindDataSets(node->GetBlock(block));
      order.insert(order.end(), found.begin(), found.end());
    }
  }
  for (unsigned int block = node->GetNumberOfBlocks(); block-- > 0;)
  {
    auto* child = vtkMultiBlockDataSet::SafeDownCast(node->GetBlock(block));
    if (child && IsNode(node, block))
    {
      CollectInImportOrder(child, order);
    }
  }
}

/// Transforms tangents, which the reader leaves in the coordinates of the node.
void TransformTangents(vtkDataSet* data)
{
  vtkDataArray* tangents = data->GetPointData()->GetTangents();
  vtkDataArray* matrix = data->GetFieldData()->GetArray("globalTransform");
  if (!tangents || !matrix || matrix->GetNumberOfValues() < 16)
  {
    return;
  }
  const auto transformed = vtkSmartPointer<vtkDataArray>::Take(tangents->NewInstance());
  transformed->DeepCopy(tangents);
  for (vtkIdType i = 0; i < tangents->GetNumberOfTuples(); ++i)
  {
    const double* t = tangents->GetTuple(i);
    double result[3];
    for (int row = 0; row < 3; ++row)
    {
      result[row] = 0.0;
      for (int column = 0; column < 3; ++column)
      {
        const vtkIdType value = 4 * row + column;
        const int components = matrix->GetNumberOfComponents();
        result[row] +=
          matrix->GetComponent(value / components, static_cast<int>(value % components)) *
          t[column];
      }
    }
    vtkMath::Normalize(result);
    for (int c = 0; c < 3; ++c)
    {
      transformed->SetComponent(i, c, result[c]);
    }
  }
  data->GetPointData()->SetTangents(transformed);
}

/// Returns the actor of each data set; empty if they do not fit each other.
std::vector<vtkSmartPointer<vtkActor>> MatchActors(
  vtkDataObject* data, const std::vector<vtkActor*>& actors)
{
  std::vector<vtkDataSet*> imported;
  if (auto* root = vtkMultiBlockDataSet::SafeDownCast(data))
  {
    CollectInImportOrder(root, imported);
  }
  std::vector<vtkSmartPointer<vtkActor>> matched;
  for (vtkDataSet* leaf : FindDataSets(data))
  {
    const auto found = std::find(imported.begin(), imported.end(), leaf);
    const auto index = static_cast<std::size_t>(found - imported.begin());
    if (found == imported.end() || index >= actors.size())
    {
      return {};
    }
    vtkDataSet* input = actors[index]->GetMapper()->GetInput();
    if (!input || input->GetNumberOfPoints() != leaf->GetNumberOfPoints())
    {
      return {};
    }
    ConvertTexturesToBytes(actors[index]);
    matched.push_back(actors[index]);
    TransformTangents(leaf);
  }
  return matched;
}

}

vtkSmartPointer<vtkDataObject> ImportGltf(
  const std::string& path, vtkDataObject* data, Appearance& appearance)
{
  TakeErrors();
  vtkNew<vtkGLTFImporter> importer;
  importer->SetFileName(appearance.Copy ? appearance.Copy->Path.c_str() : path.c_str());
  vtkRenderer* renderer = RunImporter(importer);
  const std::vector<std::string> errors = TakeErrors();
  appearance.Actors = MatchActors(data, GetItems<vtkActor>(renderer->GetActors()));
  if (appearance.Actors.empty())
  {
    appearance.Warnings.push_back("its materials cannot be read" +
      (errors.empty() ? std::string() : " (" + errors.front() + ")") +
      "; the surfaces are drawn without them");
    return data;
  }
  appearance.Lights = GetItems<vtkLight, vtkSmartPointer<vtkLight>>(renderer->GetLights());
  for (vtkIdType i = 0; i < importer->GetNumberOfCameras(); ++i)
  {
    appearance.Cameras.push_back(importer->GetCamera(static_cast<unsigned int>(i)));
  }
  return data;
}

}
