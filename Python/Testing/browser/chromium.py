# SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
# SPDX-License-Identifier: BSD-3-Clause
"""A page in headless Chromium, driven by its DevTools protocol."""
import asyncio
import base64
import itertools
import os
import shutil
import tempfile


def find_chromium():
    """Return the path of Chromium: that of PENUMBRA_CHROMIUM, else of the program found; None without."""
    return os.environ.get("PENUMBRA_CHROMIUM") or next(
        filter(None, map(shutil.which, ("chromium", "chromium-browser", "google-chrome"))), None)


class Page:
    """``async with Page(session, width, height) as page``; `session` is an aiohttp.ClientSession."""

    def __init__(self, session, width, height):
        self.session = session
        self.size = (width, height)
        self.numbers = itertools.count(1)

    async def __aenter__(self):
        self.folder = tempfile.mkdtemp(prefix="penumbra-chromium-")
        self.process = await asyncio.create_subprocess_exec(
            find_chromium(), "--headless=new", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage",
            "--no-first-run", "--remote-debugging-port=0", f"--user-data-dir={self.folder}",
            f"--window-size={self.size[0]},{self.size[1]}", "about:blank",
            stdout=asyncio.subprocess.DEVNULL, stderr=asyncio.subprocess.DEVNULL)
        path = os.path.join(self.folder, "DevToolsActivePort")
        for _ in range(300):
            if os.path.exists(path) and open(path).read().count("\n"):
                break
            await asyncio.sleep(0.1)
        with open(path) as file:
            port = file.readline().strip()
        async with self.session.get(f"http://127.0.0.1:{port}/json") as response:
            targets = await response.json()
        address = next(target["webSocketDebuggerUrl"] for target in targets if target["type"] == "page")
        self.socket = await self.session.ws_connect(address, max_msg_size=0)
        return self

    async def __aexit__(self, *_):
        await self.socket.close()
        self.process.terminate()
        await self.process.wait()
        shutil.rmtree(self.folder, ignore_errors=True)

    async def call(self, method, **parameters):
        number = next(self.numbers)
        await self.socket.send_json({"id": number, "method": method, "params": parameters})
        while True:
            message = await asyncio.wait_for(self.socket.receive_json(), 60)
            if message.get("id") == number:
                assert "error" not in message, message
                return message["result"]

    async def evaluate(self, expression):
        result = await self.call("Runtime.evaluate", expression=expression, returnByValue=True, awaitPromise=True)
        assert "exceptionDetails" not in result, result
        return result["result"].get("value")

    async def wait_for(self, expression, seconds):
        """Wait until an expression is true, and return the seconds that it took; None if it stays false."""
        begin = asyncio.get_running_loop().time()
        while asyncio.get_running_loop().time() - begin < seconds:
            if await self.evaluate(expression):
                return asyncio.get_running_loop().time() - begin
            await asyncio.sleep(0.02)
        return None

    async def screenshot(self):
        """Return the page as PNG."""
        return base64.b64decode((await self.call("Page.captureScreenshot", format="png"))["data"])

    async def drag(self, begin, end, steps=10):
        """Move the mouse with the left button pressed."""
        await self.call("Input.dispatchMouseEvent", type="mouseMoved", x=begin[0], y=begin[1])
        button = {"button": "left", "buttons": 1, "clickCount": 1}
        await self.call("Input.dispatchMouseEvent", type="mousePressed", x=begin[0], y=begin[1], **button)
        for step in range(1, steps + 1):
            x, y = (a + (b - a) * step / steps for a, b in zip(begin, end))
            await self.call("Input.dispatchMouseEvent", type="mouseMoved", x=x, y=y, button="left", buttons=1)
            await asyncio.sleep(0.03)
        await self.call("Input.dispatchMouseEvent", type="mouseReleased", x=end[0], y=end[1], **button)
