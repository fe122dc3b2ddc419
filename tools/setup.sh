# Shell functions of ./cnctrans and ./check; POSIX sh, to be sourced with $root set to the repository's folder.
# Everything they say goes to stderr; standard output belongs to the program.

as= # the preset that a tree is made with, where it is not called as the tree

say() { printf '%s: %s\n' "${0##*/}" "$*" >&2; }

# packages_of PURPOSE...: the names in tools/packages-debian.txt for these purposes.
packages_of() {
  for purpose in "$@"; do
    awk -v p="$purpose" '$1 == p { print $2 }' "$root/tools/packages-debian.txt"
  done | sort -u
}

# install_packages PURPOSE...: installs what is missing on Debian 12; elsewhere says what is needed, and goes on.
install_packages() {
  id=unknown version=
  [ -r /etc/os-release ] && id=$(. /etc/os-release && echo "$ID") && version=$(. /etc/os-release && echo "${VERSION_ID-}")
  if [ "$id" != debian ] || [ "${version%%.*}" != 12 ]; then
    for tool in cmake ninja c++ antlr4; do
      command -v "$tool" >/dev/null && continue
      say "$tool is missing. On Debian 12 the packages would be:" $(packages_of "$@")
      say "please install their like on this system; trying to go on"
      return 0
    done
    return 0
  fi
  missing=
  for package in $(packages_of "$@"); do
    case $(dpkg-query -W -f='${Status}' "$package" 2>/dev/null) in
      'install ok installed' | 'hold ok installed') ;;
      *) missing="$missing $package" ;;
    esac
  done
  [ -n "$missing" ] || return 0
  sudo=
  if [ "$(id -u)" != 0 ]; then
    if ! command -v sudo >/dev/null; then
      say "these packages are missing and there is no sudo; please install:$missing"
      return 0
    fi
    sudo=sudo
  fi
  say "installing$missing (log: build/packages.log)"
  mkdir -p "$root/build"
  if ! { $sudo apt-get update && $sudo env DEBIAN_FRONTEND=noninteractive apt-get install -y \
    --no-install-recommends $missing; } </dev/null >"$root/build/packages.log" 2>&1; then
    tail -n 20 "$root/build/packages.log" >&2
    say "the packages could not be installed; trying to go on"
  fi
}

# debian_source PACKAGE PATTERN: a file of Debian's source of a package, which apt brings to build/sources once.
debian_source() {
  have=$(find "$root/build/sources/$1" -path "$2" 2>/dev/null | head -n 1)
  if [ -z "$have" ]; then
    mkdir -p "$root/build/sources/$1/lists"
    (
      cd "$root/build/sources/$1" || exit 1
      echo "deb-src [signed-by=/usr/share/keyrings/debian-archive-keyring.gpg] http://deb.debian.org/debian bookworm main" >sources.list
      apt="apt-get -qq -o Dir::Etc::sourcelist=$PWD/sources.list -o Dir::Etc::sourceparts=/dev/null -o Dir::State::lists=$PWD/lists"
      $apt update && $apt source --only-source "$1"
    ) >"$root/build/sources/$1.log" 2>&1 || { tail -n 5 "$root/build/sources/$1.log" >&2; say "the source of $1 can't be had"; return 1; }
    have=$(find "$root/build/sources/$1" -path "$2" | head -n 1)
  fi
  echo "$have"
}

# lock_build PRESET: one build of a preset at a time; the others wait. Held by descriptor 9 until unlock_build.
lock_build() {
  mkdir -p "$root/build" || return 1
  exec 9>"$root/build/$1.lock" || return 1
  command -v flock >/dev/null || return 0
  flock 9
}
unlock_build() { exec 9>&-; }

# configure TREE: when build/TREE is not configured yet, or was copied here from another place.
configure() {
  tree=$root/build/$1
  if [ -f "$tree/CMakeCache.txt" ] && ! grep -qxF "CMAKE_HOME_DIRECTORY:INTERNAL=$root" "$tree/CMakeCache.txt"; then
    rm -rf "$tree"
  fi
  [ -f "$tree/build.ninja" ] && return 0
  mkdir -p "$tree"
  (cd "$root" && cmake --preset "${as:-$1}") </dev/null >"$tree/build.log" 2>&1 9>&-
}

# build PRESET TARGET...: configures and builds; all output goes to build/PRESET/build.log, whose end is shown when it
# fails. Says so on stderr as soon as there is really something to build, with a counter on a terminal.
build() {
  preset=$1
  shift
  log=$root/build/$preset/build.log
  note="building (log: build/$preset/build.log)"
  [ -f "$root/build/$preset/build.ninja" ] || note="building for the first time, this takes some minutes (log: build/$preset/build.log)"
  if ! configure "$preset"; then
    tail -n 40 "$log" >&2
    say "cmake could not set up the build"
    return 1
  fi
  status=$root/build/$preset/build.status
  rm -f "$status"
  {
    NINJA_STATUS='[%f/%t] ' ninja -C "$root/build/$preset" "$@" </dev/null 2>&1 9>&-
    echo $? >"$status"
  } | tee "$log" | {
    said=
    while IFS= read -r line; do
      case $line in
        *'Re-checking globbed directories'* | '[0/1] Re-running CMake'*) continue ;;
        '['*/*) ;;
        *) continue ;;
      esac
      [ -n "$said" ] || say "$note"
      said=yes
      [ -t 2 ] && printf '\r%s ' "${line%%]*}]" >&2
    done
    [ -n "$said" ] && [ -t 2 ] && printf '\r            \r' >&2
    :
  }
  if [ "$(cat "$status" 2>/dev/null)" != 0 ]; then
    tail -n 60 "$log" >&2
    say "the build failed"
    return 1
  fi
}
