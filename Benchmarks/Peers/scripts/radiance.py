# SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
# SPDX-License-Identifier: BSD-3-Clause
"""The scenes of the irradiance benchmark by Radiance's ambient cache: error and time for several settings.

    pip install pyradiance numpy
    python Benchmarks/Peers/scripts/radiance.py FOLDER sphere HEIGHT
    python Benchmarks/Peers/scripts/radiance.py FOLDER box REFERENCE

Prints one line per setting: RMSE (relative in the box), CPU seconds of rtrace, records and the setting. FOLDER
receives intermediate files. REFERENCE contains lines of pixel x, y (from the bottom) and irradiance (RGB)."""
import pathlib
import sys

import numpy

from rtrace import BYTES_PER_RECORD, VERSION, child_seconds, run

LADDERS = {
    "sphere": ["", "-aa .15 -ad 1024 -as 0 -ar 4000", "-aa .1 -ad 1024 -as 0 -ar 4000",
               "-aa .1 -ad 1024 -as 0 -ar 10000", "-aa .07 -ad 1024 -as 0 -ar 10000"],
    # -ds: sampling of the area light; the default causes steps in the penumbra with an error of 0.046.
    "box": ["-aa .3 -ad 256 -as 0 -ar 32 -ds .06", "-aa .25 -ad 256 -as 0 -ar 32 -ds .06",
            "-aa .25 -ad 256 -as 0 -ar 32 -ds .05", "-aa .2 -ad 256 -as 0 -ar 32 -ds .04"]}


def sphere(height):
    """A unit sphere over a plane, all black, under a sky of radiance 1."""
    text = f"""void glow sky 0 0 4 1 1 1 0
sky source all 0 0 4 0 0 1 360
void plastic black 0 0 5 0 0 0 0 0
black polygon plane 0 0 12 -1000 -1000 0 1000 -1000 0 1000 1000 0 -1000 1000 0
black sphere ball 0 0 4 0 0 {height} 1
"""
    view = "-vp 0 -7 4 -vd 0 7 -3.4 -vu 0 0 1 -vh 45 -vv 45 -x 1024 -y 1024"

    def error(rays, seen):
        at, irradiance = seen[:, :3], seen[:, 6]
        middle = numpy.array([0, 7, height - 4])
        away = numpy.linalg.norm(middle)
        along = rays[:, 3:] / numpy.linalg.norm(rays[:, 3:], axis=1)[:, None]
        beside = numpy.arccos(along @ middle / away) - numpy.arcsin(1 / away)
        pixel = 2 * numpy.tan(numpy.radians(22.5)) / 1024
        known = (numpy.abs(beside) > 2 * pixel) & (numpy.abs(at).max(1) < 1e4)
        plane = height * (height ** 2 + (at[:, :2] ** 2).sum(1)) ** -1.5
        truth = numpy.where(beside < 0, (1 - (at[:, 2] - height)) / 2, plane)
        return numpy.sqrt(numpy.mean((1 - irradiance / numpy.pi - truth)[known] ** 2))

    return text, view, "-ab 1", error


def box(file):
    """The room of Benchmarks/Reference/BruteForce/PathTracer: albedo 0.5, five bounces, the last at the visible point."""
    panels = []

    def panel(material, corner, side, other):
        corner, side, other = map(numpy.array, (corner, side, other))
        corners = numpy.concatenate([corner, corner + side, corner + side + other, corner + other])
        panels.append(f"{material} polygon p{len(panels)} 0 0 12 " +
                      " ".join(f"{x:g}" for x in corners))

    def solid(low, high):
        low, high = numpy.array(low), numpy.array(high)
        for axis in range(3):
            side, other, across = numpy.zeros((3, 3))
            across[axis] = (high - low)[axis]
            side[(axis + 1) % 3] = (high - low)[(axis + 1) % 3]
            other[(axis + 2) % 3] = (high - low)[(axis + 2) % 3]
            panel("white", low, other, side)
            panel("white", low + across, side, other)

    x, y, z = numpy.eye(3)
    panel("white", [0, 0, 0], x, y)
    panel("white", [0, 0, 1], y, x)
    panel("white", [0, 1, 0], x, z)
    panel("red", [0, 0, 0], y, z)
    panel("green", [1, 0, 0], y, z)
    panel("emitter", [.35, .35, .999], .3 * y, .3 * x)
    panel("emitter", [.35, .35, .9991], .3 * x, .3 * y)  # Panels of the reference emit on both sides.
    solid([.15, .5, 0], [.45, .8, .6])
    solid([.55, .2, 0], [.85, .5, .3])
    text = """void plastic white 0 0 5 .5 .5 .5 0 0
void plastic red 0 0 5 .5 .15 .15 0 0
void plastic green 0 0 5 .15 .5 .15 0 0
void light emitter 0 0 3 12 11 9
""" + "\n".join(panels) + "\n"
    view = "-vp .51 -1.3 .47 -vd -.01 1.3 .03 -vu 0 0 1 -vh 41 -vv 41 -x 256 -y 256"
    known = numpy.loadtxt(file)

    def error(rays, seen):
        row = 255 - known[:, 1].astype(int)
        found = seen[row * 256 + known[:, 0].astype(int), 6:]
        return numpy.sqrt(((found - known[:, 2:]) ** 2).sum() / (known[:, 2:] ** 2).sum())

    return text, view, "-ab 4", error


folder, kind, of = pathlib.Path(sys.argv[1]), sys.argv[2], sys.argv[3]
text, view, bounces, error = sphere(float(of)) if kind == "sphere" else box(of)
(folder / "radiance.rad").write_text(text)
(folder / "radiance.oct").write_bytes(run("oconv", str(folder / "radiance.rad")))
rays = run("vwrays", "-ff", *view.split())
records = folder / "radiance.amb"
for setting in LADDERS[kind]:
    records.unlink(missing_ok=True)
    start = child_seconds()
    seen = run("rtrace", "-w", "-h", "-ff", "-i", "-opNv", "-af", str(records), "-aw", "0", "-av",
               "0", "0", "0", "-dt", "0", "-dj", "0", *bounces.split(), *setting.split(),
               str(folder / "radiance.oct"), given=rays)
    seconds = child_seconds() - start
    table = numpy.frombuffer(seen, numpy.float32).reshape(-1, 9).astype(float)
    lines = numpy.frombuffer(rays, numpy.float32).reshape(-1, 6).astype(float)
    print(f"{error(lines, table):.5f} {seconds:.3f} {setting or 'its defaults'}, "
          f"{records.stat().st_size // BYTES_PER_RECORD} records, {VERSION}", flush=True)
