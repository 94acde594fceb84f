#!/usr/bin/env bash
# with_progress.sh COMMAND...: runs a command that builds with ninja, and instead of ninja's lines shows the step that it has
# reached and about how long the rest takes. Everything else that the command prints stays.
set -euo pipefail

# rest SECONDS DONE ALL: the time for the rest if its steps take as long as those done.
rest() {
    local seconds=$(($1 * ($3 - $2) / $2))
    if [ "$seconds" -ge 90 ]; then
        echo "about $(((seconds + 30) / 60)) minutes left"
    else
        echo "less than $((seconds / 30 * 30 + 30)) seconds left"
    fi
}

mark=$'\1' shown=-10
[ -t 1 ] && every=1 || every=15
NINJA_STATUS="$mark%f %t " "$@" 2>&1 | while IFS= read -r line; do
    if [[ $line != *"$mark"* ]]; then
        [ "$every" -gt 1 ] || printf '\r\033[K'
        printf '%s\n' "$line"
        continue
    fi
    read -r done all _ <<<"${line##*"$mark"}"
    [ $((SECONDS - shown)) -ge "$every" ] || [ "$done" = "$all" ] || continue
    shown=$SECONDS
    text="step $done of $all"
    # The first steps say little.
    [ "$SECONDS" -lt 10 ] || [ "$done" -lt 5 ] || [ "$done" = "$all" ] || text+=", $(rest "$SECONDS" "$done" "$all")"
    [ "$every" -gt 1 ] && printf '%s\n' "$text" || printf '\r\033[K%s' "$text"
done
[ "$every" -gt 1 ] || echo
