// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Setters that reject NaN, which vtkSetClampMacro and vtkSetMacro let through.
#ifndef vtkPenumbraSetNumber_h
#define vtkPenumbraSetNumber_h

#include "vtkSetGet.h"

#include <algorithm> // for std::clamp
#include <cmath>     // for std::isnan

/// Like vtkSetMacro(name, double); NaN is an error and changes nothing.
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

/// Like vtkSetClampMacro(name, double, least, most); NaN is an error and changes nothing.
#define vtkPenumbraSetClampedNumberMacro(name, least, most)                                        \
  virtual void Set##name(double value)                                                             \
  {                                                                                                \
    if (std::isnan(value))                                                                         \
    {                                                                                              \
      vtkErrorMacro(#name " must be a number, not NaN; it remains " << this->name << ".");         \
    }                                                                                              \
    else if (this->name != std::clamp<double>(value, least, most))                                 \
    {                                                                                              \
      this->name = std::clamp<double>(value, least, most);                                         \
      this->Modified();                                                                            \
    }                                                                                              \
  }                                                                                                \
  virtual double Get##name##MinValue()                                                             \
  {                                                                                                \
    return least;                                                                                  \
  }                                                                                                \
  virtual double Get##name##MaxValue()                                                             \
  {                                                                                                \
    return most;                                                                                   \
  }

#endif
