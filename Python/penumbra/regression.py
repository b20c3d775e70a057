# SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
# SPDX-License-Identifier: BSD-3-Clause
"""Images compared with baselines on disk: the fixture ``penumbra_regression`` of pytest."""
from __future__ import annotations

import contextlib
import hashlib
import html
import os
import pathlib
import re
import shutil
import tempfile
from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
import numpy.typing as npt

from ._backend import vtk_module
from .comparison import Comparison, compare
from .conversion import image_data, to_bytes, to_numpy
from .messages import messages_as_warnings
from .rendering import render

OPENGL_TOLERANCE = 1.0 / 16.0
LIMITS = {"pixel_limit": 0.01, "tile_pixel_limit": 1.0 / 32.0}
NAMES = ("image.png", "baseline.png", "difference.png")
LIMITED = {"tile rmse": "tolerance", "pixels": "pixel_limit", "tile pixels": "tile_pixel_limit"}


def read_png(path: pathlib.Path) -> npt.NDArray[Any]:
    """Return the pixels of a PNG file, rows from top to bottom."""
    reader = vtk_module("vtkIOImage").vtkPNGReader()
    if not reader.CanReadFile(str(path)):
        raise ValueError(f"{path} is not a PNG file: restore it, or remove it and make a new one")
    reader.SetFileName(str(path))
    with messages_as_warnings():
        reader.Update()
    image = reader.GetOutput()
    width, height, _ = image.GetDimensions()
    scalars = to_numpy(image.GetPointData().GetScalars())
    return np.ascontiguousarray(scalars.reshape(height, width, -1)[::-1])


def write_png(path: pathlib.Path, image: npt.NDArray[Any]) -> None:
    """Write a PNG file, which appears whole or not at all."""
    path.parent.mkdir(parents=True, exist_ok=True)
    descriptor, name = tempfile.mkstemp(".png", f".{path.stem}-", path.parent)
    os.close(descriptor)
    try:
        writer = vtk_module("vtkIOImage").vtkPNGWriter()
        writer.SetFileName(name)
        writer.SetInputData(image_data("image", image))
        with messages_as_warnings():
            writer.Write()
        if writer.GetErrorCode():
            raise OSError(f"{path}: the disk is full or cannot be written")
        mask = os.umask(0)
        os.umask(mask)
        os.chmod(name, 0o666 & ~mask)
        os.replace(name, path)
    except BaseException:
        with contextlib.suppress(OSError):
            os.unlink(name)
        raise


def _reason(error: OSError) -> str:
    return error.strerror or str(error)


def baseline_name(test: str) -> str:
    """Return a file name for a test, such as ``cone-red`` for ``test_cone[red]``; tests of other names have others."""
    path, bracket, parameters = test.partition("[")
    name = ".".join(word.removeprefix("test_") for word in path.split("::"))
    if bracket:
        plain = re.sub(r"[^\w.=+-]+", "-", parameters.removesuffix("]")).strip("-")[:80]
        name += f"-{plain}"
        if f"{plain}]" != parameters:
            name += f"-{hashlib.sha256(parameters.encode()).hexdigest()[:8]}"
    return name


def _with_limits(found: Comparison, limits: dict[str, float]) -> str:
    """Return the metrics, with the limit of each that has one."""
    parts = []
    for part in str(found).split(", "):
        name = part.rpartition(" ")[0]
        parts.append(f"{part} (limit {limits[LIMITED[name]]:.4g})" if name in LIMITED else part)
    return ", ".join(parts)


class Regression:
    """Compares images with baselines; pytest makes one for each test that asks for ``penumbra_regression``."""

    def __init__(self, folder: pathlib.Path, test: str, node: str, *, update: bool, output: pathlib.Path,
                 images: pathlib.PurePath, record: Callable[[dict[str, Any]], object],
                 written: dict[pathlib.Path, str]) -> None:
        self._folder = folder
        self._test = baseline_name(test)
        self._node = node
        self._update = update
        self._output = output
        self._images = images
        self._record = record
        self._written = written
        self._names: set[str] = set()

    def __repr__(self) -> str:
        return f"<penumbra_regression of {self._node}, baselines in {self._folder}>"

    def __call__(
        self, scene: Any, name: str | None = None, *, tolerance: float | None = None, pixel_limit: float | None = None,
        tile_pixel_limit: float | None = None, mask: npt.ArrayLike | None = None, **options: Any,
    ) -> Comparison | None:
        """Compare an image, or the ray-cast image of a scene, with its baseline.

        Parameters
        ----------
        scene : array_like, mesh, vtkRenderer, vtkRenderWindow or pyvista.Plotter
            An image of shape (height, width, 1 to 4), uint8 or floats from 0 to 1; or anything that `penumbra.render`
            draws.
        name : str, optional
            Name of the baseline. Default: that of the test, with ``_1``, ``_2``, ... for further images of the test.
        tolerance : float, optional
            Largest RMSE of any 16 by 16 pixels. Default: 0, equal images, for ray-cast images; 1/16 for others.
        pixel_limit, tile_pixel_limit : float, optional
            As in `penumbra.compare`.
        mask : array_like, shape (height, width), uint8, optional
            Pixels that are 0 are ignored.
        **options
            Arguments of `penumbra.render`, such as ``window_size=(320, 240)``.

        Returns
        -------
        Comparison or None
            None if the baseline was written.

        Raises
        ------
        AssertionError
            If the image differs, or if there is no baseline.
        """
        __tracebackhide__ = True
        is_image = isinstance(scene, np.ndarray) or (hasattr(scene, "IsA") and scene.IsA("vtkImageData"))
        if is_image and options:
            raise TypeError(f"an image takes no rendering options: {', '.join(options)}")
        image = self._pixels(scene) if is_image else render(scene, **options)
        case = self._next_name(name)
        path = self._folder / f"{case}.png"
        limits = {**LIMITS, "tolerance": (OPENGL_TOLERANCE if is_image else 0.0) if tolerance is None else tolerance}
        if pixel_limit is not None:
            limits["pixel_limit"] = pixel_limit
        if tile_pixel_limit is not None:
            limits["tile_pixel_limit"] = tile_pixel_limit
        return self._check(case, path, image, limits, mask)

    @staticmethod
    def _pixels(image: Any) -> npt.NDArray[Any]:
        if not isinstance(image, np.ndarray):
            width, height, _ = image.GetDimensions()
            image = to_numpy(image.GetPointData().GetScalars()).reshape(height, width, -1)[::-1]
        return to_bytes(image) if image.dtype.kind == "f" else image

    def _next_name(self, name: str | None) -> str:
        if name is not None:
            if name in self._names or not re.fullmatch(r"[\w.=+-]+", name):
                raise ValueError(f"name must be letters, digits and _.=+-, and differ from those before, not {name!r}")
            case = name
        else:
            case = self._test
            number = len(self._names)
            while case in self._names:
                case = f"{self._test}_{number}"
                number += 1
        self._names.add(case)
        return case

    def _check(self, case: str, path: pathlib.Path, image: npt.NDArray[Any], limits: dict[str, float],
               mask: npt.ArrayLike | None) -> Comparison | None:
        __tracebackhide__ = True
        found = output = None
        problem = ""
        shown = os.path.relpath(path)
        if path.exists():
            baseline = read_png(path)
            if baseline.shape[:2] != image.shape[:2]:
                problem = (f"The baseline {shown} has {baseline.shape[1]} by {baseline.shape[0]} pixels, the image "
                           f"{image.shape[1]} by {image.shape[0]}: render it with that size.")
            else:
                found = compare(image, baseline, mask=mask, **limits)
                if found.near:
                    self._report(case, "equal" if found.maximum == 0.0 else "near", found, None)
                    return found
                problem = f"The image differs from {shown}: {_with_limits(found, limits)}.\n" + "".join(
                    f"  worst tile, {tile}\n" for tile in found.worst)
        else:
            baseline = None
            problem = f"There is no baseline {shown}."
        other = self._written.get(path, self._node) if self._update else self._node
        if other != self._node:
            problem += f"\n{other} wrote it in this run: give one of the two images another name."
        elif self._update:
            self._write_baseline(path, image)
            self._report(case, "updated", found, None)
            return None
        try:
            output = self._write_failure(case, image, baseline, found)
            problem += f"\nLook at {os.path.relpath(output)}/."
        except OSError as error:
            problem += f"\nThe image cannot be written to {self._output}: {_reason(error)}. Choose another folder with " \
                       "--penumbra-report."
        self._report(case, "failed", found, output)
        if other == self._node:
            problem = (f"{problem.rstrip()}\nIf the image is right, make it the baseline: "
                       f"pytest --penumbra-update '{self._node}'")
        raise AssertionError(problem)

    def _write_baseline(self, path: pathlib.Path, image: npt.NDArray[Any]) -> None:
        __tracebackhide__ = True
        try:
            write_png(path, image)
        except OSError as error:
            raise AssertionError(
                f"The baseline {os.path.relpath(path)} cannot be written: {_reason(error)}. Make its folder writable, or "
                "choose another with the setting penumbra_baselines.") from None
        self._written[path] = self._node

    def _write_failure(self, case: str, image: npt.NDArray[Any], baseline: npt.NDArray[Any] | None,
                       found: Comparison | None) -> pathlib.Path:
        output = self._output / self._images / case
        shutil.rmtree(output, ignore_errors=True)
        write_png(output / "image.png", image)
        if baseline is not None:
            write_png(output / "baseline.png", baseline)
        if found is not None:
            write_png(output / "difference.png", found.difference)
        return output

    def _report(self, case: str, outcome: str, found: Comparison | None, output: pathlib.Path | None) -> None:
        self._record({
            "test": self._node, "name": case, "outcome": outcome, "measured": str(found) if found else "",
            "worst": [str(tile) for tile in found.worst] if found and outcome == "failed" else [],
            "folder": os.path.relpath(output, self._output) if output else "",
        })


STYLE = """body { font: 15px/1.4 system-ui, sans-serif; margin: 2em; max-width: 90em }
table { border-collapse: collapse } td, th { padding: .3em 1em .3em 0; text-align: left; vertical-align: top }
.failed { color: #b00020; font-weight: 600 } figure { display: inline-block; margin: 0 1em 1em 0 }
img { max-width: 28em; border: 1px solid #ccc } section { border-top: 1px solid #ccc; margin-top: 1.5em }
code { background: #f2f2f2; padding: 0 .3em }"""


def _section(folder: pathlib.Path, row: dict[str, Any]) -> str:
    figures = "".join(
        f'<figure><img src="{html.escape(row["folder"])}/{name}.png" alt="{name}"><figcaption>{caption}</figcaption>'
        "</figure>"
        for name, caption in (("baseline", "baseline"), ("image", "image"), ("difference", "difference, times 4"))
        if row["folder"] and (folder / row["folder"] / f"{name}.png").exists())
    worst = "".join(f"<li>{html.escape(tile)}</li>" for tile in row["worst"])
    update = html.escape(f"pytest --penumbra-update '{row['test']}'")
    return (f'<section id="{html.escape(row["test"])}"><h2>{html.escape(row["test"])}</h2>'
            f"<p>{html.escape(row['measured'] or 'not compared')}</p>{figures}"
            f"{f'<p>Worst tiles:</p><ul>{worst}</ul>' if worst else ''}"
            f"<p>If the image is right: <code>{update}</code></p></section>")


def remove_report(folder: pathlib.Path, rows: Sequence[dict[str, Any]] = ()) -> None:
    """Remove the page of an earlier run, if write_report() wrote it, and its images, except those of ``rows``."""
    path = folder / "index.html"
    with contextlib.suppress(OSError, UnicodeDecodeError):
        page = path.read_text(encoding="utf-8")
        if re.search(r"<title>\d+ of \d+ images differ</title>", page[:300]):
            path.unlink()
            sources = {html.unescape(source) for source in re.findall('<img src="([^"]*)"', page)}
            _remove_images(folder, sources, {row["folder"] for row in rows})


def _remove_images(folder: pathlib.Path, sources: set[str], kept: set[str]) -> None:
    for source in sources:
        parent, _, name = source.rpartition("/")
        if parent in kept or name not in NAMES or os.pardir in parent.split("/") or os.path.isabs(parent):
            continue
        with contextlib.suppress(OSError):  # Folders with other files remain.
            (folder / source).unlink(missing_ok=True)
            while parent:
                (folder / parent).rmdir()
                parent = parent.rpartition("/")[0]


def write_report(folder: pathlib.Path, rows: Sequence[dict[str, Any]]) -> pathlib.Path:
    """Write a page that lists all comparisons and shows the images of those that failed."""
    rows = sorted(rows, key=lambda row: (row["outcome"] != "failed", row["test"], row["name"]))
    failed = [row for row in rows if row["outcome"] == "failed"]
    table = "".join(
        f'<tr><td class="{row["outcome"]}">{row["outcome"]}</td><td>{html.escape(row["test"])}</td>'
        f"<td>{html.escape(row['name'])}</td><td>{html.escape(row['measured'])}</td></tr>" for row in rows)
    title = f"{len(failed)} of {len(rows)} images differ"
    page = (f'<!DOCTYPE html>\n<html lang="en"><head><meta charset="utf-8"><title>{title}</title>'
            f"<style>{STYLE}</style></head><body><h1>{title}</h1>"
            f"{''.join(_section(folder, row) for row in failed)}<section><h2>All images</h2><table>"
            f"<tr><th>result</th><th>test</th><th>baseline</th><th>difference</th></tr>{table}</table></section>"
            "</body></html>\n")
    folder.mkdir(parents=True, exist_ok=True)
    remove_report(folder, failed)
    path = folder / "index.html"
    path.write_text(page, encoding="utf-8")
    return path
