// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Constants of kernels for static views.

// Number of rays per side of a slice (march kernel). With 4, the same tolerance takes twice the samples.
const int raysPerSide = 8;
