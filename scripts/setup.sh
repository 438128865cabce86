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
  installed=" $(dpkg-query -W -f='${db:Status-Status}:${Package} ' "${wanted[@]%\?}" 2> /dev/null || true)"
  for name in "${wanted[@]}"; do
    # shellcheck disable=SC2053  # a * in the name stands for any version
    if [[ $installed != *" installed:"${name%\?}" "* ]]; then missing+=("$name"); fi
  done
  if ((${#missing[@]} > 0)); then installPackages "${missing[@]}"; fi
}

# releasesNames NAME...: what this release calls them, a line each: with the version of its clang for *, and without those
# ending in ? that it has not.
releasesNames() {
  local name clang
  clang=$(apt-cache depends clang 2> /dev/null | sed -n 's/^ *Depends: clang-\([0-9]*\)$/\1/p' | head -n 1) || true
  for name in "$@"; do
    name=${name/\*/$clang}
    if [[ $name == *\? ]] && ! apt-cache show "${name%\?}" > /dev/null 2>&1; then
      say "this release has no package ${name%\?}: going on without"
    else
      printf '%s\n' "${name%\?}"
    fi
  done
}

# installPackages NAME...: by apt-get, as root or with sudo; its words go to a log that a failure points to.
installPackages() {
  local byHand="apt-get install $*" log names apt=(env DEBIAN_FRONTEND=noninteractive apt-get -q -y)
  if ((EUID != 0)); then
    command -v sudo > /dev/null ||
      fail "cannot install Debian packages (neither root nor sudo): run as root: $byHand"
    apt=(sudo "${apt[@]}")
  fi
  apt+=(-o DPkg::Lock::Timeout=300 -o Acquire::Retries=3)
  log=$(mktemp)
  "${apt[@]}" update >> "$log" 2>&1 || say "the package lists could not be updated; going on with the present ones"
  mapfile -t names < <(releasesNames "$@")
  if ((${#names[@]} > 0)); then
    say "installing ${names[*]}"
    "${apt[@]}" install --no-install-recommends "${names[@]}" >> "$log" 2>&1 ||
      fail "cannot install Debian packages ($(grep '^E:' "$log" | tail -n 1), log in $log): by hand: $byHand"
  fi
  rm -f "$log"
}

# driverFile NAME|FILE: the file by which the Vulkan loader finds a CPU driver: lavapipe of the installed Mesa, mesa-backports
# for that of the backports, unpacked aside, swiftshader for that of Chromium; else the file itself.
driverFile() {
  local found=()
  case $1 in
    lavapipe) found=(/usr/share/vulkan/icd.d/lvp_icd*.json) ;;
    swiftshader) found=(/usr/lib/chromium*/vk_swiftshader_icd.json) ;;
    mesa-backports)
      unpackBackport mesa-vulkan-drivers "$root/build/drivers/mesa"
      found=("$root"/build/drivers/mesa/usr/share/vulkan/icd.d/lvp_icd*.json)
      ;;
    *) found=("$1") ;;
  esac
  [[ -e ${found[0]} ]] || fail "there is no such driver ($1): lavapipe, swiftshader, mesa-backports or a file"
  printf '%s\n' "${found[0]}"
}

# unpackBackport PACKAGE FOLDER: the package of this release's backports, unpacked into the folder but not installed. The
# files of its Vulkan drivers name their libraries there.
unpackBackport() {
  local folder=$2 site release apt libraries
  [[ ! -e $folder/.unpacked ]] || return 0
  # shellcheck source=/dev/null
  release=$(. /etc/os-release && printf '%s' "$VERSION_CODENAME")
  site=$(apt-get indextargets --format '$(SITE) $(RELEASE)' 'Created-By: Packages' |
    awk -v release="$release" '$2 == release { print $1; exit }')
  rm -rf "$folder" && mkdir -p "$folder/lists/partial" "$folder/archives/partial"
  printf 'deb %s %s-backports main\n' "$site" "$release" > "$folder/sources.list"
  apt=(apt-get -q -y -o "Dir::Etc::sourcelist=$folder/sources.list" -o Dir::Etc::sourceparts=-
    -o "Dir::State::lists=$folder/lists" -o APT::Sandbox::User=root)
  say "fetching $1 of $release-backports"
  { "${apt[@]}" update && (cd "$folder" && "${apt[@]}" download "$1"); } > "$folder/log" 2>&1 ||
    fail "cannot fetch $1 of $release-backports (log in $folder/log)"
  dpkg-deb --extract "$folder/$1"_*.deb "$folder"
  libraries=$(dirname "$(find "$folder/usr/lib" -name 'libvulkan_*.so' -print -quit)")
  sed -i "s|\(\"library_path\": \"\)[^\"]*/\?\(lib[^\"/]*\"\)|\1$libraries/\2|" "$folder"/usr/share/vulkan/icd.d/*.json
  touch "$folder/.unpacked"
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
