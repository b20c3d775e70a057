# SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
# SPDX-License-Identifier: BSD-3-Clause
"""Writes an isosurface with about COUNT triangles as binary PLY, without normals, and prints their number.

The surface is Neovius's, 3 (cos x + cos y + cos z) + 4 cos x cos y cos z = 0, two periods in each direction.
make_mesh.py COUNT FILE.ply
"""
import math
import sys

import numpy
import pyvista

import view

TRIANGLES_PER_SQUARE = 19.8  # triangles over the square of the cells of a side, measured


def write(path, points, triangles):
    faces = numpy.empty(len(triangles), [("count", "u1"), ("points", "<i4", 3)])
    faces["count"], faces["points"] = 3, triangles
    with open(path, "wb") as file:
        file.write(f"ply\nformat binary_little_endian 1.0\nelement vertex {len(points)}\n"
                   "property float x\nproperty float y\nproperty float z\n"
                   f"element face {len(faces)}\nproperty list uchar int vertex_indices\nend_header\n".encode())
        file.write(points.astype("<f4").tobytes())
        file.write(faces.tobytes())


def main():
    cells = round(math.sqrt(float(sys.argv[1]) / TRIANGLES_PER_SQUARE))
    cosines = numpy.cos(numpy.linspace(-2 * math.pi, 2 * math.pi, cells + 1, dtype="f4") + 0.4)
    x, y, z = cosines[None, None, :], cosines[None, :, None], cosines[:, None, None]
    grid = pyvista.ImageData(dimensions=(cells + 1,) * 3, spacing=(2 * view.HALF_SIDE / cells,) * 3,
                             origin=(-view.HALF_SIDE,) * 3)
    grid["field"] = (3 * (x + y + z) + 4 * x * y * z).ravel()
    mesh = grid.contour([0.0], "field", compute_normals=False, compute_scalars=False, method="flying_edges")
    write(sys.argv[2], mesh.points, mesh.regular_faces)
    print(mesh.n_cells)


if __name__ == "__main__":
    main()
