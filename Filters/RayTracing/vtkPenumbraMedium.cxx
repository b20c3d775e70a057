// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkPenumbraMedium.h"

#include "vtkObjectFactory.h"

vtkStandardNewMacro(vtkPenumbraMedium);

void vtkPenumbraMedium::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Scattering: " << this->Scattering << "\n";
  os << indent << "Extinction: " << this->Extinction << "\n";
  os << indent << "Phase: " << this->Phase << "\n";
  os << indent << "Asymmetry: " << this->Asymmetry << "\n";
  os << indent << "Bounds:";
  for (const double bound : this->Bounds)
  {
    os << " " << bound;
  }
  os << "\n";
}
