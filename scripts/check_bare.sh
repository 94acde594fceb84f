#!/usr/bin/env bash
# check_bare.sh [SUITE] [--run] [--user]: makes a Debian (bookworm, or trixie, testing, any other) that has nothing but git and
# ca-certificates, clones the current commit into it, and runs there ./run.sh and ./test.sh (with --run only the first) as root,
# or with --user as a user with sudo. Says what is missing when that fails, and how long each part took. Needs root, mmdebstrap and 3 GB below $TMPDIR, which
# are free again when it ends, however it ends.
set -euo pipefail
cd "$(dirname "$0")/.."
. scripts/common.sh
. scripts/bare_system.sh

commands=(./run.sh ./test.sh) as_user= suite=bookworm
for argument in "$@"; do
    case $argument in
        --run) commands=(./run.sh) ;;
        --user) as_user=stranger ;;
        [a-z]*) suite=$argument ;;
        *) echo "check_bare.sh: found $argument, expected a suite, --run or --user" >&2; exit 64 ;;
    esac
done

enter_own_mounts "$@"
make_bare_system "$suite" ${as_user:+sudo}
home=/root
if [ -n "$as_user" ]; then
    home=/home/$as_user
    in_bare root / "useradd --create-home --shell /bin/bash $as_user"
    echo "$as_user ALL=(ALL) NOPASSWD: ALL" >"$bare/etc/sudoers.d/$as_user"
fi
clone_into_bare "$home/slipface"
[ -z "$as_user" ] || in_bare root / "chown -R $as_user: $home/slipface"

for command in "${commands[@]}"; do
    say "$command as ${as_user:-root}"
    watch_bare "$command" "${as_user:-root}" "$home/slipface" "$command"
    [ "$command" = ./run.sh ] || continue
    for picture in editor.png level.png; do
        [ -s "$bare$home/slipface/out/$picture" ] || bare_failed "./run.sh wrote no out/$picture"
    done
done
say "A bare Debian ($suite) runs ${commands[*]} as ${as_user:-root}"
