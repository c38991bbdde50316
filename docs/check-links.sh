#!/bin/sh
# Checks the links of the built manual: `docs/check-links.sh FOLDER`. Files and anchors must exist.
set -eu
cd "$1"

dead=$(find . -name '*.html' ! -name 404.html | while read -r page; do
	folder=$(dirname "$page")
	grep -oE '(href|src)="[^"]*"' "$page" | sed 's/^[^"]*"//; s/"$//' | sort -u | while read -r link; do
		case $link in '' | '#' | http:* | https:* | data:* | javascript:* | mailto:*) continue ;; esac
		file=${link%%[#?]*}
		anchor=
		case $link in *'#'*) anchor=${link#*#} ;; esac
		if [ -z "$file" ]; then target=$page; else target=$folder/$file; fi
		if [ ! -e "$target" ]; then
			echo "$page: $link: there is no such file"
		elif [ -n "$anchor" ] && ! grep -qF "id=\"$anchor\"" "$target"; then
			echo "$page: $link: there is no such anchor"
		fi
	done
done)

if [ -n "$dead" ]; then
	echo "$dead" >&2
	exit 1
fi
