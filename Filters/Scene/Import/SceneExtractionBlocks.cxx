// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "SceneExtractionBlocks.h"

#include "vtkColorTransferFunction.h"
#include "vtkCompositeDataDisplayAttributes.h"
#include "vtkCompositeDataIterator.h"
#include "vtkCompositePolyDataMapper.h"
#include "vtkDataObjectTree.h"
#include "vtkDataObjectTreeIterator.h"
#include "vtkDataSet.h"
#include "vtkLookupTable.h"
#include "vtkScalarsToColors.h"
#include "vtkTexture.h"
#include "vtkVersionMacros.h"
#if VTK_VERSION_NUMBER < VTK_VERSION_CHECK(9, 3, 0)
#include "vtkCompositePolyDataMapper2.h"
#endif

#include <algorithm>

namespace penumbra
{
namespace
{

/// Attributes of a block. Unset attributes are inherited from the parent block.
struct BlockState
{
  bool Visible = true;
  bool HasColor = false;
  vtkColor3d Color;
  double Opacity = 1.0;
  bool HasOpacity = false;
  vtkSmartPointer<ScalarMapper> Scalars;
  vtkTexture* BlockTexture = nullptr;
};

/// Returns the block attributes of vtkCompositePolyDataMapper, which has them since VTK 9.3.
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

/// Returns the block attributes of a mapper, or null. Before VTK 9.3, vtkCompositePolyDataMapper2
/// of VTK's OpenGL module has them.
vtkCompositeDataDisplayAttributes* GetBlockAttributes(vtkMapper* mapper)
{
#if VTK_VERSION_NUMBER < VTK_VERSION_CHECK(9, 3, 0)
  if (auto* blocks = vtkCompositePolyDataMapper2::SafeDownCast(mapper))
  {
    return blocks->GetCompositeDataDisplayAttributes();
  }
#endif
  return FindAttributes(vtkCompositePolyDataMapper::SafeDownCast(mapper), 0);
}

/// Returns true if blocks without the array of colors have the color of NaN. Until VTK 9.3, that is a
/// setting of vtkCompositePolyDataMapper2.
template <typename Mapper>
auto ReadColorsMissing(Mapper* mapper, int) -> decltype(mapper->GetColorMissingArraysWithNanColor())
{
  return mapper && mapper->GetColorMissingArraysWithNanColor();
}
template <typename Mapper>
bool ReadColorsMissing(Mapper*, long)
{
  return false;
}

bool ColorsMissing(vtkMapper* mapper)
{
#if VTK_VERSION_NUMBER < VTK_VERSION_CHECK(9, 3, 0)
  if (auto* blocks = vtkCompositePolyDataMapper2::SafeDownCast(mapper))
  {
    return blocks->GetColorMissingArraysWithNanColor();
  }
#endif
  return ReadColorsMissing(vtkCompositePolyDataMapper::SafeDownCast(mapper), 0);
}

/// Returns true if a block lacks the array that colors others.
bool LacksScalars(vtkDataSet* block, ScalarMapper* scalars)
{
  int cellFlag = 0;
  return scalars->GetScalarVisibility() &&
    !vtkAbstractMapper::GetAbstractScalars(block, scalars->GetScalarMode(),
      scalars->GetArrayAccessMode(), scalars->GetArrayId(), scalars->GetArrayName(), cellFlag);
}

/// Finds the color of NaN. Returns false if the colors have none.
bool FindNanColor(vtkScalarsToColors* colors, vtkColor3d& color)
{
  if (auto* table = vtkLookupTable::SafeDownCast(colors))
  {
    color = vtkColor3d(table->GetNanColor());
    return true;
  }
  if (auto* function = vtkColorTransferFunction::SafeDownCast(colors))
  {
    color = vtkColor3d(function->GetNanColor());
    return true;
  }
  return false;
}

/// Applies the scalar attributes of a block (since VTK 9.3) to `scalars`. Returns false if there
/// are none.
template <typename Attributes>
auto ApplyScalarAttributes(Attributes* attributes, vtkDataObject* block, ScalarMapper* scalars, int)
  -> decltype(attributes->HasBlockScalarVisibility(block))
{
  bool changed = false;
  const auto apply = [&](bool has, auto&& set) {
    changed = changed || has;
    if (has)
    {
      set();
    }
  };
  apply(attributes->HasBlockScalarVisibility(block),
    [&] { scalars->SetScalarVisibility(attributes->GetBlockScalarVisibility(block)); });
  apply(attributes->HasBlockUseLookupTableScalarRange(block), [&] {
    scalars->SetUseLookupTableScalarRange(attributes->GetBlockUseLookupTableScalarRange(block));
  });
  apply(attributes->HasBlockInterpolateScalarsBeforeMapping(block), [&] {
    scalars->SetInterpolateScalarsBeforeMapping(
      attributes->GetBlockInterpolateScalarsBeforeMapping(block));
  });
  apply(attributes->HasBlockColorMode(block),
    [&] { scalars->SetColorMode(attributes->GetBlockColorMode(block)); });
  apply(attributes->HasBlockScalarMode(block),
    [&] { scalars->SetScalarMode(attributes->GetBlockScalarMode(block)); });
  apply(attributes->HasBlockArrayAccessMode(block),
    [&] { scalars->SetArrayAccessMode(attributes->GetBlockArrayAccessMode(block)); });
  apply(attributes->HasBlockArrayComponent(block),
    [&] { scalars->SetArrayComponent(attributes->GetBlockArrayComponent(block)); });
  apply(attributes->HasBlockArrayId(block),
    [&] { scalars->SetArrayId(attributes->GetBlockArrayId(block)); });
  apply(attributes->HasBlockArrayName(block),
    [&] { scalars->SetArrayName(attributes->GetBlockArrayName(block).c_str()); });
  apply(attributes->HasBlockScalarRange(block),
    [&] { scalars->SetScalarRange(attributes->GetBlockScalarRange(block).GetData()); });
  apply(attributes->HasBlockFieldDataTupleId(block),
    [&] { scalars->SetFieldDataTupleId(attributes->GetBlockFieldDataTupleId(block)); });
  apply(attributes->HasBlockLookupTable(block),
    [&] { scalars->SetLookupTable(attributes->GetBlockLookupTable(block)); });
  return changed;
}
template <typename Attributes>
bool ApplyScalarAttributes(Attributes*, vtkDataObject*, ScalarMapper*, long)
{
  return false;
}

/// Returns the lookup table of a block (since VTK 9.3), or null.
template <typename Attributes>
auto FindLookupTable(Attributes* attributes, vtkDataObject* block, int)
  -> decltype(attributes->GetBlockLookupTable(block).GetPointer())
{
  return attributes->HasBlockLookupTable(block)
    ? attributes->GetBlockLookupTable(block).GetPointer()
    : nullptr;
}
template <typename Attributes>
vtkScalarsToColors* FindLookupTable(Attributes*, vtkDataObject*, long)
{
  return nullptr;
}

/// Returns the texture of a block (since VTK 9.3), or null.
template <typename Attributes>
auto FindTexture(Attributes* attributes, vtkDataObject* block, int)
  -> decltype(attributes->GetBlockTexture(block).GetPointer())
{
  return attributes->HasBlockTexture(block) ? attributes->GetBlockTexture(block).GetPointer()
                                            : nullptr;
}
template <typename Attributes>
vtkTexture* FindTexture(Attributes*, vtkDataObject*, long)
{
  return nullptr;
}

class BlockVisitor
{
public:
  BlockVisitor(vtkMapper* mapper, const DrawItem& prototype, std::vector<std::string>& warnings,
    const BlockFunction& callback)
    : Attributes(GetBlockAttributes(mapper)),
      ColorsMissingArrays(ColorsMissing(mapper)),
      Prototype(prototype),
      Warnings(warnings),
      Callback(callback)
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
    if (vtkTexture* texture = FindTexture(this->Attributes, block, 0))
    {
      state.BlockTexture = texture;
    }
    vtkSmartPointer<ScalarMapper> changed = Copy(state.Scalars);
    if (changed && ApplyScalarAttributes(this->Attributes, block, changed.Get(), 0))
    {
      state.Scalars = changed;
    }
  }

  void Draw(vtkDataSet* leaf, BlockState state) const
  {
    if (this->ColorsMissingArrays && state.Scalars && LacksScalars(leaf, state.Scalars))
    {
      state.HasColor |= FindNanColor(state.Scalars->GetLookupTable(), state.Color);
    }
    DrawItem item = this->Prototype;
    if (state.HasColor || state.HasOpacity)
    {
      auto property = vtkSmartPointer<vtkProperty>::New();
      property->DeepCopy(item.Property);
      if (state.HasColor)
      {
        property->SetAmbientColor(state.Color.GetData());
        property->SetDiffuseColor(state.Color.GetData());
      }
      if (state.HasOpacity)
      {
        property->SetOpacity(state.Opacity);
      }
      item.Property = property;
    }
    if (state.BlockTexture)
    {
      item.LitTexture = MakeTexture(state.BlockTexture, item.Name, this->Warnings);
    }
    vtkSmartPointer<ScalarMapper> scalars = Copy(state.Scalars);
    this->Callback(leaf, item, scalars);
  }

  static vtkSmartPointer<ScalarMapper> Copy(ScalarMapper* from)
  {
    vtkSmartPointer<ScalarMapper> copy;
    if (from)
    {
      copy = vtkSmartPointer<ScalarMapper>::New();
      copy->ShallowCopy(from);
    }
    return copy;
  }

  vtkCompositeDataDisplayAttributes* Attributes;
  const bool ColorsMissingArrays;
  const DrawItem& Prototype;
  std::vector<std::string>& Warnings;
  const BlockFunction& Callback;
};

}

void ForEachBlock(vtkCompositeDataSet* data, vtkMapper* mapper, const DrawItem& prototype,
  ScalarMapper* scalars, std::vector<std::string>& warnings, const BlockFunction& callback)
{
  BlockState state;
  state.Scalars = scalars;
  BlockVisitor(mapper, prototype, warnings, callback).Visit(data, state);
}

vtkMTimeType GetBlockMTime(vtkCompositeDataSet* data, vtkMapper* mapper)
{
  vtkCompositeDataDisplayAttributes* attributes = GetBlockAttributes(mapper);
  if (!attributes)
  {
    return 0;
  }
  vtkMTimeType time = attributes->GetMTime();
  vtkSmartPointer<vtkCompositeDataIterator> blocks;
  blocks.TakeReference(data->NewIterator());
  if (auto* tree = vtkDataObjectTreeIterator::SafeDownCast(blocks))
  {
    tree->VisitOnlyLeavesOff();
  }
  for (blocks->InitTraversal(); !blocks->IsDoneWithTraversal(); blocks->GoToNextItem())
  {
    vtkScalarsToColors* table = FindLookupTable(attributes, blocks->GetCurrentDataObject(), 0);
    time = std::max(time, table ? table->GetMTime() : 0);
    vtkTexture* texture = FindTexture(attributes, blocks->GetCurrentDataObject(), 0);
    time = std::max(time, texture ? texture->GetMTime() : 0);
  }
  return time;
}

}
