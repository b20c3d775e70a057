#!/usr/bin/env python3
# Runs every `./penumbra render Data/...` command of the given pages and compares its image with the one
# of the same name in Documentation/Images: run-documented-commands.py PROGRAM PAGE...
import pathlib
import re
import shlex
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]


def documented_commands(page):
    """The arguments of every command on a page; each must make an image that the page shows."""
    text = pathlib.Path(page).read_text()
    images = set(re.findall(r"!\[[^]]*\]\([^)]*Images/([^)]+)\)", text))
    for block in re.findall(r"```sh\n(.*?)```", text, re.DOTALL):
        for line in block.replace("\\\n", " ").splitlines():
            words = shlex.split(line, comments=True)
            if words[:2] == ["./penumbra", "render"] and words[2].startswith("Data/"):
                if words[words.index("--output") + 1] not in images:
                    sys.exit(f"{page}: no image for: {line}")
                yield words[1:]


def main(program, *pages):
    commands = {tuple(c) for page in pages for c in documented_commands(page)}
    if not commands:
        sys.exit("no commands found")
    failures = 0
    with tempfile.TemporaryDirectory() as folder:
        (pathlib.Path(folder) / "Data").symlink_to(ROOT / "Data")
        for command in sorted(commands):
            name = command[command.index("--output") + 1]
            committed = str(ROOT / "Documentation" / "Images" / name)
            print(name, flush=True)
            for words in [command, ("compare", name, committed, "--tolerance", "0.0625")]:
                if subprocess.run([program, *words], cwd=folder).returncode:
                    print(f"failed: {shlex.join(words)}", flush=True)
                    failures += 1
                    break
    sys.exit(1 if failures else 0)


main(*sys.argv[1:])
