# shellcheck shell=bash
# Messages and logs of ./dev and of the scripts that it calls: they source this file, with the root of
# the repository as the current folder.

logs=build/logs

say() { printf 'dev: %s\n' "$*"; }
fail() {
  printf 'dev: %s\n' "$*" >&2
  exit 1
}

# logged NAME COMMAND...: runs quietly and shows the end of the log only on failure.
logged() {
  local name=$1
  shift
  mkdir -p "$logs"
  if ! "$@" >"$logs/$name.log" 2>&1 </dev/null; then
    tail -n 40 "$logs/$name.log" >&2
    fail "'$*' failed; the whole log is in $logs/$name.log"
  fi
}
