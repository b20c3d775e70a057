// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Random props: actors with random properties, images, text, axes.
#ifndef penumbra_soak_RandomProps_h
#define penumbra_soak_RandomProps_h

#include "Random.h"

#include "vtkSmartPointer.h"

#include <string>

class vtkProp;
class vtkRenderer;

namespace penumbra_soak
{

struct RandomProp
{
  vtkSmartPointer<vtkProp> Prop;
  std::string Description;
  bool Translucent = false;
  bool Arbitrary = false;   ///< VTK's image of it is not a reference
  bool NeedsCaster = false; ///< a stratified reference does not draw it
};

/// Makes a prop of about the size `unit` near `center`.
RandomProp MakeRandomProp(
  Random& random, vtkRenderer* renderer, bool difficult, glm::dvec3 center, double unit);

}
#endif
