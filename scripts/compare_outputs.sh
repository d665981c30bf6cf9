#!/usr/bin/env bash
# Runs two programs `kappa` with the same commands and compares all that they write, byte by byte.
#   scripts/compare_outputs.sh [--expect FILE] [--only PATTERN] BEFORE AFTER [FOLDER]
# BEFORE and AFTER are the programs. BEFORE makes the inputs. Where KAPPA_TEST_DATA names a folder of real scans, these
# are inputs too. The commands stand in compare_outputs.commands, beside this script.
# FOLDER must be new or empty, and keeps all inputs and outputs. Without it, they are kept only if something is wrong.
#   --only PATTERN   runs the commands whose names fit this pattern of the shell, such as 'render-*'
#   --expect FILE    states the differences that are wanted, one a line, with the reason behind each:
#                        curvature-cloud             the automatic radius is wider
#                        usage-*:stderr              the messages are reworded
#                        segment-mesh:*.regions.csv  the table has a new column
#                    A line begins with a pattern for the names of commands. A second pattern, behind a colon, limits
#                    the line to the exit code (exit), to what is printed (stdout, stderr), or to files that fit it.
# Prints one line a command, then the counts. A command is broken if BEFORE does not end with the exit code that is due.
# Exit codes of this script:
#   0  whatever differs is expected, and whatever is expected differs
#   1  something else differs, an expected difference does not occur, or a command is broken
#   2  the script is called wrongly
set -euo pipefail
unset DISPLAY # every picture is drawn on a virtual display
export LC_ALL=C

here=$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")
readonly here limit=120 # seconds after which a command is stopped

fail_usage() {
  echo "compare_outputs.sh: $1" >&2
  exit 2
}

# Sets before, after, given_folder, only and the expected differences.
read_arguments() {
  local arguments=()
  only='*'
  while [ $# -gt 0 ]; do
    case $1 in
      --expect | --only)
        [ $# -ge 2 ] || fail_usage "$1 needs a value"
        if [ "$1" = --only ]; then only=$2; else read_expected "$2"; fi
        shift
        ;;
      -*) fail_usage "unknown option $1; give --expect FILE or --only PATTERN" ;;
      *) arguments+=("$1") ;;
    esac
    shift
  done
  [ ${#arguments[@]} -eq 2 ] || [ ${#arguments[@]} -eq 3 ] ||
    fail_usage "give two programs and perhaps a folder: [--expect FILE] [--only PATTERN] BEFORE AFTER [FOLDER]"
  before=$(program "${arguments[0]}")
  after=$(program "${arguments[1]}")
  given_folder=${arguments[2]:-}
}

program() {
  if [ ! -f "$1" ] || [ ! -x "$1" ]; then fail_usage "'$1' is not a program; build it, or correct the path"; fi
  realpath -s "$1"
}

# Sets folder, from $1 if it is not empty, and whether to keep it.
make_folder() {
  keep=yes
  if [ -z "$1" ]; then
    keep=no
    folder=$(mktemp -d -t compare_outputs.XXXXXX)
  else
    folder=$(realpath -m "$1")
    [ ! -e "$folder" ] || [ -d "$folder" ] || fail_usage "'$1' is not a folder"
    [ ! -d "$folder" ] || [ -z "$(ls -A "$folder")" ] || fail_usage "the folder '$1' is not empty; name a new one"
  fi
  mkdir -p "$folder"/{inputs,before,after}
}

expected_names=() expected_things=() expected_reasons=() expected_met=()

read_expected() {
  local what reason
  [ -r "$1" ] || fail_usage "the file '$1' of expected differences cannot be read"
  while read -r what reason || [ -n "$what" ]; do
    case $what in '' | '#'*) continue ;; esac
    [ -n "$reason" ] || fail_usage "'$what' in '$1' has no reason behind it"
    expected_names+=("${what%%:*}")
    case $what in *:*) expected_things+=("${what#*:}") ;; *) expected_things+=('*') ;; esac
    expected_reasons+=("$reason")
    expected_met+=(no)
  done <"$1"
}

# Whether the text $1 fits the pattern $2.
fits() {
  # shellcheck disable=SC2254 # a pattern it is
  case $1 in $2) return 0 ;; *) return 1 ;; esac
}

# Whether it is expected that $2 of the command $1 differs; sets `reason`.
is_expected() {
  local i found=1
  for i in "${!expected_names[@]}"; do
    fits "$1" "${expected_names[i]}" || continue
    fits "$2" "${expected_things[i]}" || continue
    expected_met[i]=yes
    reason=${expected_reasons[i]}
    found=0
  done
  return $found
}

# Complains about what was expected of the commands that ran, $@, and does not occur.
report_unmet() {
  local i name due text
  for i in "${!expected_names[@]}"; do
    [ "${expected_met[i]}" = no ] || continue
    due=no
    for name in "$@"; do ! fits "$name" "${expected_names[i]}" || due=yes; done
    [ $due = yes ] || [ "$only" = '*' ] || continue
    text=${expected_names[i]}:${expected_things[i]}
    printf 'does not occur: %s [%s]\n' "${text%:\*}" "${expected_reasons[i]}"
    unmet=$((unmet + 1))
  done
}

# Makes an input with BEFORE in the folder of inputs.
produce() {
  timeout "$limit" "$before" "$@" >produce.log 2>&1 && return
  echo "compare_outputs.sh: BEFORE cannot make an input with '$*':" >&2
  cat produce.log >&2
  exit 1
}

# Prints the coordinates x,y,z of a table that `kappa` wrote, without the header.
rows() {
  tail -n +2 "$1" | cut -d, -f1-3
}

# Prints the lines on standard input as a PCD file with the fields $1, $2 columns and $3 rows, seen from the place $4.
pcd() {
  local ones=${1//+([a-z])/1}
  printf 'VERSION 0.7\nFIELDS %s\nSIZE %s\nTYPE %s\nCOUNT %s\n' "$1" "${ones//1/8}" "${ones//1/F}" "$ones"
  printf 'WIDTH %d\nHEIGHT %d\nVIEWPOINT %s 1 0 0 0\nPOINTS %d\nDATA ascii\n' "$2" "$3" "$4" $(($2 * $3))
  tr ',' ' '
}

make_meshes() {
  produce generate torus torus.ply --slices 60 --sides 40
  produce generate torus torus-bare.ply --slices 60 --sides 40 --no-normals --no-truth
  produce generate torus quads.ply --slices 60 --sides 40 --faces quads
  produce generate torus noisy.ply --slices 60 --sides 40 --noise 0.3 --no-normals --no-truth
  produce generate torus far.ply --slices 60 --sides 40 --origin 500000,5400000,100
  produce generate goursat goursat.ply --step 1
  produce generate saddle saddle.ply --cells 40
  produce generate saddle saddle.vtp --cells 40 --faces other-diagonal
  printf '%s\n' OFF '12 8 0' '2 0 0' '1 1.7 0' '-1 1.7 0' '-2 0 0' '-1 -1.7 0' '1 -1.7 0' \
    '2 0 2' '1 1.7 2' '-1 1.7 2' '-2 0 2' '-1 -1.7 2' '1 -1.7 2' '6 5 4 3 2 1 0' '6 6 7 8 9 10 11' '4 0 1 7 6' \
    '4 1 2 8 7' '4 2 3 9 8' '4 3 4 10 9' '4 4 5 11 10' '4 5 0 6 11' >prism.off
  { echo solid && printf 'facet normal 0 0 0\nouter loop\nvertex %s\nvertex %s\nvertex %s\nendloop\nendfacet\n' \
    '0 0 0' '0 1 0' '1 0 0' '0 0 0' '1 0 0' '0 0 1' '0 0 0' '0 0 1' '0 1 0' '1 0 0' '0 1 0' '0 0 1' &&
    echo endsolid; } >tetrahedron.stl
  head -c 1000 torus.ply >cut.ply
  true >empty.ply
}

make_clouds() {
  produce generate torus torus.pcd --points 3000
  produce generate torus torus.csv --points 2000 --seed 1 --no-normals --no-truth
  rows torus.csv | tr ',' ' ' >torus.xyz
  head -n 2 torus.xyz >two.xyz
  produce generate sphere sphere-bare.pcd --points 3000 --radius 5 --noise-normal 0.02 --no-normals --no-truth
  produce generate waves waves.pcd --points 5000 --no-normals --no-truth
  produce generate airborne airborne.las --width 60 --depth 60
  produce generate airborne doubles.csv --width 30 --depth 30 --duplicates 0.1 --seed 2
}

# A cloud with pulses of two returns, four classes, and points that are flagged as withheld.
make_returns() {
  local points=4000
  produce generate waves waves.csv --points $points --width 100 --depth 100 --amplitude 3 --x-length 15 --y-length 12 \
    --no-normals --no-truth
  paste -d, <(echo x,y,z && rows waves.csv) \
    <(echo return_number && cycle $points 1 1 1 1 2) <(echo number_of_returns && cycle $points 1 1 1 2 2) \
    <(echo classification && cycle $points 2 2 6 2 9 2 5) <(echo withheld && cycle $points 0 0 0 0 0 0 0 0 0 0 1) \
    >returns.csv
  produce normals returns.csv returns.las
}

# Prints $1 lines: the words behind $1, one a line, again and again.
cycle() {
  yes "$(printf '%s\n' "${@:2}")" | head -n "$1" || true
}

# - A depth image of 50 x 50 points, the same points as a mesh of quads, and the image with holes and edges in depth.
# - A sweep of 16 rings of 360 points, once with 40 pulses that have no return, once with the numbers of the rings.
make_scans() {
  local i ring
  produce generate quadric grid.csv --a 0.3 --b -0.2 --size 4 --cells 49 --no-faces
  rows grid.csv | pcd 'x y z' 50 50 '0 0 8' >grid.pcd
  {
    rows grid.csv | sed -e 's/^/v /' -e 's/,/ /g'
    for i in {1..2449}; do [ $((i % 50)) -eq 0 ] || echo "f $i $((i + 1)) $((i + 51)) $((i + 50))"; done
  } >grid.obj
  rows grid.csv | sed -e '7~13s/.*/nan,nan,nan/' -e '1001,1400s/[^,]*$/-1/' | pcd 'x y z' 50 50 '0 0 8' >holes.pcd
  produce generate cylinder sweep.csv --radius 10 --height 6 --slices 360 --rings 15 --noise-normal 0.01 --no-faces \
    --origin 0,0,-3
  { rows sweep.csv && cycle 40 0,0,0; } | pcd 'x y z' 5800 1 '0 0 0' >sweep.pcd
  paste -d, <(rows sweep.csv) <(for ring in {0..15}; do cycle 360 "$ring"; done) |
    pcd 'x y z ring' 5760 1 '0 0 0' >rings.pcd
}

make_results() {
  produce segment torus.ply result.ply --radius 0.5
  produce segment airborne.las regions.ply --radius 4 --smooth 1
  produce curvature grid.pcd organised.pcd --radius 0.3
  produce curvature torus.ply radii.csv --radius 0.5,0.8
  produce curvature noisy.ply moved.ply --radius 0.6
}

# Runs the program $2 for the command called $3, with the arguments behind. $1 is the side: before or after.
run_one() {
  local code=0 place=$folder/$1/$3
  mkdir "$place" && cd "$place"
  exec >"$place.stdout" 2>"$place.stderr" </dev/null
  timeout "$limit" "$2" "${@:4}" || code=$?
  echo $code >"$place.exit"
}

# Prints $1 as a regular expression of `sed -E` that fits this text alone.
literal() {
  printf '%s' "$1" | sed 's/[][(){}|\.*+?^$#]/\\&/g'
}

# Prints the file $2, which holds what the program $1 printed, without what may differ: the path of the program, the
# folder of its side, and seconds.
normalised() {
  sed -E -e "s#$(literal "$1")#kappa#g" -e "s#$(literal "$folder")/(before|after)#OUT#g" \
    -e '/^seconds /s/[0-9]+\.[0-9]+/S/g' \
    -e ':next' -e 's/("seconds": \{[^}]*: )[-+.0-9e]+/\1S/' -e 't next' "$2"
}

# Prints where two files differ, such as "byte 20, line 2", or nothing if they are equal.
first_difference() {
  local text
  text=$(cmp "$1" "$2" 2>&1) && return
  case $text in
    *'differ: char '*) echo "byte ${text##*differ: char }" ;;
    *' after byte '*) echo "one ends after byte ${text##* after byte }" ;;
    *' which is empty') echo 'one is empty' ;;
    *) echo "$text" ;;
  esac
}

# Prints what differs between the outputs of the command $1. A line has two columns: the name that a file of expected
# differences gives it, and a text.
differences() {
  local old=$folder/before/$1 new=$folder/after/$1 codes files file stream where
  codes=$(<"$old.exit")/$(<"$new.exit")
  [ "${codes%/*}" = "${codes#*/}" ] || printf 'exit\texit code %s differs\n' "$codes"
  files=$({ cd "$old" && find . -type f && cd "$new" && find . -type f; } | cut -c3- | sort -u)
  while IFS= read -r file; do
    if [ -z "$file" ]; then
      continue
    elif [ ! -e "$new/$file" ]; then
      printf '%s\tfile %s (only before)\n' "$file" "$file"
    elif [ ! -e "$old/$file" ]; then
      printf '%s\tfile %s (only after)\n' "$file" "$file"
    else
      where=$(first_difference "$old/$file" "$new/$file")
      [ -z "$where" ] || printf '%s\tfile %s (%s)\n' "$file" "$file" "$where"
    fi
  done <<<"$files"
  for stream in stdout stderr; do
    normalised "$before" "$old.$stream" >"$folder/old"
    normalised "$after" "$new.$stream" >"$folder/new"
    where=$(first_difference "$folder/old" "$folder/new")
    [ -z "$where" ] || printf '%s\t%s (%s)\n' "$stream" "$stream" "$where"
  done
}

due_exit() {
  case $1 in usage-*) echo 2 ;; fails-*) echo 1 ;; *) echo 0 ;; esac
}

# Compares the outputs of the command $1 and prints its line.
report() {
  local name=$1 code thing text reason='' wanted='' unwanted=''
  code=$(<"$folder/before/$name.exit")
  differences "$name" >"$folder/differences" # a failure ends the script here, and is not taken for equality
  while IFS=$'\t' read -r thing text; do
    if is_expected "$name" "$thing"; then wanted+=", $text"; else unwanted+=", $text"; fi
  done <"$folder/differences"
  files=$((files + $(find "$folder/before/$name" -type f | wc -l)))
  if [ "$code" != "$(due_exit "$name")" ]; then
    text="broken: BEFORE ends with exit code $code where $(due_exit "$name") is due, see before/$name.stderr"
    broken=$((broken + 1))
  elif [ -n "$unwanted" ]; then
    text="differs: ${unwanted#, }${wanted:+; expected: ${wanted#, }}"
    text=${text/#differs: exit code/exit code}
    different=$((different + 1))
  elif [ -n "$wanted" ]; then
    text="expected: ${wanted#, } [$reason]"
    expected=$((expected + 1))
  else
    text=equal
    equal=$((equal + 1))
    [ $keep = yes ] || rm -rf "$folder"/{before,after}/"$name"{,.exit,.stdout,.stderr}
  fi
  printf '%-26s %s\n' "$name" "$text"
}

# Runs the command $1 with both programs at once; its arguments stand behind.
compare() {
  run_one before "$before" "$@" &
  run_one after "$after" "$@" &
  wait
  report "$1"
}

# Prints the name and the arguments of each command that is asked for, or of all if $1 is *.
commands() {
  local name arguments known=' '
  while IFS='|' read -r name arguments; do
    name=${name%%+([ ])}
    case $name in '' | '#'*) continue ;; esac
    case $known in *" $name "*) fail_usage "two commands are called $name" ;; esac
    known+="$name "
    ! fits "$name" "$1" || printf '%s %s\n' "$name" "$arguments"
  done <"$here/compare_outputs.commands"
}

# Runs the commands of the lines on standard input.
run_all() {
  local line words names=() data=''
  [ ! -d "${KAPPA_TEST_DATA:-}" ] || data=$(realpath "$KAPPA_TEST_DATA")
  while IFS= read -r line; do
    case $line in
      *%data/*) [ -n "$data" ] || { left_out=$((left_out + 1)) && continue; } ;;
    esac
    read -ra words <<<"$line"
    words=("${words[@]//%in\//../../inputs/}")
    words=("${words[@]//%data\//"$data"/}")
    names+=("${words[0]}")
    compare "${words[@]}"
  done
  report_unmet "${names[@]}"
}

files=0 equal=0 different=0 expected=0 broken=0 unmet=0 left_out=0
shopt -s extglob
read_arguments "$@"
table=$(commands "$only")
[ -n "$table" ] || fail_usage "no command fits '$only'"
make_folder "$given_folder"
(
  cd "$folder/inputs"
  make_meshes
  make_clouds
  make_returns
  make_scans
  make_results
)
run_all <<<"$table"
[ $left_out -eq 0 ] || echo "$left_out commands are left out: KAPPA_TEST_DATA names no folder"
printf '%d files; %d commands equal, %d expected, %d differ, %d broken; %d expected do not occur\n' \
  $files $equal $expected $different $broken $unmet
wrong=$((different + broken + unmet))
if [ $keep = no ] && [ $wrong -eq 0 ]; then rm -rf "$folder"; else echo "inputs and outputs: $folder"; fi
[ $wrong -eq 0 ]
