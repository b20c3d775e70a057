// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "SceneModificationTime.h"

#include "CollectionItems.h"
#include "Light.h"
#include "SceneExtractionBlocks.h"
#include "SceneExtractionProps.h"

#include "vtkAbstractContextItem.h"
#include "vtkActor.h"
#include "vtkActor2D.h"
#include "vtkAssemblyNode.h"
#include "vtkAssemblyPath.h"
#include "vtkAxisActor2D.h"
#include "vtkBillboardTextActor3D.h"
#include "vtkCamera.h"
#include "vtkCaptionActor2D.h"
#include "vtkCompositeDataIterator.h"
#include "vtkCompositeDataSet.h"
#include "vtkContextActor.h"
#include "vtkContextScene.h"
#include "vtkCoordinate.h"
#include "vtkCornerAnnotation.h"
#include "vtkCubeAxesActor.h"
#include "vtkDataObjectTree.h"
#include "vtkDataObjectTreeIterator.h"
#include "vtkDemandDrivenPipeline.h"
#include "vtkFollower.h"
#include "vtkHomogeneousTransform.h"
#include "vtkImageData.h"
#include "vtkImageMapper3D.h"
#include "vtkImageProperty.h"
#include "vtkImageSlice.h"
#include "vtkLODProp3D.h"
#include "vtkLegendBoxActor.h"
#include "vtkLegendScaleActor.h"
#include "vtkLight.h"
#include "vtkLightCollection.h"
#include "vtkMapper.h"
#include "vtkMapper2D.h"
#include "vtkMatrix4x4.h"
#include "vtkPiecewiseFunction.h"
#include "vtkPlane.h"
#include "vtkPlaneCollection.h"
#include "vtkPointGaussianMapper.h"
#include "vtkPolyData.h"
#include "vtkProp3D.h"
#include "vtkProp3DFollower.h"
#include "vtkPropCollection.h"
#include "vtkProperty.h"
#include "vtkProperty2D.h"
#include "vtkRenderer.h"
#include "vtkScalarBarActor.h"
#include "vtkScalarsToColors.h"
#include "vtkTextActor.h"
#include "vtkTextActor3D.h"
#include "vtkTextMapper.h"
#include "vtkTextProperty.h"
#include "vtkTexture.h"
#include "vtkTexturedActor2D.h"

#include <algorithm>

namespace penumbra
{
namespace
{

/// Collects the latest modification time of objects.
class MTimeCollector
{
public:
  vtkMTimeType Time = 0;

  void Add(vtkObject* object)
  {
    if (object)
    {
      this->Time = std::max(this->Time, object->GetMTime());
    }
  }

  void AddView(vtkRenderer* renderer)
  {
    this->Add(renderer);
    if (vtkTexture* texture = renderer->GetBackgroundTexture())
    {
      this->AddTexture(texture);
    }
    if (vtkTexture* texture = renderer->GetEnvironmentTexture())
    {
      this->AddTexture(texture);
    }
    if (renderer->IsActiveCameraCreated())
    {
      this->AddCamera(renderer->GetActiveCamera());
    }
    vtkLightCollection* lights = renderer->GetLights();
    this->Add(lights);
    for (vtkLight* light : GetItems<vtkLight>(lights))
    {
      this->Add(light);
      this->Add(light->GetTransformMatrix());
    }
  }

  void AddProp(vtkProp* prop)
  {
    this->Add(prop);
    if (!prop->GetVisibility())
    {
      return;
    }
    this->AddOverlay(prop);
    this->AddImageOrText(prop);
    if (vtkNew<vtkPropCollection> parts; CollectParts(prop, parts))
    {
      for (vtkProp* next : GetItems<vtkProp>(parts))
      {
        this->AddProp(next);
      }
      return;
    }
    if (auto* follower = vtkProp3DFollower::SafeDownCast(prop))
    {
      this->AddCamera(follower->GetCamera());
    }
    if (auto* details = vtkLODProp3D::SafeDownCast(prop))
    {
      if (vtkProp3D* best = FindBestLevel(details))
      {
        this->AddProp(best);
      }
    }
    if (auto* actor = vtkActor::SafeDownCast(prop)) // without parts, its only path is itself
    {
      this->AddTransform(actor);
      this->AddActor(actor);
      return;
    }
    prop->InitPathTraversal();
    while (vtkAssemblyPath* path = prop->GetNextPath())
    {
      for (vtkAssemblyNode* node : GetItems<vtkAssemblyNode>(path))
      {
        this->AddTransform(node->GetViewProp());
      }
      if (vtkProp* leaf = path->GetLastNode()->GetViewProp(); leaf != prop)
      {
        this->AddOverlay(leaf);
      }
      if (auto* actor = vtkActor::SafeDownCast(path->GetLastNode()->GetViewProp()))
      {
        this->AddActor(actor);
      }
    }
  }

private:
  void AddCamera(vtkCamera* camera)
  {
    if (camera)
    {
      this->Add(camera);
      this->Add(camera->GetUserTransform());
      this->Add(camera->GetUserViewTransform());
      this->Add(camera->GetModelTransformMatrix());
      this->Add(camera->GetExplicitProjectionTransformMatrix());
    }
  }

  /// Adds a prop and its transforms.
  void AddTransform(vtkProp* prop)
  {
    this->Add(prop);
    if (auto* prop3D = vtkProp3D::SafeDownCast(prop))
    {
      this->Time = std::max(this->Time, prop3D->GetUserTransformMatrixMTime());
    }
    if (auto* follower = vtkFollower::SafeDownCast(prop))
    {
      this->AddCamera(follower->GetCamera());
    }
  }

  void AddTexture(vtkTexture* texture)
  {
    this->Add(texture);
    this->Add(texture->GetLookupTable());
    this->AddInputs(texture);
  }

  void AddActor(vtkActor* actor)
  {
    this->Add(actor->GetProperty());
    this->Add(actor->GetBackfaceProperty());
    if (vtkTexture* texture = actor->GetTexture())
    {
      this->AddTexture(texture);
    }
    for (const auto& [name, texture] : actor->GetProperty()->GetAllTextures())
    {
      if (texture)
      {
        this->AddTexture(texture);
      }
    }
    vtkMapper* mapper = actor->GetMapper();
    if (!mapper)
    {
      return;
    }
    this->Add(mapper);
    this->AddInputs(mapper);
    if (auto* splats = vtkPointGaussianMapper::SafeDownCast(mapper))
    {
      this->Add(splats->GetScaleFunction());
      this->Add(splats->GetScalarOpacityFunction());
    }
    if (vtkPlaneCollection* planes = mapper->GetClippingPlanes())
    {
      this->Add(planes);
      for (int i = 0; i < planes->GetNumberOfItems(); ++i)
      {
        this->Add(planes->GetItem(i));
      }
    }
    if (auto* blocks = vtkCompositeDataSet::SafeDownCast(mapper->GetInputDataObject(0, 0)))
    {
      this->Time = std::max(this->Time, GetBlockMTime(blocks, mapper));
    }
  }

  /// Adds the inputs of `algorithm` on all its ports, without executing their pipelines.
  void AddInputs(vtkAlgorithm* algorithm)
  {
    for (int port = 0; port < algorithm->GetNumberOfInputPorts(); ++port)
    {
      for (int i = 0; i < algorithm->GetNumberOfInputConnections(port); ++i)
      {
        int output = 0;
        vtkAlgorithm* producer = algorithm->GetInputAlgorithm(port, i, output);
        if (auto* executive = vtkDemandDrivenPipeline::SafeDownCast(producer->GetExecutive()))
        {
          executive->UpdatePipelineMTime();
          this->Time = std::max(this->Time, executive->GetPipelineMTime());
        }
        this->AddData(producer->GetOutputDataObject(output));
      }
    }
  }

  void AddData(vtkDataObject* data)
  {
    this->Add(data);
    auto* composite = vtkCompositeDataSet::SafeDownCast(data);
    if (!composite)
    {
      return;
    }
    vtkSmartPointer<vtkCompositeDataIterator> blocks;
    blocks.TakeReference(composite->NewIterator());
    if (auto* tree = vtkDataObjectTreeIterator::SafeDownCast(blocks))
    {
      tree->VisitOnlyLeavesOff();
    }
    for (blocks->InitTraversal(); !blocks->IsDoneWithTraversal(); blocks->GoToNextItem())
    {
      this->Add(blocks->GetCurrentDataObject());
    }
  }

  void AddImageOrText(vtkProp* prop)
  {
    if (auto* slice = vtkImageSlice::SafeDownCast(prop))
    {
      this->Add(slice->GetProperty());
      if (slice->GetProperty())
      {
        this->Add(slice->GetProperty()->GetLookupTable());
      }
      if (slice->GetMapper())
      {
        this->Add(slice->GetMapper());
        this->AddInputs(slice->GetMapper());
      }
    }
    else if (auto* axes = vtkCubeAxesActor::SafeDownCast(prop))
    {
      this->Add(axes->GetXAxesLinesProperty());
      this->Add(axes->GetYAxesLinesProperty());
      this->Add(axes->GetZAxesLinesProperty());
      for (int axis = 0; axis < 3; ++axis)
      {
        this->Add(axes->GetTitleTextProperty(axis));
        this->Add(axes->GetLabelTextProperty(axis));
      }
    }
    else if (auto* text3D = vtkTextActor3D::SafeDownCast(prop))
    {
      this->Add(text3D->GetTextProperty());
    }
    else if (auto* billboard = vtkBillboardTextActor3D::SafeDownCast(prop))
    {
      this->Add(billboard->GetTextProperty());
    }
  }

  void AddOverlay(vtkProp* prop)
  {
    if (auto* text = vtkTextActor::SafeDownCast(prop))
    {
      this->AddRectangle(text);
      this->Add(text->GetTextProperty());
    }
    else if (auto* bar = vtkScalarBarActor::SafeDownCast(prop))
    {
      this->AddRectangle(bar);
      this->Add(bar->GetLookupTable());
      this->Add(bar->GetTitleTextProperty());
      this->Add(bar->GetLabelTextProperty());
      this->Add(bar->GetAnnotationTextProperty());
    }
    else if (auto* actor = vtkActor2D::SafeDownCast(prop))
    {
      this->AddAnnotation(actor);
    }
    else if (auto* chart = vtkContextActor::SafeDownCast(prop))
    {
      this->Add(chart->GetScene());
      for (unsigned int i = 0; i < chart->GetScene()->GetNumberOfItems(); ++i)
      {
        this->AddItems(chart->GetScene()->GetItem(i));
      }
    }
    else if (auto* scale = vtkLegendScaleActor::SafeDownCast(prop))
    {
      this->Add(scale->GetLegendTitleProperty());
      this->Add(scale->GetLegendLabelProperty());
      for (vtkAxisActor2D* side : { scale->GetRightAxis(), scale->GetTopAxis(),
             scale->GetLeftAxis(), scale->GetBottomAxis() })
      {
        this->AddAxis(side);
      }
    }
  }

  void AddItems(vtkAbstractContextItem* item)
  {
    this->Add(item);
    for (vtkIdType i = 0; i < item->GetNumberOfItems(); ++i)
    {
      this->AddItems(item->GetItem(i));
    }
  }

  void AddAnnotation(vtkActor2D* actor)
  {
    this->AddRectangle(actor);
    this->Add(actor->GetProperty());
    if (vtkMapper2D* mapper = actor->GetMapper())
    {
      this->Add(mapper);
      this->AddInputs(mapper);
      auto* text = vtkTextMapper::SafeDownCast(mapper);
      this->Add(text ? text->GetTextProperty() : nullptr);
    }
    if (auto* textured = vtkTexturedActor2D::SafeDownCast(actor))
    {
      if (textured->GetTexture())
      {
        this->AddTexture(textured->GetTexture());
      }
    }
    else if (auto* caption = vtkCaptionActor2D::SafeDownCast(actor))
    {
      this->Add(caption->GetCaptionTextProperty());
      this->Add(caption->GetAttachmentPointCoordinate());
    }
    else if (auto* legend = vtkLegendBoxActor::SafeDownCast(actor))
    {
      this->Add(legend->GetEntryTextProperty());
      for (int i = 0; i < legend->GetNumberOfEntries(); ++i)
      {
        this->Add(legend->GetEntrySymbol(i));
        this->Add(legend->GetEntryIcon(i));
      }
    }
    else if (auto* axis = vtkAxisActor2D::SafeDownCast(actor))
    {
      this->AddAxis(axis);
    }
    else if (auto* corner = vtkCornerAnnotation::SafeDownCast(actor))
    {
      this->Add(corner->GetTextProperty());
    }
  }

  void AddAxis(vtkAxisActor2D* axis)
  {
    this->Add(axis);
    this->Add(axis->GetProperty());
    this->Add(axis->GetTitleTextProperty());
    this->Add(axis->GetLabelTextProperty());
  }

  void AddRectangle(vtkActor2D* actor)
  {
    for (vtkCoordinate* coordinate :
      { actor->GetPositionCoordinate(), actor->GetPosition2Coordinate() })
    {
      for (; coordinate; coordinate = coordinate->GetReferenceCoordinate())
      {
        this->Add(coordinate);
      }
    }
  }
};

}

vtkMTimeType GetSceneMTime(vtkRenderer* renderer)
{
  MTimeCollector collector;
  collector.AddView(renderer);
  vtkPropCollection* props = renderer->GetViewProps();
  collector.Add(props);
  for (vtkProp* prop : GetItems<vtkProp>(props))
  {
    collector.AddProp(prop);
  }
  return collector.Time;
}

vtkMTimeType GetGeometryMTime(vtkRenderer* renderer)
{
  MTimeCollector collector;
  vtkPropCollection* props = renderer->GetViewProps();
  collector.Add(props);
  for (vtkProp* prop : GetItems<vtkProp>(props))
  {
    if (vtkProp3D::SafeDownCast(prop))
    {
      collector.AddProp(prop);
    }
  }
  return collector.Time;
}

vtkMTimeType GetPropMTime(vtkProp* prop)
{
  MTimeCollector collector;
  collector.AddProp(prop);
  return collector.Time;
}

}
