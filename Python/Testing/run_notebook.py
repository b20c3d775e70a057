# SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
# SPDX-License-Identifier: BSD-3-Clause
"""Run the code cells of notebooks in the order of the file, without Jupyter."""
import json
import pathlib
import sys

for path in sys.argv[1:]:
    names: dict = {"__name__": "__main__"}
    for number, cell in enumerate(json.loads(pathlib.Path(path).read_text(encoding="utf-8"))["cells"], 1):
        if cell["cell_type"] == "code":
            exec(compile("".join(cell["source"]), f"{path}, cell {number}", "exec"), names)
