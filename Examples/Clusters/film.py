#!/usr/bin/env python3
"""Renders a film with Dask: film.py [--scheduler ADDRESS] [--workers N] FILM.json OPTIONS...

OPTIONS are those of `penumbra animate`; paths must be valid on all workers. The defaults that depend on the data are
written to FILM.json first. A task renders a group of images. If a worker ends, another one repeats its task and keeps
the images that were finished. Without a scheduler, local processes are the workers."""
import argparse
import json
import os
import subprocess
import sys

from dask.distributed import Client, LocalCluster, as_completed

PROGRAM = os.environ.get("PENUMBRA", "penumbra")
GROUP = 8  # Images per task: the number that one process of `penumbra animate` renders.


def animate(options, *more):
    """Returns the messages of a failed command, otherwise an empty text."""
    result = subprocess.run([PROGRAM, "animate", *options, *more], stderr=subprocess.PIPE, text=True)
    return result.stderr if result.returncode else ""


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--scheduler", help="address of a Dask scheduler")
    parser.add_argument("--workers", type=int, default=2, help="number of local workers without a scheduler")
    parser.add_argument("film", metavar="FILM.json")
    parser.add_argument("options", nargs=argparse.REMAINDER, metavar="OPTIONS")
    arguments = parser.parse_args()

    failure = animate(arguments.options, "--prepare", arguments.film)
    if failure:
        sys.exit(failure)
    with open(arguments.film) as file:
        images = json.load(file)["images"]

    cluster = arguments.scheduler or LocalCluster(
        n_workers=arguments.workers, threads_per_worker=1, processes=True, dashboard_address=None)
    with Client(cluster) as client:
        tasks = []
        for first in range(0, images, GROUP):
            part = f"{first}:{min(first + GROUP, images) - 1}"
            tasks.append(client.submit(animate, arguments.options, "--defaults", arguments.film, "--resume",
                                       "--frames", part, pure=False, retries=3))
        failures = [task.result() for task in as_completed(tasks)]
    sys.exit("".join(failures) or None)


if __name__ == "__main__":
    main()
