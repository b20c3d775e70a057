# SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
# SPDX-License-Identifier: BSD-3-Clause
"""Statistics as dictionaries, and VTK errors as Python exceptions."""
import contextlib
import signal

from cvista.vtkCommonCore import VTK_STRING


def statistics_dict(algorithm):
    """Return the statistics of a filter or pass as a dictionary of numbers or strings."""
    data = algorithm.GetStatistics()
    arrays = (data.GetAbstractArray(i) for i in range(data.GetNumberOfArrays()))
    return {array.GetName(): array.GetValue(0) for array in arrays}


@contextlib.contextmanager
def _interruptible(algorithm):
    """Abort the filter on Ctrl-C, without a result, and raise KeyboardInterrupt."""
    interrupted = []

    def stop(number, frame):
        interrupted.append(number)
        algorithm.SetAbortExecute(1)

    try:
        before = signal.signal(signal.SIGINT, stop)
    except ValueError:  # only the main thread receives Ctrl-C
        yield
        return
    # Python handles signals only while it executes code, here at each progress event of the filter.
    observer = algorithm.AddObserver("ProgressEvent", lambda caller, event: None)
    try:
        yield
    finally:
        algorithm.RemoveObserver(observer)
        signal.signal(signal.SIGINT, signal.SIG_DFL if before is None else before)
    if interrupted:
        raise KeyboardInterrupt


def update_or_raise(algorithm):
    """Update a filter. Raise RuntimeError if it reports an error."""
    errors = []

    def record_error(caller, event, text):
        errors.append(text)

    record_error.CallDataType = VTK_STRING
    observer = algorithm.AddObserver("ErrorEvent", record_error)
    executive = algorithm.GetExecutive()
    executive_observer = executive.AddObserver("ErrorEvent", record_error)
    try:
        with _interruptible(algorithm):
            algorithm.Update()
    finally:
        algorithm.RemoveObserver(observer)
        executive.RemoveObserver(executive_observer)
    if errors:
        raise RuntimeError(errors[0].strip().splitlines()[-1])
