# A Debian that has nothing, for checks of what a stranger meets. Source it after common.sh; in this order:
#   enter_own_mounts "$@"; make_bare_system SUITE [PACKAGE...]; clone_into_bare FOLDER; in_bare USER FOLDER COMMAND

bare_failed() { printf '\nFailed: %s\n' "$*" >&2; exit 1; }

# Starts the calling script again where its mounts are its own: the machine never sees them, and they end with it.
enter_own_mounts() {
    [ "${SLIPFACE_OWN_MOUNTS:-}" = 1 ] && return 0
    [ "$(id -u)" -eq 0 ] || bare_failed "making a system needs root. Try: sudo $0 $*"
    command -v mmdebstrap >/dev/null || bare_failed "mmdebstrap is missing. Install it: apt-get install mmdebstrap"
    unshare --mount --pid --fork true 2>/dev/null ||
        bare_failed "this machine does not let root make mount and process namespaces (unshare), as some containers do"
    SLIPFACE_OWN_MOUNTS=1 exec unshare --mount --propagation private "$0" "$@"
}

# make_bare_system SUITE [PACKAGE...]: bookworm, trixie, testing or any other that the mirror has. Sets $bare, its folder, and
# removes it when the script ends.
make_bare_system() {
    local suite=$1
    shift
    scratch=$(mktemp -d "${TMPDIR:-/tmp}/slipface-bare.XXXXXX")
    bare=$scratch/root
    child=
    trap 'remove_bare_system' EXIT
    trap 'exit 130' INT
    trap 'exit 143' TERM HUP
    chmod 755 "$scratch"

    # Where this machine gets its packages is where the new system gets them: by the same list if both are the same Debian, else
    # from the mirror that apt knows.
    local sources=() name mirror
    if grep -qx "VERSION_CODENAME=$suite" /etc/os-release; then
        for name in /etc/apt/sources.list /etc/apt/sources.list.d/*.list /etc/apt/sources.list.d/*.sources; do
            [ ! -s "$name" ] || sources+=("$name")
        done
    else
        mirror=$(apt-get indextargets 'Identifier: Packages' 'Label: Debian' --format '$(REPO_URI)' 2>/dev/null | sed -n 1p)
        [ -z "$mirror" ] || sources=("$mirror")
    fi
    # How it gets them (proxies, certificates, time-outs), but not what its packages want apt to run.
    apt-config dump | grep '^Acquire::' | grep -v ' "";$' >"$scratch/apt.conf" || true
    for name in http https; do
        local variable=${name}_proxy
        [ -z "${!variable:-}" ] || echo "Acquire::$name::Proxy \"${!variable}\";" >>"$scratch/apt.conf"
    done

    say "Making a bare Debian ($suite)"
    local packages=git,ca-certificates${1:+,$(IFS=,; echo "$*")}
    mmdebstrap --quiet --mode=root --variant=minbase --include="$packages" --aptopt="$scratch/apt.conf" \
        --setup-hook='for d in /etc/apt/keyrings /usr/share/keyrings /etc/apt/trusted.gpg.d; do
            [ ! -d "$d" ] || { mkdir -p "$1$d"; cp -n "$d"/* "$1$d/" 2>/dev/null || true; }; done' \
        "$suite" "$bare" "${sources[@]}" </dev/null ||
        bare_failed "mmdebstrap made no system: see above. Does this machine reach a Debian mirror, and may root mount?"
    cp -L /etc/resolv.conf "$bare/etc/resolv.conf"
    mount --rbind /dev "$bare/dev" || bare_failed "this machine does not let root mount /dev in $bare"
    in_bare root / true || bare_failed "this machine does not let root chroot to $bare"
}

remove_bare_system() {
    trap - EXIT
    [ -z "$child" ] || kill -KILL "$child" 2>/dev/null || true
    umount --recursive --lazy "$bare/dev" 2>/dev/null || true
    rm -rf --one-file-system "$scratch"
}

# in_bare USER FOLDER COMMAND: runs it with an empty environment and no input. What it leaves running ends with it.
in_bare() {
    unshare --pid --fork --kill-child --mount-proc="$bare/proc" chroot "$bare" \
        su - "$1" -c "cd $2 && $3" </dev/null &
    child=$!
    local code=0
    wait "$child" || code=$?
    child=
    return "$code"
}

# watch_bare NAME USER FOLDER COMMAND: the same, with its output in a file; prints the headlines with the seconds since the
# start, and at the end the times, or else the last lines and what is missing.
watch_bare() {
    local log=$scratch/log code=0 start=$SECONDS line out
    local TIMEFORMAT="$1 took %0R s, and %0U + %0S s of processor time"
    exec {out}> >(tee "$log" | while IFS= read -r line; do
        [[ $line != *'==> '* ]] || printf '%5d s  %s\n' $((SECONDS - start)) "${line#*==> }"
    done)
    local watcher=$!
    time in_bare "$2" "$3" "$4" >&"$out" 2>&1 || code=$?
    exec {out}>&-
    wait "$watcher"
    [ "$code" -eq 0 ] && return 0
    grep -v '^same ' "$log" | grep -A 30 '\*\*\*Failed' | head -n 120 || true
    tail -n 40 "$log"
    mkdir -p out && cp "$log" out/bare.log && echo "All that it printed: out/bare.log"
    scripts/missing_packages.sh "$log"
    bare_failed "$1 ended with $code"
}

# clone_into_bare FOLDER: the current commit, as a clone would bring it.
clone_into_bare() {
    [ -z "$(git status --porcelain)" ] || echo "Note: what is not committed is not looked at."
    git clone --quiet --depth 1 "file://$PWD" "$bare$1"
}
