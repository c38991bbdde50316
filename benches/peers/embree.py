#!/usr/bin/env python3
"""Traces ray sets with Embree's interface for single rays (rtcIntersect1, rtcOccluded1), through embreex.

The loop over the rays is compiled code that holds Python's lock, so each thread is a process of its own.
"""

import argparse
import multiprocessing

import numpy as np
from embreex.mesh_construction import TriangleMesh
from embreex.rtcore_scene import EmbreeScene

import raysets

# A worker takes this many rays at a time.
BLOCK = 16384
processes = multiprocessing.get_context("fork")


def trace_block(scene, rays, any_hit):
    """Number of hits and sum of their distances."""
    origins, directions, t_max = rays
    if any_hit:
        return np.count_nonzero(scene.run(origins, directions, t_max.copy(), query="OCCLUDED") == 0), 0.0
    t = scene.run(origins, directions, t_max.copy(), query="DISTANCE")
    is_hit = t < t_max
    return np.count_nonzero(is_hit), t[is_hit].sum(dtype=np.float64)


def work(scene, sets, jobs, results, taken):
    """Takes blocks of a set until none is left, for each job."""
    columns = {s.name: [np.ascontiguousarray(s.rays[:, a:b]) for a, b in [(0, 3), (3, 6)]] for s in sets}
    limits = {s.name: np.minimum(s.rays[:, 6], np.float32(1e30)) for s in sets}
    any_hit = {s.name: s.any_hit for s in sets}
    while (name := jobs.get()) is not None:
        hits, total = 0, 0.0
        while True:
            with taken.get_lock():
                first = taken.value
                taken.value += BLOCK
            if first >= len(limits[name]):
                break
            block = slice(first, first + BLOCK)
            rays = columns[name][0][block], columns[name][1][block], limits[name][block]
            more = trace_block(scene, rays, any_hit[name])
            hits, total = hits + more[0], total + more[1]
        results.put((hits, total))


def main():
    parsed = raysets.arguments(argparse.ArgumentParser(description=__doc__)).parse_args()
    records = []
    for triangles, sets in raysets.scenes(parsed.folder):
        scene = EmbreeScene()
        TriangleMesh(scene, triangles)
        # The tree is built with the first ray, and all processes share it.
        scene.run(np.zeros((1, 3), np.float32), np.ones((1, 3), np.float32))
        for threads in map(int, parsed.threads.split(",")):
            jobs = [processes.SimpleQueue() for _ in range(threads)]
            results, taken = processes.SimpleQueue(), processes.Value("q")
            workers = [processes.Process(target=work, args=(scene, sets, job, results, taken)) for job in jobs]
            for worker in workers:
                worker.start()

            def everywhere(name):
                taken.value = 0
                for job in jobs:
                    job.put(name)
                return [results.get() for _ in jobs] if name else []

            def trace(ray_set):
                seconds, parts = raysets.timed(everywhere, ray_set.name)
                return seconds, sum(hits for hits, _ in parts), sum(total for _, total in parts)

            records += raysets.measure("Embree, single rays", sets, threads, parsed.rounds, trace)
            everywhere(None)
            for worker in workers:
                worker.join()
    raysets.report(records, parsed.json)


if __name__ == "__main__":
    main()
