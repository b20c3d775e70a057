#!/usr/bin/env python3
# count-f3d-tests.py PROGRAM F3D-SOURCES: runs the options of F3D's own tests of its command line that compare an image, and
# prints how many `penumbra render` accepts, as the table in Documentation/user/F3D.md.
#
# A test counts if the format of its file is read and no option is in the table "Not offered" of this page. F3D's data are not in
# its repository, so a triangle with the arrays that the options name stands for each file. Accepted: an image is
# written, and no warning says that an option has no effect; --hdri-file alone has none in F3D either.
import base64
import collections
import json
import pathlib
import re
import shlex
import struct
import subprocess
import sys
import tempfile

PAGE = pathlib.Path(__file__).resolve().parents[3] / "Documentation" / "user" / "F3D.md"
FLAGS = ("LONG_TIMEOUT DEFAULT_HDRI INTERACTION INTERACTION_CONFIGURE NO_BASELINE NO_RENDER NO_OUTPUT WILL_FAIL "
         "NO_DATA_FORCE_RENDER UI SCRIPT PIPED SKIP_GLES").split()
VALUES = ("NAME BASELINE_PATH OUTPUT_PATH CONFIG RESOLUTION THRESHOLD REGEXP REGEXP_FAIL HDRI RENDERING_BACKEND WORKING_DIR "
          "DPI_SCALE PIPED_READER PIPED_ARG PLUGIN").split()
LISTS = "DATA DEPENDS LABELS ENV ARGS".split()
# Tests of messages, scripts, recordings, windows and configuration files, which have no image of given options.
OTHERS = ("INTERACTION", "INTERACTION_CONFIGURE", "NO_BASELINE", "NO_RENDER", "NO_OUTPUT", "WILL_FAIL",
          "NO_DATA_FORCE_RENDER", "SCRIPT", "CONFIG", "DPI_SCALE")


def parse_tests(folder):
    """Yield each f3d_test() as a dictionary."""
    for path in sorted(folder.glob("tests.*.cmake")):
        text = re.sub(r"(?m)(^|\s)#.*$", "", path.read_text())
        for body in re.findall(r"f3d_test\(((?:[^()\"]|\"[^\"]*\")*)\)", text):
            test, current = collections.defaultdict(list), None
            for word in shlex.split(body):
                if word in FLAGS:
                    test[word], current = True, None
                elif word in VALUES or word in LISTS:
                    current = word
                elif current:
                    test[current].append(word)
                    current = current if current in LISTS else None
            yield test


def options_of(text):
    """Return the names of the options in code spans."""
    spans = " ".join(re.findall(r"`([^`]+)`", text))
    return set(re.findall(r"(?<![\w-])--?[a-zA-Z][a-z-]*", spans))


def refused_options():
    return options_of("\n".join(
        line.split("|")[1] for line in PAGE.read_text().split("## Not offered")[1].splitlines() if line.startswith("| `")))


def split_names(arguments):
    """Yield the names of the options, one for each letter of a cluster such as -sob."""
    for word in arguments:
        if word.startswith("--"):
            yield word.split("=")[0]
        elif re.fullmatch(r"-[a-zA-Z]{1,5}", word):
            yield from (f"-{letter}" for letter in word[1:])
        elif re.match(r"-[DR]", word):
            yield word[:2]


def value_of(arguments, option, default):
    return next((word.split("=", 1)[1] for word in arguments if word.startswith(f"{option}=")), default)


def write_vtp(path, array):
    values = " ".join(str(i % 7) for i in range(12))
    path.write_text(
        '<VTKFile type="PolyData"><PolyData><Piece NumberOfPoints="3" NumberOfPolys="1">'
        f'<PointData Scalars="{array}"><DataArray type="Float32" Name="{array}" NumberOfComponents="4" format="ascii">'
        f'{values}</DataArray></PointData><CellData Scalars="{array}"><DataArray type="Float32" Name="{array}" '
        'NumberOfComponents="4" format="ascii">1 2 3 4</DataArray></CellData><Points><DataArray type="Float32" '
        'NumberOfComponents="3" format="ascii">0 0 0 1 0 0 0 1 0</DataArray></Points><Polys><DataArray type="Int32" '
        'Name="connectivity" format="ascii">0 1 2</DataArray><DataArray type="Int32" Name="offsets" format="ascii">3'
        "</DataArray></Polys></Piece></PolyData></VTKFile>")


def write_gltf(path, _):
    """Write a triangle with texture coordinates and weights, an animation of 3 seconds, and two cameras."""
    floats = [0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 1, 0, 3, 0, 0, 0, 0.1, 0, 0] + 3 * [1, 0, 0, 0]
    data = struct.pack(f"<{len(floats)}f", *floats)
    views = [(0, 36), (36, 24), (60, 8), (68, 24), (92, 48)]
    accessors = [("VEC3", 3), ("VEC2", 3), ("SCALAR", 2), ("VEC3", 2), ("VEC4", 3)]
    path.write_text(json.dumps({
        "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0, 1, 2]}],
        "nodes": [{"mesh": 0}, {"camera": 0, "translation": [0.3, 0.3, 3]}, {"camera": 1, "translation": [0.3, 0.3, 3]}],
        "cameras": [{"type": "perspective", "perspective": {"yfov": 0.7, "znear": 0.1}},
                    {"type": "orthographic", "orthographic": {"xmag": 1, "ymag": 1, "znear": 0.1, "zfar": 9}}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "TEXCOORD_0": 1, "WEIGHTS_0": 4}}]}],
        "animations": [{"channels": [{"sampler": 0, "target": {"node": 0, "path": "translation"}}],
                        "samplers": [{"input": 2, "output": 3}]}],
        "buffers": [{"byteLength": len(data), "uri": f"data:;base64,{base64.b64encode(data).decode()}"}],
        "bufferViews": [{"buffer": 0, "byteOffset": at, "byteLength": size} for at, size in views],
        "accessors": [{"bufferView": i, "componentType": 5126, "type": kind, "count": count,
                       **({"min": [0, 0, 0], "max": [1, 1, 0]} if i == 0 else
                          {"min": [0], "max": [3]} if i == 2 else {})}
                      for i, (kind, count) in enumerate(accessors)]}))


def write_image(path):
    """Write a gray .bmp of 2 x 1 pixels."""
    path.write_bytes(b"BM" + struct.pack("<IIIIiiHHIIiiII", 62, 0, 54, 40, 2, 1, 1, 24, 0, 8, 0, 0, 0, 0) + bytes([128] * 6 + [0] * 2))


def write_series(path, array):
    write_vtp(path.with_suffix(".vtp"), array)
    path.write_text(json.dumps({"file-series-version": "1.0", "files": [
        {"name": path.with_suffix(".vtp").name, "time": time} for time in (-3, 0, 0.003, 2)]}))


def run_test(program, test, arguments, folder):
    """Return what the program says, or an empty text if it accepts the options."""
    files = []
    for i, name in enumerate(test["DATA"]):
        suffix = pathlib.Path(name).suffix.lower()
        kind, write = ((".gltf", write_gltf) if suffix in (".gltf", ".glb") else
                       (".series", write_series) if suffix in (".ex2", ".e", ".exo", ".g") else (".vtp", write_vtp))
        files.append(folder / f"{i}{kind}")
        write(files[-1], value_of(arguments, "--coloring-array", "Scalars"))
    write_image(folder / "image.bmp")
    arguments = [re.sub(r"=(\$\{F3D_SOURCE_DIR\}|~).*", f"={folder / 'image.bmp'}", word) for word in arguments]
    output = folder / "image.png"
    output.unlink(missing_ok=True)
    command = [program, "render", *map(str, files), *arguments, "--no-config", "--output", str(output),
               f"--resolution={(test['RESOLUTION'] or ['300,300'])[0]}"]
    result = subprocess.run(command, capture_output=True, text=True)
    message = result.stderr.strip().replace("penumbra: ", "")
    return message if result.returncode or not output.exists() or re.search("(?<!--hdri-file) has no effect", message) else ""


def main(program, sources):
    formats = set(re.findall(r"\.\w+", subprocess.run([program, "list"], capture_output=True, text=True).stdout))
    refused = refused_options()
    counts, rest = collections.Counter(), collections.Counter()
    with tempfile.TemporaryDirectory() as folder:
        for test in parse_tests(pathlib.Path(sources, "application", "testing")):
            arguments = test["ARGS"]
            names = set(split_names(arguments))
            suffixes = {pathlib.Path(name).suffix.lower() for name in test["DATA"]}
            if any(test[key] for key in OTHERS) or not suffixes or any("${" in name for name in test["DATA"]):
                counts["other"] += 1
            elif not suffixes <= formats:
                counts["format"] += 1
            elif test["HDRI"] or names & refused:
                counts["option"] += 1
            else:
                message = run_test(program, test, arguments, pathlib.Path(folder))
                counts["refused" if message else "accepted"] += 1
                if message:
                    rest[re.split(r"[=:]", next((n for n in names if n in message), message))[0]] += 1
                    print(f"{test['NAME'][0]}: {' '.join(arguments)}: {message}", file=sys.stderr)
    common = counts["accepted"] + counts["refused"]
    print(f"{sum(counts.values())} tests: {counts['other']} without an image of given options, {counts['format']} of other "
          f"formats, {counts['option']} with an option that is not offered")
    print(f"{common} in common: {counts['accepted']} accepted ({100 * counts['accepted'] / common:.0f} %)")
    for name, count in rest.most_common():
        print(f"| `{name}` | {count} |")


main(*sys.argv[1:])
