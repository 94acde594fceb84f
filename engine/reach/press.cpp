#include "slipface/reach/press.h"

#include <array>
#include <cmath>

namespace slipface {
namespace {

constexpr std::uint32_t quarter = press_directions / 4;

// Each halving of the step puts a direction between two: their sum, made unit.
std::array<Vec2, press_directions> make_directions() {
    std::array<Vec2, press_directions> all;
    all[0] = Vec2(1, 0);
    all[quarter] = Vec2(0, 1);
    all[2 * quarter] = Vec2(-1, 0);
    all[3 * quarter] = Vec2(0, -1);
    for (std::uint32_t step = quarter / 2; step > 0; step /= 2) {
        for (std::uint32_t i = step; i < press_directions; i += 2 * step) {
            const Vec2 sum = all[i - step] + all[(i + step) % press_directions];
            all[i] = sum / std::sqrt(sum.x() * sum.x() + sum.y() * sum.y());
        }
    }
    return all;
}

constexpr std::array<double, 4> strengths{0.0, 1.0, 0.5, 0.25};

}  // namespace

Vec2 direction_vector(std::uint32_t direction) {
    static const std::array<Vec2, press_directions> all = make_directions();
    return all[direction % press_directions];
}

std::uint8_t stick_towards(const Vec2& way) {
    std::uint32_t nearest = 0;
    for (std::uint32_t direction = 1; direction < press_directions; ++direction)
        if (direction_vector(direction).dot(way) > direction_vector(nearest).dot(way)) nearest = direction;
    return full_stick(nearest);
}

PlayerInput input_of(const Press& press) {
    const double strength = strengths[press.stick / press_directions];
    PlayerInput input;
    input.buttons.bits = press.buttons;
    if (strength > 0.0) input.wish = strength * direction_vector(press.stick);
    return input;
}

}  // namespace slipface
