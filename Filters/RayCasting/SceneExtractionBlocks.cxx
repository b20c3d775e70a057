// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "SceneExtractionBlocks.h"

#include "vtkCompositeDataDisplayAttributes.h"
#include "vtkCompositeDataIterator.h"
#include "vtkCompositePolyDataMapper.h"
#include "vtkDataObjectTree.h"
#include "vtkDataObjectTreeIterator.h"
#include "vtkDataSet.h"

namespace penumbra
{
namespace
{

/// What applies to a block: its own attributes, else those of the block above.
struct BlockState
{
  bool Visible = true;
  bool HasColor = false;
  vtkColor3d Color;
  double Opacity = 1.0;
  bool HasOpacity = false;
};

/// The attributes of composite mappers came to vtkCompositePolyDataMapper in VTK 9.3.
template <typename Mapper>
auto FindAttributes(Mapper* mapper, int) -> decltype(mapper->GetCompositeDataDisplayAttributes())
{
  return mapper ? mapper->GetCompositeDataDisplayAttributes() : nullptr;
}
template <typename Mapper>
vtkCompositeDataDisplayAttributes* FindAttributes(Mapper*, long)
{
  return nullptr;
}

class Walk
{
public:
  Walk(vtkCompositeDataDisplayAttributes* attributes, const Piece& look, ScalarMapper* scalars,
    const BlockFunction& use)
    : Attributes(attributes),
      Look(look),
      Scalars(scalars),
      Use(use)
  {
  }

  void Visit(vtkDataObject* block, BlockState state)
  {
    this->Inherit(block, state);
    if (auto* tree = vtkDataObjectTree::SafeDownCast(block))
    {
      vtkSmartPointer<vtkDataObjectTreeIterator> children;
      children.TakeReference(tree->NewTreeIterator());
      children->VisitOnlyLeavesOff();
      children->TraverseSubTreeOff();
      for (children->InitTraversal(); !children->IsDoneWithTraversal(); children->GoToNextItem())
      {
        this->Visit(children->GetCurrentDataObject(), state);
      }
    }
    else if (auto* other = vtkCompositeDataSet::SafeDownCast(block))
    {
      vtkSmartPointer<vtkCompositeDataIterator> leaves;
      leaves.TakeReference(other->NewIterator());
      for (leaves->InitTraversal(); !leaves->IsDoneWithTraversal(); leaves->GoToNextItem())
      {
        this->Visit(leaves->GetCurrentDataObject(), state);
      }
    }
    else if (auto* leaf = vtkDataSet::SafeDownCast(block))
    {
      if (state.Visible)
      {
        this->Draw(leaf, state);
      }
    }
  }

private:
  void Inherit(vtkDataObject* block, BlockState& state) const
  {
    if (!this->Attributes)
    {
      return;
    }
    if (this->Attributes->HasBlockVisibility(block))
    {
      state.Visible = this->Attributes->GetBlockVisibility(block);
    }
    if (this->Attributes->HasBlockColor(block))
    {
      state.HasColor = true;
      state.Color = this->Attributes->GetBlockColor(block);
    }
    if (this->Attributes->HasBlockOpacity(block))
    {
      state.HasOpacity = true;
      state.Opacity = this->Attributes->GetBlockOpacity(block);
    }
  }

  void Draw(vtkDataSet* leaf, const BlockState& state) const
  {
    Piece piece = this->Look;
    if (state.HasColor || state.HasOpacity)
    {
      auto property = vtkSmartPointer<vtkProperty>::New();
      property->DeepCopy(piece.Property);
      if (state.HasColor)
      {
        property->SetAmbientColor(state.Color.GetData());
        property->SetDiffuseColor(state.Color.GetData());
      }
      if (state.HasOpacity)
      {
        property->SetOpacity(state.Opacity);
      }
      piece.Property = property;
    }
    if (this->Scalars)
    {
      vtkNew<ScalarMapper> scalars;
      scalars->ShallowCopy(this->Scalars);
      this->Use(leaf, piece, scalars);
    }
    else
    {
      this->Use(leaf, piece, nullptr);
    }
  }

  vtkCompositeDataDisplayAttributes* Attributes;
  const Piece& Look;
  ScalarMapper* Scalars;
  const BlockFunction& Use;
};

}

void ForEachBlock(vtkCompositeDataSet* data, vtkMapper* mapper, const Piece& look,
  ScalarMapper* scalars, const BlockFunction& use)
{
  vtkCompositeDataDisplayAttributes* attributes =
    FindAttributes(vtkCompositePolyDataMapper::SafeDownCast(mapper), 0);
  Walk(attributes, look, scalars, use).Visit(data, BlockState());
}

}
