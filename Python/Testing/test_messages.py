# SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
# SPDX-License-Identifier: BSD-3-Clause
"""Tests of the messages of VTK in calls of several threads."""
import concurrent.futures
import threading
import warnings

import pytest
import pyvista

import penumbra
from penumbra import messages
from penumbra._backend import vtk_module

TRIANGLE = ([(0, 0, 0), (1, 0, 0), (0, 1, 0)], [(0, 1, 2)])
UNUSABLE = [(0, 0, 0), (0, 0, 0), (0, 0, 1)]  # a camera at its focal point


def state():
    core = vtk_module("vtkCommonCore")
    return core.vtkOutputWindow.GetInstance(), core.vtkLogger.GetCurrentVerbosityCutoff()


def outcome(camera):
    try:
        return penumbra.render(TRIANGLE, window_size=(24, 16), camera=camera).shape
    except RuntimeError as error:
        return str(error).split(":")[0]


def test_calls_of_threads_have_their_own_errors():
    before = state()
    cameras = [None, UNUSABLE] * 64
    with concurrent.futures.ThreadPoolExecutor(16) as pool:
        found = list(pool.map(outcome, cameras))
    assert found == [(16, 24, 3), "The camera is not usable"] * 64
    assert state() == before


def test_blocks_that_end_in_any_order_leave_the_output_as_it_was():
    before = state()
    core = vtk_module("vtkCommonCore")
    started, ended = threading.Event(), threading.Event()

    def first():
        with penumbra.messages_as_warnings():
            started.set()
            assert ended.wait(20)

    thread = threading.Thread(target=first)
    thread.start()
    assert started.wait(20)
    second = messages._WINDOWS.add()
    ended.set()
    thread.join()  # the block that began first ends first
    assert core.vtkOutputWindow.GetInstance() is second
    core.vtkOutputWindow.GetInstance().DisplayWarningText("a message of VTK\n")
    assert "a message of VTK" in messages._WINDOWS.remove(second)
    assert state() == before


def test_threads_may_call_functions_in_a_block():
    with penumbra.messages_as_warnings(), concurrent.futures.ThreadPoolExecutor(2) as pool:
        assert list(pool.map(outcome, [None, UNUSABLE])) == [(16, 24, 3), "The camera is not usable"]


def test_callbacks_may_call_functions():
    before = state()
    found = []

    def progress(fraction):
        if not found:
            found.extend([outcome(UNUSABLE), outcome(None)])

    assert penumbra.render(TRIANGLE, window_size=(24, 16), progress=progress).shape == (16, 24, 3)
    assert found == ["The camera is not usable", (16, 24, 3)]
    assert state() == before


def test_errors_leave_the_output_as_it_was():
    before = state()
    with pytest.raises(RuntimeError, match="camera is not usable"):
        penumbra.render(TRIANGLE, window_size=(24, 16), camera=UNUSABLE)
    with pytest.raises(ZeroDivisionError), penumbra.messages_as_warnings():
        1 / 0
    assert state() == before


def test_errors_of_several_lines_have_the_line_that_says_what_happened():
    with pytest.raises(RuntimeError) as raised, penumbra.messages_as_warnings():
        penumbra.vtkPenumbraIrradianceFilter().Update()
    assert str(raised.value) == "Algorithm vtkPenumbraIrradianceFilter returned failure for request REQUEST_DATA_OBJECT"


def test_warnings_of_a_render_are_printed_if_they_are_errors(capfd):
    plotter = pyvista.Plotter(off_screen=True, lighting="none", window_size=(40, 30))
    plotter.add_mesh(pyvista.Cone())
    plotter.add_light(pyvista.Light(light_type="headlight"))
    with warnings.catch_warnings(record=True) as printed:
        warnings.simplefilter("error", penumbra.PenumbraWarning)
        plotter.penumbra.enable_light_shafts(scattering=1)
        assert plotter.screenshot(return_img=True).shape == (30, 40, 3)
    assert any(str(each.message).startswith("No light casts light shafts") for each in printed)
    assert "Traceback" not in capfd.readouterr().err


def test_unknown_kernel_is_one_error():
    plotter = pyvista.Plotter(off_screen=True, window_size=(40, 30))
    with warnings.catch_warnings(record=True) as shown:
        warnings.simplefilter("always", penumbra.PenumbraWarning)
        with pytest.raises(ValueError, match="kernel must be 'automatic', 'traced' or a name .*, not 'zz'"):
            plotter.penumbra.enable_temporal_ssao(kernel="zz")
    assert not [each for each in shown if each.category is penumbra.PenumbraWarning]
    assert plotter.penumbra.describe() == "no effects"
