// Rules from Quake 3's surface parameters. Source: the public Quake III source, qcommon/qfiles.h (lumps of a
// BSP).
#include "quake.h"

#include <fmt/format.h>

#include <algorithm>

#include "slipface/base/text.h"
#include "slipface/mesh/bsp_flags.h"

namespace slipface {
namespace {

constexpr std::size_t max_rules = 100'000;
constexpr std::size_t max_warnings = 100;

void need_type(const char* name, std::vector<SurfaceType>& types) {
    const auto named = [&](const SurfaceType& type) { return type.name == name; };
    if (std::none_of(types.begin(), types.end(), named)) types.push_back(found_surface_type(name));
}

void add_rule(const std::string& pattern, const char* type, ImportedRules& out) {
    need_type(type, out.types);
    MaterialRule rule{pattern, type};
    if (std::find(out.rules.begin(), out.rules.end(), rule) == out.rules.end())
        out.rules.push_back(std::move(rule));
}

// The words and braces of a shader text with their lines; `//` and `/* */` are comments.
class ShaderWords {
  public:
    explicit ShaderWords(std::string_view text) : text_(text) {}

    std::string_view next() {
        skip();
        if (at_ == text_.size()) return {};
        if (text_[at_] == '{' || text_[at_] == '}') return text_.substr(at_++, 1);
        const std::size_t begin = at_;
        while (at_ < text_.size() && static_cast<unsigned char>(text_[at_]) > ' ' && text_[at_] != '{' &&
               text_[at_] != '}')
            ++at_;
        return text_.substr(begin, at_ - begin);
    }
    std::size_t line() const { return line_; }

  private:
    void skip() {
        while (at_ < text_.size()) {
            const std::string_view rest = text_.substr(at_, 2);
            if (rest == "//") {
                at_ = std::min(text_.find('\n', at_), text_.size());
            } else if (rest == "/*") {
                const std::size_t end = std::min(text_.find("*/", at_ + 2), text_.size());
                line_ += static_cast<std::size_t>(std::count(text_.begin() + static_cast<std::ptrdiff_t>(at_),
                                                             text_.begin() + static_cast<std::ptrdiff_t>(end),
                                                             '\n'));
                at_ = std::min(end + 2, text_.size());
            } else if (static_cast<unsigned char>(text_[at_]) <= ' ') {
                if (text_[at_++] == '\n') ++line_;
            } else {
                return;
            }
        }
    }

    std::string_view text_;
    std::size_t at_ = 0;
    std::size_t line_ = 1;
};

class ShaderReader {
  public:
    ShaderReader(std::string_view text, const std::string& location) : words_(text), location_(location) {}

    Result<ImportedRules> run() {
        for (std::string_view name = words_.next(); !name.empty(); name = words_.next()) {
            if (name == "{" || name == "}") return unexpected(name, "a shader's name");
            if (auto open = words_.next(); open != "{")
                return unexpected(open, "'{' after the shader's name");
            if (auto status = read_shader(std::string(name)); !status) return status.error();
            if (out_.rules.size() > max_rules) return Error{location_, "gives more than 100000 rules"};
        }
        return std::move(out_);
    }

  private:
    Status read_shader(const std::string& name) {
        const BspParameter* found = nullptr;
        for (std::size_t depth = 1; depth > 0;) {
            const std::string_view word = words_.next();
            if (word.empty()) return unexpected(word, "'}' at the end of shader " + name);
            if (word == "{") ++depth;
            if (word == "}") --depth;
            if (to_lower(word) != "surfaceparm") continue;
            const BspParameter* parameter = known(words_.next());
            if (parameter != nullptr && parameter->type != nullptr && (found == nullptr || parameter < found))
                found = parameter;
        }
        if (found == nullptr) return {};
        add_rule(name, found->type, out_);
        if (const std::size_t slash = name.rfind('/'); slash != std::string::npos)
            add_rule(name.substr(slash + 1), found->type, out_);
        return {};
    }

    const BspParameter* known(std::string_view word) {
        const std::string name = to_lower(word);
        const std::span<const BspParameter> all = bsp_parameters();
        const auto found =
            std::find_if(all.begin(), all.end(), [&](const BspParameter& one) { return name == one.name; });
        if (found != all.end()) return &*found;
        if (out_.warnings.size() < max_warnings)
            out_.warnings.push_back(
                {fmt::format("{}:{}", location_, words_.line()),
                 fmt::format("the surface parameter \"{:.40}\" is unknown: ignored", name)});
        return nullptr;
    }

    Error unexpected(std::string_view found, const std::string& expected) const {
        return Error{fmt::format("{}:{}", location_, words_.line()),
                     found.empty() ? "found the end of the file, expected " + expected
                                   : fmt::format("found \"{:.40}\", expected {}", found, expected)};
    }

    ShaderWords words_;
    const std::string& location_;
    ImportedRules out_;
};

}  // namespace

Result<ImportedRules> read_shaders(std::string_view text, const std::string& location) {
    return ShaderReader(text, location).run();
}

Result<ImportedRules> read_bsp_flags(std::string_view bytes, const std::string& location) {
    const auto textures = bsp_textures(bytes, location);
    if (!textures) return textures.error();
    if (textures->size() > max_rules) return Error{location, "gives more than 100000 rules"};
    ImportedRules out;
    for (const auto& [name, type] : *textures)
        if (type != nullptr && !name.empty()) add_rule(std::string(name), type, out);
    return out;
}

}  // namespace slipface
