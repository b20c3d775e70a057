// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Setters that reject NaN, which vtkSetClampMacro and vtkSetMacro let through.
#ifndef vtkPenumbraSetNumber_h
#define vtkPenumbraSetNumber_h

#include "vtkSetGet.h"

#include <algorithm> // for std::clamp
#include <cmath>     // for std::isnan

/// Like vtkSetMacro(name, double), but NaN is an error and does not change the value.
#define vtkPenumbraSetNumberMacro(name)                                                            \
  virtual void Set##name(double value)                                                             \
  {                                                                                                \
    if (std::isnan(value))                                                                         \
    {                                                                                              \
      vtkErrorMacro(#name " must be a number, not NaN; it remains " << this->name << ".");         \
    }                                                                                              \
    else if (this->name != value)                                                                  \
    {                                                                                              \
      this->name = value;                                                                          \
      this->Modified();                                                                            \
    }                                                                                              \
  }

/// Like vtkSetClampMacro(name, double, minimum, maximum), but NaN is an error and does not change
/// the value.
#define vtkPenumbraSetClampedNumberMacro(name, minimum, maximum)                                   \
  virtual void Set##name(double value)                                                             \
  {                                                                                                \
    if (std::isnan(value))                                                                         \
    {                                                                                              \
      vtkErrorMacro(#name " must be a number, not NaN; it remains " << this->name << ".");         \
    }                                                                                              \
    else if (this->name != std::clamp<double>(value, minimum, maximum))                            \
    {                                                                                              \
      this->name = std::clamp<double>(value, minimum, maximum);                                    \
      this->Modified();                                                                            \
    }                                                                                              \
  }                                                                                                \
  virtual double Get##name##MinValue()                                                             \
  {                                                                                                \
    return minimum;                                                                                \
  }                                                                                                \
  virtual double Get##name##MaxValue()                                                             \
  {                                                                                                \
    return maximum;                                                                                \
  }

#endif
