#!/usr/bin/env bash
# Whether a tag names the version of Cargo.toml, and CHANGELOG.md its date: `packaging/check-tag.sh v0.1.0`.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

version=$(sed -n 's/^version = "\(.*\)"$/\1/p' Cargo.toml | head -n 1)
if [ "$1" != "v$version" ]; then
	echo "error: the tag is $1, and Cargo.toml names the version $version. Tag v$version, or set the version." >&2
	exit 1
fi
if ! grep -qE "^## $version \([0-9]{4}-[0-9]{2}-[0-9]{2}\)$" CHANGELOG.md; then
	echo "error: CHANGELOG.md has no section \`## $version (YYYY-MM-DD)\`. Write the date of the release there." >&2
	exit 1
fi
