# SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
# SPDX-License-Identifier: BSD-3-Clause
"""The command ``penumbra``: starts the program that was linked with the VTK of this environment."""
import os
import sys

UNAVAILABLE = 3  # exit status of the program if the machine lacks something


def main() -> None:
    try:
        from penumbra import _backend
    except ImportError as error:
        print(f"penumbra: {error}", file=sys.stderr)
        sys.exit(UNAVAILABLE)
    os.execv(_backend.HERE / f"_{_backend.ROOT}" / "penumbra", sys.argv)
