# SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
# SPDX-License-Identifier: BSD-3-Clause
"""Prints the RMSE of the unoccluded fraction of an image, against the pixels of reference.py.

error.py REFERENCE.npz radius|sky IMAGE [PLAIN]: the image has the fraction, or it is divided by the plain image.
"""
import sys

import numpy
import PIL.Image


def read(path):
    """Return the mean of the channels, in [0, 1]."""
    if path.endswith(".npy"):
        return numpy.load(path).ravel()
    return numpy.asarray(PIL.Image.open(path).convert("RGB"), "f8").mean(-1).ravel() / 255.0


def compute_error(values, one, other):
    """Return the RMSE. The noise of two independent estimates of the reference cancels on average."""
    return numpy.sqrt(max(numpy.mean((values - one) * (values - other)), 0.0))


def main():
    reference = numpy.load(sys.argv[1])
    pixels = reference["pixels"]
    values = read(sys.argv[3])[pixels]
    if len(sys.argv) > 4:
        values = values / numpy.maximum(read(sys.argv[4])[pixels], 1.0 / 255.0)
    print(compute_error(values, *reference[sys.argv[2]]))


if __name__ == "__main__":
    main()
