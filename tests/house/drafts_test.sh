#!/bin/sh
# The drafts of docs/drafts.md are what --draft writes, and what was made of them by hand can be read.
# usage: drafts_test.sh CNCTRANS
set -eu
cnctrans=$1
here=$(cd "$(dirname "$0")/../../docs/drafts" && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
fail() { echo "drafts_test: $*" >&2; exit 1; }

one() { # from to program names draft finished things
  cp "$here/$3" "$here/$4" "$work/"
  cd "$work"
  status=0
  "$cnctrans" --from "$1" --to "$2" "$3" --draft -o first/ 2> first.log || status=$?
  [ "$status" = 4 ] || fail "$3: status $status of the first draft"
  grep -q "$7" first.log || fail "$3: the first draft is not as docs/drafts.md says: $(tail -2 first.log)"
  status=0
  "$cnctrans" --from "$1" --to "$2" "$3" --draft --names "$4" -o "${6}" 2> second.log || status=$?
  [ "$status" = 4 ] || fail "$3: status $status of the second draft"
  diff -u "$here/$5" "$5" || fail "$5 is not what is kept"
  "$cnctrans" check --dialect "$2" "$here/$6" -q > check.log 2>&1 || fail "$6: $(cat check.log)"
  if grep -q 'DRAFT\|TO DO\|TODO_' "$here/$6"; then fail "$6 is not finished"; fi
}
one fagor sinumerik PLATE.PIM plate.names.json PLATE.draft.MPF PLATE.MPF '4 things to do, 4 lines not translated'
one num fagor HOUSING.XPI housing.names.json HOUSING.draft.PIM HOUSING.PIM '4 things to do, 4 lines not translated'
one sinumerik fagor FLANGE.MPF flange.names.json FLANGE.draft.PIM FLANGE.PIM '5 things to do, 4 lines not translated'
