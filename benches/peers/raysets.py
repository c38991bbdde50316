"""Ray sets in files (see README.md), and the measurement that all peers in Python share."""

import json
import statistics
import time
from pathlib import Path
from typing import NamedTuple

import numpy as np

import tables


class RaySet(NamedTuple):
    """Rows of `rays`: origin, direction, t_max."""

    scene: str
    name: str
    any_hit: bool
    rays: np.ndarray


def scenes(folder):
    """Yields the triangles of each scene, of the shape (n, 3, 3), and the list of its ray sets."""
    for path in sorted(Path(folder).glob("*/triangles.f32")):
        triangles = np.fromfile(path, "<f4").reshape(-1, 3, 3)
        files = sorted(path.parent.glob("*.closest.f32")) + sorted(path.parent.glob("*.any.f32"))
        sets = []
        for file in files:
            name, query, _ = file.name.split(".")
            sets.append(RaySet(path.parent.name, name, query == "any", np.fromfile(file, "<f4").reshape(-1, 7)))
        yield triangles, sets


def measure(peer, sets, threads, rounds, trace):
    """Traces every set once per round and returns a record for each.

    `trace(ray_set)` returns seconds, number of hits and sum of distances.
    """
    for ray_set in sets:
        trace(ray_set)
    seconds, results = {}, {}
    for number in range(rounds):
        for ray_set in sets if number % 2 == 0 else reversed(sets):
            took, *results[ray_set.name] = trace(ray_set)
            seconds.setdefault(ray_set.name, []).append(took)
    return [
        {
            "peer": peer,
            "scene": ray_set.scene,
            "set": ray_set.name,
            "threads": threads,
            "mrays_per_s": len(ray_set.rays) / statistics.median(seconds[ray_set.name]) / 1e6,
            "hits": int(results[ray_set.name][0]),
            "sum_t": float(results[ray_set.name][1]),
        }
        for ray_set in sets
    ]


def timed(function, *arguments):
    """Seconds that the call took, and its result."""
    start = time.perf_counter()
    result = function(*arguments)
    return time.perf_counter() - start, result


def arguments(parser):
    """Adds the arguments that all peers have."""
    parser.add_argument("folder", type=Path, help="ray sets, written by `glimray bench --export-rays`")
    parser.add_argument("--threads", default="1,2", help="numbers of threads [default: 1,2]")
    parser.add_argument("--rounds", type=int, default=5, help="measurements of each set [default: 5]")
    parser.add_argument("--json", type=Path, metavar="FILE", help="also write the results as JSON lines")
    return parser


def report(records, path):
    """Prints a table of the records and writes them to `path` if there is one."""
    print(tables.rates(records))
    if path:
        path.write_text("".join(json.dumps(r) + "\n" for r in records))
