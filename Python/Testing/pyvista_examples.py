# SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
# SPDX-License-Identifier: BSD-3-Clause
"""Render the examples of PyVista's documentation with and without ambient occlusion, or by rays.

Runs the docstring examples of PyVista modules unchanged and offline. Each plot is rendered without and with
ambient occlusion, and both images are saved to --output. Exit status 1 if a render fails or becomes lighter.
With --rays, the second image is ray cast: exit status 1 if that fails. "look" marks images that differ without a warning;
most of them have edges with their full width at silhouettes, or smoothed lines of charts.
"""
import argparse
import contextlib
import doctest
import importlib
import io
import pathlib
import sys
import urllib.request
import warnings

import matplotlib.image
import numpy
import pyvista

import penumbra

QUICK = ("pyvista.examples.examples",)
WINDOW = [320, 240]


BLOCK = 8  # pixels: means over blocks are equal where images differ only by antialiasing


def block_means(image):
    rows, columns = (length // BLOCK * BLOCK for length in image.shape[:2])
    return image[:rows, :columns, :3].reshape(rows // BLOCK, BLOCK, columns // BLOCK, BLOCK, 3).mean(axis=(1, 3))


class ExampleRenderer:
    """Renders the plots of the examples and records the results."""

    def __init__(self, folder, rays=False):
        self.folder = folder
        self.rays = rays
        self.name = ""
        self.rows = []
        self.shown = 0

    def show(self, plotter, *_, **__):
        """Replacement of Plotter.show, which renders the plot twice."""
        self.shown += 1
        name = f"{self.name}-{self.shown}"
        try:
            self.rows.append((name, *(self.cast if self.rays else self.render)(plotter, name)))
        except Exception as error:  # noqa: BLE001: each failure becomes a row
            self.rows.append((name, None, f"{type(error).__name__}: {error}"))
        finally:
            plotter.close()
        _, result, problem = self.rows[-1]
        # The output of the examples themselves is redirected.
        print(f"{name}: {problem or result}", file=sys.__stdout__, flush=True)

    def render(self, plotter, name):
        plain = plotter.screenshot(return_img=True).astype(int)
        for index in range(len(plotter.renderers)):
            plotter.renderers.set_active_renderer(*plotter.renderers.index_to_loc(index))
            plotter.penumbra.enable_temporal_ssao(tolerance=0.02)
        dark = plotter.screenshot(return_img=True).astype(int)
        both = numpy.concatenate([plain, dark], axis=1).astype(numpy.uint8)
        matplotlib.image.imsave(self.folder / f"{name}.png", both)
        lighter = (dark - plain).max(axis=2)
        darker = (plain - dark).max(axis=2)
        problem = ""
        # Ambient occlusion only darkens; a few edge pixels differ by antialiasing.
        if (lighter > 8).mean() > 0.01:
            problem = f"{(lighter > 8).mean():.1%} of pixels lighter"
        return f"{(darker > 4).mean():.1%} of pixels darker", problem

    def cast(self, plotter, name):
        rasterized = plotter.screenshot(return_img=True)
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            cast = plotter.penumbra.screenshot(return_img=True)
        matplotlib.image.imsave(self.folder / f"{name}.png", numpy.concatenate([rasterized, cast], axis=1))
        off = (numpy.abs(block_means(rasterized) - block_means(cast)).max(axis=2) > 16.0).mean()
        messages = [str(item.message) for item in caught if issubclass(item.category, penumbra.PenumbraWarning)]
        result = f"{off:.1%} of blocks differ" + "".join(f"; {message}" for message in messages)
        return result + ("; look" if off > 0.02 and not messages else ""), ""


def raise_offline(*_, **__):
    raise OSError("offline")


def run(module, renderer):
    """Run the examples of a module. Return the number skipped because they need the network."""
    skipped = 0
    for test in doctest.DocTestFinder().find(importlib.import_module(module)):
        if not test.examples or not any("show(" in e.source or "plot(" in e.source
                                        for e in test.examples):
            continue
        renderer.name, renderer.shown = test.name.removeprefix("pyvista."), 0
        script = "".join(example.source for example in test.examples)
        try:
            with contextlib.redirect_stdout(io.StringIO()):
                exec(compile(script, test.name, "exec"), dict(test.globs))
        except OSError:
            skipped += 1
        except Exception as error:  # noqa: BLE001
            print(f"{renderer.name}: the example itself fails: {type(error).__name__}: {error}")
        pyvista.close_all()
    return skipped


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("modules", nargs="*", default=QUICK)
    parser.add_argument("--output", type=pathlib.Path, default=pathlib.Path("pyvista-examples"))
    parser.add_argument("--rays", action="store_true", help="compare with ray casting instead of ambient occlusion")
    options = parser.parse_args()
    options.output.mkdir(parents=True, exist_ok=True)
    renderer = ExampleRenderer(options.output, options.rays)
    pyvista.OFF_SCREEN = True
    pyvista.global_theme.window_size = WINDOW
    pyvista.Plotter.show = lambda plotter, *a, **k: renderer.show(plotter, *a, **k)
    urllib.request.urlopen = raise_offline
    skipped = sum(run(module, renderer) for module in options.modules)
    failed = [row for row in renderer.rows if row[2]]
    print(f"{len(renderer.rows)} images, {len(failed)} failed, {skipped} examples need the network")
    return 1 if failed or not renderer.rows else 0


if __name__ == "__main__":
    sys.exit(main())
