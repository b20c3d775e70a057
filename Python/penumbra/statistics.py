# SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
# SPDX-License-Identifier: BSD-3-Clause
"""Counts of the work done, and errors as Python exceptions."""
import contextlib
import signal

from cvista.vtkCommonCore import VTK_STRING


def counts_of(algorithm):
    """The statistics of a filter or pass: a dictionary of numbers (or texts) by name."""
    data = algorithm.GetStatistics()
    arrays = (data.GetAbstractArray(i) for i in range(data.GetNumberOfArrays()))
    return {array.GetName(): array.GetValue(0) for array in arrays}


@contextlib.contextmanager
def _interruptible(algorithm):
    """Let Ctrl-C stop the filter, which then leaves no result, and raise KeyboardInterrupt here."""
    interrupted = []

    def stop(number, frame):
        interrupted.append(number)
        algorithm.SetAbortExecute(1)

    try:
        before = signal.signal(signal.SIGINT, stop)
    except ValueError:  # another thread than the main one: Ctrl-C does not arrive here
        yield
        return
    # Python looks for signals while it runs: at each progress of the filter.
    observer = algorithm.AddObserver("ProgressEvent", lambda caller, event: None)
    try:
        yield
    finally:
        algorithm.RemoveObserver(observer)
        signal.signal(signal.SIGINT, signal.SIG_DFL if before is None else before)
    if interrupted:
        raise KeyboardInterrupt


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
        with _interruptible(algorithm):
            algorithm.Update()
    finally:
        algorithm.RemoveObserver(observer)
        executive.RemoveObserver(watching)
    if errors:
        raise RuntimeError(errors[0].strip().splitlines()[-1])
