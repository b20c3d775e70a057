# SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
# SPDX-License-Identifier: BSD-3-Clause
"""Each unsupported environment causes one clear message: another ParaView version, no display, a server."""
import os
import re
import socket
import subprocess
import sys
import tempfile
import unittest

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from plugin import *

PLUGIN = os.environ["PENUMBRA_PLUGIN"]

RENDER = """
from paraview.simple import *
import sys
LoadPlugin(sys.argv[1], remote=False, ns=globals())
baked = BakeAmbientOcclusion(Input=Sphere())
print("baked", baked.GetDataInformation().GetNumberOfPoints(), flush=True)
view = CreateView("PenumbraRenderView")
Show(baked, view)
try:
    SaveScreenshot(sys.argv[2], view)
except RuntimeError:
    print("no image", flush=True)
"""

# Renders the same image in this process and with a server that has no display.
CONNECT = """
from paraview.simple import *
import sys
def render(name, rays=False):
    view = CreateView("PenumbraRenderView")
    view.ViewSize = [120, 90]
    view.OrientationAxesVisibility = 0
    view.StillByRays = rays
    Show(BakeAmbientOcclusion(Input=Sphere(ThetaResolution=30)), view)
    view.CameraPosition = [0, -3, 1]
    SaveScreenshot(name, view)
LoadPlugin(sys.argv[1], remote=False, ns=globals())
render(sys.argv[2])
Connect("localhost", int(sys.argv[4]))
LoadPlugin(sys.argv[1], remote=True, ns=globals())
LoadPlugin(sys.argv[1], remote=False, ns=globals())
render(sys.argv[3])
if len(sys.argv) > 5:
    render(sys.argv[5], rays=True)
"""


def run_script(folder, script, arguments, display=True):
    path = os.path.join(folder, "script.py")
    with open(path, "w") as file:
        file.write(script)
    environment = {name: value for name, value in os.environ.items() if display or name != "DISPLAY"}
    return subprocess.run(["pvpython", "--force-offscreen-rendering", path, *arguments],
                          capture_output=True, text=True, timeout=120, env=environment)


def errors(run):
    """Return the errors reported by ParaView, without color codes and source locations."""
    text = re.sub(r"\x1b\[[0-9;]*m", "", run.stderr)
    return [line.split("ERR|", 1)[1] for line in text.splitlines() if "ERR|" in line]


class OtherParaView(unittest.TestCase):
    def test_reports_the_required_version(self):
        with tempfile.TemporaryDirectory() as folder:
            # Simulate another version: library names contain the version.
            other = os.path.join(folder, "Penumbra.so")
            with open(PLUGIN, "rb") as file:
                content = file.read()
            with open(other, "wb") as file:
                file.write(content.replace(b"-pv5.11.so", b"-pv5.99.so"))
            run = run_script(folder, RENDER, [other, os.path.join(folder, "image.png")])
        self.assertEqual(run.returncode, 1)
        messages = errors(run)
        self.assertEqual(len(messages), 1, messages)
        self.assertIn("-pv5.99.so", messages[0])
        self.assertIn("cannot open shared object file", messages[0])

    def test_is_rejected_by_cmake(self):
        with tempfile.TemporaryDirectory() as folder:
            for name, text in (
                    ("ParaViewConfig.cmake", "set(ParaView_FOUND 1)\n"),
                    ("ParaViewConfigVersion.cmake", 'set(PACKAGE_VERSION "5.99.0")\n')):
                with open(os.path.join(folder, name), "w") as file:
                    file.write(text)
            installed = os.environ["PENUMBRA_PARAVIEW_DIR"]
            run = subprocess.run(
                [os.environ["PENUMBRA_CMAKE"], "-S", ROOT, "-B", os.path.join(folder, "build"),
                 "-G", "Ninja", f"-DCMAKE_MAKE_PROGRAM={os.environ['PENUMBRA_NINJA']}",
                 "-DPENUMBRA_BUILD_PLUGIN=ON", f"-DParaView_DIR={folder}",
                 # Ignore the installed version: /lib is a link to /usr/lib.
                 f"-DCMAKE_IGNORE_PATH={installed};{installed.removeprefix('/usr')}",
                 "-DPython3_EXECUTABLE=/usr/bin/python3"],
                capture_output=True, text=True, timeout=120)
        self.assertEqual(run.returncode, 1)
        self.assertEqual(run.stderr.count("CMake Error"), 1, run.stderr)
        messages = " ".join(run.stderr.split())
        self.assertIn("The plugin needs ParaView 5.11 (found: 5.99.0)", messages)


class NoDisplay(unittest.TestCase):
    def test_filters_work_and_the_view_reports_an_error(self):
        with tempfile.TemporaryDirectory() as folder:
            image = os.path.join(folder, "image.png")
            run = run_script(folder, RENDER, [PLUGIN, image], display=False)
            self.assertFalse(os.path.exists(image))
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertIn("baked", run.stdout)
        messages = [line for line in errors(run) if "The render view needs an X display" in line]
        self.assertEqual(len(messages), 1, run.stderr)
        with open(os.path.join(ROOT, "Documentation/user/ParaView.md")) as page:
            command = re.search(r"`(xvfb-run .* script\.py)`", page.read())[1]
        self.assertIn(command, run.stderr)


class Server(unittest.TestCase):
    def start_server(self):
        """Start a server without a display, for which ParaView disables remote rendering. Return its port."""
        with socket.socket() as probe:
            probe.bind(("localhost", 0))
            port = probe.getsockname()[1]
        environment = {name: value for name, value in os.environ.items() if name != "DISPLAY"}
        server = subprocess.Popen(
            ["pvserver", f"--server-port={port}"], env=environment, text=True,
            stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
        self.addCleanup(server.wait)
        self.addCleanup(server.kill)
        for line in server.stdout:
            if line.startswith("Accepting connection"):
                break
        return port

    def test_without_a_display_renders_the_image_of_one_process(self):
        port = self.start_server()
        with tempfile.TemporaryDirectory() as folder:
            names = [os.path.join(folder, name) for name in ("local.png", "connected.png")]
            run = run_script(folder, CONNECT, [PLUGIN, *names, str(port)])
            self.assertEqual(run.returncode, 0, run.stderr)
            local, connected = (read_image(name).astype(int) for name in names)
        self.assertGreater(numpy.ptp(local), 50)
        self.assertLess((numpy.abs(local - connected).max(axis=2) > 8).mean(), 0.001)

    def test_warns_once_if_the_client_casts_the_rays(self):
        port = self.start_server()
        with tempfile.TemporaryDirectory() as folder:
            names = [os.path.join(folder, name) for name in ("local.png", "connected.png", "rays.png")]
            run = run_script(folder, CONNECT, [PLUGIN, *names[:2], str(port), names[2]])
            self.assertEqual(run.returncode, 0, run.stderr)
            self.assertTrue(os.path.exists(names[2]))
        self.assertEqual(run.stderr.count("The client has received all data"), 1, run.stderr)


run_tests()
