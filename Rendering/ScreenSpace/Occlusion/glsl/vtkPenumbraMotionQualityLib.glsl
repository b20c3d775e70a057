// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Constants of kernels for frames in motion: of slow motion, in which the history is the mean over many frames,
// and of turns that are too fast for a history, in which each frame is seen briefly.

// Number of rays per side of a slice (march kernel). Measured: with 8, frames cost 30 % more and are
// as far from their limit (`./penumbra benchmark ambient-occlusion --only cost` and `noise`).
const int raysPerSide = 4;
