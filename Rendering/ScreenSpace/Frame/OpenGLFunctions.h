// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Includes the header that declares OpenGL functions, which depends on the version of VTK. Include
// it in source files only.
#ifndef penumbra_OpenGLFunctions_h
#define penumbra_OpenGLFunctions_h

#if __has_include("vtk_glad.h")
#include "vtk_glad.h"
#else
#include "vtk_glew.h"
#endif

#endif
