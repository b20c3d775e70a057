# SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
# SPDX-License-Identifier: BSD-3-Clause
"""Compares figures: plotter.save_graphic(), which is VTK's vtkGL2PSExporter, and plotter.penumbra.save_graphic(), which
is vtkPenumbraVectorExporter.

The figures are rasterized by rsvg-convert (SVG) and pdftocairo (PDF) at the size of the window and at ZOOM times this
size, as in print. Errors are the RMSE of all channels, in units of 1/255, against the ray-cast image of the same size.
figures.py DATA [IMAGES]: DATA is the folder of meshes; IMAGES, if given, receives the figures and images.
figures.py --features [IMAGES]: the scenes of figure_scenes.py, by Penumbra only.
"""
import pathlib
import subprocess
import sys
import tempfile
import time
import warnings
import xml.etree.ElementTree as ElementTree

import figure_scenes
import numpy
import PIL.Image
import pyvista

SIZE = (800, 600)
FORMATS = ("svg", "pdf")
ZOOM = 4
TEXT_MARGINS = (8, 50)  # vertical and horizontal, in points: fonts have different widths


def make_bracket(data):
    plotter = pyvista.Plotter(off_screen=True, window_size=SIZE)
    plotter.add_mesh(pyvista.read(data / "bracket.stl"), color="lightsteelblue")
    return plotter


def make_brain(data):
    plotter = pyvista.Plotter(off_screen=True, window_size=SIZE)
    plotter.add_mesh(pyvista.read(data / "brain.vtp"), color="lightpink", smooth_shading=True)
    return plotter


def make_spheres(_data):
    """Return 5 x 5 intersecting spheres of 896 triangles, colored by height."""
    plotter = pyvista.Plotter(off_screen=True, window_size=SIZE)
    for row in range(5):
        for column in range(5):
            sphere = pyvista.Sphere(radius=0.6, center=(column, row, 0.3 * ((3 * row + 7 * column) % 5)),
                                    theta_resolution=32, phi_resolution=16)
            sphere["height"] = sphere.points[:, 2]
            plotter.add_mesh(sphere, scalars="height", clim=(-0.6, 1.8), smooth_shading=True, show_scalar_bar=False)
    return plotter


SCENES = {"bracket": make_bracket, "brain": make_brain, "spheres": make_spheres}
EXPORTERS = {
    "vtkGL2PSExporter": lambda plotter, path: plotter.save_graphic(str(path)),
    "Penumbra": lambda plotter, path: plotter.penumbra.save_graphic(path),
}


def rasterize(path, zoom):
    """Return the pixels of a figure at a multiple of the size of the window, in [0, 1]."""
    image = path.with_name(f"{path.stem}-{path.suffix[1:]}-{zoom}.png")
    width, height = (str(zoom * size) for size in SIZE)
    if path.suffix == ".svg":
        command = ["rsvg-convert", "-w", width, "-h", height, "-b", "white", path, "-o", image]
    else:
        command = ["pdftocairo", "-png", "-singlefile", "-scale-to-x", width, "-scale-to-y", height, path,
                   image.with_suffix("")]
    subprocess.run(command, check=True, capture_output=True)
    return numpy.asarray(PIL.Image.open(image).convert("RGB")) / 255


def compute_error(image, reference):
    return 255 * numpy.sqrt(numpy.mean((image - reference / 255) ** 2))


def count_triangles(plotter):
    return sum(actor.mapper.dataset.triangulate().n_cells for actor in plotter.actors.values()
               if isinstance(actor, pyvista.Actor))


def main():
    data = pathlib.Path(sys.argv[1])
    with tempfile.TemporaryDirectory() as scratch:
        folder = pathlib.Path(sys.argv[2] if len(sys.argv) > 2 else scratch)
        folder.mkdir(parents=True, exist_ok=True)
        for scene, make in SCENES.items():
            plotter = make(data)
            plotter.show(auto_close=False)
            triangles = count_triangles(plotter)
            references = {}
            for zoom in (1, ZOOM):
                references[zoom] = plotter.penumbra.ray_cast(window_size=tuple(zoom * size for size in SIZE))[..., :3]
                PIL.Image.fromarray(references[zoom]).save(folder / f"{scene}-rays-{zoom}.png")
            for extension in FORMATS:
                for name, export in EXPORTERS.items():
                    path = folder / f"{scene}-{name}.{extension}"
                    begin = time.perf_counter()
                    export(plotter, path)
                    seconds = time.perf_counter() - begin
                    errors = " | ".join(f"{compute_error(rasterize(path, zoom), references[zoom]):.2f}" for zoom in references)
                    print(f"| {scene} | {triangles} | {extension.upper()} | {name} "
                          f"| {path.stat().st_size / 1e6:.2f} | {seconds:.1f} | {errors} |", flush=True)
            plotter.close()


def extract_text(path):
    """Return the text that a viewer can select."""
    if path.suffix == ".pdf":
        return subprocess.run(["pdftotext", path, "-"], check=True, capture_output=True, text=True).stdout
    return "\n".join("".join(text.itertext()) for text in ElementTree.parse(path).iter("{http://www.w3.org/2000/svg}text"))


def find_text(path, zoom):
    """Return the pixels that are not near text, whose font is that of the viewer."""
    plain = path.with_name(f"{path.stem}-without-text.svg")
    tree = ElementTree.parse(path)
    for parent in list(tree.iter()):
        for child in list(parent):
            if child.tag.endswith("}text"):
                parent.remove(child)
    tree.write(plain)
    differs = (rasterize(path, zoom) != rasterize(plain, zoom)).any(axis=2)
    for margin in (zoom * margin for margin in TEXT_MARGINS):  # counts in a window along each axis
        sums = numpy.cumsum(numpy.pad(differs, ((margin + 1, margin), (0, 0))), axis=0)
        differs = (sums[2 * margin + 1:] > sums[:-2 * margin - 1]).T
    return ~differs


def measure_features(folder):
    """Print errors of figures of plotters, and whether they are vector graphics and hold their text."""
    folder.mkdir(parents=True, exist_ok=True)
    worst = missing = 0
    for make, texts in figure_scenes.SCENES.items():
        plotter = figure_scenes.make_plotter()
        make(plotter)
        plotter.show(auto_close=False)
        references = {}
        for zoom in (1, ZOOM):
            references[zoom] = plotter.penumbra.ray_cast(scale=zoom)[..., :3]
            PIL.Image.fromarray(references[zoom]).save(folder / f"{make.__name__}-rays-{zoom}.png")
        for extension in FORMATS:
            path = folder / f"{make.__name__}.{extension}"
            with warnings.catch_warnings():
                warnings.simplefilter("ignore")
                reason = plotter.penumbra.save_graphic(path, return_statistics=True)["Vector/ImageReason"]
            if extension == "svg":
                counted = {zoom: find_text(path, zoom) for zoom in references}
            errors = [compute_error(rasterize(path, zoom)[counted[zoom]], references[zoom][counted[zoom]])
                      for zoom in references]
            held = extract_text(path)
            found = sum(text in held for text in texts)
            worst, missing = max(worst, errors[-1]), missing + len(texts) - found
            print(f"| {make.__name__.replace('_', ' ')} | {extension.upper()} | {reason or 'vector graphics'} "
                  f"| {path.stat().st_size / 1e6:.2f} | {errors[0]:.2f} | {errors[1]:.2f} | {found} of {len(texts)} |", flush=True)
        plotter.close()
    print(f"\nWorst error at {ZOOM} x: {worst:.2f}; texts that cannot be selected: {missing}.")


if __name__ == "__main__":
    if sys.argv[1] == "--features":
        with tempfile.TemporaryDirectory() as scratch:
            measure_features(pathlib.Path(sys.argv[2] if len(sys.argv) > 2 else scratch))
        sys.exit()
    try:
        from pyvista import _vtk
        _vtk.vtkGL2PSExporter
    except (AttributeError, ImportError):
        print("skipped: this VTK has no module IOExportGL2PS")
        sys.exit(77)
    main()
