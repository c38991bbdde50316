#!/usr/bin/env bash
# Measures glimray beside other renderers and prints one report: see README.md.
#
#   benches/peers/run.sh OUT_FOLDER
#
# The report is also written to OUT_FOLDER/report.md, and the tables of each peer, with numbers of rays, to log.txt.
# Environment: GLIMRAY, the program (target/release/glimray); ROUNDS of each of the two passes (3); THREADS (2); SPD, a folder with SPD's
# teapot.nff and teapot.pov.
set -euo pipefail

if [ $# -ne 1 ]; then
	echo "usage: $0 OUT_FOLDER" >&2
	exit 2
fi
mkdir -p "$1"
out=$(cd "$1" && pwd)
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
peers=benches/peers
rounds=${ROUNDS:-3}
threads=${THREADS:-2}
glimray=${GLIMRAY:-${CARGO_TARGET_DIR:-target}/release/glimray}
export NODEVICE_SELECT=1 LP_NUM_THREADS=$threads PYTHONDONTWRITEBYTECODE=1
if ! [ -x "$glimray" ]; then
	echo "There is no $glimray: run \`make build\`, or set GLIMRAY." >&2
	exit 1
fi

exec 3>"$out/log.txt"
python=$out/venv/bin/python
[ -x "$python" ] || python3 -m venv "$out/venv"
"$python" -m pip install --quiet embreex==4.4.0.post1 mitsuba==3.9.1 numpy==2.4.6
# Dr.Jit cannot compile for AVX-512 with LLVM 14 to 16.
llvm=(/usr/lib/*/libLLVM.so.19.1)
if ! [ -e "${llvm[0]}" ]; then
	sudo=$([ "$(id -u)" -eq 0 ] || echo sudo)
	$sudo apt-get install --quiet --yes --no-install-recommends libllvm19 >&3
	llvm=(/usr/lib/*/libLLVM.so.19.1)
fi
export DRJIT_LIBLLVM_PATH=${DRJIT_LIBLLVM_PATH:-${llvm[0]}}
# For the processor at hand, as Embree chooses its code at run time and lavapipe compiles for it.
RUSTFLAGS="-C target-cpu=native" cargo build --quiet --release --locked --manifest-path $peers/obvhs/Cargo.toml \
	--target-dir "$out/obvhs"

# Everything is measured in two passes, the second in the opposite order, so that a busy machine affects all.
results=()
measure() { # NAME COMMAND…: one peer; the command gets the file for its results as its last argument
	echo "pass $pass: $1" >&2
	if "${@:2}" "$out/$1-$pass.json" >&3; then
		results+=("$out/$1-$pass.json")
	else
		echo "pass $pass: $1 failed, and is missing from the report" >&2
	fi
}
bench() {
	"$glimray" bench --only heightfield --repeats "$rounds" --json >"$1"
}
"$glimray" bench --only heightfield --export-rays "$out/rays" >&3
sets=("$out/rays" --rounds "$rounds" --threads "1,$threads")
for pass in 1 2; do
	order=(povray glimray embree mitsuba obvhs)
	[ $pass = 1 ] || order=(obvhs mitsuba embree glimray povray)
	for peer in "${order[@]}"; do
		case $peer in
			povray) measure povray "$python" $peers/povray.py "$out/povray" --rounds "$rounds" --threads "$threads" \
				--glimray "$glimray" ${SPD:+--spd "$SPD"} --json ;;
			glimray) measure glimray bench ;;
			embree) measure embree "$python" $peers/embree.py "${sets[@]}" --json ;;
			mitsuba) measure mitsuba "$python" $peers/mitsuba3.py "${sets[@]}" --glimray "$glimray" --json ;;
			obvhs) measure obvhs "$out/obvhs/release/obvhs-peer" "${sets[@]}" --json ;;
		esac
	done
done
"$python" $peers/report.py "${results[@]}" | tee "$out/report.md"
"$python" $peers/path_tracing.py --glimray "$glimray" --rounds $((4 * rounds)) | tee -a "$out/report.md"
"$python" $peers/equal_time.py "$out/paths" --glimray "$glimray" --threads "$threads" --seconds 10 \
	--renderers glimray,scalar_rgb,llvm_ad_rgb | tee -a "$out/report.md"
