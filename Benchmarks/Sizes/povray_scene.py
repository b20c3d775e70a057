# SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
# SPDX-License-Identifier: BSD-3-Clause
"""Writes a POV-Ray scene of a mesh under a white sky: radiosity of one reflection, which has no limit of the radius.

povray_scene.py MESH.ply SCENE.pov
"""
import sys

import numpy

import view

SETTINGS = """#version 3.7;
global_settings {{
  assumed_gamma 1.0
  radiosity {{ count 100 error_bound 0.5 nearest_count 10 pretrace_start 0.08 pretrace_end 0.01 recursion_limit 1 }}
}}
background {{ rgb 1 }}
camera {{
  perspective location <{eye}> sky <{up}> direction z*{height} up y right -x*{width}/{height} look_at <{target}>
  angle {angle}
}}
"""
MATERIAL = "pigment { rgb 1 } finish { ambient 0 diffuse 1 } }\n"


def read_mesh(path):
    """Return points and triangles of a file of make_mesh.py."""
    with open(path, "rb") as file:
        header = b""
        while not header.endswith(b"end_header\n"):
            header += file.readline()
        points, triangles = (int(line.split()[2]) for line in header.splitlines() if line.startswith(b"element"))
        positions = numpy.fromfile(file, "<f4", 3 * points).reshape(-1, 3)
        faces = numpy.fromfile(file, [("count", "u1"), ("points", "<i4", 3)], triangles)
    return positions, faces["points"]


def write_vectors(file, template, values):
    """Write rows of three numbers, in pieces."""
    for first in range(0, len(values), 100000):
        piece = values[first:first + 100000]
        file.write((template * len(piece)) % tuple(piece.ravel().tolist()))


def main():
    positions, triangles = read_mesh(sys.argv[1])
    width = 2.0 * numpy.degrees(numpy.arctan(numpy.tan(numpy.radians(view.ANGLE) / 2) * view.WIDTH / view.HEIGHT))
    join = lambda vector: ",".join(map(str, vector))
    with open(sys.argv[2], "w", encoding="ascii") as file:
        file.write(SETTINGS.format(eye=join(view.EYE), up=join(view.UP), target=join(view.TARGET), angle=width,
                                   width=view.WIDTH, height=view.HEIGHT))
        file.write(f"mesh2 {{\nvertex_vectors {{ {len(positions)}\n")
        write_vectors(file, ",<%.7g,%.7g,%.7g>\n", positions)
        file.write(f"}}\nface_indices {{ {len(triangles)}\n")
        write_vectors(file, ",<%d,%d,%d>\n", triangles)
        file.write("}\n" + MATERIAL)


main()
