# SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
# SPDX-License-Identifier: BSD-3-Clause
"""Radiance's ambient cache for `penumbra chart`: light at surface points. SETTING: options of rtrace.

Rays are counted as records times -ad, which is an upper bound."""
import pathlib

import numpy

import point_protocol
import rtrace

# Area lights are one-sided in Radiance. A second light at this distance behind the first replaces the back side.
BEHIND = 1e-4


def join_halves(lights):
    """Joins triangles a b c and a c d of one material to parallelograms: Radiance samples a triangle as a parallelogram
    of its area, with an error of a third of the light in places."""
    joined = []
    for name, corners in lights:
        last, half = joined[-1] if joined else (None, None)
        if name == last and len(half) == 3 and (half[[0, 2]] == corners[:2]).all() and numpy.allclose(
                half[0] + half[2], half[1] + corners[2]):
            joined[-1] = name, numpy.vstack([half, corners[2:]])
        else:
            joined.append((name, corners))
    return joined


def describe(scene):
    """Returns the scene in Radiance's format."""
    lines = [f"void glow sky 0 0 4 {scene.sky} {scene.sky} {scene.sky} 0", "sky source all 0 0 4 0 0 1 360"]
    names = {}

    def material(reflectance, emission):
        key = (*reflectance, *emission)
        if key not in names:
            names[key] = f"m{len(names)}"
            shines = max(emission) > 0
            lines.append(f"void {'light' if shines else 'plastic'} {names[key]} 0 0 " + (
                "3 " + " ".join(map(str, emission)) if shines
                else "5 " + " ".join(map(str, reflectance)) + " 0 0"))
        return names[key]

    def polygon(name, corners):
        lines.append(f"{name} polygon t{len(lines)} 0 0 {corners.size} " +
                     " ".join(f"{x:.9g}" for x in corners.ravel()))

    lights = []
    for corners, reflectance, emission in zip(scene.corners.reshape(-1, 3, 3), scene.reflectance, scene.emission):
        name = material(reflectance, emission)
        if max(emission) > 0:
            lights.append((name, corners))
        else:
            polygon(name, corners)
    for name, corners in join_halves(lights):
        across = numpy.cross(corners[1] - corners[0], corners[2] - corners[0])
        polygon(name, corners)
        polygon(name, corners[::-1] - BEHIND * across / numpy.linalg.norm(across))
    return "\n".join(lines) + "\n"


def ask(scene, setting, path):
    tree, records = path + ".oct", pathlib.Path(path + ".amb")
    pathlib.Path(path + ".rad").write_text(describe(scene))
    pathlib.Path(tree).write_bytes(rtrace.run("oconv", "-w", "-f", path + ".rad"))
    gathers = int(scene.bounces) - (scene.sky == 0)  # Emitters shine without.
    options = ["-h", "-w", "-I", "-fdf", "-ov", "-af", str(records), "-aw", "0", "-av", "0", "0", "0", "-dt", "0",
               "-dj", "0", "-ab", str(gathers), *setting.split(), tree]

    def seconds_of(some):
        records.unlink(missing_ok=True)
        start = rtrace.child_seconds()
        seen = rtrace.run("rtrace", *options, given=some.tobytes())
        return rtrace.child_seconds() - start, seen

    loading, _ = seconds_of(scene.points[:0])
    seconds, seen = seconds_of(scene.points)
    light = numpy.frombuffer(seen, numpy.float32).reshape(-1, 3) / numpy.pi
    rays = int(setting.split()[setting.split().index("-ad") + 1])
    count = records.stat().st_size / rtrace.BYTES_PER_RECORD * rays / len(scene.points)
    return light, max(seconds - loading, 0), count


point_protocol.run(rtrace.VERSION, ask)
