#!/usr/bin/env bash
# Renders one image as a job array: render_array_test.sh SOURCES IMPORTON [slurm]. By Slurm where asked for, else by
# the same script under plain bash.
set -euo pipefail
sources=$1
export IMPORTON=$2
how=${3:-bash}
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
scene="$sources/scenes/cornell_box/cornell_box.gltf"
settings=(--width 24 --height 16 --photons 4096 --importons 2048 -q)
options=("${settings[@]}" --passes 2)
failures=0

# check WHAT COMMAND...: the command must succeed.
check() {
  local what=$1
  shift
  if ! "$@"; then
    echo "failed: $what"
    failures=$((failures + 1))
  fi
}

if [[ $how == slurm ]]; then
  sbatch --wait --array=0-2 -o "$folder/%a.log" --export=ALL "$sources/scripts/render_array" "$folder/runs" "$scene" \
    "${options[@]}" || cat "$folder"/*.log
else
  for i in 0 1 2; do
    SLURM_ARRAY_TASK_ID=$i "$sources/scripts/render_array" "$folder/runs" "$scene" "${options[@]}"
  done
fi
check "three images and nothing else" test "$(cd "$folder/runs" && echo *)" = "run-0.exr run-1.exr run-2.exr"
check "merges" "$IMPORTON" merge "$folder"/runs/run-*.exr -o "$folder/image.exr"
check "the average is closer to one of its runs than another run is" \
  bash -c "! '$IMPORTON' compare '$folder/runs/run-1.exr' '$folder/runs/run-0.exr' --max-relmse 0 > '$folder/a' &&
           '$IMPORTON' compare '$folder/image.exr' '$folder/runs/run-0.exr' > '$folder/b' &&
           awk '/^rmse /{ if (n++) exit !(\$2 < first); first = \$2 }' '$folder/a' '$folder/b'"

# A run that is stopped goes on, and its image is that of a run never stopped.
touch -r "$folder/runs/run-0.exr" "$folder/before"
SLURM_ARRAY_TASK_ID=0 "$sources/scripts/render_array" "$folder/runs" "$scene" "${options[@]}"
check "a run that is done is left alone" test ! "$folder/runs/run-0.exr" -nt "$folder/before"
mkdir "$folder/again"
"$IMPORTON" "$scene" -o "$folder/part.exr" --seed 0 "${settings[@]}" --passes 1 --checkpoint "$folder/again/run-0.state"
SLURM_ARRAY_TASK_ID=0 "$sources/scripts/render_array" "$folder/again" "$scene" "${options[@]}"
check "a stopped run goes on to the same image" cmp "$folder/again/run-0.exr" "$folder/runs/run-0.exr"

status=0
"$sources/scripts/render_array" "$folder/runs" "$scene" 2> "$folder/err" || status=$?
check "needs a task number" test "$status" = 1
check "says so in one line" grep -q '^importon: error: needs FOLDER' "$folder/err"
exit $((failures > 0))
