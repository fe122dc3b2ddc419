#!/bin/sh
# Two shards of a batch side by side under GNU parallel leave the same folder as one run; a second run does nothing again.
# usage: batch_shards_test.sh CNCTRANS. Status 77 (skipped) without GNU parallel.
set -u
parallel --version 2>/dev/null | grep -q '^GNU parallel' || { echo "no GNU parallel here: skipped"; exit 77; }
cnctrans=$1
root=$(cd "$(dirname "$0")/../.." && pwd)
folder=$(mktemp -d) || exit 1
trap 'rm -rf "$folder"' EXIT
export PARALLEL_HOME="$folder/parallel"
mkdir -p "$folder/in/sub" "$PARALLEL_HOME"
: >"$PARALLEL_HOME/will-cite"
cp "$root"/tests/identity/fagor/* "$folder/in/"
cp "$root"/examples/fagor/* "$folder/in/sub/"
printf '%%000007,MX,\nG0 X$$\nM30\n' >"$folder/in/bad.pim"
batch() { # OUT ARGUMENTS...
  out=$1
  shift
  "$cnctrans" batch --from fagor --to sinumerik "$folder/in" "$out" -q "$@"
}
fail() { echo "$*"; exit 1; }

# The list of what was written keeps the sums of before too, and so tells shards from one run.
batch "$folder/one" --jobs 2
[ $? = 1 ] || fail "a batch with an unreadable program ends with status 1"
parallel --will-cite -j 2 "$cnctrans" batch --from fagor --to sinumerik "$folder/in" "$folder/two" -q --shard {}/2 ::: 1 2
diff -r -x .cnctrans-written "$folder/one" "$folder/two" || fail "two shards left another folder than one run"
[ "$(find "$folder/one" -name result.json | wc -l)" = "$(find "$folder/in" -type f | wc -l)" ] || fail "not every program has a result"
grep -q '^status,verified,[1-9]' "$folder/one/summary.csv" || fail "nothing is verified"
grep -q '^bad.pim,refused' "$folder/one/programs.csv" || fail "the bad program is not in the table"

# Nothing is done again, until a file changes.
"$cnctrans" batch --from fagor --to sinumerik "$folder/in" "$folder/one" >"$folder/said"
grep -q "($(find "$folder/in" -type f | wc -l) done before)" "$folder/said" || fail "a second run did something: $(cat "$folder/said")"
diff -r -x .cnctrans-written "$folder/one" "$folder/two" || fail "a second run changed something"
printf '%%000007,MX,\nG1 X1 F100\nM30\n' >"$folder/in/bad.pim"
batch "$folder/one"
grep -q '^bad.pim,verified' "$folder/one/programs.csv" || fail "a program that changed was not done again"
