# SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
# SPDX-License-Identifier: BSD-3-Clause
"""Messages of VTK as Python warnings and exceptions; progress and Ctrl-C in long calls."""
from __future__ import annotations

import contextlib
import re
import signal
import threading
import warnings
from collections.abc import Callable, Iterator, Sequence
from typing import Any

from ._backend import vtk_module

Progress = Callable[[float], object]

# Remedies of the classes, which name their methods, and those that the functions and accessors have for them.
REMEDIES = {
    "Increase Tolerance and LightTolerance.": "Pass a larger tolerance and light_tolerance.",
    "Increase Tolerance.": "Pass a larger tolerance.",
    "Increase LightTolerance.": "Pass a larger light_tolerance.",
    "Increase TimeLimit.": "Pass a larger time_limit.",
}


class PenumbraWarning(UserWarning):
    """Category of all warnings of this package: a result that is usable but not what was asked for."""


def _sentence(text: str) -> str:
    """Return a message of VTK without its file name, line number and object address."""
    text = re.sub(r"^(Generic )?(Warning|ERROR): In .*?, line \d+\s*", "", text.strip())
    return re.sub(r"^\w+ \(0x[0-9a-fA-F]+\): ", "", text).strip()


def _error_line(text: str) -> str:
    """Return the line of an error that says what happened, without the state of objects that VTK prints after it."""
    line = text.splitlines()[0] if text else "VTK reported an error without a text"
    request = re.search(r"(?m)^ *Request: (\w+)", text)
    if request and (failure := re.match(r"(Algorithm \w+) \(.*\) (returned failure for request)", line)):
        return f"{failure[1]} {failure[2]} {request[1]}"
    return line


def _split(text: str) -> tuple[list[str], list[str]]:
    """Return the warnings and the errors in the output of VTK."""
    messages = re.split(r"(?m)^(?=(?:Generic )?(?:Warning|ERROR): In )", text)
    notes: list[str] = []
    errors: list[str] = []
    for message in filter(str.strip, messages):
        (errors if message.startswith("ERROR") else notes).append(_sentence(message))
    return notes, errors


class _Windows:
    """The output windows that collect messages of VTK, which has one for all threads: the last one is in use."""

    def __init__(self) -> None:
        self.lock = threading.Lock()
        self.collecting: list[Any] = []
        self.before: Any = None
        self.verbosity: int | None = None

    def add(self) -> Any:
        core = vtk_module("vtkCommonCore")
        with self.lock:
            if not self.collecting:
                self.before = core.vtkOutputWindow.GetInstance()
                # VTK's log goes to the standard error stream, too. More than its default means that someone wants it.
                verbosity = core.vtkLogger.GetCurrentVerbosityCutoff()
                self.verbosity = verbosity if verbosity <= core.vtkLogger.VERBOSITY_INFO else None
                if self.verbosity is not None:
                    core.vtkLogger.SetStderrVerbosity(core.vtkLogger.VERBOSITY_OFF)
            self.collecting.append(core.vtkStringOutputWindow())
            core.vtkOutputWindow.SetInstance(self.collecting[-1])
            return self.collecting[-1]

    def remove(self, window: Any) -> str:
        """Return what a window collected."""
        core = vtk_module("vtkCommonCore")
        with self.lock:
            self.collecting.remove(window)
            core.vtkOutputWindow.SetInstance(self.collecting[-1] if self.collecting else self.before)
            if not self.collecting and self.verbosity is not None:
                core.vtkLogger.SetStderrVerbosity(self.verbosity)
        return str(window.GetOutput())


_WINDOWS = _Windows()

# Held by the call of a filter, so that its messages are its own; filters use all processors anyway.
_CALL = threading.RLock()


@contextlib.contextmanager
def _collected() -> Iterator[list[str]]:
    """Collect what VTK prints; the list has the text after the block.

    No observers written in Python: VTK may call them from threads, which wait forever for the interpreter.
    """
    text: list[str] = []
    window = _WINDOWS.add()
    try:
        yield text
    finally:
        text.append(_WINDOWS.remove(window))


def warn(message: str, stacklevel: int = 2) -> None:
    warnings.warn(message, PenumbraWarning, stacklevel=stacklevel + 1)


@contextlib.contextmanager
def messages_as_warnings() -> Iterator[None]:
    """Turn what VTK prints to the standard error stream within the block into Python warnings.

    Errors raise RuntimeError at the end of the block. The functions and accessors of this package do this
    themselves, also if several threads call them; the block serves classes that are used under their VTK names. It has
    the messages of VTK from all threads.

    Warns
    -----
    PenumbraWarning
        For every warning of VTK.

    Raises
    ------
    RuntimeError
        If VTK reported an error.

    Examples
    --------
    >>> import penumbra
    >>> caster = penumbra.vtkPenumbraRayCaster()
    >>> caster.SetRenderer(renderer)
    >>> with penumbra.messages_as_warnings():
    ...     caster.Update()
    """
    with _collected() as text:
        yield
    _report(text[0], stacklevel=4)


def _report(text: str, stacklevel: int, ignored: Sequence[str] = ()) -> None:
    notes, errors = _split(text)
    for note in notes:
        if not note.startswith(tuple(ignored)):
            warn(note, stacklevel)
    if errors:
        message = _error_line(errors[0])
        raise (MemoryError if message.startswith("Out of memory") else RuntimeError)(message)


def observe_warnings(vtk_object: Any) -> None:
    """Turn the messages of an object that works later, such as a render pass, into Python warnings.

    Filters that make warnings errors do not stop it: its warnings are printed.
    """
    def emit(caller: object, event: str, text: str) -> None:
        try:
            warn(_sentence(text), stacklevel=1)
        except PenumbraWarning as warning:  # an error by a filter, but no exception leaves a render: VTK prints a traceback
            line = warning.__traceback__.tb_lineno if warning.__traceback__ else 0
            warnings.showwarning(warning, PenumbraWarning, __file__, line)

    emit.CallDataType = vtk_module("vtkCommonCore").VTK_STRING  # type: ignore[attr-defined]
    if not vtk_object.HasObserver("WarningEvent"):
        vtk_object.AddObserver("WarningEvent", emit)
        vtk_object.AddObserver("ErrorEvent", emit)


class _Interruption:
    """Reports progress of a filter, and stops it on Ctrl-C or if the callback raises an exception."""

    def __init__(self, algorithm: Any, progress: Progress | None) -> None:
        self.algorithm = algorithm
        self.progress = progress
        self.error: BaseException | None = None
        self.before: Any = None
        self.fraction = 0.0

    def stop(self, error: BaseException) -> None:
        self.error = self.error or error
        self.algorithm.SetAbortExecute(1)

    def __enter__(self) -> _Interruption:
        # Python handles signals only while it executes code, here at each progress event of the filter.
        self.observer = self.algorithm.AddObserver("ProgressEvent", self.observe)
        try:
            self.before = signal.signal(signal.SIGINT, lambda *_: self.stop(KeyboardInterrupt()))
            self.handles = True
        except ValueError:  # only the main thread receives Ctrl-C
            self.handles = False
        return self

    def observe(self, caller: Any, event: str) -> None:
        if self.progress is None or self.error is not None:
            return
        try:
            self.fraction = max(self.fraction, float(self.algorithm.GetProgress()))
            self.progress(self.fraction)
        except BaseException as error:  # VTK would print it and go on
            self.stop(error)

    def __exit__(self, *_: object) -> None:
        self.algorithm.RemoveObserver(self.observer)
        if self.handles:
            signal.signal(signal.SIGINT, signal.SIG_DFL if self.before is None else self.before)


def _in_python(text: str) -> str:
    """Return messages with the remedies as callers of the functions of this package have them."""
    for words, python in REMEDIES.items():
        text = text.replace(words, python)
    return text


def run(
    work: Callable[[], object], algorithm: Any, progress: Progress | None = None, stacklevel: int = 2,
    ignored: Sequence[str] = (),
) -> None:
    """Call a function that updates a filter; raise errors, and warn warnings that begin with no ignored sentence."""
    with _CALL, _collected() as text, _Interruption(algorithm, progress) as interruption:
        work()
    if interruption.error is not None:
        raise interruption.error
    _report(_in_python(text[0]), stacklevel + 2, ignored)


def update(algorithm: Any, progress: Progress | None = None, stacklevel: int = 2, ignored: Sequence[str] = ()) -> None:
    """Update a filter; raise its errors, and warn its warnings except those that begin with an ignored sentence."""
    run(algorithm.Update, algorithm, progress, stacklevel + 1, ignored)
