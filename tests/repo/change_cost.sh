#!/usr/bin/env bash
# What a change costs: how many tracked files name an existing metric, command, route, setting, migration or modality,
# in their text or their path, by words that only it has; and how many of these are written by hand, not by
# `seldinger help --…` or a test. Another of its kind touches about as many.
#   tests/repo/change_cost.sh            a table
#   tests/repo/change_cost.sh --files    the files of each example too
#   tests/repo/change_cost.sh --check    exit 1 when more of an example's files are by hand than its limit, or it has none
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
  sed -n '2,8p' "tests/repo/change_cost.sh" >&2
  exit 2
  ;;
esac

# example KIND NAME LIMIT WORDS [PATHS...]: LIMIT, of those by hand, "-" is none; WORDS an extended regular expression;
# PATHS as git takes them, the whole tree when there are none.
examples() {
  # One that happens at a moment, or rules another out, is also in the table of those.
  example 'metric, in a table that is there' advance_in_breath 5 '\badvance_in_breath\b'
  example 'metric, in a table that is there' plane_angle_max 5 '\bplane_angle_max\b'
  # Its own file, the list of commands, and the examples, which a test types in one order.
  example 'command' 'case mesh' 3 '\bcase_mesh\b|\bcase mesh\b'
  # Its errors too.
  example 'command, that acts' 'cohort list' 4 '\bcohort_list\b|\bcohort list\b'
  example 'route' '/cases/{case_id}/checks.json' - 'checks\.json|checks_json\b'
  # Not the migrations that made anew a trigger which names it.
  example 'setting, with its migration' breath_irregularity 5 'breath[_-]irregularity' ':!migrations/0039*' ':!migrations/0046*'
  example 'setting, with its migrations' breath_depth - 'breath[_-]depth'
  example 'migration' '0010_motion' - '0010_motion|training_case_keeps_its_motion'
  example 'modality, in the product' xray - '\bModality::xray\b' ':!tests'
  example 'modality, in the tests' xray - '\bModality::xray\b' tests
}

made='^(docs/(commands|metrics|differences|errors|statistics|routes|steps)\.md|migrations/schema\.sql)$'
failed=0
example() {
  local kind=$1 name=$2 limit=$3 words=$4 files count hand note=''
  shift 4
  local where=("$@" ':!docs/benchmarks' ':!CHANGELOG.md' ':!tests/e2e/wrong_calls.txt' ':!tests/repo/change_cost.sh')
  files=$({
    git grep -lIP -e "$words" -- "${where[@]}"
    git ls-files -- "${where[@]}" | grep -P -e "$words"
  } | sort -u)
  count=$(printf '%s' "$files" | grep -c '')
  hand=$(printf '%s' "$files" | grep -cvE "$made")
  if [ "$count" -eq 0 ]; then
    note='  not found: is the example gone?' failed=1
  elif [ "$limit" != - ] && [ "$hand" -gt "$limit" ]; then
    note='  above its limit' failed=1
  fi
  printf '%-34s %-30s %5d %7d %5s%s\n' "$kind" "$name" "$count" "$hand" "$limit" "$note"
  if [ "$mode" = --files ] && [ -n "$files" ]; then printf '%s\n' "$files" | sed 's/^/    /'; fi
}

printf '%-34s %-30s %5s %7s %5s\n' kind example files 'by hand' most
examples
if [ "$mode" = --check ] && [ "$failed" -ne 0 ]; then exit 1; fi
exit 0
