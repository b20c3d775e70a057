# SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
# SPDX-License-Identifier: BSD-3-Clause
"""Write aggregate.vtk and streamlines.vtk into this folder. Requires NumPy."""
import pathlib

import numpy as np

FOLDER = pathlib.Path(__file__).parent


def write(name, title, points, lines, array, values):
    """Write points, or lines through them, with one array per point as a binary legacy VTK file."""
    cells = np.concatenate([np.concatenate([[len(line)], line]) for line in lines]).astype(">i4")
    kind = "LINES" if len(lines[0]) > 1 else "VERTICES"
    header = f"# vtk DataFile Version 3.0\n{title}\nBINARY\nDATASET POLYDATA\nPOINTS {len(points)} float\n"
    scalars = f"\nPOINT_DATA {len(points)}\nSCALARS {array} float 1\nLOOKUP_TABLE default\n"
    (FOLDER / name).write_bytes(
        header.encode() + points.astype(">f4").tobytes() + f"\n{kind} {len(lines)} {len(cells)}\n".encode()
        + cells.tobytes() + scalars.encode() + values.astype(">f4").tobytes() + b"\n")


def aggregate(count, random):
    """Return the centers of spheres of diameter 1 that stuck where their random walks ended."""
    points = np.zeros((count, 3))
    size, reach = 1, 0.0

    def direction():
        v = random.normal(size=3)
        return v / np.linalg.norm(v)

    while size < count:
        p = (reach + 2.0) * direction()
        while True:
            distances = np.linalg.norm(points[:size] - p, axis=1)
            nearest = int(distances.argmin())
            gap = distances[nearest] - 1.0
            if gap < 0.02:
                break
            p = p + gap * direction()
            if np.linalg.norm(p) > 3.0 * reach + 6.0:
                p = (reach + 2.0) * direction()
        points[size] = points[nearest] + (p - points[nearest]) / distances[nearest]
        reach = max(reach, np.linalg.norm(points[size]))
        size += 1
    return points


def flow(p):
    """Return the velocity of the Arnold-Beltrami-Childress flow."""
    x, y, z = p.T
    a, b, c = np.sqrt(3.0), np.sqrt(2.0), 1.0
    return np.stack([a * np.sin(z) + c * np.cos(y), b * np.sin(x) + a * np.cos(z), c * np.sin(y) + b * np.cos(x)], 1)


def streamlines(count, steps, random):
    """Return points of streamlines by the method of Runge and Kutta, of shape (count, steps + 1, 3)."""
    p = random.uniform(-np.pi, np.pi, (count, 3))
    paths = [p]
    for _ in range(steps):
        h = 0.09 / np.linalg.norm(flow(p), axis=1)[:, None]
        k1 = flow(p)
        k2 = flow(p + 0.5 * h * k1)
        k3 = flow(p + 0.5 * h * k2)
        k4 = flow(p + h * k3)
        p = p + h / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4)
        paths.append(p)
    return np.stack(paths, 1)


def main():
    centers = aggregate(4000, np.random.default_rng(1))
    write("aggregate.vtk", "Diffusion-limited aggregate", centers, np.arange(len(centers))[:, None], "Radius",
          np.linalg.norm(centers, axis=1))
    paths = streamlines(70, 90, np.random.default_rng(2))
    points = paths.reshape(-1, 3)
    write("streamlines.vtk", "Streamlines of the ABC flow", points,
          np.arange(len(points)).reshape(len(paths), -1), "Speed", np.linalg.norm(flow(points), axis=1))


if __name__ == "__main__":
    main()
