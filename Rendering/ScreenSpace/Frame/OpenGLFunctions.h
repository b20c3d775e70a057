// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// The one seam between versions of VTK: which header declares OpenGL. For sources only.
#ifndef penumbra_OpenGLFunctions_h
#define penumbra_OpenGLFunctions_h

#if __has_include("vtk_glad.h")
#include "vtk_glad.h"
#else
#include "vtk_glew.h"
#endif

#endif
