# The packages that each purpose needs, by the names of Debian. In a row `a|b` means the first of them that this system's apt
# offers, and a `|` at the end that it may offer none. So the rows hold for releases and derivatives that nobody knew when they
# were written. Sourced by common.sh.

# What building and running needs.
packages=(
    build-essential cmake ninja-build 'pkg-config|pkgconf'
    libimgui-dev libstb-dev libglfw3-dev 'libosmesa6|' libegl1 libgl1-mesa-dri
    libassimp-dev libdraco-dev libmeshoptimizer-dev libeigen3-dev python3-glad nlohmann-json3-dev libcli11-dev libfmt-dev libtbb-dev libdeflate-dev libwebp-dev
    fonts-inter fonts-font-awesome
)
# What the tests need besides.
test_packages=(libgtest-dev libgmock-dev librapidcheck-dev libbenchmark-dev librecast-dev
    pybind11-dev python3-dev python3-numpy)
# What the checks of .ci/run need besides.
check_packages=(clang clang-format clang-tidy libclang-rt-dev mmdebstrap python3-yaml abigail-tools appstream xvfb xdotool)
command -v node > /dev/null || check_packages+=(nodejs) # asks the site's search

# What the editor as a page needs (scripts/build_web.sh), and its test in a browser (scripts/check_web.sh).
web_packages=(emscripten brotli libfast-float-dev)
web_check_packages=(chromium)
command -v npm > /dev/null || web_check_packages+=(npm) # some packages of node have it in them, and conflict with Debian's

# What the documents as a site need (scripts/build_docs.sh).
docs_packages=(mkdocs mkdocs-material doxygen fonts-inter python3)

# What the build for Windows needs, and its tests (scripts/check_windows.sh).
windows_packages=(g++-mingw-w64-x86-64-posix wine64 wine googletest)
