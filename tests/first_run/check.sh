#!/usr/bin/env bash
# check.sh SOURCE SCRATCH COMPILER: what ./run.sh says where it cannot work. Its PATH is a folder in which apt, sudo, id and df are
# scripts that play a system; what they were asked to do is written to a log, so that nothing was installed is known and not believed.
set -euo pipefail
source=$1 scratch=$2 compiler=$3
rm -rf "$scratch"
mkdir -p "$scratch"
cd "$source"
failures=0

# new_system: one with apt that offers and can download everything, with nothing installed, for root, on a large disk.
new_system() {
    system=$scratch/system
    rm -rf "$system"
    mkdir -p "$system"
    for name in bash env dirname realpath grep awk xargs tail cat; do ln -s "$(command -v "$name")" "$system/$name"; done
    play dpkg-query 'exit 1'
    play id 'echo 0'
    play df 'echo "Mounted Avail"; echo "/ 99000000"'
    play apt-cache 'case $1 in show) printf "Installed-Size: 1000\nSize: 500000\n" ;; esac
[ "$1" = policy ] || exit 0
shift
for name in "$@"; do
    echo "$name:"
    case $name in gone | old | $(cat "${0%/*}/lacks")) echo "  Candidate: (none)" ;; *) echo "  Candidate: 1.0" ;; esac
done'
    echo nothing >"$system/lacks"
    play apt-get 'case "$*" in *" -s "*) echo "Inst something (1.0)" ;; esac'
}
play() { printf '#!%s\necho "%s $*" >>"%s/log"\n%s\n' "$(command -v bash)" "$1" "$system" "$2" >"$system/$1" && chmod +x "$system/$1"; }

# expect TEXT CODE WORDS: run.sh ends with the code, its complaint is one line with the words in it, and nothing was installed.
expect() {
    local code=0 complaint
    env -i PATH="$system" "$system/bash" ./run.sh >"$scratch/out" 2>"$scratch/complaint" </dev/null || code=$?
    complaint=$(grep -v '^$' "$scratch/complaint" || true)
    if [ "$code" -ne "$2" ] || [[ $complaint != *"$3"* ]] || [ "$(wc -l <<<"$complaint")" -ne 1 ]; then
        printf '%s: found code %s and\n%s\nexpected code %s and one line with "%s"\n' "$1" "$code" "$complaint" "$2" "$3"
        failures=1
    fi
    if grep '^apt-get.* install ' "$system/log" 2>/dev/null | grep -v -e ' -s ' -e --download-only; then
        echo "$1: something was installed"
        failures=1
    fi
}

new_system
rm "$system/apt-get"
expect "no apt" 69 "no apt-get"

new_system
play id 'echo 1000'
expect "no sudo" 77 "there is no sudo"
play sudo 'exit 1'
expect "sudo refuses" 77 "sudo refused"

new_system
play apt-get 'case "$*" in *update*) exit 100 ;; esac'
echo '*' >"$system/lacks"
expect "no network, no lists" 69 "is there a network?"

new_system
echo libimgui-dev >"$system/lacks"
expect "a package that no server has" 69 "offers no package libimgui-dev"

new_system
play apt-get 'case "$*" in *--download-only*) exit 100 ;; *" -s "*) echo "Inst something (1.0)" ;; esac'
expect "the network ends" 69 "could not be downloaded"

new_system
play df 'echo "Mounted Avail"; echo "/ 50000"'
expect "a full disk" 73 "too full"

# A row's first package that apt offers is installed, and an optional row that it does not know is left out.
new_system
env -i PATH="$system" "$system/bash" -c '. scripts/common.sh && install_packages "old|new" "gone|"' >"$scratch/out" 2>&1 || failures=1
if ! grep -q 'install -y --no-install-recommends new$' "$system/log"; then
    echo "alternatives: apt-get was called so:"
    grep apt-get "$system/log"
    failures=1
fi

# A compiler that is too old.
printf '#!/bin/sh\nexec %s "$@" -std=c++17\n' "$compiler" >"$scratch/old" && chmod +x "$scratch/old"
if cmake -S . -B "$scratch/build" -DCMAKE_CXX_COMPILER="$scratch/old" >"$scratch/out" 2>&1 ||
    ! tr -s ' \n' ' ' <"$scratch/out" | grep -q 'lacks parts of C++20 that Slipface is written in'; then
    echo "an old compiler: CMake said"
    tail "$scratch/out"
    failures=1
fi

# Progress: ninja's lines become steps, what a compiler says stays, and so does the exit code.
code=0
scripts/with_progress.sh bash -c 'for i in 1 2 3; do printf "%s\n" "${NINJA_STATUS//%f/$i}Building" | sed s/%t/3/; done
    echo "a.cpp:1: error"; exit 3' >"$scratch/out" || code=$?
if [ "$code" -ne 3 ] || ! grep -q 'step 3 of 3' "$scratch/out" || ! grep -qx 'a.cpp:1: error' "$scratch/out"; then
    echo "progress: found code $code and"
    cat "$scratch/out"
    failures=1
fi
exit $failures
