# SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
# SPDX-License-Identifier: BSD-3-Clause
"""Plots the table of sizes.py: CPU seconds and peak memory against triangles, a line per program.

chart.py SIZES.csv CHART.svg
"""
import csv
import math
import sys

WIDTH, HEIGHT = 1275, 460
TOP, BOTTOM = 56, 404
PANELS = ((70, 370), (725, 1025))  # left and right edges; labels stand to the right
LINE_HEIGHT = 17
# Distinguishable with color vision deficiency, as in the other charts. Penumbra is black and dark red.
COLORS = {"Penumbra": "#000000", "Penumbra, tolerance 0.03": "#a00000", "Penumbra without occlusion": "#787878",
          "F3D": "#e69f00", "PyVista": "#56b4e9", "Mitsuba": "#009e73", "trimesh": "#cc79a7", "Blender": "#0072b2",
          "POV-Ray": "#d55e00"}


def spread(wanted, distance, low, high):
    """Return positions near the wanted ones, in the same order, at least a distance apart and within the range."""
    order = sorted(range(len(wanted)), key=lambda i: wanted[i])
    placed = [0.0] * len(wanted)
    least = low
    for index in order:
        placed[index] = least = max(wanted[index], least)
        least += distance
    most = high
    for index in reversed(order):
        placed[index] = most = min(placed[index], most)
        most -= distance
    return placed


def group(rows, column):
    """Return the points (triangles, value) of each program that has values, and its error as text."""
    lines, errors = {}, {}
    for row in rows:
        if row[column] != "":
            lines.setdefault(row[0], []).append((float(row[2]), float(row[column])))
        if row[5] != "":
            errors[row[0]] = row[5]
    return lines, errors


def format_power(power):
    return {4: "10,000", 5: "100,000", 6: "1 million", 7: "10 million"}.get(power, f"{10.0 ** power:g}")


def plot_panel(rows, column, title, edges, with_errors):
    lines, errors = group(rows, column)
    values = [value for points in lines.values() for _, value in points]
    if not values:
        return
    low, high = math.log10(min(values) / 1.2), math.log10(max(values) * 1.2)
    left, right = edges

    def to_x(triangles):
        return left + (right - left) * (math.log10(triangles) - 3.9) / 3.2

    def to_y(value):
        return BOTTOM - (BOTTOM - TOP) * (math.log10(value) - low) / (high - low)

    yield f'<text x="{left}" y="26" font-size="17" font-weight="bold">{title}</text>'
    for power in range(math.ceil(low), math.floor(high) + 1):
        for factor in (1, 2, 5):
            value = factor * 10.0 ** power
            if math.log10(value) <= high:
                y = to_y(value)
                yield f'<path d="M{left} {y:.1f}H{right}" stroke="#e1e1e1"/>'
                yield f'<text x="{left - 8}" y="{y + 4:.1f}" text-anchor="end">{value:g}</text>'
    for power in range(4, 8):
        x = to_x(10.0 ** power)
        yield f'<path d="M{x:.1f} {TOP}V{BOTTOM}" stroke="#e1e1e1"/>'
        yield f'<text x="{x:.1f}" y="{BOTTOM + 20}" text-anchor="middle">{format_power(power)}</text>'
    yield f'<text x="{(left + right) / 2}" y="{BOTTOM + 42}" text-anchor="middle">triangles</text>'
    ends = [to_y(points[-1][1]) for points in lines.values()]
    for (name, points), y in zip(lines.items(), spread(ends, LINE_HEIGHT, TOP, BOTTOM)):
        color, is_ours = COLORS.get(name, "#5a5a5a"), name.startswith("Penumbra")
        path = "L".join(f"{to_x(triangles):.1f} {to_y(value):.1f}" for triangles, value in points)
        x, end = to_x(points[-1][0]), to_y(points[-1][1])
        yield f'<path d="M{path}" fill="none" stroke="{color}" stroke-width="{2.6 if is_ours else 1.6}"/>'
        for triangles, value in points:
            yield f'<circle cx="{to_x(triangles):.1f}" cy="{to_y(value):.1f}" r="3" fill="{color}"/>'
        yield f'<path d="M{x + 4:.1f} {end:.1f}L{right + 8} {y:.1f}" stroke="{color}" stroke-width="0.6"/>'
        error = f", error {errors[name]}" if with_errors and name in errors else ""
        weight = ' font-weight="bold"' if is_ours else ""
        yield f'<text x="{right + 11}" y="{y + 4:.1f}" fill="{color}"{weight}>{name}{error}</text>'


def write(rows, path):
    parts = [f'<svg xmlns="http://www.w3.org/2000/svg" width="{WIDTH}" height="{HEIGHT}" '
             f'viewBox="0 0 {WIDTH} {HEIGHT}" font-family="sans-serif" font-size="13">',
             f'<rect width="{WIDTH}" height="{HEIGHT}" fill="#ffffff"/>',
             *plot_panel(rows, 3, "CPU seconds of an image, and its error", PANELS[0], True),
             # The tolerance does not change the memory.
             *plot_panel([row for row in rows if "tolerance" not in row[0]], 4, "Peak memory, MB", PANELS[1], False),
             "</svg>\n"]
    with open(path, "w", encoding="utf-8") as file:
        file.write("\n".join(parts))


if __name__ == "__main__":
    with open(sys.argv[1], encoding="utf-8", newline="") as table:
        write(list(csv.reader(table))[1:], sys.argv[2])
