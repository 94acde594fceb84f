#include <cstdint>
#include <cstdio>
#include <fstream>
#include <string>
#include <vector>

template <class T>
std::vector<T> take(std::ifstream& file, std::size_t count) {
    std::vector<T> values(count);
    file.read(reinterpret_cast<char*>(values.data()), static_cast<std::streamsize>(count * sizeof(T)));
    return values;
}

int main(int argc, char** argv) {
    std::ifstream file(argc > 1 ? argv[1] : "level.flat", std::ios::binary);
    const auto magic = take<char>(file, 8);
    const auto count = take<std::uint32_t>(file, 5);  // version, types, fields, vertices, triangles
    if (!file || std::string(magic.begin(), magic.end()) != "slipflat" || count[0] != 1) return 2;
    const auto fields = take<char>(file, 32 * count[2]);  // "friction", "restitution", ...
    std::vector<std::string> names;
    std::vector<std::vector<float>> parameters;
    for (std::uint32_t type = 0; type < count[1]; ++type) {
        names.emplace_back(take<char>(file, 32).data());
        parameters.push_back(take<float>(file, count[2]));
    }
    const auto vertices = take<float>(file, 3 * count[3]);  // x, y, z
    const auto triangles = take<std::uint32_t>(file, 3 * count[4]);
    const auto type_of_triangle = take<std::uint8_t>(file, count[4]);

    std::vector<int> triangles_of(names.size());
    for (const std::uint8_t type : type_of_triangle)
        ++triangles_of.at(type);
    for (std::size_t type = 0; type < names.size(); ++type)
        std::printf("%-12s %6d triangles, %s %g\n", names[type].c_str(), triangles_of[type], fields.data(),
                    parameters[type][0]);
    return file ? 0 : 2;
}
