// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ClassReplacement.h"

#include "vtkNew.h"
#include "vtkObjectFactoryCollection.h"
#include "vtkVersion.h"

#ifndef VTK_FUTURE_CONST // before VTK 9.4
#define VTK_FUTURE_CONST
#endif

namespace penumbra
{
namespace
{

/// Creates one class.
class ReplacementFactory : public vtkObjectFactory
{
public:
  static ReplacementFactory* New();
  vtkTypeMacro(ReplacementFactory, vtkObjectFactory);

  const char* GetVTKSourceVersion() VTK_FUTURE_CONST override { return VTK_SOURCE_VERSION; }
  const char* GetDescription() VTK_FUTURE_CONST override { return "Penumbra's parts of props"; }

  void Replace(const char* className, const char* replacement, CreateFunction create)
  {
    this->RegisterOverride(className, replacement, "renders without a graphics context", 1, create);
  }
};
vtkStandardNewMacro(ReplacementFactory);

}

void ReplaceClass(
  const char* className, const char* replacement, vtkObjectFactory::CreateFunction create)
{
  vtkNew<ReplacementFactory> factory;
  factory->Replace(className, replacement, create);
  // VTK asks its factories in order, and RegisterFactory() appends.
  vtkObjectFactory::GetRegisteredFactories()->InsertItem(-1, factory);
}

}
