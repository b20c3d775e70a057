# SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
# SPDX-License-Identifier: BSD-3-Clause
"""Runs Radiance's programs, which pyradiance includes."""
import importlib.metadata
import os
import pathlib
import resource
import subprocess

import pyradiance

HOME = pathlib.Path(pyradiance.__file__).parent
os.environ["RAYPATH"] = str(HOME / "lib")
VERSION = "pyradiance " + importlib.metadata.version("pyradiance")
BYTES_PER_RECORD = 76


def run(program, *arguments, given=None):
    return subprocess.run([HOME / "bin" / program, *arguments], input=given,
                          stdout=subprocess.PIPE, check=True).stdout


def child_seconds():
    usage = resource.getrusage(resource.RUSAGE_CHILDREN)
    return usage.ru_utime + usage.ru_stime
