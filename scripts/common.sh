# Shared by run.sh, test.sh and .ci/run: progress, packages, configure and build. Source it from the top folder.

say() { printf '\n\033[1m==> %s\033[0m\n' "$*"; }

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

# What building and running needs.
packages=(
    build-essential cmake ninja-build pkg-config
    libimgui-dev libstb-dev libglfw3-dev libosmesa6 libegl1 libgl1-mesa-dri
    libassimp-dev libeigen3-dev python3-glad nlohmann-json3-dev libcli11-dev libfmt-dev libtbb-dev libdeflate-dev
    fonts-inter fonts-font-awesome
)
# What the tests need besides.
test_packages=(libgtest-dev libgmock-dev librapidcheck-dev libbenchmark-dev librecast-dev
    pybind11-dev python3-dev python3-numpy)
# What the checks of .ci/run need besides.
check_packages=(clang clang-format clang-tidy libclang-rt-14-dev mmdebstrap python3-yaml)

# What the editor as a page needs (scripts/build_web.sh), and its test in a browser (scripts/check_web.sh).
web_packages=(emscripten brotli libfast-float-dev)
web_check_packages=(chromium)
command -v npm > /dev/null || web_check_packages+=(npm) # some packages of node have it in them, and conflict with Debian's

# What the documents as a site need (scripts/build_docs.sh).
docs_packages=(mkdocs mkdocs-material doxygen fonts-inter python3)

# install_packages NAME...: those that are missing, through apt; nothing at all when none is.
install_packages() {
    local missing=() name
    for name in "$@"; do
        [ "$(dpkg-query -W -f '${db:Status-Status}' "$name" 2>/dev/null)" = installed ] || missing+=("$name")
    done
    [ ${#missing[@]} -eq 0 ] && return 0
    local sudo=()
    if [ "$(id -u)" -ne 0 ]; then
        command -v sudo >/dev/null || { echo "Please install as root: apt-get install ${missing[*]}" >&2; exit 1; }
        sudo=(sudo)
    fi
    step "Updating the package list" "${sudo[@]}" apt-get update -q
    step "Installing ${#missing[@]} packages: ${missing[*]}" \
        "${sudo[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -q -y --no-install-recommends "${missing[@]}"
}

# configure PRESET and build PRESET [TARGET...]: only what is out of date. `program` is `release` without its tests, in the
# same folder, so that ./test.sh after ./run.sh builds nothing twice, and ./run.sh after ./test.sh leaves the tests in.
configure() {
    local cache=build/$1/CMakeCache.txt
    [ "$1" != program ] || cache=build/release/CMakeCache.txt
    if [ -f "${cache%/*}/build.ninja" ]; then
        [ "$1" = release ] && grep -q '^SLIPFACE_TESTS:BOOL=OFF' "$cache" || return 0
    fi
    step "Configuring ($1)" cmake --preset "$1" --log-level=WARNING
}
build() {
    local preset=$1
    shift
    step "Building ($preset)" cmake --build --preset "$preset" ${1:+--target "$@"}
}
