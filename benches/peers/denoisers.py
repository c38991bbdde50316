#!/usr/bin/env python3
"""Compares glimray's denoiser with Open Image Denoise (PyPI `pyoidn`) on pictures of glimray.

Each scene is path-traced with few samples and with many. Both denoisers get the same radiance, albedo and normals; the
peak signal-to-noise ratio is that of display values (gamma 2.2, clamped to 0..1) against the picture of many samples.
With --crop, pieces of a large picture stand for all of it: their errors are averaged, and their times added up.
Needs PyPI `numpy`, `OpenEXR` and `pyoidn`.
"""

import argparse
import json
import pathlib
import subprocess
import time

import numpy as np
import OpenEXR
import pyoidn

SCENES = ["cornell_box", "still_life", "patterns", "soft_shadows", "solids", "glass_and_mirrors"]


def channels(path):
    with OpenEXR.File(str(path), separate_channels=True) as file:
        return {name: np.array(channel.pixels, np.float32) for name, channel in file.channels().items()}


def layer(found, prefix="", names="RGB"):
    return np.stack([found[prefix + name] for name in names], -1)


def error(a, b):
    shown = [np.clip(picture.astype(np.float64), 0, 1) ** (1 / 2.2) for picture in (a, b)]
    return ((shown[0] - shown[1]) ** 2).mean()


def pieces(size, crop):
    """Flags for a piece of this size in the middle of each of 3 x 3 parts of the picture; without a size, for all of it."""
    if not crop:
        return [[]]
    (width, height), (across, down) = ([int(side) for side in text.split("x")] for text in (size, crop))
    corners = [((2 * i + 1) * width // 6 - across // 2, (2 * j + 1) * height // 6 - down // 2) for j in range(3) for i in range(3)]
    return [["--crop", f"{x},{y},{x + across},{y + down}"] for x, y in corners]


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--glimray", default="target/release/glimray")
    parser.add_argument("--size", default="240x180")
    parser.add_argument("--crop", help="width and height of pieces, such as 160x120")
    parser.add_argument("--scenes", nargs="+", default=SCENES)
    parser.add_argument("--samples", default="16")
    parser.add_argument("--reference", default="2048")
    parser.add_argument("out", type=pathlib.Path)
    flags = parser.parse_args()
    flags.out.mkdir(parents=True, exist_ok=True)
    print("| scene | noisy, dB | glimray, dB | OIDN fast, dB | glimray, s | OIDN fast, s |\n|---|---|---|---|---|---|")
    for name in flags.scenes:
        found = [measure(flags, name, index, piece) for index, piece in enumerate(pieces(flags.size, flags.crop))]
        errors, seconds = (np.array(part) for part in zip(*found))
        ratios = -10 * np.log10(errors.mean(0))
        print(f"| {name} | " + " | ".join(f"{ratio:.2f}" for ratio in ratios), *(f"{time:.2f}" for time in seconds.sum(0)), sep=" | ", end=" |\n", flush=True)


def measure(flags, name, index, piece):
    """The errors of the noisy picture and of those that both denoisers make of it, and the seconds that these take."""
    piece_name = f"{name}.{flags.size}.{flags.crop or 'all'}.{index}"
    noisy, many, report = (flags.out / f"{piece_name}{end}" for end in (".exr", f".{flags.reference}.exr", ".json"))
    command = [flags.glimray, "render", f"assets/scenes/{name}.toml", "--integrator", "path", "--size", flags.size, *piece, "--quiet"]
    layers = ["--layers", "beauty,albedo,normal", "--denoise", "--report", report]
    subprocess.run([*command, "--samples", flags.samples, *layers, "-o", noisy], check=True)
    if not many.exists():
        subprocess.run([*command, "--samples", flags.reference, "--seed", "1", "-o", many], check=True)
    found, reference = channels(noisy), layer(channels(many))
    beauty = layer(found)
    features = {"albedo": layer(found, "albedo."), "normal": layer(found, "normal.", "XYZ")}
    started = time.perf_counter()
    peer = pyoidn.denoise(beauty, **features, hdr=True, quality="fast")
    seconds = time.perf_counter() - started
    own = json.loads(report.read_text())["seconds"]["denoise"]
    return [error(picture, reference) for picture in (beauty, layer(found, "denoised."), peer)], [own, seconds]


if __name__ == "__main__":
    main()
