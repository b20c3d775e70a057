// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Attribute of loops over samples that have a version for AVX2. Without fused multiplications, both
// compute the same bits.
#ifndef penumbra_Vectorized_h
#define penumbra_Vectorized_h

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
#define PENUMBRA_VECTORIZED __attribute__((target_clones("avx2", "default")))
#else
#define PENUMBRA_VECTORIZED
#endif

#endif
