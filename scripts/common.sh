# Shared by run.sh, test.sh and .ci/run: progress, packages, configure and build. Source it from the top folder.
# Exit codes: 1 a step failed, 69 packages cannot be had here, 73 the disk is too full, 77 root or sudo is needed.
. scripts/packages.sh

say() { printf '\n\033[1m==> %s\033[0m\n' "$*"; }

# stop CODE SENTENCE: nothing can be done here, and this is why.
stop() {
    printf '\n%s\n' "$2" >&2
    exit "$1"
}

# step TEXT COMMAND...: says what it does, does it, and on failure names the command to run by hand. After half a minute or
# more it says how long it took.
step() {
    say "$1"
    shift
    local start=$SECONDS
    if "$@"; then
        [ $((SECONDS - start)) -lt 30 ] || echo "($((SECONDS - start)) s)"
        return 0
    fi
    printf '\nFailed. To see it again, run by hand:\n    %s\n' "$*" >&2
    exit 1
}

is_installed() { [ "$(dpkg-query -W -f '${db:Status-Status}' "$1" 2>/dev/null)" = installed ]; }

# missing_packages ROW...: fills `missing` with what the rows of packages.sh lack here, and `unknown` with the rows of which apt
# offers nothing.
missing_packages() {
    missing=() unknown=()
    local row name names absent=()
    local -A offered=()
    for row in "$@"; do
        IFS='|' read -ra names <<<"$row"
        for name in "${names[@]}"; do is_installed "$name" && continue 2; done
        absent+=("$row")
    done
    [ ${#absent[@]} -gt 0 ] || return 0
    IFS='| ' read -ra names <<<"${absent[*]}"
    while read -r name; do offered[$name]=yes; done < <(LC_ALL=C apt-cache policy "${names[@]}" 2>/dev/null |
        awk '/^[^ ]/ {name = $1} /Candidate: [^(]/ {sub(/:$/, "", name); print name}')
    for row in "${absent[@]}"; do
        IFS='|' read -ra names <<<"$row"
        for name in "${names[@]}"; do [ "${offered[$name]:-}" ] && missing+=("$name") && continue 2; done
        [[ $row == *'|' ]] || unknown+=("$row")
    done
}

# need_room KIB FOLDER [KIB FOLDER]...: stops if a file system has less room than all that is to come onto it.
need_room() {
    local -A wanted=() free=() place=()
    local disk
    while [ $# -gt 0 ]; do
        read -r disk free_kib < <(df --output=target,avail -k "$2" | tail -n 1)
        wanted[$disk]=$((${wanted[$disk]:-0} + $1)) free[$disk]=$free_kib place[$disk]=$2
        shift 2
    done
    for disk in "${!wanted[@]}"; do
        [ "${wanted[$disk]}" -le "${free[$disk]}" ] || stop 73 "The disk of ${place[$disk]} is too full: $((
            ${wanted[$disk]} / 1024)) MB are needed and $((${free[$disk]} / 1024)) MB are free."
    done
}

# What building writes, in KiB. test.sh says more.
build_kib=800000

# install_packages ROW...: what is missing of these rows of packages.sh, through apt; nothing at all when nothing is.
install_packages() {
    command -v apt-get >/dev/null && command -v dpkg-query >/dev/null || stop 69 "This system has no apt-get: install what\
 scripts/packages.sh lists by your system's means, then run: cmake -B build -G Ninja && cmake --build build"
    missing_packages "$@"
    [ $((${#missing[@]} + ${#unknown[@]})) -gt 0 ] || return 0
    local sudo=() wanted="${missing[*]} ${unknown[*]%%|*}"
    if [ "$(id -u)" -ne 0 ]; then
        command -v sudo >/dev/null ||
            stop 77 "Installing packages needs root, and there is no sudo. As root: apt-get install $wanted"
        sudo true || stop 77 "Installing packages needs root, and sudo refused. As root: apt-get install $wanted"
        sudo=(sudo)
    fi
    say "Updating the package list"
    local apt=("${sudo[@]}" env DEBIAN_FRONTEND=noninteractive apt-get -q -o DPkg::Lock::Timeout=300) reached=
    "${apt[@]}" -o APT::Update::Error-Mode=any update && reached=yes
    missing_packages "$@"
    if [ ${#unknown[@]} -gt 0 ]; then
        [ "$reached" ] ||
            stop 69 "apt reached none of its servers (is there a network?) and does not know ${unknown[*]}; nothing was installed."
        stop 69 "$(. /etc/os-release 2>/dev/null; echo "${PRETTY_NAME:-This system}") offers no package ${unknown[*]};\
 nothing was installed."
    fi
    [ ${#missing[@]} -gt 0 ] || return 0
    local installed downloaded
    read -r installed downloaded < <(apt-get -q -s -o Debug::NoLocking=1 --no-install-recommends install "${missing[@]}" |
        awk '/^Inst/ {print $2}' | xargs -r apt-cache show --no-all-versions 2>/dev/null |
        awk '/^Installed-Size:/ {i += $2} /^Size:/ {d += $2} END {printf "%d %d\n", i, d / 1024}')
    need_room "$installed" /usr "$downloaded" /var/cache/apt "$build_kib" . # before anything is installed
    say "Downloading ${#missing[@]} packages and what they need ($((downloaded / 1024)) MB): ${missing[*]}"
    "${apt[@]}" install -y --no-install-recommends --download-only "${missing[@]}" ||
        stop 69 "The packages could not be downloaded (is there a network?); nothing was installed."
    step "Installing them ($((installed / 1024)) MB)" "${apt[@]}" install -y --no-install-recommends "${missing[@]}"
}

# configure PRESET and build PRESET [TARGET...]: only what is out of date. `program` is `release` without its tests and `ci` is
# `release` where warnings are errors, in the same folder, so that ./test.sh after ./run.sh builds nothing twice, and ./run.sh
# after ./test.sh leaves the tests in.
configure() {
    local folder=build/$1 lacks=-
    case $1 in
        program) folder=build/release ;;
        release) lacks=SLIPFACE_TESTS:BOOL=OFF ;;
        ci) folder=build/release lacks=SLIPFACE_WERROR:BOOL=OFF ;;
    esac
    [ ! -f "$folder/build.ninja" ] || grep -q "^$lacks" "$folder/CMakeCache.txt" || return 0
    [ -f "$folder/CMakeCache.txt" ] || need_room "$build_kib" .
    step "Configuring ($1)" cmake --preset "$1" --log-level=WARNING
}
build() {
    local preset=$1
    shift
    step "Building ($preset)" scripts/with_progress.sh cmake --build --preset "$preset" ${1:+--target "$@"}
}
