# A compiler that is too old is named here, not by the first file that it does not understand.
if(EMSCRIPTEN)
    return()  # web/stand_ins has what its library lacks
endif()
include(CheckCXXSourceCompiles)
check_cxx_source_compiles("
    #include <algorithm>
    #include <bit>
    #include <charconv>
    #include <compare>
    #include <concepts>
    #include <ranges>
    #include <span>
    #include <vector>
    struct Point { double x = 0, y = 0; auto operator<=>(const Point&) const = default; };
    int main() {
        std::vector<Point> points{{.x = 1, .y = 2}};
        std::ranges::sort(points, {}, &Point::y);
        double number = 0;
        const char text[] = \"2.5\";
        std::from_chars(text, text + 3, number);
        return static_cast<int>(std::bit_cast<unsigned long long>(number) >> 63) + static_cast<int>(std::span(points).size()) - 1;
    }" SLIPFACE_CXX20_WORKS)
if(NOT SLIPFACE_CXX20_WORKS)
    message(FATAL_ERROR "${CMAKE_CXX_COMPILER} (${CMAKE_CXX_COMPILER_ID} ${CMAKE_CXX_COMPILER_VERSION}) lacks parts of C++20 that "
        "Slipface is written in; GCC 12 and clang 14 have them: cmake -DCMAKE_CXX_COMPILER=g++-12 ...")
endif()
