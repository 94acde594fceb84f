#include "slipface/sim/recorded_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "slipface/base/files.h"
#include "slipface/base/text.h"

namespace slipface {
namespace {

struct Wrong {
    std::string found, expected;
};

std::string shortened(std::string_view text) {
    return fmt::format("\"{}\"", text.size() > 60 ? std::string(text.substr(0, 57)) + "..." : text);
}

double number(std::string_view text, double low, double high) {
    const std::optional<double> value = parse_double(trim(text));
    if (!value || *value < low || *value > high)
        throw Wrong{shortened(text), fmt::format("a number from {} to {}", low, high)};
    return *value;
}

constexpr double far_away = 1e7;

class RunReader {
  public:
    // "name value", of a line "# name value" of CSV and of the members of JSON's first line.
    void header(std::string_view name, std::string_view value) {
        if (name == "slipface-run" || name == "slipface_run")
            number(value, 1, 1);
        else if (name == "position" && (value == "feet" || value == "centre"))
            centre_ = value == "centre";
        else if (name == "position")
            throw Wrong{shortened(value), "feet or centre"};
        else if (name == "radius")
            run.radius = number(value, 0.01, 100);
        else if (name == "height")
            run.height = number(value, 0.02, 1000);
        else if (name == "walk_speed")
            run.walk_speed = number(value, 0.01, 1000);
        else if (name == "rate")
            rate_ = number(value, 1, 10000);
        else if (name == "scale")
            scale_ = number(value, 1e-6, 1e6);
        else if (name == "axes")
            axes(value);
        // Anything else is a comment.
    }
    void tick(const std::array<std::optional<double>, 7>& cells) {
        const auto& [t, x, y, z, wish_x, wish_z, jump] = cells;
        if (!x || !y || !z) throw Wrong{"a row without x, y and z", "a position"};
        if (run.ticks.size() >= max_recorded_ticks)
            throw Wrong{"more ticks", fmt::format("at most {}", max_recorded_ticks)};
        RecordedTick made;
        const Vec3 as_written(*x, *y, *z);
        for (int i = 0; i < 3; ++i)
            made.feet[i] = scale_ * signs_[i] * as_written[from_[static_cast<std::size_t>(i)]];
        const double before = run.ticks.empty() ? 0.0 : run.ticks.back().time_s;
        made.time_s = t ? *t : before + 1.0 / rate_;
        if (!run.ticks.empty() && !(made.time_s - before >= 1e-4 && made.time_s - before <= 10.0))
            throw Wrong{fmt::format("the time {} after {}", made.time_s, before),
                        "times that ascend, by 0.0001 to 10 s"};
        if (wish_x && wish_z) made.wish = Vec2(*wish_x, *wish_z);
        made.jump = jump && *jump != 0.0;
        run.ticks.push_back(made);
    }
    Result<RecordedRun> result(const std::filesystem::path& file) {
        if (run.ticks.size() < 3)
            return Error{file.string(), fmt::format("found {} ticks, expected 3 or more", run.ticks.size())};
        if (run.height < 2.0 * run.radius)
            return Error{file.string(), fmt::format("found a height of {} m, expected twice the radius, {} m",
                                                    run.height, 2.0 * run.radius)};
        if (centre_)
            for (RecordedTick& tick : run.ticks)
                tick.feet.y() -= 0.5 * run.height;
        return std::move(run);
    }

    RecordedRun run;

  private:
    // "x,z,-y": which of the file's axes are the level's x, y and z.
    void axes(std::string_view value) {
        const std::vector<std::string_view> names = split(value, ',');
        std::array<bool, 3> used{};
        if (names.size() != 3) throw Wrong{shortened(value), "three axes such as x,z,-y"};
        for (std::size_t i = 0; i < 3; ++i) {
            std::string_view name = trim(names[i]);
            signs_[static_cast<Eigen::Index>(i)] = name.starts_with('-') ? -1.0 : 1.0;
            if (name.starts_with('-')) name.remove_prefix(1);
            if (name != "x" && name != "y" && name != "z")
                throw Wrong{shortened(value), "three axes such as x,z,-y"};
            from_[i] = name[0] - 'x';
            if (std::exchange(used[static_cast<std::size_t>(from_[i])], true))
                throw Wrong{shortened(value), "each axis once"};
        }
    }

    bool centre_ = false;
    double rate_ = 60.0, scale_ = 1.0;
    std::array<int, 3> from_{0, 1, 2};
    Vec3 signs_ = Vec3::Ones();
};

constexpr std::array<std::string_view, 7> columns{"t", "x", "y", "z", "wish_x", "wish_z", "jump"};

class CsvLines {
  public:
    explicit CsvLines(RunReader& reader) : reader_(reader) {}

    void line(std::string_view text) {
        if (text.starts_with('#')) {
            const std::string_view words = trim(text.substr(1));
            const std::size_t space = words.find(' ');
            if (space != std::string_view::npos)
                reader_.header(words.substr(0, space), trim(words.substr(space)));
            return;
        }
        const std::vector<std::string_view> cells = split(text, ',');
        if (order_.empty()) return names(cells);
        if (cells.size() != order_.size())
            throw Wrong{fmt::format("{} cells", cells.size()),
                        fmt::format("{}, as in the first row", order_.size())};
        std::array<std::optional<double>, 7> row{};
        for (std::size_t i = 0; i < cells.size(); ++i)
            if (order_[i] < columns.size() && !trim(cells[i]).empty())
                row[order_[i]] = number(cells[i], -far_away, far_away);
        reader_.tick(row);
    }

  private:
    void names(const std::vector<std::string_view>& cells) {
        for (const std::string_view cell : cells) {
            const auto found = std::find(columns.begin(), columns.end(), to_lower(trim(cell)));
            order_.push_back(static_cast<std::size_t>(found - columns.begin()));
        }
        for (const std::size_t needed : {1U, 2U, 3U})
            if (std::find(order_.begin(), order_.end(), needed) == order_.end())
                throw Wrong{"a first row without it", fmt::format("a column {}", columns[needed])};
    }
    RunReader& reader_;
    std::vector<std::size_t> order_;  // [cell] index into columns; beyond it: another column
};

using Json = nlohmann::json;

double number(const Json& value) {
    const double found = value.is_number() ? value.get<double>() : far_away * 2;
    if (!(std::abs(found) <= far_away))
        throw Wrong{"something else", fmt::format("a number up to {}", far_away)};
    return found;
}

void json_line(RunReader& reader, std::string_view text) {
    const Json json = Json::parse(text);
    if (!json.is_object()) throw Wrong{"no object", "an object per line"};
    if (json.contains("slipface_run")) {
        for (const auto& entry : json.items())
            if (entry.value().is_primitive())
                reader.header(entry.key(), entry.value().is_string() ? entry.value().get<std::string>()
                                                                     : entry.value().dump());
        return;
    }
    std::array<std::optional<double>, 7> row{};
    const auto vector = [&](const char* name, std::size_t count, std::size_t first) {
        const auto found = json.find(name);
        if (found == json.end()) return;
        if (!found->is_array() || found->size() != count)
            throw Wrong{fmt::format("another {}", name), fmt::format("{} numbers", count)};
        for (std::size_t i = 0; i < count; ++i)
            row[first + i] = number((*found)[i]);
    };
    vector("position", 3, 1);
    vector("wish", 2, 4);
    if (json.contains("t")) row[0] = number(json["t"]);
    if (json.contains("jump")) row[6] = json["jump"] == true ? 1.0 : 0.0;
    reader.tick(row);
}

}  // namespace

Result<RecordedRun> read_recorded_run(const std::filesystem::path& file) {
    const Result<std::string> bytes = read_file(file, std::uint64_t{512} << 20);
    if (!bytes) return bytes.error();
    RunReader reader;
    CsvLines csv(reader);
    const std::size_t begin = bytes->find_first_not_of(" \t\r\n");
    const bool json = begin != std::string::npos && (*bytes)[begin] == '{';
    std::size_t line = 0;
    for (std::size_t at = 0; at < bytes->size();) {
        const std::size_t end = std::min(bytes->find('\n', at), bytes->size());
        const std::string_view text = trim(std::string_view(*bytes).substr(at, end - at));
        at = end + 1;
        ++line;
        if (text.empty()) continue;
        const std::string location = fmt::format("{}:{}", file.string(), line);
        try {
            json ? json_line(reader, text) : csv.line(text);
        } catch (const Wrong& wrong) {
            return Error{location, "found " + wrong.found + ", expected " + wrong.expected};
        } catch (const Json::exception&) {
            return Error{location, "found " + shortened(text) + ", expected JSON"};
        }
    }
    return reader.result(file);
}

}  // namespace slipface
