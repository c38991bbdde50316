#!/usr/bin/env python3
"""Renders SPD scenes with POV-Ray and with glimray in turn, and a glass ball with adaptive antialiasing.

    povray.py OUT_FOLDER [SCENE…]       balls gears mount rings tetra tree, teapot with --spd, glass-ball

Scenes and pictures are written to OUT_FOLDER. POV-Ray is installed (Debian: povray) if it is missing.
"""

import argparse
import json
import os
import re
import resource
import shutil
import subprocess
import sys
import time
from pathlib import Path
from typing import NamedTuple

import spd
import tables

HERE = Path(__file__).parent
SIZE = 512
# The glass ball: pixels along a side, and settings of adaptive antialiasing that give similar errors.
BALL_SIZE = 1024
POVRAY_ADAPTIVE = ["+A0.05", "+AM1", "+R4", "-J"]
GLIMRAY_ADAPTIVE = ["--antialias", "adaptive", "--samples", "16", "--noise", "0.1"]
# Pictures with many samples, from which the error is measured.
POVRAY_REFERENCE = ["+A0.0", "+AM1", "+R9", "-J"]
GLIMRAY_REFERENCE = ["--antialias", "stratified", "--samples", "64"]


# Numbers of rays in POV-Ray's statistics.
POVRAY_COUNTS = {
    "all": "Rays",
    "shadow": "Shadow Ray Tests",
    "mirrored": "Reflected Rays",
    "refracted": "Refracted Rays",
}


class Run(NamedTuple):
    """One process: seconds of tracing, of the whole process, and of the CPU."""

    trace: float
    whole: float
    cpu: float


def install():
    if shutil.which("povray"):
        return
    as_root = [] if os.geteuid() == 0 else ["sudo"]
    print("POV-Ray is missing: installing it with apt-get.", file=sys.stderr)
    subprocess.run([*as_root, "apt-get", "update"], check=True)
    command = ["apt-get", "install", "--yes", "--no-install-recommends", "povray"]
    subprocess.run([*as_root, "env", "DEBIAN_FRONTEND=noninteractive", *command], check=True)


def run(command, folder, environment=None):
    """Whole and CPU seconds of the process, and all that it printed."""
    before, start = resource.getrusage(resource.RUSAGE_CHILDREN), time.perf_counter()
    log = folder / "log.txt"
    with log.open("wb") as file:
        status = subprocess.run(command, cwd=folder, stdout=file, stderr=file, env=environment).returncode
    whole, after = time.perf_counter() - start, resource.getrusage(resource.RUSAGE_CHILDREN)
    text = log.read_text(errors="replace")
    if status != 0:
        sys.exit(f"{command}\n{text}")
    cpu = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    return whole, cpu, text


class Programs:
    """Both programs, which work in one folder: POV-Ray may only read and write the current one and /tmp."""

    def __init__(self, glimray, folder, threads):
        self.glimray = str(Path(glimray).resolve())
        self.folder = folder
        self.threads = str(threads)
        self.environment = {**os.environ, "LP_NUM_THREADS": self.threads, "NODEVICE_SELECT": "1"}

    def povray(self, scene, picture, size, antialiasing):
        """A run, and numbers of rays by kind."""
        command = ["povray", f"+I{scene}.pov", f"+O{picture}", f"+W{size}", f"+H{size}", f"+WT{self.threads}"]
        whole, cpu, text = run([*command, "-D", "-V", "+FN", *antialiasing], self.folder)
        trace = re.search(r"Trace Time: .*\(([\d.]+) seconds\)", text)
        counts = {}
        for kind, name in POVRAY_COUNTS.items():
            found = re.search(rf"^ *{name}: +(\d+)", text, re.MULTILINE)
            counts[kind] = int(found[1]) if found else 0
        return Run(float(trace[1]), whole, cpu), counts

    def render(self, scene, picture, size, flags):
        """The same of glimray. Rays are counted with --count-rays only."""
        command = [self.glimray, "render", scene, "--size", f"{size}x{size}", "-o", picture, "--report", "report.json"]
        whole, cpu, _ = run([*command, "--quiet", *flags], self.folder, self.environment)
        report = json.loads((self.folder / "report.json").read_text())
        rays = report.get("rays") or {}
        counts = {
            "all": sum(rays.get(kind, 0) for kind in ("primary", "reflection", "refraction")),
            "shadow": rays.get("shadow", 0),
            "mirrored": rays.get("reflection", 0),
            "refracted": rays.get("refraction", 0),
        }
        return Run(report["seconds"]["trace"], whole, cpu), counts

    def convert(self, scene):
        """A native scene from an NFF file, in which light passes through glass as in POV-Ray."""
        native = scene.replace(".nff", ".toml")
        run([self.glimray, "convert", scene, "-o", native], self.folder, self.environment)
        path = self.folder / native
        path.write_text('shadows = "filtered"\n' + path.read_text())
        return native

    def levels(self, a, b, difference=None):
        """Root of the mean squared difference of two pictures, in levels of 8 bits."""
        command = [self.glimray, "compare", a, b, "--tolerance", "255"]
        command += ["--diff", difference] if difference else []
        return float(re.search(r"RMSE .*\(([\d.]+) levels\)", run(command, self.folder)[2])[1])

    def in_turn(self, rounds, *programs):
        """Runs both in every round, first the one, then the other, and returns the runs of each."""
        runs = [[], []]
        for number in range(rounds):
            for which in (0, 1) if number % 2 == 0 else (1, 0):
                runs[which].append(programs[which]()[0])
        return runs

    def record(self, scene, what, runs, **more):
        seconds = [[getattr(r, what) for r in each] for each in runs]
        return {
            "peer": "POV-Ray",
            "render": scene,
            "what": what,
            "threads": int(self.threads),
            "peer_seconds": seconds[0],
            "glimray_seconds": seconds[1],
            **more,
        }


def compare_scene(programs, scene, rounds):
    """Records of tracing and of the whole process, and a row with the numbers of rays."""
    pictures = f"{scene}.povray.png", f"{scene}.glimray.png"
    _, theirs = programs.povray(scene, pictures[0], SIZE, ["-A"])
    # This also warms the shader cache, and so does one without the counters.
    _, ours = programs.render(f"{scene}.nff", pictures[1], SIZE, ["--count-rays"])
    programs.render(f"{scene}.nff", pictures[1], SIZE, [])
    compared = pictures[1]
    if ours["refracted"]:
        compared = f"{scene}.filtered.png"
        programs.render(programs.convert(f"{scene}.nff"), compared, SIZE, [])
    rmse = programs.levels(pictures[0], compared, f"{scene}.difference.png")
    runs = programs.in_turn(
        rounds,
        lambda: programs.povray(scene, pictures[0], SIZE, ["-A"]),
        lambda: programs.render(f"{scene}.nff", pictures[1], SIZE, []),
    )
    rays = [scene, *(f"{theirs[kind]:,} / {ours[kind]:,}" for kind in ("all", "shadow", "mirrored", "refracted"))]
    return [programs.record(scene, "trace", runs, rmse=rmse), programs.record(scene, "whole", runs)], rays


def compare_ball(programs, rounds):
    """Records of CPU seconds and of the whole process, with both errors."""
    for ending in ("pov", "toml"):
        shutil.copy(HERE / f"glass_ball.{ending}", programs.folder)

    def povray(picture, flags):
        return programs.povray("glass_ball", picture, BALL_SIZE, flags)

    def glimray(picture, flags):
        return programs.render("glass_ball.toml", picture, BALL_SIZE, flags)

    # These take minutes and are kept in the folder.
    references = ["ball.povray.reference.png", "ball.glimray.reference.png"]
    for render, picture, flags in zip((povray, glimray), references, (POVRAY_REFERENCE, GLIMRAY_REFERENCE)):
        if not (programs.folder / picture).exists():
            render(picture, flags)
    glimray("ball.glimray.png", GLIMRAY_ADAPTIVE)
    runs = programs.in_turn(
        rounds,
        lambda: povray("ball.povray.png", POVRAY_ADAPTIVE),
        lambda: glimray("ball.glimray.png", GLIMRAY_ADAPTIVE),
    )
    errors = [programs.levels(*pair) for pair in zip(("ball.povray.png", "ball.glimray.png"), references)]
    between = programs.levels(*references)
    rmse = f"own error {errors[0]:.2f} / {errors[1]:.2f}, references {between:.2f} apart"
    return [programs.record("glass-ball", "cpu", runs, rmse=rmse), programs.record("glass-ball", "whole", runs)]


def prepare_teapot(folder, out):
    """SPD's own files, without the ambient terms, which NFF lacks."""
    shutil.copy(folder / "teapot.nff", out)
    text = re.sub(r"(?m)^( *ambient ).*$", r"\g<1>0", (folder / "teapot.pov").read_text())
    (out / "teapot.pov").write_text(text + "\nglobal_settings { adc_bailout 1/512 max_trace_level 6 }\n")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=Path)
    parser.add_argument("scenes", nargs="*", metavar="SCENE")
    parser.add_argument("--spd", type=Path, help="a folder with SPD's teapot.nff and teapot.pov")
    parser.add_argument("--threads", type=int, default=2)
    parser.add_argument("--rounds", type=int, default=5)
    parser.add_argument("--glimray", default="target/release/glimray", help="the program [default: %(default)s]")
    parser.add_argument("--json", type=Path, metavar="FILE", help="also write the results as JSON lines")
    parsed = parser.parse_args()
    if not Path(parsed.glimray).exists():
        sys.exit(f"There is no {parsed.glimray}: run `make build`, or give --glimray.")
    install()
    parsed.folder.mkdir(parents=True, exist_ok=True)
    programs = Programs(parsed.glimray, parsed.folder, parsed.threads)
    scenes = parsed.scenes or [*spd.KINDS, *(["teapot"] if parsed.spd else []), "glass-ball"]
    records, rays = [], []
    for scene in scenes:
        if scene == "glass-ball":
            records += compare_ball(programs, parsed.rounds)
            continue
        if scene == "teapot":
            prepare_teapot(parsed.spd, parsed.folder)
        else:
            spd.write(parsed.folder, scene, spd.SIZES[scene])
        more, row = compare_scene(programs, scene, parsed.rounds)
        records += more
        rays.append(row)
    print(tables.renders(records))
    if rays:
        print("Numbers of rays, POV-Ray's / glimray's. POV-Ray also counts rays of the level after the last.\n")
        print(tables.table(["scene", "all but shadow rays", "shadow", "mirrored", "refracted"], rays))
    if parsed.json:
        parsed.json.write_text("".join(json.dumps(r) + "\n" for r in records))


if __name__ == "__main__":
    main()
