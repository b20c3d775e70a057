# SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
# SPDX-License-Identifier: BSD-3-Clause
"""Names of the falloffs of occlusion with distance."""

# In the order of vtkPenumbraIrradianceProvider::Falloffs.
FALLOFFS = ("none", "linear", "quadratic", "square-root")


def falloff_index(name):
    """Return the enumeration value of a falloff."""
    if name not in FALLOFFS:
        raise ValueError(f"falloff must be one of {', '.join(FALLOFFS)}, not {name!r}")
    return FALLOFFS.index(name)
