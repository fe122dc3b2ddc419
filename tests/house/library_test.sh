#!/bin/sh
# The library as another project gets it: installed, found by CMake, used from C++ and from C; each answers as the
# command does. usage: library_test.sh BUILD-FOLDER EXECUTABLE
set -eu
build=$1
cnctrans=$2
root=$(CDPATH= cd -- "$(dirname -- "$0")/../.." && pwd -P)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"

fail() { echo "$*"; exit 1; }

cmake --install "$build" --prefix "$work/installed" >install.log || { cat install.log; exit 1; }
cmake -S "$root/examples/library" -B use -DCMAKE_PREFIX_PATH="$work/installed" -DCMAKE_BUILD_TYPE=Debug >use.log 2>&1 &&
  cmake --build use >>use.log 2>&1 || { cat use.log; exit 1; }

if [ -e "$build/lib/archive.mri" ]; then # a static library that is not there is no library that is not wanted
  sed 's|/lib/libcnctrans\.a|/lib/not-built.a|g' "$build/cmake_install.cmake" >without.cmake
  if cmake -DCMAKE_INSTALL_PREFIX="$work/without" -P without.cmake >without.log 2>&1; then fail "installed without the library"; fi
  tr '\n' ' ' <without.log | grep -q 'is  *not  *built' || fail "an install without the library says: $(cat without.log)"
fi

source=$root/examples/fagor/flange.pim
"$cnctrans" --no-origin --from fagor --to sinumerik "$source" --verify >expected.mpf 2>/dev/null
use/post "$source" sinumerik >post.mpf 2>post.err || { cat post.err; fail "post does not translate"; }
cmp expected.mpf post.mpf || fail "the library translates otherwise than the command"
grep -q 'verified' post.err || fail "post says no verdict: $(cat post.err)"

"$cnctrans" run --dialect fagor "$source" --trace expected.trace >/dev/null
use/trace fagor "$source" >c.trace || fail "trace does not run the program"
cmp expected.trace c.trace || fail "the library runs otherwise than the command"

printf 'N10 G1 X10 F100 G99999\nM30\n' >bad.pim
status=0
use/trace fagor bad.pim >bad.trace 2>bad.err || status=$?
[ "$status" = 1 ] || fail "status $status where the program is wrong"
grep -q '^bad.pim:1:' bad.err || fail "the diagnostic is missing: $(cat bad.err)"

if command -v pkg-config >/dev/null; then
  PKG_CONFIG_PATH=$(dirname "$(find installed -name cnctrans.pc)") # wherever this system has its libraries
  export PKG_CONFIG_PATH
  ${CC:-cc} "$root/examples/library/trace.c" $(pkg-config --cflags --libs cnctrans) -o trace2 && ./trace2 fagor "$source" >c2.trace
  cmp c.trace c2.trace || fail "pkg-config leads to another library"
fi
echo "the installed library works"
