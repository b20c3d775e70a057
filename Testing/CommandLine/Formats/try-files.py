#!/usr/bin/env python3
# Renders every file of folders whose extension `penumbra list` names, and prints those that are refused.
#   try-files.py PROGRAM FOLDER... [--output FOLDER] [--jobs N]
# If the Python package vtk can be imported, each refused file is also read by VTK's reader or importer,
# and by the program assimp if it is installed. With --output the images are kept, and sheet.html shows
# them. Exit status 1: more than 1 % are refused although one of these reads them. That is right for
# damaged files: VTK's readers return what precedes the damage.
import argparse
import concurrent.futures
import html
import pathlib
import shutil
import subprocess
import sys
import tempfile

# Read by VTK for comparison: a reader or importer that returns points without an error.
VTK_READER = """
import sys
import vtk
path, name = sys.argv[1:]
reader = getattr(vtk, name)()
errors = []
reader.AddObserver("ErrorEvent", lambda *_: errors.append(1))
getattr(reader, "SetCaseFileName", reader.SetFileName)(path)
if name.endswith("Importer"):
    window = vtk.vtkRenderWindow()
    window.SetOffScreenRendering(1)
    reader.SetRenderWindow(window)
    reader.Update()
    actors = list(reader.GetRenderer().GetActors())
    for actor in actors:
        actor.GetMapper().Update()
    points = sum(actor.GetMapper().GetInput().GetNumberOfPoints() for actor in actors)
else:
    reader.Update()
    data = reader.GetOutputDataObject(0)
    points = data.GetNumberOfElements(vtk.vtkDataObject.POINT) if data else 0
sys.exit(bool(errors) or points == 0)
"""
# The program reads these formats itself.
READERS = {".stl": "vtkSTLReader", ".ply": "vtkPLYReader", ".obj": "vtkOBJReader", ".off": "vtkOFFReader"}


def extensions(program):
    """Maps extensions to the names of readers."""
    table = {}
    lines = subprocess.run([program, "list"], capture_output=True, text=True).stdout.split("\n")
    for line in lines[1:lines.index("")]:
        words = line.split()
        for word in words:
            if word.startswith("."):
                table.setdefault(word, READERS.get(word, words[-1]))
    return table


def reader_of(path, table):
    name = path.name.lower()
    return next((table[e] for e in sorted(table, key=len, reverse=True)
                 if name.endswith(e) and len(name) > len(e)), None)


def render(program, path, image):
    command = [program, "render", path, "--output", image, "--resolution", "160,120",
               "--camera-direction=-1,-1,-2", "--read-limit", "60"]
    try:
        result = subprocess.run(command, capture_output=True, text=True, timeout=120, errors="replace")
        return result.returncode, result.stderr.strip()
    except subprocess.TimeoutExpired:
        return -1, "no image after 120 s"


def reads_with_vtk(path, name):
    try:
        return subprocess.run([sys.executable, "-c", VTK_READER, path, name], capture_output=True,
                              timeout=60).returncode == 0
    except subprocess.TimeoutExpired:
        return False


def reads_with_assimp(path):
    if not shutil.which("assimp"):
        return False
    try:
        return subprocess.run(["assimp", "info", path], capture_output=True, timeout=60).returncode == 0
    except subprocess.TimeoutExpired:
        return False


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("program")
    parser.add_argument("folders", nargs="+", type=pathlib.Path)
    parser.add_argument("--output", type=pathlib.Path)
    parser.add_argument("--jobs", type=int, default=1)
    options = parser.parse_args()
    table = extensions(options.program)
    files = sorted(p for folder in options.folders for p in folder.rglob("*")
                   if p.is_file() and reader_of(p, table))
    images = options.output or pathlib.Path(tempfile.mkdtemp())
    images.mkdir(parents=True, exist_ok=True)
    targets = [images / f"{number:04}.png" for number in range(len(files))]
    with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        results = list(pool.map(lambda pair: render(options.program, *pair), zip(files, targets)))
    refused = [(path, error) for path, (status, error) in zip(files, results) if status != 0]
    wrong = 0
    for path, error in refused:
        name = reader_of(path, table)
        readers = []
        if name != "Penumbra" and reads_with_vtk(path, name):
            readers.append("VTK")
        if reads_with_assimp(path):
            readers.append("assimp")
        wrong += bool(readers)
        print("read by " + " and ".join(readers) if readers else "refused", error or path, sep=": ")
    for path, (status, error) in zip(files, results):
        if status == 0 and error:
            print("warning", error, sep=": ")
    print(f"{len(files)} files, {len(refused)} refused, {wrong} of these are read by VTK or assimp")
    if options.output:
        cells = "".join(f'<figure><img src="{target.name}"><figcaption>{html.escape(path.name)}'
                        "</figcaption></figure>" for path, target in zip(files, targets)
                        if target.exists())
        (images / "sheet.html").write_text(
            f"<style>figure {{ display: inline-block; margin: 2px }}</style>{cells}")
    return wrong > 0.01 * len(files)


if __name__ == "__main__":
    sys.exit(main())
