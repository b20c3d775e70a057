# SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
# SPDX-License-Identifier: BSD-3-Clause
"""Comparison of two images."""
from __future__ import annotations

import dataclasses
from typing import Any

import numpy as np
import numpy.typing as npt

from ._classes import vtkPenumbraImageComparison
from .conversion import check_range, colors_of, image_data, to_bytes

TILE = 16
METRICS = ("rmse", "maximum", "ssim", "pixels", "tile_rmse", "tile_pixels", "excess")


@dataclasses.dataclass(frozen=True)
class Tile:
    """A square of an image: its left column, its top row, its size in pixels, and its RMSE."""

    x: int
    y: int
    size: int
    rmse: float

    def __str__(self) -> str:
        return f"columns {self.x} to {self.x + self.size - 1}, rows {self.y} to {self.y + self.size - 1}: " \
               f"RMSE {self.rmse:.4f}"


@dataclasses.dataclass(frozen=True)
class Comparison:
    """Difference of two images; every metric is 0 for equal images.

    Attributes
    ----------
    rmse : float
        Root mean square of the difference of colors in [0, 1].
    maximum : float
        Largest difference of a channel of a pixel.
    ssim : float
        1 minus the structural similarity.
    pixels : float
        Fraction of pixels that differ by more than 4/255.
    tile_rmse, tile_pixels : float
        `rmse` and `pixels` of the worst 16 by 16 pixels at any position.
    excess : float
        The largest of `tile_rmse`, `pixels` and `tile_pixels`, each divided by its limit.
    near : bool
        True if `excess` is at most 1.
    worst : tuple of Tile
        The tiles of a grid of 16 by 16 pixels that differ most, the worst first; empty for equal images.
    difference : numpy.ndarray, shape (height, width, 3), uint8
        Absolute differences times 4.
    """

    rmse: float
    maximum: float
    ssim: float
    pixels: float
    tile_rmse: float
    tile_pixels: float
    excess: float
    near: bool
    worst: tuple[Tile, ...]
    difference: npt.NDArray[np.uint8] = dataclasses.field(repr=False, compare=False)

    def __str__(self) -> str:
        return ", ".join(f"{name.replace('_', ' ')} {getattr(self, name):.4g}" for name in METRICS)


def _worst_tiles(difference: npt.NDArray[Any], count: int) -> tuple[Tile, ...]:
    height, width = difference.shape[:2]
    squares = (difference.astype(float) ** 2).mean(axis=2)
    rows, columns = np.arange(0, height, TILE), np.arange(0, width, TILE)
    sums = np.add.reduceat(np.add.reduceat(squares, rows, axis=0), columns, axis=1)
    pixels = np.outer(np.minimum(TILE, height - rows), np.minimum(TILE, width - columns))
    errors = np.sqrt(sums / pixels).ravel()
    worst = np.argsort(-errors, kind="stable")[:count]
    return tuple(Tile(int(columns[i % len(columns)]), int(rows[i // len(columns)]), TILE, float(errors[i]))
                 for i in worst if errors[i] > 0.0)


def _are_equal(a: Any, b: Any) -> bool:
    """Return True if two arrays are images of finite, equal values of one type."""
    return (isinstance(a, np.ndarray) and isinstance(b, np.ndarray) and a.dtype == b.dtype and np.array_equal(a, b)
            and (a.dtype.kind == "u" or bool(np.isfinite(a).all())))


def compare(
    a: Any, b: Any, *, tolerance: float = 1.0 / 16.0, pixel_limit: float = 0.01, tile_pixel_limit: float = 1.0 / 32.0,
    mask: npt.ArrayLike | None = None,
) -> Comparison:
    """Compare two images.

    Parameters
    ----------
    a, b : array_like, shape (height, width) or (height, width, 1 to 4)
        Images of one size, rows from top to bottom: uint8, uint16, or floats, for which 1 is white. Colors are
        compared after multiplication by alpha. A vtkImageData is accepted, too.
    tolerance : float
        Largest RMSE of any 16 by 16 pixels of images that are near; 0 requires equal images. Range: [0, 1].
    pixel_limit, tile_pixel_limit : float
        Largest fraction of pixels, of the image and of any 16 by 16 pixels, that may differ by more than 4/255.
        Range: [0, 1].
    mask : array_like, shape (height, width), uint8, optional
        Pixels that are 0 are ignored.

    Returns
    -------
    Comparison
        All metrics, the decision `near`, the worst tiles, and an image of the difference.

    Raises
    ------
    TypeError
        If an image has another type than these.
    ValueError
        If the images differ in size, have another shape, or are not finite.

    Examples
    --------
    >>> import numpy, penumbra
    >>> black = numpy.zeros((32, 32, 3), numpy.uint8)
    >>> dot = black.copy()
    >>> dot[20, 5] = 255
    >>> result = penumbra.compare(dot, black)
    >>> result.near, result.pixels, str(result.worst[0])
    (True, 0.0009765625, 'columns 0 to 15, rows 16 to 31: RMSE 0.0625')
    """
    comparison = vtkPenumbraImageComparison()
    comparison.SetTolerance(check_range("tolerance", tolerance, 0.0, 1.0))
    comparison.SetPixelLimit(check_range("pixel_limit", pixel_limit, 0.0, 1.0))
    comparison.SetTilePixelLimit(check_range("tile_pixel_limit", tile_pixel_limit, 0.0, 1.0))
    first, second = image_data("a", a), image_data("b", b)
    if first.GetDimensions() != second.GetDimensions():
        sizes = [f"{image.GetDimensions()[0]} by {image.GetDimensions()[1]}" for image in (first, second)]
        raise ValueError(f"a has {sizes[0]} pixels and b {sizes[1]}: compare images of one size")
    if mask is None and _are_equal(a, b):
        return Comparison(**dict.fromkeys(METRICS, 0.0), near=True, worst=(),
                          difference=np.zeros((*first.GetDimensions()[1::-1], 3), np.uint8))
    comparison.SetImage(first)
    comparison.AddBaseline(second)
    if mask is not None:
        comparison.SetMask(image_data("mask", mask))
    if not comparison.Compare():
        raise ValueError(f"a and b cannot be compared: {comparison.GetErrorText()}")
    values = {name: comparison.GetValue(index) for index, name in enumerate(METRICS)}
    difference = colors_of(comparison.MakeDifference(1.0), 3)
    return Comparison(**values, near=comparison.IsNear(), worst=_worst_tiles(difference, 3),
                      difference=to_bytes(4.0 * difference))
