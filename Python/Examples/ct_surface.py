# SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
# SPDX-License-Identifier: BSD-3-Clause
"""Surfaces of the organs in a segmented scan of a frog; ambient occlusion shows their depth order."""
import matplotlib.image
import numpy
import penumbra  # noqa: F401
import pyvista as pv

# A subset of the Whole Frog Project, which is part of PyVista.
tissues = pv.examples.load_frog_tissues()
coarse = tissues.extract_subset(tissues.extent, rate=(4, 4, 2))
organs = coarse.contour_labels(smoothing=True, output_mesh_type="triangles")

plotter = pv.Plotter(off_screen=True, window_size=[480, 360])
plotter.add_mesh(organs, scalars="boundary_labels", component=0, cmap="tab20", show_scalar_bar=False)
plotter.camera_position = "yx"
plotter.zoom_camera(1.4)
plain = plotter.penumbra.ray_cast(tolerance=1 / 64)
image, statistics = plotter.penumbra.ray_cast(
    tolerance=1 / 64, ambient_occlusion=True, return_statistics=True)
print(f"{organs.n_cells} triangles, {statistics['Rays/PerPixel']:.1f} rays per pixel")

matplotlib.image.imsave("ct_surface.png", image)

# Ambient occlusion only darkens the image.
difference = plain.astype(int) - image.astype(int)
assert difference.max() > 40 and numpy.count_nonzero(difference < -4) < 0.01 * difference.size
