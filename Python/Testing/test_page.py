# SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
# SPDX-License-Identifier: BSD-3-Clause
"""Runs the examples of Documentation/user/Python.md in the order of the page."""
import pathlib
import re
import warnings

import matplotlib.image
import numpy as np
import pytest

import penumbra

pyvista = pytest.importorskip("pyvista")

PAGE = pathlib.Path(__file__).parents[2] / "Documentation" / "user" / "Python.md"


@pytest.fixture
def folder(tmp_path, monkeypatch):
    """Return an empty working directory with the image of the sky that the page reads."""
    matplotlib.image.imsave(tmp_path / "sky.tif", np.full((8, 16, 3), 0.5), format="tiff")
    monkeypatch.chdir(tmp_path)
    return tmp_path


def test_examples_run_without_warnings(folder):
    blocks = re.findall(r"```python\n(.*?)```", PAGE.read_text(), re.DOTALL)
    assert len(blocks) == 4
    names = {}
    with warnings.catch_warnings():
        warnings.simplefilter("error", penumbra.PenumbraWarning)
        for block in blocks:
            exec(compile(block, str(PAGE), "exec"), names)
    assert (folder / "image.png").exists()
    assert names["occlusion"].shape == names["sunlight"].shape == (9,)
    assert names["light"].shape == (9, 3)
    assert names["occlusion"].max() > 0.15
    assert names["result"].rmse == 0.0
    assert names["image"].ndim == 3
    for mesh, array in (("baked", "AmbientOcclusion"), ("lit", "Irradiance"), ("sunny", "DirectLight")):
        assert array in names[mesh].point_data
    assert names["caster"].GetOutput().GetNumberOfPoints() > 0
