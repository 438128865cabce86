#!/usr/bin/env bash
# Tests scripts/setup.sh against stand-ins for dpkg-query, apt-get, sudo, cmake: setup_test.sh SOURCES
set -euo pipefail
sources=$1
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
mkdir -p "$folder/bin" "$folder/sources/scripts"
cp "$sources/scripts/setup.sh" "$folder/sources/scripts/"
printf '# a comment\nrun driver\nbuild compiler\ntest oracle\nrelease browser?\nrelease runtime-*-dev\n' > "$folder/sources/scripts/packages.txt"
failures=0

# standIn NAME BODY: a command that notes its arguments in $folder/calls, then runs BODY.
standIn() {
  printf '#!/bin/bash\necho "%s $*" >> %q\n%s\n' "$1" "$folder/calls" "$2" > "$folder/bin/$1"
  chmod +x "$folder/bin/$1"
}

# setup COMMAND...: runs it after sourcing setup.sh, with the stand-ins in front; keeps status, stdout and stderr.
setup() {
  : > "$folder/calls"
  status=0
  PATH="$folder/bin:$PATH" root="$folder/sources" bash -euo pipefail -c 'source "$root/scripts/setup.sh"; "$@"' _ "$@" \
    > "$folder/out" 2> "$folder/err" || status=$?
}

# check WHAT COMMAND...: the command must succeed.
check() {
  local what=$1
  shift
  if ! "$@"; then
    echo "failed: $what; status $status; calls: $(cat "$folder/calls"); stderr: $(cat "$folder/err")"
    failures=$((failures + 1))
  fi
}

standIn dpkg-query 'echo -n "installed:driver installed:compiler "'
standIn apt-get 'exit 0'
standIn sudo '"$@"'

setup ensurePackages run build
check "nothing missing: no error" test "$status" = 0
check "nothing missing: apt-get is not called" bash -c "! grep -q apt-get '$folder/calls'"
check "nothing missing: nothing is said" test ! -s "$folder/err"

setup ensurePackages run build test
check "one missing: no error" test "$status" = 0
check "one missing: it alone is installed" grep -q 'apt-get .*install --no-install-recommends oracle$' "$folder/calls"
check "one missing: it is said" grep -q '^importon: installing oracle$' "$folder/err"
check "one missing: stdout stays empty" test ! -s "$folder/out"

# Releases differ: the version of clang, and packages that are not everywhere.
standIn apt-cache '[[ $1 == depends ]] && printf "clang\n  Depends: clang-19\n"; [[ $1 == show ]] && exit 100; exit 0'
setup ensurePackages release
check "of another release: no error" test "$status" = 0
check "of another release: the runtime of its clang" \
  grep -q 'apt-get .*install --no-install-recommends runtime-19-dev$' "$folder/calls"
check "of another release: what it has not is said" grep -q 'no package browser: going on without' "$folder/err"
standIn apt-cache '[[ $1 == depends ]] && printf "clang\n  Depends: clang-14\n"; exit 0'
setup ensurePackages release
check "of this release: both" \
  grep -q 'apt-get .*install --no-install-recommends browser runtime-14-dev$' "$folder/calls"

standIn apt-get 'echo "E: no such package"; exit 100'
setup ensurePackages test
check "install fails: status 1" test "$status" = 1
check "install fails: says why and what to do" \
  grep -q '^importon: error: .*E: no such package.*by hand: apt-get install oracle$' "$folder/err"

rm -f "$folder"/sources/scripts/../build/release/.built
mkdir -p "$folder/sources/src" "$folder/sources/shaders"
touch "$folder/sources/CMakeLists.txt" "$folder/sources/CMakePresets.json" "$folder/sources/src/a.cpp"
standIn cmake '[[ $* == *--preset* ]] && touch build/release/build.ninja; echo built'
setup isBuilt release
check "never built" test "$status" = 1
setup build release importon
check "builds" test "$status" = 0
check "what the build says goes to stderr" test ! -s "$folder/out"
check "builds the target" grep -q -- '--target importon' "$folder/calls"
setup isBuilt release
check "is built then" test "$status" = 0
touch -d '+2 seconds' "$folder/sources/src/a.cpp"
setup isBuilt release
check "not any more after a change" test "$status" = 1

standIn cmake 'exit 1'
setup build release importon
check "build fails: status 1" test "$status" = 1
check "build fails: one line says so" grep -q '^importon: error: cannot build (build/release)' "$folder/err"

exit $((failures > 0))
