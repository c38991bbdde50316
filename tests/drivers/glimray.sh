#!/usr/bin/env bash
# Runs glimray with another software driver than the installed one: trixie (Debian 13), trixie-backports, sid or
# swiftshader. Give it to the scripts of benches/peers in place of the program.
#
#   DRIVER=trixie tests/drivers/glimray.sh ARGUMENT…
#
# Environment: GLIMRAY, the program (target/release/glimray); DRIVERS, the folder for the drivers (target/drivers). Files
# that it reads and writes are in /tmp, in the folder that it is called in, or in that of the drivers.
set -euo pipefail
root=$(realpath "$(dirname "${BASH_SOURCE[0]}")/../..")
glimray=$(realpath "${GLIMRAY:-$root/target/release/glimray}") suite=$glimray
mkdir -p "${DRIVERS:-$root/target/drivers}"
out=$(realpath "${DRIVERS:-$root/target/drivers}")
export NODEVICE_SELECT=1
source "$root/tests/drivers/tree.sh"
unpack "${DRIVER:?names no driver}" || { tail -n 1 "$out/$DRIVER.txt" >&2 && exit 1; }
limit=86400 inside "$DRIVER" "$glimray" "$@"
