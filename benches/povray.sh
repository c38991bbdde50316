#!/usr/bin/env bash
# Renders scenes of the Standard Procedural Database with POV-Ray, from the .pov files, and with
# glimray, from the .nff files, and compares the pictures.
#
#   benches/povray.sh SPD_FOLDER OUT_FOLDER [SCENE…]        scenes: balls teapot
#
# The script writes SCENE.pov.png, SCENE.glimray.png and SCENE.difference.png (amplified 8 times with
# ImageMagick, otherwise scaled to white), with ImageMagick also SCENE.beside.png, and the output of
# both programs to OUT_FOLDER. It installs POV-Ray (Debian: povray) if it is missing. Environment:
# GLIMRAY, the program (target/release/glimray); SIZE, the side in pixels (512); ONLY=pov for
# POV-Ray's pictures alone; AMBIENT=1 to keep the ambient terms in its files; LEVEL, its
# max_trace_level (6).
#
# The files differ in one respect: `balls.pov` gives the floor an ambient term, which NFF lacks, so it
# is set to 0 unless AMBIENT=1. Lights (white, 1/√n), colours, diffuse, highlight (white) and
# reflection are the same. POV-Ray 3.7 reads such old files without gamma, as glimray reads NFF. Its
# trace level counts the camera ray, so that 6 equals our 5 bounces; it also counts, without tracing
# them, the reflected rays of the level after the last (LEVEL=5 for those that we trace).
set -euo pipefail

if [ $# -lt 2 ]; then
	echo "usage: $0 SPD_FOLDER OUT_FOLDER [SCENE…]" >&2
	exit 2
fi
spd=$(cd "$1" && pwd)
mkdir -p "$2"
out=$(cd "$2" && pwd)
shift 2
[ $# -gt 0 ] || set -- balls teapot
cd "$(dirname "${BASH_SOURCE[0]}")/.."
size=${SIZE:-512}
glimray=${GLIMRAY:-${CARGO_TARGET_DIR:-target}/release/glimray}
export NODEVICE_SELECT=1

if ! command -v povray >/dev/null; then
	as_root=; [ "$(id -u)" -eq 0 ] || as_root=sudo
	$as_root apt-get update
	$as_root env DEBIAN_FRONTEND=noninteractive \
		apt-get install --yes --no-install-recommends povray
fi
if [ "${ONLY:-}" != pov ] && ! [ -x "$glimray" ]; then
	echo "There is no $glimray: run \`make build\`, or set GLIMRAY." >&2
	exit 1
fi

seconds() { # COMMAND…: runs it and prints the wall-clock seconds it took
	local TIMEFORMAT=%R
	{ time "$@" >&3 2>&3; } 2>&1
}

for scene; do
	# POV-Ray can read and write only below /tmp and the current folder, so it works on a copy.
	work=$(mktemp -d)
	trap 'rm -rf "$work"' EXIT
	if [ "${AMBIENT:-}" = 1 ]; then keep=1; else keep=0; fi
	sed "s/\(ambient *\)\([0-9.]*\)/\1\2*$keep/" "$spd/$scene.pov" >"$work/$scene.pov"
	echo "global_settings { max_trace_level ${LEVEL:-6} }" >>"$work/$scene.pov"
	exec 3>"$out/$scene.pov.log"
	took=$(cd "$work" && seconds povray "+I$scene.pov" +Oout.png "+W$size" "+H$size" -D -V -A +FN) || {
		cat "$out/$scene.pov.log" >&2
		exit 1
	}
	cp "$work/out.png" "$out/$scene.pov.png"
	rm -rf "$work"
	echo "$scene: POV-Ray $took s"
	grep -E '^ *(Rays|Shadow Ray Tests|Reflected Rays|Refracted Rays):' "$out/$scene.pov.log" || true

	[ "${ONLY:-}" != pov ] || continue
	exec 3>"$out/$scene.glimray.log"
	took=$(seconds "$glimray" render "$spd/$scene.nff" --size "${size}x$size" \
		--count-rays --report "$out/$scene.glimray.json" -o "$out/$scene.glimray.png") || {
		cat "$out/$scene.glimray.log" >&2
		exit 1
	}
	echo "$scene: glimray $took s"
	grep -E '"(primary|shadow|reflection|refraction)[a-z_]*":' "$out/$scene.glimray.json"
	# For the statistics: any fraction of the pixels may differ.
	"$glimray" compare "$out/$scene.pov.png" "$out/$scene.glimray.png" --tolerance 3 \
		--max-share 100 --diff "$out/$scene.difference.png"
	if command -v convert >/dev/null; then
		convert "$out/$scene.pov.png" "$out/$scene.glimray.png" -compose difference -composite \
			-evaluate multiply 8 "$out/$scene.difference.png"
		convert "$out/$scene.pov.png" "$out/$scene.difference.png" "$out/$scene.glimray.png" \
			+append "$out/$scene.beside.png"
	fi
done
