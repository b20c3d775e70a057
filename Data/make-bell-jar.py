#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
# SPDX-License-Identifier: BSD-3-Clause
"""Writes bell-jar.vtk: three rings on a floor, one of them below a bell jar of glass, with RGBA point colors."""
import math
import pathlib

FLOOR, RED, BLUE, GOLD = (0.8, 0.79, 0.77, 1.0), (0.8, 0.22, 0.16, 1.0), (0.2, 0.4, 0.75, 1.0), (0.86, 0.66, 0.2, 1.0)
GLASS = (0.75, 0.9, 0.95, 0.22)

points, normals, colors, polygons = [], [], [], []


def add_grid(columns, rows, vertex, color):
    """Adds columns x rows quads; vertex(u, v) returns a point and its normal for u, v in [0, 1]."""
    first = len(points)
    for j in range(rows + 1):
        for i in range(columns + 1):
            point, normal = vertex(i / columns, j / rows)
            points.append(point)
            normals.append(normal)
            colors.append(color)
    for j in range(rows):
        for i in range(columns):
            a = first + j * (columns + 1) + i
            polygons.append((a, a + 1, a + columns + 2, a + columns + 1))


def revolve(profile):
    """Vertices of a surface of revolution about z; profile(v) returns radius, height and their normal."""
    def vertex(u, v):
        radius, height, outward, upward = profile(v)
        c, s = math.cos(2 * math.pi * u), math.sin(2 * math.pi * u)
        return (radius * c, radius * s, height), (outward * c, outward * s, upward)
    return vertex


def ring(center, radius, tube, color):
    def profile(v):
        c, s = math.cos(2 * math.pi * v), math.sin(2 * math.pi * v)
        return radius + tube * c, tube + tube * s, c, s

    def moved(u, v):
        (x, y, z), normal = revolve(profile)(u, v)
        return (x + center[0], y + center[1], z + center[2]), normal
    add_grid(48, 20, moved, color)


def bell(v):
    """A cylinder of height 0.9 below a hemisphere of radius 0.8."""
    if v < 0.4:
        return 0.8, 0.9 * v / 0.4, 1.0, 0.0
    angle = 0.5 * math.pi * (v - 0.4) / 0.6
    return 0.8 * math.cos(angle), 0.9 + 0.8 * math.sin(angle), math.cos(angle), math.sin(angle)


add_grid(1, 1, lambda u, v: ((40 * u - 20, 40 * v - 20, 0.0), (0.0, 0.0, 1.0)), FLOOR)
ring((0.0, 0.0, 0.0), 0.4, 0.16, GOLD)
ring((0.0, 0.0, 0.32), 0.26, 0.13, RED)
ring((-1.6, 0.5, 0.0), 0.4, 0.16, BLUE)
ring((1.55, 0.2, 0.0), 0.4, 0.16, GOLD)
add_grid(64, 24, revolve(bell), GLASS)

with open(pathlib.Path(__file__).parent / "bell-jar.vtk", "w") as file:
    file.write("# vtk DataFile Version 3.0\nRings on a floor, and a bell jar\nASCII\nDATASET POLYDATA\n")
    file.write(f"POINTS {len(points)} float\n")
    file.writelines("%.4g %.4g %.4g\n" % point for point in points)
    file.write(f"POLYGONS {len(polygons)} {5 * len(polygons)}\n")
    file.writelines("4 %d %d %d %d\n" % polygon for polygon in polygons)
    file.write(f"POINT_DATA {len(points)}\nCOLOR_SCALARS Color 4\n")
    file.writelines("%g %g %g %g\n" % color for color in colors)
    file.write("NORMALS Normals float\n")
    file.writelines("%.3g %.3g %.3g\n" % normal for normal in normals)
