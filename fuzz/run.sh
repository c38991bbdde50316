#!/usr/bin/env bash
# Fuzzes: fuzz/run.sh [TARGET…], by default all of them, each for SECONDS_EACH seconds (600).
# It needs a nightly compiler, and installs cargo-fuzz if it is missing. Finds are in target/fuzz/finds.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"

seconds=${SECONDS_EACH:-600}
work=${CARGO_TARGET_DIR:-$PWD/../target}/fuzz
command -v cargo-fuzz >/dev/null || cargo install --locked cargo-fuzz
targets=("$@")
[ $# -gt 0 ] || mapfile -t targets < <(cargo +nightly fuzz list)

# Without AddressSanitizer: glimray has no unsafe code, and runs are twice as fast.
cargo +nightly fuzz build --release --sanitizer none --target-dir "$work/build"
status=0
for target in "${targets[@]}"; do
    corpus=$work/corpus/$target
    mkdir -p "$corpus" "$work/finds/$target"
    # What earlier runs found to be interesting.
    if [ -e "../tests/fuzz/corpus/$target.zip" ]; then unzip -qno "../tests/fuzz/corpus/$target.zip" -d "$corpus"; fi
    for folder in seeds regressions; do
        from=../tests/fuzz/$folder/$target
        if [ -d "$from" ]; then cp "$from"/* "$corpus"; fi
    done
    case $target in
        native) cp ../assets/scenes/*.toml "$corpus" ;;
        course) cp ../assets/scenes/*.scene "$corpus" ;;
        nff) cp ../assets/scenes/*.nff "$corpus" ;;
        glb) cp ../tests/encoded/*.glb "$corpus" ;;
        picture) cp ../tests/encoded/*.ktx2 ../tests/encoded/*.webp "$corpus" ;;
    esac
    dictionary=()
    if [ -e "dictionaries/$target.dict" ]; then dictionary=(-dict="dictionaries/$target.dict"); fi
    echo "$target for $seconds s"
    "$work/build/x86_64-unknown-linux-gnu/release/$target" "$corpus" "${dictionary[@]}" \
        -max_total_time="$seconds" -timeout=10 -rss_limit_mb=2048 -max_len=16384 \
        -print_final_stats=1 -artifact_prefix="$work/finds/$target/" >"$work/$target.log" 2>&1 || status=1
    tail -n 12 "$work/$target.log" | grep -E 'number_of_executed_units|peak_rss|ERROR|SUMMARY' || true
done
exit $status
