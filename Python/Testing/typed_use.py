# SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
# SPDX-License-Identifier: BSD-3-Clause
"""Use of the package as a type checker sees it; mypy --strict accepts this file."""
from typing import Any, assert_type

import numpy as np
import numpy.typing as npt

import pyvista as pv

import penumbra
from penumbra.plotter import PlotterAccessor
from penumbra.regression import Regression

points = np.zeros((3, 3))
faces = [(0, 1, 2)]

assert_type(penumbra.__version__, str)
assert_type(penumbra.ambient_occlusion(points, faces), npt.NDArray[np.float32])
values, statistics = penumbra.irradiance(points, faces, progress=lambda fraction: None, return_statistics=True)
assert_type(values, npt.NDArray[np.float32])
assert_type(statistics, dict[str, Any])
assert_type(penumbra.direct_light(points, faces, lights=[(0, 0, 9)], light_radius=1), npt.NDArray[np.float32])
image = penumbra.render((points, faces), window_size=(320, 240), ambient_occlusion=True)
assert_type(image, npt.NDArray[Any])
assert_type(penumbra.ambient_occlusion(points, faces, lines=[(0, 1)], line_radius=0.1, point_radius=0.2),
            npt.NDArray[np.float32])
assert_type(penumbra.render((points, None, [(0, 1)]), point_radius=0.1, line_radius=0.1, light_radius=1.0,
                            light_angle=0.53), npt.NDArray[Any])
comparison = penumbra.compare(image, image, tolerance=0.0)
assert_type(comparison, penumbra.Comparison)
assert_type(comparison.worst[0].x, int)


def write_figure(plotter: pv.Plotter) -> None:
    # Type checkers do not know the attribute of the plotter, but its class.
    assert_type(PlotterAccessor(plotter).save_graphic("figure.svg", outline_width=0.5, scale=2), dict[str, Any] | None)


def test_image(penumbra_regression: Regression) -> None:
    assert_type(penumbra_regression(image), penumbra.Comparison | None)
