# SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
# SPDX-License-Identifier: BSD-3-Clause
"""Plugin of pytest: the fixture ``penumbra_regression`` and the page that reports its comparisons.

A module of its own, because pytest imports it in every run: VTK is loaded when a test uses the fixture.
"""
from __future__ import annotations

import json
import os
import pathlib
from typing import TYPE_CHECKING, Any

import pytest

if TYPE_CHECKING:
    from penumbra.regression import Regression

PROPERTY = "penumbra_regression"
WRITTEN = pytest.StashKey[dict[pathlib.Path, str]]()  # the tests that wrote the baselines of this run


def pytest_addoption(parser: pytest.Parser) -> None:
    group = parser.getgroup("penumbra", "image regression tests with Penumbra")
    group.addoption("--penumbra-update", action="store_true",
                    help="Write the images of penumbra_regression as baselines where they are missing or differ.")
    group.addoption("--penumbra-report", metavar="DIR", default=None,
                    help="Write a page with all comparisons to this folder. Default: penumbra-report, if one fails.")
    parser.addini("penumbra_baselines", default="image_cache",
                  help="Folder of the baselines, relative to that of the test. Default: image_cache.")


def pytest_configure(config: pytest.Config) -> None:
    if not hasattr(config, "workerinput"):  # the process that collects the reports
        config.pluginmanager.register(_Report(config), "penumbra-report")


def report_folder(config: pytest.Config) -> pathlib.Path:
    return config.rootpath / (config.getoption("--penumbra-report") or "penumbra-report")


class _Report:
    """Collects the comparisons of all processes and writes the page."""

    def __init__(self, config: pytest.Config) -> None:
        self.config = config
        self.rows: list[dict[str, Any]] = []

    def pytest_runtest_logreport(self, report: pytest.TestReport) -> None:
        if report.when == "call":
            self.rows += [json.loads(str(value)) for name, value in report.user_properties if name == PROPERTY]

    def pytest_terminal_summary(self, terminalreporter: Any) -> None:
        if not self.rows:
            return
        counts = {outcome: sum(row["outcome"] == outcome for row in self.rows)
                  for outcome in ("equal", "near", "updated", "failed")}
        line = ", ".join(f"{count} {outcome}" for outcome, count in counts.items() if count)
        terminalreporter.write_sep("-", "penumbra_regression")
        terminalreporter.write_line(f"{len(self.rows)} image{'s' * (len(self.rows) > 1)}: {line}")
        from penumbra.regression import remove_report, write_report
        if not counts["failed"] and not self.config.getoption("--penumbra-report"):
            remove_report(report_folder(self.config))
        else:
            try:
                terminalreporter.write_line(f"report: {write_report(report_folder(self.config), self.rows)}")
            except OSError as error:
                terminalreporter.write_line(f"The report cannot be written: {error}. Choose another folder with "
                                            "--penumbra-report.")


@pytest.fixture
def penumbra_regression(request: pytest.FixtureRequest) -> Regression:
    """Compare an image with its baseline: ``penumbra_regression(plotter)``."""
    from penumbra.regression import Regression

    config = request.config
    stem = request.path.stem.removeprefix("test_")
    folder = request.path.parent
    # The folder of the images in the report: that of the test below the root, which other files of its name do not have.
    images = pathlib.PurePath(os.path.relpath(folder, config.rootpath).replace(os.pardir, "up")) / stem
    return Regression(
        folder / config.getini("penumbra_baselines") / stem,
        request.node.nodeid.removeprefix(request.node.nodeid.split("::")[0]).removeprefix("::"), request.node.nodeid,
        update=bool(config.getoption("--penumbra-update")), output=report_folder(config), images=images,
        record=lambda row: request.node.user_properties.append((PROPERTY, json.dumps(row))),
        written=config.stash.setdefault(WRITTEN, {}))
