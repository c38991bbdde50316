#!/usr/bin/env bash
# Tests glimray on software drivers beside the installed one, and prints a Markdown table.
#
#   tests/drivers/run.sh OUT_FOLDER GLIMRAY SUITE [DRIVER…]
#
# Debian's archive has the drivers: Mesa of Debian 13 and of unstable, and SwiftShader in a browser's package. Each is
# unpacked once, with the C library that it needs, into a tree under OUT_FOLDER, in which the programs run. They must not
# need a newer C library than the tree has. This needs Debian with apt-get, and root or user namespaces.
set -uo pipefail

if [ $# -lt 3 ]; then
	echo "usage: $0 OUT_FOLDER GLIMRAY SUITE [DRIVER…]" >&2
	exit 2
fi
mkdir -p "$1"
out=$(realpath "$1") glimray=$(realpath "$2") suite=$(realpath "$3")
shift 3
[ $# -gt 0 ] || set -- trixie sid swiftshader
cd "$(dirname "${BASH_SOURCE[0]}")/../.." || exit
export NODEVICE_SELECT=1
unset GLIMRAY_REQUIRE MESA_SHADER_CACHE_DIR

# Tests of pictures, crops and shader functions, by parts of their names.
tests=(drivers:: golden:: lanes:: levels:: optics:: pictures:: reference:: render:: shader_)
# For a driver that takes ten times as long.
fewer=(golden:: lanes::a_value levels:: optics:: reference:: shader_)
# Other tests with such names.
skips=(--skip shader_library:: --skip examples:: --skip import:: --skip imports:: --skip manual::)
# Nothing is left to chance in pictures of one Whitted sample in each pixel: drivers may only round.
exact=(assets/scenes/*.{toml,scene,nff,obj,glb})
# Rounding decides single choices of paths. Means are compared.
means=(crates/app/src/showcase.toml assets/scenes/{cornell_box.toml,glass_and_mirrors.toml,flower.glb,helmet.glb})
timed=(assets/scenes/{glass_and_mirrors.toml,helmet.glb})
# Seconds for a command: a driver may be stuck.
limit=600
# Failures that are known, as `DRIVER NAME`.
known=(
	# One of 15,000 numbers is off by 2.3e-5. The test allows 2e-5 on software adapters, and 4e-5 on GPUs, which round elsewhere.
	'sid shader_triangles::random_triangles_agree_with_exact_arithmetic'
	# Its sines and cosines are right to 2e-4, and Vulkan asks for 5e-4.
	'swiftshader shader_dispersion::rotations_of_material_and_texture_add_up'
	'swiftshader shader_quad_warp::u_and_v_of_a_direction_lead_back_to_it'
	'swiftshader shader_shape_sampling::points_lie_on_their_shape_with_the_density_of_their_cell'
	'swiftshader shader_warp::cones_and_the_sphere_are_covered_evenly_in_solid_angle'
	'swiftshader shader_warp::the_disc_is_covered_evenly'
	'swiftshader shader_warp::the_disc_map_keeps_the_places_of_centre_edges_and_corners'
	# One number of 64 is off by more than 4 units in the last place, and one of 9,000 by 1.1e-6 where 1e-6 is allowed.
	'swiftshader shader_motion::every_member_of_a_camera_is_interpolated'
	'swiftshader shader_motion::interpolated_transforms_are_the_mean_and_have_the_right_inverse'
)

source tests/drivers/tree.sh

render() { # DRIVER NAME SCENE OPTION…: a picture, its report and its messages, under this name
	local base=$out/$1/$2
	inside "$1" "$glimray" render "${@:3}" --quiet --report "$base.report" -o "$base.exr" 2>"$base.txt"
}

# The first value of this name in a report.
field() { sed -n "s/^ *\"$1\": \"\\{0,1\\}\\([^\"]*[^\",]\\)\"\\{0,1\\},\\{0,1\\}$/\\1/p" "$2" | head -n 1; }

fail() { # DRIVER NAME WHY
	local entry
	for entry in "${known[@]}"; do
		if [ "$entry" = "$1 $2" ]; then
			echo "$1: $2: known" >&2
			return
		fi
	done
	echo "$1: $2: $3" >&2
	status=1
}

check() { # DRIVER: prints a row of the table
	local driver=$1 folder=$out/$1 other=$out/installed name scene version alike=0 levels bias passed failed speed=
	rm -f "$folder"/{exact,mean,speed}-*
	if ! inside "$driver" "$glimray" doctor --backend vulkan --json >"$folder/doctor.json" 2>"$folder/doctor.txt"; then
		fail "$driver" doctor "$(head -n 1 "$folder/doctor.txt")"
		return
	fi
	version=$(field driver "$folder/doctor.json")
	[ "$driver" != swiftshader ] || version="SwiftShader of Chromium $(basename "$folder"/apt/*.deb | cut -d _ -f 2)"

	for scene in "${exact[@]}"; do
		name=exact-${scene##*/}
		render "$driver" "$name" "$scene" --integrator whitted --samples 1 --size 240x160 &&
			"$glimray" compare "$other/$name.exr" "$folder/$name.exr" --json --tolerance 2 --max-share 0.2 \
				>"$folder/$name.json" 2>"$folder/$name.txt" && alike=$((alike + 1)) ||
			fail "$driver" "$name" "$(head -n 1 "$folder/$name.txt")"
	done
	levels=$(for name in "$folder"/exact-*.json; do field max_levels "$name" 2>/dev/null; done | sort -g | tail -n 1)

	for scene in "${means[@]}"; do
		name=mean-${scene##*/}
		render "$driver" "$name" "$scene" --integrator path --samples 64 --size 160x120 &&
			GLIMRAY_PICTURES=$other/$name.exr:$folder/$name.exr "$suite" --ignored --nocapture \
				drivers::two_pictures_have_the_same_mean >"$folder/$name.txt" 2>&1 ||
			fail "$driver" "$name" "see $folder/$name.txt"
	done
	bias=$(sed -n 's/^the mean differs by -\{0,1\}\(.*\) of it.*/\1/p' "$folder"/mean-*.txt | sort -g | tail -n 1)

	# By turns, as the machine may have other work; the shortest times count.
	for scene in "${timed[@]}"; do
		name=speed-${scene##*/}
		touch "$folder/$name".{installed,own}
		for _ in 1 2 3 4 5; do
			render installed "$name" "$scene" --integrator path --samples 16 --size 320x240 &&
				field trace "$other/$name.report" >>"$folder/$name.installed"
			render "$driver" "$name" "$scene" --integrator path --samples 16 --size 320x240 &&
				field trace "$folder/$name.report" >>"$folder/$name.own"
		done
		speed+=${speed:+, }$(awk '!(FILENAME in least) || $1 < least[FILENAME] { least[FILENAME] = $1 }
			END { if (least[ARGV[2]]) printf "%.2f", least[ARGV[1]] / least[ARGV[2]]; else printf "–" }' "$folder/$name".{installed,own})
	done

	local wanted=("${tests[@]}")
	[ "$driver" != swiftshader ] || wanted=("${fewer[@]}")
	limit=5400 inside "$driver" "$suite" "${wanted[@]}" "${skips[@]}" >"$folder/tests.txt" 2>"$folder/tests.messages.txt"
	read -r passed failed < <(sed -n 's/^test result:.* \([0-9]*\) passed; \([0-9]*\) failed.*/\1 \2/p' "$folder/tests.txt")
	[ -n "$passed" ] || fail "$driver" tests "no result, see $folder/tests.txt"
	for name in $(sed -n 's/^test \([^ ]*\) .*FAILED$/\1/p' "$folder/tests.txt"); do
		fail "$driver" "$name" "see $folder/tests.txt"
	done
	printf '| %s | %s of %s | %s of %s | %.1f | %s | %s |\n' "$version" "${passed:-?}" "$((passed + failed))" \
		"$alike" "${#exact[@]}" "$levels" "$bias" "$speed" >>"$out/table.md"
}

status=0
mkdir -p "$out/installed"
inside installed "$glimray" doctor --backend vulkan --json >"$out/installed/doctor.json" || exit
for scene in "${exact[@]}"; do
	render installed "exact-${scene##*/}" "$scene" --integrator whitted --samples 1 --size 240x160 ||
		fail installed "$scene" "see $out/installed"
done
for scene in "${means[@]}"; do
	render installed "mean-${scene##*/}" "$scene" --integrator path --samples 64 --size 160x120 ||
		fail installed "$scene" "see $out/installed"
done
{
	echo "$(date -u +%Y-%m-%d), beside $(field driver "$out/installed/doctor.json"):"
	echo
	echo '| driver | tests passed | scenes alike | largest difference, levels | difference of means | speed |'
	echo '|---|---|---|---|---|---|'
} >"$out/table.md"
for driver; do
	if unpack "$driver"; then
		check "$driver"
	else
		fail "$driver" unpack "$(tail -n 1 "$out/$driver.txt")"
	fi
done
cat "$out/table.md"
exit "$status"
