#!/usr/bin/env python3
"""Path-traces balls of glTF materials with Cycles (PyPI `bpy`) and glimray, from the same GLB under the same picture.

Blender imports the GLB with its own importer, so its mapping of glTF's materials is compared as well. For each ball a
table has the ratio of mean radiances, glimray's divided by Cycles'. For whole pictures there are the ratio of the means,
that of all pixels on balls, and FLIP (PyPI `flip-evaluator`): LDR-FLIP of both pictures at one exposure through the curve
of sRGB, and HDR-FLIP. Both renderers use a box filter, neither a denoiser nor adaptive sampling. A second picture of
Cycles with another seed shows what is noise. Pictures go into the folder, also one above the other: Cycles', the other,
and a grey plus twice the difference.
"""

import argparse
import os
from pathlib import Path

import flip_evaluator
import numpy as np

import equal_time
import material_scenes
import path_scenes
import tables

BSDFS = ("full", "spec")


def displayed(picture, exposure):
    """The curve of sRGB, at an exposure in stops."""
    linear = np.clip(picture * 2.0**exposure, 0, 1)
    return np.where(linear <= 0.0031308, 12.92 * linear, 1.055 * linear ** (1 / 2.4) - 0.055)


def flip(reference, test, kind):
    found = flip_evaluator.evaluate(*(np.ascontiguousarray(p, np.float32) for p in (reference, test)), kind, applyMagma=False)
    return found[1]


def write_beside(file, reference, test, exposure):
    a, b = displayed(reference, exposure), displayed(test, exposure)
    both = np.concatenate([a, b, np.clip(0.5 + 2 * (b - a), 0, 1)], 0)
    file.write_bytes(path_scenes.png(np.round(255 * both).astype(np.uint8)))


def rendered(parsed, name, scene):
    """Cycles' picture, and those to compare with it."""
    renderers = equal_time.Renderers(parsed, name, scene)
    out = lambda what: parsed.folder / f"{name}-{what}.exr"
    cycles = renderers.cycles(parsed.samples, 1, out("cycles"))[0]
    pictures = {f"glimray --bsdf {bsdf}": renderers.glimray(parsed.samples, 1, out(bsdf), ("--bsdf", bsdf))[0]
                for bsdf in BSDFS}
    pictures["Cycles, another seed"] = renderers.cycles(parsed.samples, 2, out("seed"))[0]
    return cycles, pictures


def report(found, cycles, pictures, exposure):
    masks = np.array(material_scenes.masks(found))
    means = lambda picture: np.array([picture[mask].mean() for mask in masks]).reshape(len(found.columns), -1)
    cells = lambda values: " ".join(f"{value:.3f}" for value in values)
    own = means(cycles)
    ratios = [means(picture) / own for picture in pictures.values()]
    rows = [[column, " ".join(labels), cells(own[i]), *(cells(ratio[i]) for ratio in ratios)]
            for i, (column, labels, _) in enumerate(found.columns)]
    print(tables.table(["material", "of the balls", "Cycles' means", *pictures], rows))
    rows, on_balls, shown = [], np.any(masks, 0), displayed(cycles, exposure)
    for what, picture in pictures.items():
        rows.append([what, f"{picture.mean() / cycles.mean():.4f}", f"{picture[on_balls].mean() / cycles[on_balls].mean():.4f}",
                     f"{flip(shown, displayed(picture, exposure), 'LDR'):.4f}", f"{flip(cycles, picture, 'HDR'):.4f}"])
    print(tables.table(["whole picture", "mean", "mean of balls", "LDR-FLIP", "HDR-FLIP"], rows), flush=True)


def compare(parsed, name, scene):
    found = material_scenes.all_materials()[name]
    parsed.size = "x".join(map(str, found.size()))
    cycles, pictures = rendered(parsed, name, scene)
    print(f"\n{name}, {parsed.size} pixels, {parsed.samples} samples\n")
    report(found, cycles, pictures, parsed.exposure)
    for what, picture in pictures.items():
        write_beside(parsed.folder / f"{name}-{what.split()[-1]}.png", cycles, picture, parsed.exposure)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("folder", type=Path)
    parser.add_argument("--glimray", default="target/release/glimray")
    parser.add_argument("--surroundings", default="assets/scenes/studio.hdr")
    parser.add_argument("--samples", type=int, default=256)
    parser.add_argument("--threads", type=int, default=2)
    parser.add_argument("--exposure", type=float, default=-1.0, help="of LDR-FLIP and of the pictures, in stops")
    parser.add_argument("--scenes", default=",".join(material_scenes.NAMES), help="their names, with commas")
    parsed = parser.parse_args()
    parsed.folder.mkdir(parents=True, exist_ok=True)
    parsed.folder = parsed.folder.resolve()
    os.environ["LP_NUM_THREADS"] = str(parsed.threads)
    for name, scene in material_scenes.all_scenes(parsed.folder, parsed.surroundings).items():
        if name in parsed.scenes.split(","):
            compare(parsed, name, scene)


if __name__ == "__main__":
    main()
