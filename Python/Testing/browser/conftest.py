# SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
# SPDX-License-Identifier: BSD-3-Clause
"""Marker of the tests that drive a browser: ``pytest -m browser``."""


def pytest_configure(config):
    config.addinivalue_line("markers", "browser: drives Chromium, which must be installed")
