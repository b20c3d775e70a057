# SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
# SPDX-License-Identifier: BSD-3-Clause
"""Tests of the fixture penumbra_regression in runs of pytest of their own."""
import json
import pathlib

import numpy as np
import pytest

from penumbra.regression import read_png, write_png

pytest_plugins = ["pytester"]

RAYS = """
import pytest
POINTS = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, {height})]
FACES = [(0, 2, 1), (0, 1, 3), (1, 2, 3), (2, 0, 3)]

@pytest.mark.parametrize("size", [(64, 48)])
def test_pyramid(penumbra_regression, size):
    penumbra_regression((POINTS, FACES), window_size=size)
"""
IMAGE = """
import numpy as np

def test_given(penumbra_regression):
    image = np.full((40, 50, 3), 200, np.uint8)
    image[20, 30] = {value}
    penumbra_regression(image)
"""
BASELINE = "image_cache/scene/pyramid-size0.png"


@pytest.fixture
def scene(pytester):
    """Return a function that writes a test and runs it."""
    def run(text, *options):
        pytester.makepyfile(test_scene=text)
        return pytester.runpytest("-p", "no:cacheprovider", *options)
    return run


def test_missing_baseline_fails_and_says_what_to_do(scene, pytester):
    result = scene(RAYS.format(height=1))
    result.assert_outcomes(failed=1)
    result.stdout.fnmatch_lines([f"*There is no baseline {BASELINE}.", "*Look at penumbra-report/scene/pyramid-size0/.",
                                 "*pytest --penumbra-update 'test_scene.py::test_pyramid[[]size0[]]'*"])
    assert read_png(pytester.path / "penumbra-report/scene/pyramid-size0/image.png").shape == (48, 64, 3)
    assert not (pytester.path / "image_cache").exists()


def test_update_writes_the_baseline_which_then_equals(scene, pytester):
    scene(RAYS.format(height=1), "--penumbra-update").assert_outcomes(passed=1)
    before = (pytester.path / BASELINE).read_bytes()
    result = scene(RAYS.format(height=1))
    result.assert_outcomes(passed=1)
    result.stdout.fnmatch_lines(["1 image: 1 equal"])
    scene(RAYS.format(height=1), "--penumbra-update").assert_outcomes(passed=1)
    assert (pytester.path / BASELINE).read_bytes() == before
    assert not (pytester.path / "penumbra-report").exists()


def test_difference_fails_with_its_image_its_tiles_and_a_page(scene, pytester):
    scene(RAYS.format(height=1), "--penumbra-update")
    result = scene(RAYS.format(height=1.3))
    result.assert_outcomes(failed=1)
    result.stdout.fnmatch_lines([f"*The image differs from {BASELINE}: rmse *", "*worst tile, columns * rows *RMSE *"])
    folder = pytester.path / "penumbra-report"
    images = {name: read_png(folder / f"scene/pyramid-size0/{name}.png") for name in ("image", "baseline", "difference")}
    assert (np.abs(images["image"].astype(int) - images["baseline"]).max(axis=2) > 0).any()
    assert images["difference"].max() > 0
    page = (folder / "index.html").read_text()
    assert "1 of 1 images differ" in page
    assert 'src="scene/pyramid-size0/difference.png"' in page
    assert "columns" in page


def test_differences_have_their_limits(scene):
    scene(IMAGE.format(value=200), "--penumbra-update")
    scene(IMAGE.format(value=20).replace("[20, 30]", "[10:30]")).stdout.fnmatch_lines([
        "*differs*, pixels 0.5 (limit 0.01), tile rmse 0.7059 (limit 0.0625), tile pixels 1 (limit 0.03125), excess*"])


@pytest.mark.parametrize("option", ["", "--penumbra-update"])
def test_run_without_failures_removes_the_page_of_the_run_before(scene, pytester, option):
    scene(IMAGE.format(value=200), "--penumbra-update")
    text = IMAGE.format(value=20).replace("[20, 30]", "[10:30]")
    result = scene(text)
    result.stdout.fnmatch_lines(["1 image: 1 failed"])
    page = pytester.path / "penumbra-report/index.html"
    assert "1 of 1 images differ" in page.read_text()
    scene(text if option else IMAGE.format(value=200), option or "-q").assert_outcomes(passed=1)
    assert not page.exists()
    page.write_text("<title>a page of the user</title>")
    scene(text if option else IMAGE.format(value=200)).assert_outcomes(passed=1)
    assert page.exists()


def test_given_images_may_differ_in_single_pixels(scene):
    scene(IMAGE.format(value=200), "--penumbra-update").assert_outcomes(passed=1)
    result = scene(IMAGE.format(value=180))
    result.assert_outcomes(passed=1)
    result.stdout.fnmatch_lines(["1 image: 1 near"])


def test_other_size_fails_with_both_sizes(scene, pytester):
    scene(IMAGE.format(value=200), "--penumbra-update")
    write_png(pytester.path / "image_cache/scene/given.png", np.zeros((40, 51, 3), np.uint8))
    result = scene(IMAGE.format(value=200))
    result.assert_outcomes(failed=1)
    result.stdout.fnmatch_lines(["*has 51 by 40 pixels, the image 50 by 40: render it with that size."])


def test_damaged_baseline_fails(scene, pytester):
    scene(IMAGE.format(value=200), "--penumbra-update")
    (pytester.path / "image_cache/scene/given.png").write_bytes(b"nothing")
    result = scene(IMAGE.format(value=200))
    result.assert_outcomes(failed=1)
    result.stdout.fnmatch_lines(["*is not a PNG file: restore it, or remove it*"])


def test_folder_that_cannot_be_written_fails_and_says_what_to_do(scene, pytester):
    (pytester.path / "image_cache").write_text("not a folder")
    result = scene(RAYS.format(height=1), "--penumbra-update")
    result.assert_outcomes(failed=1)
    result.stdout.fnmatch_lines(["*cannot be written: *Make its folder writable, or choose another*"])
    (pytester.path / "image_cache").unlink()
    (pytester.path / "penumbra-report").write_text("not a folder")
    result = scene(RAYS.format(height=1))
    result.assert_outcomes(failed=1)
    result.stdout.fnmatch_lines(["*The image cannot be written to *penumbra-report: *--penumbra-report*",
                                 "The report cannot be written: *"])


def test_several_images_of_a_test_have_several_baselines(scene, pytester):
    scene("""
import numpy as np
def test_steps(penumbra_regression):
    for i in range(3):
        penumbra_regression(np.full((8, 8, 3), 50 * i, np.uint8))
    penumbra_regression(np.zeros((8, 8, 3)), "named")
""", "--penumbra-update").assert_outcomes(passed=1)
    names = {path.name for path in (pytester.path / "image_cache/scene").iterdir()}
    assert names == {"steps.png", "steps_1.png", "steps_2.png", "named.png"}


def test_names_between_images_of_a_test_are_skipped(scene, pytester):
    scene("""
import numpy as np
def test_cone(penumbra_regression):
    penumbra_regression(np.zeros((8, 8, 3), np.uint8))
    penumbra_regression(np.zeros((8, 8, 3), np.uint8), name="cone_2")
    penumbra_regression(np.zeros((8, 8, 3), np.uint8))
""", "--penumbra-update").assert_outcomes(passed=1)
    names = {path.name for path in (pytester.path / "image_cache/scene").iterdir()}
    assert names == {"cone.png", "cone_2.png", "cone_3.png"}


MANY = """
import numpy as np, pytest
def image(value):
    return np.full((8, 8, 3), value, np.uint8)

class TestA:
    def test_m(self, penumbra_regression):
        penumbra_regression(image(10), tolerance=0)

class TestB:
    def test_m(self, penumbra_regression):
        penumbra_regression(image(20), tolerance=0)

    class TestA:
        def test_m(self, penumbra_regression):
            penumbra_regression(image(30), tolerance=0)

def test_m(penumbra_regression):
    penumbra_regression(image(40), tolerance=0)

@pytest.mark.parametrize("name", ["a/b", "a-b", "a b", "-a-b", "a::b", "a[b]", "x" * 300, "x" * 301])
def test_p(penumbra_regression, name):
    penumbra_regression(image(len(name) % 256), tolerance=0)
    penumbra_regression(image(sum(name.encode()) % 256), tolerance=0)
"""


def test_tests_of_similar_names_have_baselines_of_their_own(scene, pytester):
    scene(MANY, "--penumbra-update").assert_outcomes(passed=12)
    assert len(list((pytester.path / "image_cache/scene").iterdir())) == 4 + 2 * 8
    scene(MANY).assert_outcomes(passed=12)


def test_files_of_one_name_have_reports_of_their_own(pytester):
    for folder, value in (("one", 10), ("two", 20)):
        pytester.mkpydir(folder)
        (pytester.path / folder / "test_scene.py").write_text(IMAGE.format(value=value))
    pytester.runpytest("-p", "no:cacheprovider").assert_outcomes(failed=2)
    for folder, value in (("one", 10), ("two", 20)):
        image = read_png(pytester.path / "penumbra-report" / folder / "scene/given/image.png")
        assert image[20, 30, 0] == value
    page = (pytester.path / "penumbra-report/index.html").read_text()
    assert 'src="one/scene/given/image.png"' in page and 'src="two/scene/given/image.png"' in page


def test_images_of_an_earlier_report_are_removed(pytester):
    report = pytester.path / "penumbra-report"
    for folder in ("one", "two"):
        pytester.mkpydir(folder)

    def run(one, two, *options):
        for folder, value in (("one", one), ("two", two)):
            text = IMAGE.format(value=value).replace("[20, 30]", "[10:30]")
            (pytester.path / folder / "test_a&b.py").write_text(text)
        pytester.runpytest("-p", "no:cacheprovider", *options)
        return sorted(path.relative_to(report).as_posix() for path in report.rglob("*") if path.is_file())

    images = [f"{folder}/a&b/given/{name}.png" for folder in ("one", "two") for name in
              ("baseline", "difference", "image")]
    run(200, 200, "--penumbra-update")
    assert run(10, 20) == ["index.html", *images]
    (report / "one/notes.txt").write_text("kept")
    assert run(200, 20) == ["index.html", "one/notes.txt", *images[3:]]
    assert not (report / "one/a&b").exists()
    assert run(200, 200) == ["one/notes.txt"]
    assert not (report / "two").exists()


def test_update_never_overwrites_a_baseline_of_the_same_run(scene, pytester):
    text = """
import numpy as np
def test_a(penumbra_regression):
    penumbra_regression(np.zeros((8, 8, 3), np.uint8), "cone")
def test_b(penumbra_regression):
    penumbra_regression(np.zeros((8, 8, 3), np.uint8), "cone")
def test_c(penumbra_regression):
    penumbra_regression(np.full((8, 8, 3), 200, np.uint8), "cone")
"""
    result = scene(text, "--penumbra-update")
    result.assert_outcomes(passed=2, failed=1)
    result.stdout.fnmatch_lines(["*test_scene.py::test_a wrote it in this run: give one of the two images another name.*"])
    assert (read_png(pytester.path / "image_cache/scene/cone.png") == 0).all()


def test_folder_of_baselines_is_a_setting(scene, pytester):
    pytester.makeini("[pytest]\npenumbra_baselines = references")
    scene(IMAGE.format(value=200), "--penumbra-update").assert_outcomes(passed=1)
    assert (pytester.path / "references/scene/given.png").exists()


def test_runs_in_several_processes(scene, pytester):
    pytest.importorskip("xdist")
    text = """
import numpy as np, pytest
@pytest.mark.parametrize("gray", range(4))
def test_gray(penumbra_regression, gray):
    penumbra_regression(np.full((8, 8, 3), gray, np.uint8), tolerance=0)
"""
    pytester.makepyfile(test_scene=text)
    pytester.runpytest_subprocess("-n2", "--penumbra-update").assert_outcomes(passed=4)
    result = pytester.runpytest_subprocess("-n2", "--penumbra-report=page")
    result.assert_outcomes(passed=4)
    result.stdout.fnmatch_lines(["4 images: 4 equal", "report: *page/index.html"])
    assert (pytester.path / "page/index.html").read_text().count(">equal<") == 4


def test_pytest_starts_without_vtk(pytester):
    pytester.makepyfile("""
import sys
def test_plugin():
    assert "pytest_penumbra" in sys.modules
    assert "penumbra" not in sys.modules
""")
    pytester.runpytest_subprocess().assert_outcomes(passed=1)


def test_results_are_in_the_report_of_junit(scene, pytester):
    scene(IMAGE.format(value=200), "--penumbra-update", "--junitxml=results.xml")
    text = pathlib.Path(pytester.path, "results.xml").read_text()
    row = text.split('name="penumbra_regression" value="')[1].split('"')[0].replace("&quot;", '"')
    assert json.loads(row)["outcome"] == "updated"
