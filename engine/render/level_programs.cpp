#include "level_programs.h"

#include <string>

#include "level_shaders.h"

namespace slipface {

LevelPrograms::~LevelPrograms() {
    for (const unsigned program : programs_)
        gl_->DeleteProgram(program);  // 0 is ignored
}

Result<unsigned> LevelPrograms::get(unsigned variant) {
    unsigned& program = programs_[variant];
    if (program != 0) return program;
    std::string head = "#version 330 core\n";
    constexpr const char* names[] = {"PAINTED", "LIT", "TEXTURED", "CUTOUT", "PLACED", "POSED"};
    for (unsigned bit = 0; bit < 6; ++bit)
        if ((variant >> bit & 1U) != 0) head.append("#define ").append(names[bit]).append("\n");
    const Result<unsigned> linked =
        link_program(*gl_, "level", head + level_vertex_shader,
                     head + level_fragment_shader_head + level_fragment_shader_main);
    if (linked) program = *linked;
    return linked;
}

}  // namespace slipface
