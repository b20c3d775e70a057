# SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
# SPDX-License-Identifier: BSD-3-Clause
"""Scenes that nobody here made: the examples in PyVista's own documentation, drawn with the passes on.

Runs the examples of the docstrings of PyVista's modules as they stand, offline. Whatever they show is drawn
as it is and with ambient occlusion; what breaks is told, and pictures of both go to --output. Exit status 1 where a pass broke something."""
import argparse
import contextlib
import doctest
import importlib
import io
import pathlib
import sys
import urllib.request

import matplotlib.image
import numpy
import pyvista

import penumbra  # noqa: F401

QUICK = ("pyvista.examples.examples",)
WINDOW = [320, 240]


class Cases:
    """What was shown so far."""

    def __init__(self, folder):
        self.folder = folder
        self.name = ""
        self.rows = []
        self.shown = 0

    def show(self, plotter, *_, **__):
        """Instead of Plotter.show: the picture twice."""
        self.shown += 1
        name = f"{self.name}-{self.shown}"
        try:
            self.rows.append((name, *self.draw(plotter, name)))
        except Exception as error:  # noqa: BLE001: whatever breaks is a row
            self.rows.append((name, None, f"{type(error).__name__}: {error}"))
        finally:
            plotter.close()
        _, darker, remark = self.rows[-1]
        # The examples' own words are not shown.
        print(f"{name}: {remark or f'{darker:.1%} of pixels darker'}", file=sys.__stdout__, flush=True)

    def draw(self, plotter, name):
        plain = plotter.screenshot(return_img=True).astype(int)
        for renderer in range(len(plotter.renderers)):
            plotter.renderers.set_active_renderer(*plotter.renderers.index_to_loc(renderer))
            plotter.penumbra.enable_temporal_ssao(tolerance=0.02)
        dark = plotter.screenshot(return_img=True).astype(int)
        both = numpy.concatenate([plain, dark], axis=1).astype(numpy.uint8)
        matplotlib.image.imsave(self.folder / f"{name}.png", both)
        lighter = (dark - plain).max(axis=2)
        darker = (plain - dark).max(axis=2)
        remark = ""
        # Occlusion takes light away; a few pixels at borders are smoothed otherwise.
        if (lighter > 8).mean() > 0.01:
            remark = f"{(lighter > 8).mean():.1%} of pixels lighter"
        return (darker > 4).mean(), remark


def unreachable(*_, **__):
    raise OSError("offline")


def run(module, cases):
    """Every example of a module; how many were left out because they need the network."""
    left_out = 0
    for test in doctest.DocTestFinder().find(importlib.import_module(module)):
        if not test.examples or not any("show(" in e.source or "plot(" in e.source
                                        for e in test.examples):
            continue
        cases.name, cases.shown = test.name.removeprefix("pyvista."), 0
        script = "".join(example.source for example in test.examples)
        try:
            with contextlib.redirect_stdout(io.StringIO()):
                exec(compile(script, test.name, "exec"), dict(test.globs))
        except OSError:
            left_out += 1
        except Exception as error:  # noqa: BLE001
            print(f"{cases.name}: the example itself stops: {type(error).__name__}: {error}")
        pyvista.close_all()
    return left_out


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("modules", nargs="*", default=QUICK)
    parser.add_argument("--output", type=pathlib.Path, default=pathlib.Path("real-cases"))
    options = parser.parse_args()
    options.output.mkdir(parents=True, exist_ok=True)
    cases = Cases(options.output)
    pyvista.OFF_SCREEN = True
    pyvista.global_theme.window_size = WINDOW
    pyvista.Plotter.show = lambda plotter, *a, **k: cases.show(plotter, *a, **k)
    urllib.request.urlopen = unreachable
    left_out = sum(run(module, cases) for module in options.modules)
    broken = [row for row in cases.rows if row[2]]
    print(f"{len(cases.rows)} pictures, {len(broken)} broken, {left_out} examples need the network")
    return 1 if broken or not cases.rows else 0


if __name__ == "__main__":
    sys.exit(main())
