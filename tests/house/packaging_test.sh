#!/bin/sh
# What tools/package relies on: installs of the program alone, its spoken texts, the version in one place, an image of a tree.
# usage: packaging_test.sh BUILD-FOLDER EXECUTABLE
set -eu
build=$1
cnctrans=$2
root=$(CDPATH= cd -- "$(dirname -- "$0")/../.." && pwd -P)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
fail() { echo "$*"; exit 1; }

cmake --install "$build" --component program --prefix "$work/installed" >"$work/log" || { cat "$work/log"; fail "the program alone is not installed"; }
cd "$work/installed"
[ ! -e include ] || fail "the library came with the program"
for file in bin/cnctrans share/bash-completion/completions/cnctrans share/zsh/vendor-completions/_cnctrans share/fish/vendor_completions.d/cnctrans.fish \
  share/cnctrans/examples/fagor/flange.pim share/cnctrans/profile.schema.json; do
  [ -s "$file" ] || fail "$file is missing"
done
"$cnctrans" man >"$work/page"
zcat -f share/man/man1/cnctrans.1* | cmp - "$work/page" || fail "the manual page is not what the command says"
find . -name THIRD-PARTY-NOTICES | grep -q . || fail "no notices of third parties"
[ "$(bin/cnctrans --version)" = "cnctrans $(sed -n 's/.*version = "\([0-9.]*\)".*/\1/p' "$root/translator/version.h")" ] || fail "another version"

mkdir -p "$work/tree/bin" && echo program >"$work/tree/bin/cnctrans"
"$root/packaging/image" "$work/tree" 1.2.3 "$work/image.tar"
tar -tf "$work/image.tar" | grep -q '^blobs/sha256/' || fail "the image has no blobs"
tar -xOf "$work/image.tar" oci-layout | grep -q '"1.0.0"' || fail "the image has no layout"
echo "what is packaged is there"
