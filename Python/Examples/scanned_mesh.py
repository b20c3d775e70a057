# SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
# SPDX-License-Identifier: BSD-3-Clause
"""Ambient occlusion baked onto a scanned head, rendered by ray casting."""
import pathlib

import matplotlib.image
import penumbra  # noqa: F401
import pyvista as pv

data = pathlib.Path(__file__).parents[2] / "Data"
head = pv.read(data / "head.ply")
baked = head.penumbra.bake_ambient_occlusion(tolerance=0.02, statistics=True)
records, points = (baked.field_data[name][0] for name in ("Cache/Records", "Points/Total"))
print(f"{points:.0f} points, {records:.0f} records, error {baked.field_data['EstimatedError'][0]:.3f}")

plotter = pv.Plotter(off_screen=True, window_size=[480, 480])
plotter.add_mesh(baked, scalars="AmbientOcclusion", cmap="bone_r", clim=(0, 1), show_scalar_bar=False)
image = plotter.penumbra.ray_cast(tolerance=1 / 128)

matplotlib.image.imsave("scanned_mesh.png", image)

values = baked["AmbientOcclusion"]
assert 0.0 <= values.min() and values.max() <= 1.0 and 0.05 < values.mean() < 0.6
