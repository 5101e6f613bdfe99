#!/usr/bin/env bash
# What a change costs: how many tracked files name an existing metric, command, route, setting, migration or modality,
# in their text or their path, by words that only it has. Another of its kind touches about as many.
#   tests/repo/change_cost.sh            a table
#   tests/repo/change_cost.sh --files    the files of each example too
#   tests/repo/change_cost.sh --check    exit 1 when an example has more files than its limit, or none at all
# Benchmarks, the changelog and this script do not count: they record changes; nor do wrong calls, which pick any command.
set -u
cd "$(dirname "$0")" || exit 2
if ! top=$(git rev-parse --show-toplevel 2>/dev/null); then
  echo 'skipped: this is no git checkout, so nothing tells which files are tracked' >&2
  exit 77
fi
cd "$top" || exit 2
mode=${1:-}
case $mode in '' | --files | --check) ;; *)
  sed -n '2,7p' "tests/repo/change_cost.sh" >&2
  exit 2
  ;;
esac

# example KIND NAME LIMIT WORDS [PATHS...]: LIMIT "-" is none; WORDS an extended regular expression; PATHS as git
# takes them, the whole tree when there are none.
examples() {
  # One that happens at a moment, or rules another out, is also in the table of those.
  example 'metric, in a table that is there' advance_in_breath 7 '\badvance_in_breath\b'
  example 'metric, in a table that is there' plane_angle_max 7 '\bplane_angle_max\b'
  # Its own file, the list of commands, its page, and the examples, which a test types in one order.
  example 'command' 'case mesh' 4 '\bcase_mesh\b|\bcase mesh\b'
  example 'command, that acts' 'cohort list' 6 '\bcohort_list\b|\bcohort list\b'
  example 'route' '/cases/{case_id}/checks.json' - 'checks\.json|checks_json\b'
  example 'setting, with its migration' breath_irregularity 7 'breath[_-]irregularity'
  example 'setting, with its migration' breath_depth - 'breath[_-]depth'
  example 'migration' '0010_motion' - '0010_motion|training_case_keeps_its_motion'
  example 'modality, in the product' xray - '\bModality::xray\b' ':!tests'
  example 'modality, in the tests' xray - '\bModality::xray\b' tests
}

failed=0
example() {
  local kind=$1 name=$2 limit=$3 words=$4 files count note=''
  shift 4
  local where=("$@" ':!docs/benchmarks' ':!CHANGELOG.md' ':!tests/e2e/wrong_calls.txt' ':!tests/repo/change_cost.sh')
  files=$({
    git grep -lIP -e "$words" -- "${where[@]}"
    git ls-files -- "${where[@]}" | grep -P -e "$words"
  } | sort -u)
  count=$(printf '%s' "$files" | grep -c '')
  if [ "$count" -eq 0 ]; then
    note='  not found: is the example gone?' failed=1
  elif [ "$limit" != - ] && [ "$count" -gt "$limit" ]; then
    note='  above its limit' failed=1
  fi
  printf '%-34s %-30s %5d %5s%s\n' "$kind" "$name" "$count" "$limit" "$note"
  if [ "$mode" = --files ] && [ -n "$files" ]; then printf '%s\n' "$files" | sed 's/^/    /'; fi
}

printf '%-34s %-30s %5s %5s\n' kind example files most
examples
if [ "$mode" = --check ] && [ "$failed" -ne 0 ]; then exit 1; fi
exit 0
