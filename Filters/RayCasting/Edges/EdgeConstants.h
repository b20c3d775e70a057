// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Tuning constants of edges: which edges of a mesh count, and which surfaces have subpixel triangles.
// Lengths are in pixels, areas in pixel areas. After changing a value run the tests that
// CoverageConstants.h names.
#ifndef penumbra_EdgeConstants_h
#define penumbra_EdgeConstants_h

#include <cstddef>

namespace penumbra
{

// --- Edges of the scene ---

/// Edges across which colors change by less than this fraction of the tolerance are not feature
/// edges.
constexpr double EdgeContrastFraction = 0.25;
/// Distance of a corner to an edge below which its ray may hit either side of the edge.
constexpr double EdgePrecision = 1e-3;
/// Fraction of the distance to the pixel center by which such a corner is moved before it is
/// retraced.
constexpr double CornerInset = 4.0 * EdgePrecision;

// --- Triangles with unsteady normals ---

/// Length of an interpolated normal, relative to the longest one of the triangle, below which its
/// direction changes too fast to be found by rays. Reached if the normals of two corners differ by
/// 151 degrees.
constexpr double UnsteadyLength = 0.25;

// --- Surfaces with subpixel triangles ---

/// Number of triangles, approximately, from which the mean projected area of a surface is
/// estimated.
constexpr std::size_t MaximumTrianglesSampled = 10000;
/// Mean projected area of a triangle below which a surface is sampled. Measured: exact coverage and
/// 8 x 8 samples take the same time at this area.
constexpr double SubpixelArea = 1.0;
/// A surface is sampled only if it has more triangles than this number per pixel of its projected
/// bounds plus MinimumTriangles. Fewer small triangles are small objects, which are covered
/// exactly.
constexpr double TrianglesPerPixel = 0.5;
constexpr double MinimumTriangles = 4096.0;
/// Length of a side in pixels from which the feature edges of a triangle of such a surface are
/// covered exactly.
constexpr double LargeTriangleSide = 4.0;

// --- Outlines of spheres, tubes and instances ---

/// Number of spheres, tubes and instances in a tile of 32x32 pixels from which it is sampled if that takes less
/// time than exact coverage. Those behind the surfaces at the corners of their pixels do not count.
constexpr std::size_t MinimumOutlinesOfSampledTile = 256;
/// 1.5 times the number of rays of a pixel that take as long as exact coverage at an outline in it. Faces of
/// small spheres have one ray each, which is brighter than their mean, so that their errors exceed the estimates.
/// *Measured* with parts of the million spheres of `./penumbra benchmark scale` at a tolerance of 0.0039: errors
/// of tiles of up to 0.0052 with 128, 0.0032 with 200.
constexpr double RaysPerOutline = 200.0;
/// Largest number of shapes of a tile whose outlines are cut. If there are more, those behind the surfaces at the
/// corners are left out, and if that does not suffice, the tile is sampled.
constexpr std::size_t MaximumOutlinesInTile = 4096;

}
#endif
