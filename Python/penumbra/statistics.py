# SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
# SPDX-License-Identifier: BSD-3-Clause
"""Counts of the work done, and errors as Python exceptions."""
from cvista.vtkCommonCore import VTK_STRING


def counts_of(algorithm):
    """The statistics of a filter or pass: a dictionary of numbers (or texts) by name."""
    data = algorithm.GetStatistics()
    arrays = (data.GetAbstractArray(i) for i in range(data.GetNumberOfArrays()))
    return {array.GetName(): array.GetValue(0) for array in arrays}


def update(algorithm):
    """Run a filter; what it reports as an error is raised."""
    errors = []

    def remember(caller, event, text):
        errors.append(text)

    remember.CallDataType = VTK_STRING
    observer = algorithm.AddObserver("ErrorEvent", remember)
    executive = algorithm.GetExecutive()
    watching = executive.AddObserver("ErrorEvent", remember)
    try:
        algorithm.Update()
    finally:
        algorithm.RemoveObserver(observer)
        executive.RemoveObserver(watching)
    if errors:
        raise RuntimeError(errors[0].strip().splitlines()[-1])
