#!/usr/bin/env bash
# The manners of every executable: questions answered, misuse refused in the user's words, nothing overwritten, nothing left behind.
# SPDX-License-Identifier: GPL-3.0-or-later
set -euo pipefail
bin=$1
here=$PWD/tests/every
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"

die() { echo "$program: $1" >&2; [ ! -s err ] || sed 's/^/  stderr: /' err >&2; exit 1; }

# expect <codes> <word> <arguments...>: one of the exit codes ("2 3"), and the word in what it says on stderr; stdout stays empty.
expect() {
  local codes=$1 word=$2 code=0
  shift 2
  "$bin/$program" "$@" </dev/null >out 2>err || code=$?
  [[ " $codes " == *" $code "* ]] || die "exit code $code, not $codes, of: $*"
  grep -qF -e "$word" err || die "stderr does not say \"$word\" after: $*"
  [ ! -s out ] || die "a failure wrote on stdout: $*"
}

# ask <question>: exit 0, an answer on stdout, nothing on stderr.
ask() {
  "$bin/$program" "$1" </dev/null >answer 2>err || die "$1 failed"
  [ -s answer ] || die "$1 says nothing"
  [ ! -s err ] || die "$1 writes on stderr"
}

questions() {
  ask --help
  ask --version
  grep -qxE "$program [0-9]+\.[0-9]+\.[0-9]+" answer || die "--version says $(cat answer)"
  for question in describe xml catalogue; do
    ask --$question
    mv answer $question
  done
  python3 "$here/answers.py" "$program" describe xml catalogue >refusals || die "an answer is not as it should be"
  if "$bin/$program" --help >/dev/full 2>err; then die "a full stdout is not noticed"; fi
}

# What --describe says of itself, tried: answers.py wrote one "word TAB argument..." per line.
refusals() {
  while IFS=$'\t' read -r word arguments; do
    read -ra arguments <<<"$arguments"
    expect 2 "$word" "${arguments[@]}"
  done <refusals
}

files() { find . -mindepth 1 -not -name out -not -name err | sort; }

# Files named as in --describe, made by <maker>: garbage or nothing at all. Sets inputs and outputs.
place_files() {
  rm -rf work
  mkdir "work"
  inputs=() outputs=()
  while IFS=$'\t' read -r channel kind example; do
    local path="work/$channel of mine/$example"
    mkdir -p "$(dirname "$path")"
    if [ "$channel" = input ]; then inputs+=("$path"); else outputs+=("$path"); fi
    [ "$channel" = input ] || continue
    if [ "$kind" = folder ]; then mkdir -p "$path"; else "$1" >"$path"; fi
  done < <(python3 "$here/answers.py" --files describe)
}

garbage() { head -c 3000 /dev/zero | tr '\0' 'g'; }
nothing() { :; }

bad_inputs() {
  place_files garbage
  [ ${#inputs[@]} -gt 0 ] || return 0
  for maker in garbage nothing; do
    place_files "$maker"
    local before
    before=$(files)
    expect "2 3" "$(basename "${inputs[0]}")" "${inputs[@]}" "${outputs[@]}"
    [ "$before" = "$(files)" ] || die "a failed run left something behind: $(files | tr '\n' ' ')"
  done
  mv "${inputs[0]}" gone
  expect 3 "$(basename "${inputs[0]}")" "${inputs[@]}" "${outputs[@]}"
  mv gone "${inputs[0]}"
  expect "2" "" "${inputs[@]}"  # outputs missing
  grep -q '"several"' describe || expect 2 "too many" "${inputs[@]}" "${outputs[@]}" extra
}

existing_outputs() {
  place_files garbage
  [ ${#outputs[@]} -gt 0 ] || return 0
  for output in "${outputs[@]}"; do
    echo mine >"$output"
    expect 2 "$(basename "$output")" "${inputs[@]}" "${outputs[@]}"
    [ "$(cat "$output")" = mine ] || die "$output was overwritten"
    rm "$output"
  done
  expect 2 "no-such-folder" "${inputs[@]}" "${outputs[@]/#work/no-such-folder}"
}

for program in $(cat "$bin/../programs.txt"); do
  [ -x "$bin/$program" ] || die "not built"
  questions
  refusals
  if ! grep -q '"commands"' describe; then
    bad_inputs
    existing_outputs
  fi
  expect 2 "" # no arguments at all
done
