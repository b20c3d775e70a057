# SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
# SPDX-License-Identifier: BSD-3-Clause
"""The example of a browser in headless Chromium: first frame, convergence, interaction, no work while idle.

Run with ``pytest -m browser -s``, which prints the times. They are not compared with limits, because they depend on the machine.
"""
import asyncio
import importlib.util
import io
import os
import pathlib
import socket
import subprocess
import sys
import time

import numpy
import PIL.Image
import pytest
from chromium import Page, find_chromium

APP = pathlib.Path(__file__).parents[2] / "Examples" / "browser" / "view_in_browser.py"
MISSING = [name for name in ("trame", "trame_vtk", "trame_vuetify", "aiohttp") if importlib.util.find_spec(name) is None]

pytestmark = [
    pytest.mark.browser,
    pytest.mark.skipif(find_chromium() is None, reason="Chromium is not installed (Debian package chromium)"),
    pytest.mark.skipif(bool(MISSING), reason=f"not installed: {', '.join(MISSING)} (Python/Examples/browser/README.md)"),
]

# The text of the page, "Converged, 3 frames".
STATE = "(document.querySelector('#state')?.innerText ?? '')"
PATIENCE = 60.0  # seconds


class Server:
    """The example as a process; its address is `url`."""

    def __enter__(self):
        with socket.socket() as free:
            free.bind(("127.0.0.1", 0))
            port = free.getsockname()[1]
        self.process = subprocess.Popen([sys.executable, str(APP), "--server", "--port", str(port)],
                                        stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        self.url = f"http://127.0.0.1:{port}/"
        end = time.monotonic() + PATIENCE
        while time.monotonic() < end and self.process.poll() is None:
            with socket.socket() as client:
                if client.connect_ex(("127.0.0.1", port)) == 0:
                    return self
            time.sleep(0.1)
        self.process.kill()
        raise RuntimeError("the example does not start")

    def __exit__(self, *_):
        self.process.terminate()
        self.process.wait()

    def cpu_seconds(self):
        fields = pathlib.Path(f"/proc/{self.process.pid}/stat").read_text().rsplit(")", 1)[1].split()
        return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


async def view(page):
    """Return the pixels of the view in the browser."""
    image = numpy.asarray(PIL.Image.open(io.BytesIO(await page.screenshot())).convert("RGB"), float)
    return image[80:500]


async def settle(page):
    """Wait until the view has converged and no frame has arrived for a second; return the text of the state."""
    before = ""
    for _ in range(int(PATIENCE)):
        await asyncio.sleep(1.0)
        now = await page.evaluate(STATE)
        if now == before and now.startswith("Converged"):
            return now
        before = now
    raise AssertionError(f"the view does not converge: {before}")


async def turn(page, before, begin, end):
    """Drag the view, whose pixels are `before`, wait until it has turned and settled, and return its pixels."""
    await page.drag(begin, end)
    start = time.monotonic()
    while time.monotonic() < start + PATIENCE:
        # On a loaded machine, the view may seem settled before the server has received the mouse.
        state = await settle(page)
        after = await view(page)
        if numpy.abs(after - before).mean() > 1.0:
            print(f"at rest after an interaction: {time.monotonic() - start:.1f} s, {state}")
            return after
    raise AssertionError("the view did not turn")


async def drive(server):
    import aiohttp

    async with aiohttp.ClientSession() as session, Page(session, 1000, 700) as page:
        begin = time.monotonic()
        await page.call("Page.navigate", url=server.url)
        assert await page.wait_for("document.querySelector('canvas')?.width > 300", PATIENCE) is not None
        print(f"first frame: {time.monotonic() - begin:.2f} s")
        assert await page.wait_for(STATE + ".startsWith('Converged')", PATIENCE) is not None
        print(f"converged: {time.monotonic() - begin:.2f} s")
        state = await settle(page)
        first = await view(page)
        assert first.std() > 10.0, "the view is empty"

        used = server.cpu_seconds()
        await asyncio.sleep(3.0)
        print(f"CPU while idle: {(server.cpu_seconds() - used) / 0.03:.1f} %")
        assert await page.evaluate(STATE) == state, "the server renders while idle"
        numpy.testing.assert_array_equal(await view(page), first)

        second = await turn(page, first, (500, 300), (620, 340))
        await turn(page, second, (620, 340), (500, 300))
        return first, second


def test_shows_converges_turns_and_rests(tmp_path):
    with Server() as server:
        images = asyncio.run(drive(server))
    for name, image in zip(("first", "turned"), images):
        PIL.Image.fromarray(image.astype("uint8")).save(tmp_path / f"{name}.png")
