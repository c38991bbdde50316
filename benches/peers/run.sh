#!/usr/bin/env bash
# Measures glimray beside other renderers and prints one report: see README.md.
#
#   benches/peers/run.sh OUT_FOLDER
#
# Environment: GLIMRAY, the program (target/release/glimray); ROUNDS (5); THREADS (2); SPD, a folder with SPD's
# teapot.nff and teapot.pov.
set -euo pipefail

if [ $# -ne 1 ]; then
	echo "usage: $0 OUT_FOLDER" >&2
	exit 2
fi
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
mkdir -p "$1"
out=$(cd "$1" && pwd)
peers=benches/peers
rounds=${ROUNDS:-5}
threads=${THREADS:-2}
glimray=${GLIMRAY:-${CARGO_TARGET_DIR:-target}/release/glimray}
export NODEVICE_SELECT=1 LP_NUM_THREADS=$threads PYTHONDONTWRITEBYTECODE=1
if ! [ -x "$glimray" ]; then
	echo "There is no $glimray: run \`make build\`, or set GLIMRAY." >&2
	exit 1
fi

python=$out/venv/bin/python
[ -x "$python" ] || python3 -m venv "$out/venv"
"$python" -m pip install --quiet embreex==4.4.0.post1 mitsuba==3.9.1 numpy==2.4.6
# For the processor at hand, as Embree chooses its code at run time and lavapipe compiles for it.
RUSTFLAGS="-C target-cpu=native" cargo build --quiet --release --locked --manifest-path $peers/obvhs/Cargo.toml \
	--target-dir "$out/obvhs"

"$python" $peers/povray.py "$out/povray" --rounds "$rounds" --threads "$threads" --glimray "$glimray" \
	--json "$out/povray.json" ${SPD:+--spd "$SPD"}

"$python" $peers/rays.py "$out/rays"
bench() { # FILE: the ray sets of glimray's own bench
	"$glimray" bench --only heightfield --repeats "$rounds" --json >"$1"
}
ray_sets=("$out/rays" --rounds "$rounds" --threads "1,$threads")
bench "$out/glimray-before.json"
"$python" $peers/embree.py "${ray_sets[@]}" --json "$out/embree.json"
"$python" $peers/mitsuba3.py "${ray_sets[@]}" --json "$out/mitsuba.json" --glimray "$glimray"
"$out/obvhs/release/obvhs-peer" "${ray_sets[@]}" --json "$out/obvhs.json"
bench "$out/glimray-after.json"

"$python" $peers/report.py "$out"/{glimray-before,embree,mitsuba,obvhs,glimray-after,povray}.json | tee "$out/report.md"
