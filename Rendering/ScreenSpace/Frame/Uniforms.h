// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Sets uniforms of a shader to numbers in double precision.
#ifndef penumbra_Uniforms_h
#define penumbra_Uniforms_h

#include "ScreenTransform.h"

#include "vtkShaderProgram.h"

namespace penumbra
{

inline void SetNumber(vtkShaderProgram* program, const char* name, double value)
{
  program->SetUniformf(name, static_cast<float>(value));
}

inline void SetVector(vtkShaderProgram* program, const char* name, double x, double y)
{
  const float values[2] = { static_cast<float>(x), static_cast<float>(y) };
  program->SetUniform2f(name, values);
}

/// Sets a vector to the size of a pixel of an image whose sides have length 1.
inline void SetPixelSize(vtkShaderProgram* program, const char* name, double width, double height)
{
  SetVector(program, name, 1.0 / width, 1.0 / height);
}

inline void SetMatrix(vtkShaderProgram* program, const char* name, const Matrix& matrix)
{
  float columns[16];
  for (int i = 0; i < 16; ++i)
  {
    columns[i] = static_cast<float>(matrix[4 * (i % 4) + i / 4]);
  }
  program->SetUniformMatrix4x4(name, columns);
}

}
#endif
