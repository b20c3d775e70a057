# SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
# SPDX-License-Identifier: BSD-3-Clause
"""Names of how occluders count less with their distance."""

FALLOFFS = ("none", "linear", "quadratic", "square-root")  # as vtkPenumbraIrradianceProvider has them


def falloff_of(name):
    """The number that the classes take."""
    if name not in FALLOFFS:
        raise ValueError(f"falloff is one of {', '.join(FALLOFFS)}, not {name!r}")
    return FALLOFFS.index(name)
