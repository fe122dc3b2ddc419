#!/bin/sh
# The launcher ./cnctrans on a tree of its own, with stand-ins for cmake, ninja and dpkg-query that count their calls.
set -u
root=$(CDPATH= cd -- "$(dirname -- "$0")/../.." && pwd -P)
work=$(mktemp -d) || exit 1
trap 'rm -rf "$work"' EXIT
failures=0
fail() { echo "FAILED: $*"; failures=$((failures + 1)); }

tree="$work/a tree"
mkdir -p "$tree/tools" "$tree/base" "$tree/cmake" "$work/bin" "$work/elsewhere"
cp "$root/cnctrans" "$tree/"
cp "$root/tools/setup.sh" "$root/tools/packages-debian.txt" "$tree/tools/"
touch "$tree/CMakeLists.txt" "$tree/CMakePresets.json" "$tree/base/a.cpp"

cat >"$work/bin/cmake" <<'END'
#!/bin/sh
echo configure >>"$COUNT"
echo "noise of cmake"
mkdir -p build/release && echo "CMAKE_HOME_DIRECTORY:INTERNAL=$(pwd -P)" >build/release/CMakeCache.txt
: >build/release/build.ninja
END
cat >"$work/bin/ninja" <<'END'
#!/bin/sh
echo build >>"$COUNT"
[ -z "${FAIL-}" ] || { echo "[1/2] a.cpp"; echo "error: no such thing"; exit 1; }
[ -z "${NOTHING-}" ] || { echo "ninja: no work to do."; exit 0; }
sleep "${SLOW-0}"
echo "[1/2] noise of ninja"
mkdir -p "$2/bin"
printf '#!/bin/sh\necho "program:$*"\ncat\nexit 3\n' >"$2/bin/cnctrans"
chmod +x "$2/bin/cnctrans"
END
printf '#!/bin/sh\necho "install ok installed"\n' >"$work/bin/dpkg-query"
chmod +x "$work/bin/"*
COUNT=$work/count
export COUNT
PATH=$work/bin:$PATH
calls() { tr '\n' ' ' <"$COUNT"; : >"$COUNT"; }
: >"$COUNT"

# start ARGS...: runs the launcher from another folder, with text on standard input.
start() {
  (cd "$work/elsewhere" && echo input | "$tree/cnctrans" "$@" >"$work/out" 2>"$work/err")
  code=$?
}

FAIL=1 start run
[ $code = 70 ] || fail "a build that fails: status $code instead of 70"
[ -s "$work/out" ] && fail "a build that fails wrote to standard output"
grep -q 'no such thing' "$work/err" || fail "a build that fails must show its log"
calls >/dev/null

start run "two words"
[ $code = 3 ] || fail "the program's status got lost: $code"
[ "$(cat "$work/out")" = "program:run two words
input" ] || fail "standard output is not the program's alone: $(cat "$work/out")"
[ "$(wc -l <"$work/err")" = 1 ] || fail "a build should say one line: $(cat "$work/err")"
[ "$(calls)" = "build " ] || fail "the first good start should build, on the tree that is configured"

start run
[ -z "$(calls)" ] || fail "a start with nothing changed called cmake or ninja"
[ -s "$work/err" ] && fail "a start with nothing changed was not quiet: $(cat "$work/err")"

sleep 0.05
touch "$tree/base/a.cpp"
NOTHING=1 start run
[ "$(calls)" = "build " ] || fail "a changed source should be built"
[ -s "$work/err" ] && fail "a build with nothing to do was not quiet: $(cat "$work/err")"
start run
[ -z "$(calls)" ] || fail "a build with nothing to do was not remembered"

sleep 0.05
rm "$tree/base/a.cpp"
start run
[ "$(calls)" = "build " ] || fail "a source that went away should be noticed"

ln -s "a tree/cnctrans" "$work/link"
ln -s ../link "$work/elsewhere/link"
"$work/elsewhere/link" x </dev/null >"$work/out" 2>&1
[ "$(cat "$work/out")" = "program:x" ] || fail "through two links: $(cat "$work/out")"

if command -v flock >/dev/null; then
  sleep 0.05
  touch "$tree/base/b.cpp"
  for n in 1 2 3; do SLOW=0.3 "$tree/cnctrans" $n </dev/null >"$work/out$n" 2>/dev/null & done
  wait
  [ "$(calls)" = "build " ] || fail "three starts at once should build once"
  for n in 1 2 3; do [ "$(cat "$work/out$n")" = "program:$n" ] || fail "start $n of three at once did not run"; done
fi

mv "$tree" "$work/moved"
tree=$work/moved
sleep 0.05
touch "$tree/base/c.cpp"
start run
[ "$(calls)" = "configure build " ] || fail "a tree that was moved should be configured anew"

[ "$failures" = 0 ] && echo "the launcher does what it should"
exit "$failures"
