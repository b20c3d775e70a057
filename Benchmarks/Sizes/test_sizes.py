# SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
# SPDX-License-Identifier: BSD-3-Clause
"""Tests of the chart and the versions of `./penumbra benchmark sizes`."""
import unittest
import xml.etree.ElementTree as ElementTree

import chart
import sizes

ROWS = [
    ["Penumbra", "10000", "9760", "7.3", "192", "", ""],
    ["Penumbra", "100000", "100792", "8.4", "212", "0.0048", ""],
    ["POV-Ray", "10000", "9760", "4.4", "31", "", ""],
    ["POV-Ray", "100000", "100792", "", "", "", "over 120 s"],
]


class SpreadTest(unittest.TestCase):
    def test_keeps_distant_labels(self):
        self.assertEqual(chart.spread([50, 10, 90], 17, 0, 100), [50, 10, 90])

    def test_separates_labels_in_order_within_the_range(self):
        placed = chart.spread([99, 98, 97, 3], 10, 0, 100)
        self.assertEqual(placed, [100, 90, 80, 3])


class GroupTest(unittest.TestCase):
    def test_omits_sizes_without_a_value(self):
        lines, errors = chart.group(ROWS, 3)
        self.assertEqual(lines, {"Penumbra": [(9760, 7.3), (100792, 8.4)], "POV-Ray": [(9760, 4.4)]})
        self.assertEqual(errors, {"Penumbra": "0.0048"})


class PanelTest(unittest.TestCase):
    def test_labels_each_program_once_with_its_error(self):
        panel = "".join(chart.plot_panel(ROWS, 3, "CPU seconds", (70, 370), True))
        texts = [text.text for text in ElementTree.fromstring(f"<svg>{panel}</svg>").iter("text")]
        self.assertEqual(texts.count("Penumbra, error 0.0048"), 1)
        self.assertEqual(texts.count("POV-Ray"), 1)


class VersionTest(unittest.TestCase):
    def test_ignores_other_lines(self):
        text = "povray: cannot open the file .povray/3.7/povray.conf\nPOV-Ray 3.7.0.10.unofficial\n\nCopyright\n"
        self.assertEqual(sizes.find_version(text), "POV-Ray 3.7.0.10.unofficial")
        self.assertEqual(sizes.find_version("no version\n"), "")


if __name__ == "__main__":
    unittest.main()
