// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Props of a renderer that cast shadows in shadow maps, and whether they changed. Modification
// times reveal changes that no image shows, for example of props outside of the view.
#ifndef penumbra_ShadowCasters_h
#define penumbra_ShadowCasters_h

#include "Frame/ScreenTransform.h"

#include "vtkType.h"

#include <array>
#include <vector>

class vtkProp;
class vtkRenderer;

namespace penumbra
{

class ShadowCasters
{
public:
  /// Finds the visible props with bounds, without widgets and axes, whose geometry depends on the
  /// camera. Returns whether props, matrices or modification times differ from the last call.
  bool Update(vtkRenderer* renderer);

  /// Number of changes so far.
  long long GetVersion() const { return this->Version; }

  const std::vector<vtkProp*>& GetProps() const { return this->Props; }

  /// Corners of the bounds of all props, eight per prop, in world coordinates.
  std::vector<std::array<double, 3>> GetCorners() const;

private:
  /// An actor of a prop.
  struct Part
  {
    vtkProp* Prop;
    Matrix ToWorld;
    vtkMTimeType Time; ///< of the actor, its mapper and its mesh
    bool operator==(const Part& other) const;
  };

  std::vector<vtkProp*> Props;
  std::vector<Part> Parts;
  long long Version = 0;
};

}
#endif
