#include "game_screens.h"

#include <cmath>
#include <map>

using namespace slipface;

// A word of small balls, three by five for a letter, in front of the camera: Graphics has no text.
static void draw_word(Graphics& graphics, const Camera& camera, const std::string& word) {
    static const std::map<char, const char*> letters = {{'A', "010101111101101"}, {'C', "011100100100011"},
                                                        {'D', "110101101101110"}, {'E', "111100110100111"},
                                                        {'I', "111010010010111"}, {'N', "110101101101101"},
                                                        {'O', "010101101101010"}, {'P', "110101110100100"},
                                                        {'S', "011100010001110"}, {'U', "101101101101111"}};
    const Vec3 ahead = (camera.target - camera.eye).normalized();
    const Vec3 right = ahead.cross(Vec3::UnitY()).normalized(), up = right.cross(ahead);
    constexpr double dot = 0.13;
    const double width = 4.0 * static_cast<double>(word.size()) - 1.0;
    for (std::size_t i = 0; i < word.size(); ++i) {
        const auto letter = letters.find(word[i]);
        for (int at = 0; letter != letters.end() && at < 15; ++at) {
            if (letter->second[at] != '1') continue;
            const double x = 4.0 * static_cast<double>(i) + at % 3 - 0.5 * (width - 1.0), y = 5.0 - at / 3;
            graphics.draw_ellipsoid(camera.eye + 3.0 * ahead + dot * (x * right + y * up),
                                    Vec3::Constant(0.5 * dot));
        }
    }
}

void Title::on_tick(double seconds) {
    age_s_ += seconds;
    game_->tick({});
}

void Title::on_draw(Graphics& graphics) {
    game_->draw(graphics);
    draw_word(graphics, camera(), "COINS");
}

void Title::on_input(const ScreenInput& input) {
    if (!input.pressed) return;
    if (input.key == pause_or_back) return screens().clear();
    screens().replace(std::make_unique<Play>(std::move(game_)));
}

Camera Title::camera() const {
    Camera camera = game_->camera();
    const double angle = 0.2 * age_s_;
    camera.eye = camera.target + Vec3(8.0 * std::sin(angle), 3.5, 8.0 * std::cos(angle));
    return camera;
}

void Play::on_tick(double) {
    game_->tick(buttons);
    buttons.turn = buttons.tilt = 0.0;
    if (game_->coins().empty()) screens().replace(std::make_unique<End>(std::move(game_)));
}

void Play::on_input(const ScreenInput& input) {
    if (input.pressed && input.key == pause_or_back) screens().push(std::make_unique<Pause>(*this));
}

std::string Play::status() const {
    return std::to_string(game_->collected()) + " collected, " + std::to_string(game_->coins().size()) +
           " left, " + std::to_string(game_->deaths()) + " deaths";
}

void Pause::on_draw(Graphics& graphics) {
    draw_word(graphics, camera(), "PAUSE");
}

void Pause::on_input(const ScreenInput& input) {
    if (!input.pressed) return;
    if (input.key == pause_or_back) return screens().clear();
    screens().pop();
}

void End::on_draw(Graphics& graphics) {
    game_->draw(graphics);
    draw_word(graphics, camera(), "DONE");
}

void End::on_input(const ScreenInput& input) {
    if (input.pressed) screens().clear();
}
