# SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
# SPDX-License-Identifier: BSD-3-Clause
"""Measures one image of growing meshes with Penumbra and other programs: CPU seconds and peak memory of the process.

The error is the RMSE of the unoccluded fraction at pixels inside of surfaces, at one size, against rays that
reference.py traces. Writes sizes.csv, sizes.md and sizes.svg. `./penumbra benchmark sizes` calls it.
"""
import argparse
import csv
import dataclasses
import os
import pathlib
import re
import resource
import statistics
import subprocess
import sys

import chart
import view

SCRIPTS = pathlib.Path(__file__).resolve().parent
SIZES = (10_000, 100_000, 1_000_000, 10_000_000)
SIZE_OF_ERRORS = 100_000
LIMIT = 120  # CPU seconds
MEMORY_LIMIT = 12 << 30  # bytes
REPEATED_SECONDS = 4  # shorter runs are repeated, at most REPEATS times, until this sum
REPEATS = 3
HEAD = ("program", "size", "triangles", "CPU seconds", "peak memory, MB", "RMSE", "remark")


def python(variable, default="python3"):
    return os.environ.get(variable, default)


def penumbra(options):
    """Return the command of an image of Penumbra."""
    join = lambda vector: ",".join(map(str, vector))
    return ["{penumbra}", "render", "{mesh}", "--output", "{image}.png", "--threads", "1", "--progress", "none",
            "--resolution", join(view.SIZE), "--camera-position", join(view.EYE), "--camera-focal-point",
            join(view.TARGET), "--camera-view-up", join(view.UP), "--camera-view-angle", str(view.ANGLE), *options]


def script(interpreter, name, *arguments):
    return [interpreter, "-W", "ignore", str(SCRIPTS / name), "{mesh}", *arguments]


@dataclasses.dataclass
class Program:
    name: str
    command: list
    settings: str
    version: list = dataclasses.field(default_factory=list)  # command that prints the version
    image: str = "{image}.png"
    reference: str = "radius"  # array of reference.py; empty: the image has no occlusion
    plain: bool = False  # the fraction is the image divided by one without occlusion
    scene: list = dataclasses.field(default_factory=list)  # command that converts the mesh, not measured


def list_programs(pyvista):
    occlusion = ["--ambient-occlusion", "--ambient-occlusion-radius", f"{view.RADIUS:.7g}", "--no-lighting"]
    mitsuba, trimesh = python("MITSUBA_PYTHON"), python("TRIMESH_PYTHON")
    f3d, blender = python("F3D_PYTHON"), python("BLENDER_PYTHON")
    version = ["{penumbra}", "--version"]
    return [
        Program("Penumbra", penumbra(occlusion), "default tolerances", version),
        Program("Penumbra, tolerance 0.03", penumbra([*occlusion, "--light-tolerance", "0.03"]),
                "`--light-tolerance 0.03`", version),
        Program("Penumbra without occlusion", penumbra([]), "headlight, default tolerance", version, reference=""),
        Program("F3D", script(f3d, "f3d_image.py", "{image}.png"), "SSAO and SSAA, OpenGL in software",
                [f3d, str(SCRIPTS / "f3d_image.py")], plain=True),
        Program("PyVista", script(pyvista, "pyvista_image.py", "{image}.png"),
                "`enable_ssao`, `enable_anti_aliasing('ssaa')`, OpenGL in software",
                [pyvista, str(SCRIPTS / "pyvista_image.py")], plain=True),
        Program("Mitsuba", script(mitsuba, "mitsuba_image.py", "{image}.npy", "256", "1"),
                "script as in its tutorial, 256 rays of occlusion per pixel, variant `llvm_ad_mono`",
                [mitsuba, str(SCRIPTS / "mitsuba_image.py")], "{image}.npy"),
        Program("trimesh", script(trimesh, "trimesh_image.py", "{image}.npy", "32"),
                "32 rays of occlusion per pixel, numpy", [trimesh, str(SCRIPTS / "trimesh_image.py")], "{image}.npy"),
        Program("Blender", script(blender, "blender_image.py", "{image}.png", "32"),
                "Cycles, 32 samples and Open Image Denoise", [blender, str(SCRIPTS / "blender_image.py")]),
        Program("POV-Ray", ["povray", "+I{scene}", "+O{image}.png", "+W1000", "+H600", "+A0.1", "+AM2", "+R2", "+WT1",
                            "-D", "File_Gamma=1.0"],
                "radiosity of a white sky without a limit of the radius, `+A0.1 +AM2 +R2`", ["povray", "--version"],
                reference="sky", scene=[pyvista, str(SCRIPTS / "povray_scene.py"), "{mesh}", "{scene}"]),
    ]


def limit_child():
    resource.setrlimit(resource.RLIMIT_CPU, (LIMIT, LIMIT + 5))
    resource.setrlimit(resource.RLIMIT_DATA, (MEMORY_LIMIT, MEMORY_LIMIT))


def run(command, log):
    """Run a command. Return its CPU seconds, peak memory in MB and exit status, its children included."""
    with open(log, "wb") as output:
        child = subprocess.Popen(command, stdout=output, stderr=subprocess.STDOUT, preexec_fn=limit_child)
        _, status, usage = os.wait4(child.pid, 0)
    child.returncode = status
    return usage.ru_utime + usage.ru_stime, usage.ru_maxrss * 1024 / 1e6, status


def find_version(text):
    """Return the first line with a version of three numbers; empty without one."""
    lines = [line.strip() for line in text.splitlines() if re.search(r"\d+\.\d+\.\d+", line)]
    return lines[0] if lines else ""


def read_version(program, paths):
    """Return the program with its version; empty if it is not installed."""
    try:
        command = [word.format(**paths) for word in program.version]
        answer = subprocess.run(command, capture_output=True, text=True, timeout=120, check=False)
    except OSError:
        return ""
    return find_version(answer.stdout + answer.stderr) if answer.returncode == 0 else ""


def measure(program, paths, log):
    """Return the cells of a row from CPU seconds to the remark."""
    seconds, peaks = [], []
    while len(seconds) < REPEATS and sum(seconds) < REPEATED_SECONDS:
        cpu, peak, status = run([word.format(**paths) for word in program.command], log)
        if status != 0:
            over = "over 120 s" if cpu >= LIMIT - 1 else f"failed with {peak:.0f} MB"
            return "", "", "", over
        seconds.append(cpu)
        peaks.append(peak)
    return f"{statistics.median(seconds):.3g}", f"{statistics.median(peaks):.0f}", "", ""


def compute_error(program, paths, pyvista, reference):
    command = [pyvista, str(SCRIPTS / "error.py"), reference, program.reference, program.image.format(**paths)]
    if program.plain:
        plain = {**paths, "image": paths["image"] + "-plain"}
        plain_command = [word.format(**plain) for word in program.command] + ["plain"]
        subprocess.run(plain_command, check=True, capture_output=True)
        command.append(program.image.format(**plain))
    answer = subprocess.run(command, check=True, capture_output=True, text=True)
    return f"{float(answer.stdout):.2g}"


def write_table(path, rows, lines):
    with open(path.with_suffix(".csv"), "w", encoding="utf-8", newline="") as file:
        csv.writer(file, lineterminator="\n").writerows([HEAD, *rows])
    with open(path.with_suffix(".md"), "w", encoding="utf-8") as file:
        file.write("# An image by size of the mesh: measurements\n\n")
        file.writelines(f"- {line}\n" for line in lines)
        file.write("\n| " + " | ".join(HEAD) + " |\n" + "|---" * len(HEAD) + "|\n")
        file.writelines("| " + " | ".join(map(str, row)) + " |\n" for row in rows)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--penumbra", required=True)
    parser.add_argument("--python", required=True)
    parser.add_argument("--output", type=pathlib.Path, required=True)
    parser.add_argument("--only", help="name of one program")
    parser.add_argument("--largest", type=float, default=1e7, help="largest number of triangles")
    options = parser.parse_args()
    paths = {"penumbra": options.penumbra}
    programs = [(program, read_version(program, paths)) for program in list_programs(options.python)
                if options.only in (None, program.name)]
    for program, version in programs:
        if not version:
            print(f"sizes: {program.name} is not installed, its rows are skipped", file=sys.stderr)
    programs = [(program, version) for program, version in programs if version]
    lines = [os.environ.get("PENUMBRA_RUN", ""),
             f"{view.WIDTH}x{view.HEIGHT} pixels of Neovius's surface; ambient occlusion with a radius of a tenth of "
             "the diagonal; one thread; CPU seconds and peak resident memory of the whole process, file included",
             f"RMSE: of the unoccluded fraction at pixels inside of surfaces, with {SIZE_OF_ERRORS} triangles, against "
             "2048 rays per pixel with trimesh; of F3D and PyVista, of the image divided by that without occlusion",
             *(f"{program.name}: {version}; {program.settings}" for program, version in programs)]
    rows, finished = [], {}
    reference = ""
    for size in SIZES:
        if size > options.largest:
            break
        mesh = options.output / f"{size}.ply"
        triangles = subprocess.run([options.python, str(SCRIPTS / "make_mesh.py"), str(size), str(mesh)], check=True,
                                   capture_output=True, text=True).stdout.split()[-1]
        if size == SIZE_OF_ERRORS:
            reference = str(options.output / "reference.npz")
            command = [python("TRIMESH_PYTHON"), str(SCRIPTS / "reference.py"), str(mesh), reference]
            if subprocess.run(command, capture_output=True, check=False).returncode != 0:
                print("sizes: no errors, because TRIMESH_PYTHON lacks trimesh or embreex", file=sys.stderr)
                reference = ""
        for program, _ in programs:
            if finished.get(program.name):
                rows.append([program.name, size, triangles, "", "", "", finished[program.name]])
                continue
            paths.update(mesh=mesh, image=str(options.output / "image"), scene=str(options.output / "scene.pov"))
            if program.scene:
                subprocess.run([word.format(**paths) for word in program.scene], check=True)
            *cells, error, remark = measure(program, paths, options.output / "log")
            if remark:
                finished[program.name] = remark
            elif program.reference and reference and size == SIZE_OF_ERRORS:
                error = compute_error(program, paths, options.python, reference)
            rows.append([program.name, size, triangles, *cells, error, remark])
            print(*rows[-1], sep=" | ", flush=True)
        for path in (mesh, pathlib.Path(paths["scene"])):
            path.unlink(missing_ok=True)
        write_table(options.output / "sizes.md", rows, lines)
        chart.write(rows, options.output / "sizes.svg")


if __name__ == "__main__":
    main()
