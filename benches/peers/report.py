#!/usr/bin/env python3
"""Puts results of all peers into one report.

    report.py FILE…        JSON lines of the peers; the output of `glimray bench --json`
"""

import json
import os
import sys
from pathlib import Path

import tables


def records(path):
    """The records of a file. Those of glimray's bench get the form of a peer's."""
    text = path.read_text()
    try:
        bench = json.loads(text)
    except json.JSONDecodeError:
        return [json.loads(line) for line in text.splitlines()]
    if "scenes" not in bench:
        return [bench]
    # lavapipe uses as many threads as it is told to, or all.
    threads = int(os.environ.get("LP_NUM_THREADS") or os.cpu_count())
    return [
        {
            "peer": "glimray",
            "scene": scene["name"],
            "set": rays["set"],
            "threads": threads,
            "mrays_per_s": rays["mrays_per_second"]["median"],
            "hits": rays["hits"],
            "sum_t": 0.0,
        }
        for scene in bench["scenes"]
        for rays in scene["rays"]
    ]


def main():
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    found = [record for name in sys.argv[1:] for record in records(Path(name))]
    renders = [record for record in found if "render" in record]
    rates = [record for record in found if "set" in record]
    if renders:
        print("Whole renders, in seconds. A ratio above 1 means that glimray is faster.\n")
        print(tables.renders(renders))
    if rates:
        print("Millions of rays per second.\n")
        print(tables.rates_beside(rates))


if __name__ == "__main__":
    main()
