// The buttons of a player beside the stick: one table, from which tapes, scripts, C, Python, keys, gamepads
// and docs/settings.md have their names.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

namespace slipface {

enum class Button : std::uint8_t { jump, crouch, dash, grab, drop };

struct ButtonInfo {
    Button button;
    const char* name;     // "jump", as in tapes and in Python
    const char* label;    // "Jump"
    const char* key;      // in the playtest, by its place on a US keyboard: "Space"
    const char* pad;      // of a gamepad, as an Xbox names it: "A"
    const char* meaning;  // which ability reads it
};

// In the order of the enum.
std::span<const ButtonInfo> button_table();
const ButtonInfo* find_button(std::string_view name);  // null: none of that name

// Buttons, one bit each: those of the table in the order of the enum, and from `first_own` on those of a
// game, which no ability of the engine reads. A tape has names for these (Tape::own_buttons).
//
//   PlayerInput input{.wish = {0, -1}, .buttons = Button::jump};
//   input.buttons.set(Button::dash, pad.is_down(1));
//   if (input.buttons.has(Button::jump)) ...
struct ButtonSet {
    static constexpr std::size_t first_own = 8, capacity = 32;
    std::uint32_t bits = 0;

    constexpr ButtonSet() = default;
    constexpr ButtonSet(Button button, bool held = true) { set(button, held); }
    constexpr bool has(Button button) const { return ((bits >> static_cast<unsigned>(button)) & 1U) != 0; }
    constexpr void set(Button button, bool held = true) {
        const std::uint32_t bit = std::uint32_t{1} << static_cast<unsigned>(button);
        bits = held ? bits | bit : bits & ~bit;
    }
    // Those of either.
    friend constexpr ButtonSet operator|(ButtonSet a, ButtonSet b) {
        a.bits |= b.bits;
        return a;
    }
    friend bool operator==(const ButtonSet&, const ButtonSet&) = default;
};

struct MovementSettings;
// Those that an ability reads which is on: what looks for ways through a level presses these.
ButtonSet buttons_read(const MovementSettings& settings);

}  // namespace slipface
