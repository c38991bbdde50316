#!/usr/bin/env python3
"""Measures how fast glimray loads a wavy sheet of about a million triangles in each format.

benches/loading.py [PROGRAM] [--triangles N] [--runs N] [--formats glb,ply,stl,obj,plain.obj]

Writes the files to a temporary folder, renders each a few times at 64x48 and prints the run with the least sum of load, BVH
and upload. The CPU seconds are those of the whole run, the driver included. The peak of host memory is above that of a
sheet of two triangles, which is the driver and the program.
"""

import argparse
import json
import math
import os
import struct
import subprocess
import tempfile
from array import array
from pathlib import Path

GOALS = {"glb": 2.0, "ply": 2.0, "obj": 0.7}


def sheet(side):
    """Positions, normals and triangles of side x side quads."""
    positions, normals, triangles = array("f"), array("f"), array("I")
    for y in range(side + 1):
        for x in range(side + 1):
            u, v = 8 * x / side, 8 * y / side
            positions.extend((u - 4, 0.2 * math.sin(3 * u) * math.cos(2 * v), v - 4))
            du = 0.6 * math.cos(3 * u) * math.cos(2 * v)
            dv = -0.4 * math.sin(3 * u) * math.sin(2 * v)
            length = math.sqrt(1 + du * du + dv * dv)
            normals.extend((-du / length, 1 / length, -dv / length))
    for y in range(side):
        for x in range(side):
            a = y * (side + 1) + x
            b = a + side + 1
            triangles.extend((a, b, a + 1, a + 1, b, b + 1))
    return positions, normals, triangles


def glb(path, positions, normals, triangles):
    parts = [positions.tobytes(), normals.tobytes(), triangles.tobytes()]
    starts = [0, len(parts[0]), len(parts[0]) + len(parts[1])]
    views = [
        {"buffer": 0, "byteOffset": start, "byteLength": len(part)}
        for start, part in zip(starts, parts)
    ]
    count = len(positions) // 3
    vertices = {"componentType": 5126, "type": "VEC3", "count": count}
    document = {
        "asset": {"version": "2.0"},
        "scenes": [{"nodes": [0]}],
        "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "NORMAL": 1}, "indices": 2}]}],
        "accessors": [
            {"bufferView": 0, **vertices},
            {"bufferView": 1, **vertices},
            {"bufferView": 2, "componentType": 5125, "type": "SCALAR", "count": len(triangles)},
        ],
        "bufferViews": views,
        "buffers": [{"byteLength": sum(map(len, parts))}],
    }
    text = json.dumps(document).encode()
    text += b" " * (-len(text) % 4)
    binary = b"".join(parts)
    with open(path, "wb") as file:
        file.write(struct.pack("<4sII", b"glTF", 2, 28 + len(text) + len(binary)))
        file.write(struct.pack("<II", len(text), 0x4E4F534A) + text)
        file.write(struct.pack("<II", len(binary), 0x004E4942) + binary)


def ply(path, positions, normals, triangles):
    count, faces = len(positions) // 3, len(triangles) // 3
    names = "".join(f"property float {name}\n" for name in ("x", "y", "z", "nx", "ny", "nz"))
    header = (
        f"ply\nformat binary_little_endian 1.0\nelement vertex {count}\n{names}"
        f"element face {faces}\nproperty list uchar uint vertex_indices\nend_header\n"
    )
    rows = array("f")
    for i in range(0, 3 * count, 3):
        rows.extend(positions[i : i + 3])
        rows.extend(normals[i : i + 3])
    with open(path, "wb") as file:
        file.write(header.encode() + rows.tobytes())
        for i in range(0, 3 * faces, 3):
            file.write(struct.pack("<B3I", 3, *triangles[i : i + 3]))


def stl(path, positions, _normals, triangles):
    with open(path, "wb") as file:
        file.write(b" " * 80 + struct.pack("<I", len(triangles) // 3))
        for i in range(0, len(triangles), 3):
            corners = [positions[3 * j : 3 * j + 3] for j in triangles[i : i + 3]]
            numbers = [number for corner in corners for number in corner]
            file.write(struct.pack("<12fH", 0, 0, 0, *numbers, 0))


def obj(path, positions, normals, triangles):
    with open(path, "w", encoding="ascii") as file:
        for i in range(0, len(positions), 3):
            file.write("v %.6f %.6f %.6f\n" % tuple(positions[i : i + 3]))
        for i in range(0, len(normals), 3):
            file.write("vn %.6f %.6f %.6f\n" % tuple(normals[i : i + 3]))
        face = "f %d//%d %d//%d %d//%d\n" if len(normals) else "f %d %d %d\n"
        for i in range(0, len(triangles), 3):
            corners = [index + 1 for index in triangles[i : i + 3]]
            both = [index for corner in corners for index in (corner, corner)]
            file.write(face % tuple(both if len(normals) else corners))


def plain_obj(path, positions, _normals, triangles):
    obj(path, positions, array("f"), triangles)


WRITERS = {"glb": glb, "ply": ply, "stl": stl, "obj": obj, "plain.obj": plain_obj}


def run(program, path, folder):
    """The seconds of the steps of a run, its CPU seconds and its peak of host memory in bytes."""
    report = Path(folder) / "report.json"
    flags = "--size 64x48 --bare --samples 1 --antialias none --integrator whitted --quiet".split()
    output = ["-o", str(Path(folder) / "out.png"), "--report", str(report)]
    before = os.times()
    command = [program, "render", str(path), *flags, *output]
    subprocess.run(command, check=True, stderr=subprocess.DEVNULL)
    after = os.times()
    found = json.loads(report.read_text())
    cpu = sum(after[2:4]) - sum(before[2:4])
    return found["seconds"], cpu, found["memory"]["host_peak_bytes"]


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("program", nargs="?", default="target/release/glimray")
    parser.add_argument("--triangles", type=int, default=1_000_000)
    parser.add_argument("--runs", type=int, default=5)
    parser.add_argument("--formats", default=",".join(WRITERS))
    wanted = parser.parse_args()
    steps = ("load", "bvh", "upload")
    with tempfile.TemporaryDirectory() as folder:
        model = sheet(round(math.sqrt(wanted.triangles / 2)))
        count = len(model[2]) // 3
        small = Path(folder) / "small.glb"
        glb(small, *sheet(1))
        idle = run(wanted.program, small, folder)[2]
        print(f"{count} triangles; the program and the driver take {idle / 1e6:.0f} MB\n")
        print("| file | MB | load | BVH | upload | million triangles/s | goal | CPU s | bytes a triangle |")
        print("|---|---|---|---|---|---|---|---|---|")
        for name in wanted.formats.split(","):
            path = Path(folder) / f"sheet.{name}"
            WRITERS[name](path, *model)
            runs = [run(wanted.program, path, folder) for _ in range(wanted.runs)]
            seconds, cpu, peak = min(runs, key=lambda it: sum(it[0][step] for step in steps))
            rate = count / sum(seconds[step] for step in steps) / 1e6
            times = " | ".join(f"{seconds[step]:.3f}" for step in steps)
            size = path.stat().st_size / 1e6
            goal = GOALS.get(name, "–")
            per_triangle = (peak - idle) / count
            print(
                f"| {name} | {size:.0f} | {times} | {rate:.2f} | {goal} | {cpu:.2f} | {per_triangle:.0f} |",
                flush=True,
            )
            path.unlink()


if __name__ == "__main__":
    main()
