# Shared by scripts/run and scripts/test, which source it with `root` set to the top of the sources. All that is
# said here goes to stderr.

say() { printf 'importon: %s\n' "$*" >&2; }
fail() { printf 'importon: error: %s\n' "$*" >&2; exit 1; }

# ensurePackages KIND...: installs what is missing of these kinds of scripts/packages.txt.
ensurePackages() {
  local kinds=" $* " kind name wanted=() missing=()
  while read -r kind name; do
    if [[ $kinds == *" $kind "* ]]; then wanted+=("$name"); fi
  done < "$root/scripts/packages.txt"
  if ! command -v dpkg-query > /dev/null; then
    say "not a Debian system: the packages of scripts/packages.txt are taken to be there"
    return
  fi
  local installed
  installed=" $(dpkg-query -W -f='${db:Status-Status}:${Package} ' "${wanted[@]}" 2> /dev/null || true)"
  for name in "${wanted[@]}"; do
    if [[ $installed != *" installed:$name "* ]]; then missing+=("$name"); fi
  done
  if ((${#missing[@]} > 0)); then installPackages "${missing[@]}"; fi
}

# installPackages NAME...: by apt-get, as root or with sudo; its words go to a log that a failure points to.
installPackages() {
  local byHand="apt-get install $*" log apt=(env DEBIAN_FRONTEND=noninteractive apt-get -q -y)
  if ((EUID != 0)); then
    command -v sudo > /dev/null ||
      fail "cannot install Debian packages (neither root nor sudo): run as root: $byHand"
    apt=(sudo "${apt[@]}")
  fi
  apt+=(-o DPkg::Lock::Timeout=300 -o Acquire::Retries=3)
  log=$(mktemp)
  say "installing $*"
  "${apt[@]}" update >> "$log" 2>&1 || say "the package lists could not be updated; going on with the present ones"
  "${apt[@]}" install --no-install-recommends "$@" >> "$log" 2>&1 ||
    fail "cannot install Debian packages ($(grep '^E:' "$log" | tail -n 1), log in $log): by hand: $byHand"
  rm -f "$log"
}

# isBuilt PRESET: true when no source is newer than the last build of the preset that ended well.
isBuilt() {
  local stamp="$root/build/$1/.built"
  [[ -e $stamp ]] || return 1
  [[ -z $(cd "$root" && find CMakeLists.txt CMakePresets.json src shaders -newer "$stamp" -print -quit) ]]
}

# build PRESET [TARGET...]: configures and builds, if anything changed.
build() {
  local preset=$1 folder="$root/build/$1" started fresh=()
  shift
  { mkdir -p "$folder" 2> /dev/null && [[ -w $folder ]]; } ||
    fail "cannot write ($folder): make it yours, or remove it"
  exec 9> "$folder/.lock"
  flock 9  # one build at a time in this folder
  rm -f "$folder"/.started.*
  started=$(mktemp "$folder/.started.XXXXXX")
  if [[ -e $folder/CMakeCache.txt ]] && ! grep -qxF "CMAKE_HOME_DIRECTORY:INTERNAL=$root" "$folder/CMakeCache.txt"; then
    fresh=(--fresh)  # the sources were moved
  fi
  if ((${#fresh[@]} > 0)) || [[ ! -e $folder/build.ninja ]]; then
    say "configuring build/$preset"
    (cd "$root" && cmake --log-level=WARNING "${fresh[@]}" --preset "$preset") >&2 ||
      fail "cannot configure (build/$preset): see the messages above"
  fi
  say "building build/$preset"
  cmake --build "$folder" ${*:+--target "$@"} >&2 || fail "cannot build (build/$preset): see the messages above"
  mv "$started" "$folder/.built"  # as old as the start, so that a change made meanwhile counts
  exec 9>&-
}
