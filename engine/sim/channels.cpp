#include "slipface/sim/channels.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "slipface/base/text.h"

namespace slipface {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

const TickSample& at(const TapeRun& run, std::size_t tick) {
    return run.samples()[tick];
}

double gravity(const TapeRun& run, std::size_t tick) {
    return run.tape().changes.empty() ? run.settings().gravity : run.settings_at(tick).gravity;
}

constexpr RunChannel channels[] = {
    {"x", "", "m", "Position of the centre", false,
     [](const TapeRun& run, std::size_t tick) { return at(run, tick).position.x(); }},
    {"y", "", "m", "Position of the centre", false,
     [](const TapeRun& run, std::size_t tick) { return at(run, tick).position.y(); }},
    {"z", "", "m", "Position of the centre", false,
     [](const TapeRun& run, std::size_t tick) { return at(run, tick).position.z(); }},
    {"vx", "", "m/s", "Velocity of the state, with what presses onto the ground", false,
     [](const TapeRun& run, std::size_t tick) { return at(run, tick).velocity.x(); }},
    {"vy", "", "m/s", "Velocity", false,
     [](const TapeRun& run, std::size_t tick) { return at(run, tick).velocity.y(); }},
    {"vz", "", "m/s", "Velocity", false,
     [](const TapeRun& run, std::size_t tick) { return at(run, tick).velocity.z(); }},
    {"speed", "Speed", "m/s", "Of the motion; at rest 0", false,
     [](const TapeRun& run, std::size_t tick) { return at(run, tick).motion().norm(); }},
    {"horizontal_speed", "Horizontal speed", "m/s", "Length of the horizontal part of the velocity", false,
     [](const TapeRun& run, std::size_t tick) {
         const Vec3& v = at(run, tick).velocity;
         return std::sqrt(v.x() * v.x() + v.z() * v.z());
     }},
    {"height", "Height", "m", "Of the feet, in the level's coordinates", false,
     [](const TapeRun& run, std::size_t tick) {
         const TickSample& sample = at(run, tick);
         return sample.position.y() - body_radii(run.settings(), {.crouched = sample.crouched}).y();
     }},
    {"vertical_speed", "Vertical speed", "m/s", "Upwards; at rest 0", false,
     [](const TapeRun& run, std::size_t tick) { return at(run, tick).motion().y() + 0.0; }},
    {"energy", "Energy", "J/kg", "Kinetic energy plus potential energy above the start, per kilogram", false,
     [](const TapeRun& run, std::size_t tick) {
         const TickSample& sample = at(run, tick);
         return 0.5 * sample.motion().squaredNorm() +
                gravity(run, tick) * (sample.position.y() - run.start().y());
     }},
    {"slope", "Slope", "deg", "Slope of the ground contact", false,
     [](const TapeRun& run, std::size_t tick) {
         const TickSample& sample = at(run, tick);
         if (sample.ground_face == no_id) return nan;
         // C libraries differ in the last bits.
         constexpr double steps = 1e9;
         const double slope = std::acos(std::clamp(sample.ground_normal.y(), -1.0, 1.0));
         return std::round(slope * 180.0 / std::numbers::pi * steps) / steps;
     }},
    {"grounded", "Grounded", "", "1 while the player stands on something", true,
     [](const TapeRun& run, std::size_t tick) { return at(run, tick).grounded ? 1.0 : 0.0; }},
    {"contacts", "Contacts", "", "Contacts in the tick", true,
     [](const TapeRun& run, std::size_t tick) { return static_cast<double>(at(run, tick).contacts); }},
    {"climbing", "", "", "1 while on a ladder", true,
     [](const TapeRun& run, std::size_t tick) { return at(run, tick).climbing ? 1.0 : 0.0; }},
    {"stuck", "", "", "1 while a sticky surface holds the player", true,
     [](const TapeRun& run, std::size_t tick) { return at(run, tick).stuck ? 1.0 : 0.0; }},
    {"hanging", "", "", "1 while the player hangs from a ledge", true,
     [](const TapeRun& run, std::size_t tick) { return at(run, tick).hanging ? 1.0 : 0.0; }},
    {"crouched", "", "", "1 while the body is crouched", true,
     [](const TapeRun& run, std::size_t tick) { return at(run, tick).crouched ? 1.0 : 0.0; }},
    {"wish_x", "Stick X", "", "The stick, to +X", true,
     [](const TapeRun& run, std::size_t tick) { return run.input_at(tick).wish.x(); }},
    {"wish_z", "Stick Z", "", "The stick, to +Z", true,
     [](const TapeRun& run, std::size_t tick) { return run.input_at(tick).wish.y(); }},
    {"push_outs", "", "", "How often the player was pushed out of geometry", true,
     [](const TapeRun& run, std::size_t tick) { return static_cast<double>(at(run, tick).push_outs); }},
};

std::string csv_text(std::string_view text) {
    if (text.find_first_of(",\"\n\r") == std::string_view::npos) return std::string(text);
    std::string quoted = "\"";
    for (const char c : text)
        quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
    return quoted + "\"";
}

}  // namespace

std::span<const RunChannel> run_channels() {
    return channels;
}

std::string run_csv(const TapeRun& run, SurfaceTable surfaces) {
    std::string csv = "tick,time_s";
    for (const RunChannel& channel : channels)
        csv += std::string(",") + channel.name;
    csv += ",buttons,surface";
    for (const SettingInfo* hack : hack_rows())
        csv += std::string(",") + hack->name;
    csv += '\n';
    for (std::size_t tick = 0; tick < run.samples().size(); ++tick) {
        const TickSample& sample = run.samples()[tick];
        csv += fmt::format("{},{}", tick, to_text(static_cast<double>(tick + 1) * run.dt()));
        for (const RunChannel& channel : channels) {
            const double value = channel.value(run, tick);
            csv += ',';
            if (std::isfinite(value)) csv += to_text(value);
        }
        csv += ',';
        for (const std::string& button : button_names(run.tape(), run.input_at(tick).buttons))
            csv += (csv.back() == ',' ? "" : " ") + button;
        const bool known = sample.ground_face != no_id && sample.surface < surfaces.size();
        csv += ',' + (known ? csv_text(surfaces[sample.surface].name) : std::string());
        for (std::size_t row = 0; row < hack_rows().size(); ++row)
            csv += (sample.acted >> row) & 1 ? ",1" : ",0";
        csv += '\n';
    }
    return csv;
}

}  // namespace slipface
