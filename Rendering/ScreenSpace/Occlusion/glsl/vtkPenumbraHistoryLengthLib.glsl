// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Lengths of the history of a pixel in motion. They decide how many new samples it gets.
const int shortHistory = 0;   // more samples than others
const int growingHistory = 1; // samples in each frame
const int settledHistory = 2; // samples in one of several frames
