// game [LEVEL]: W A S D or the arrows walk, space jumps, the mouse turns the camera, Escape pauses and ends.
// game LEVEL --seconds S [--image FILE]: without a window; somebody starts the game and walks from coin to
// coin. Prints the score. With 0 seconds the picture is that of the title.
#include <slipface/render/gl_graphics.h>

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>

#include "game_screens.h"

using namespace slipface;

static int complain(const std::string& text) {
    return std::fprintf(stderr, "game: %s\n", text.c_str()), 2;
}

static GameScreen& top(const Screens& screens) {
    return static_cast<GameScreen&>(*screens.top());
}

static void draw(Screens& screens, GlGraphics& graphics, int width, int height) {
    graphics.style.overlay = 0.0F;  // textures without the colours of the surface types
    graphics.ellipsoid_fill = {0.95F, 0.70F, 0.20F, 0.95F};
    graphics.begin_frame(top(screens).camera(), width, height);
    screens.draw(graphics);
    if (const Status drawn = graphics.end_frame(); !drawn) complain(drawn.error().text());
}

// To the nearest coin; a jump where the way is blocked.
static Buttons walker(const Game& game, Vec3& before) {
    Buttons buttons;
    const Vec3 here = game.player().position();
    const Coin* nearest = nullptr;
    for (const Coin* coin : game.coins())
        if (nearest == nullptr || (coin->position - here).norm() < (nearest->position - here).norm())
            nearest = coin;
    if (nearest == nullptr) return buttons;
    const Vec3 to = nearest->position - here;
    buttons.turn = 0.1 * std::remainder(std::atan2(-to.x(), -to.z()) - game.yaw(), 6.283185307179586);
    buttons.stick = {0.0, 1.0};
    // Along the coin's direction, however the camera stands.
    const double away = std::atan2(-to.x(), -to.z()) - game.yaw() - buttons.turn;
    buttons.stick = {-std::sin(away), std::cos(away)};
    buttons.jump = (here - before).norm() < 0.5 * Game::dt * game.player().settings.walk_speed;
    before = here;
    return buttons;
}

static int without_window(Screens& screens, double seconds, const char* image) {
    if (seconds > 0.0) screens.input({.key = go_on});
    if (auto* const play = dynamic_cast<Play*>(screens.top())) {
        const Game& game = play->game();
        Vec3 before = game.player().position();
        const std::size_t all = game.coins().size();
        int ticks = 0;
        for (; ticks < seconds / Game::dt && screens.top() == play; ++ticks) {
            play->buttons = walker(game, before);
            screens.tick(Game::dt);
        }
        if (screens.top() == play)
            std::printf("%d of %zu coins, %d deaths in %.0f s\n", game.collected(), all, game.deaths(),
                        ticks * Game::dt);
        else
            std::printf("%zu of %zu coins in %.0f s\n", all, all, ticks * Game::dt);
    }
    if (image == nullptr) return 0;
    auto context = make_offscreen_context();
    if (!context) return complain(context.error().text());
    Framebuffer target((*context)->gl(), 1280, 720);
    GlGraphics graphics((*context)->gl());
    target.bind();
    draw(screens, graphics, target.width(), target.height());
    const Status saved = save_png(image, target.read());
    return saved ? 0 : complain(saved.error().text());
}

static Buttons pressed(GLFWwindow* window, double& mouse_x, double& mouse_y) {
    const auto down = [&](int a, int b) {
        return glfwGetKey(window, a) == GLFW_PRESS || glfwGetKey(window, b) == GLFW_PRESS ? 1.0 : 0.0;
    };
    Buttons buttons;
    buttons.stick = {down(GLFW_KEY_D, GLFW_KEY_RIGHT) - down(GLFW_KEY_A, GLFW_KEY_LEFT),
                     down(GLFW_KEY_W, GLFW_KEY_UP) - down(GLFW_KEY_S, GLFW_KEY_DOWN)};
    buttons.jump = down(GLFW_KEY_SPACE, GLFW_KEY_SPACE) > 0.0;
    double x = 0.0, y = 0.0;
    glfwGetCursorPos(window, &x, &y);
    buttons.turn = 0.003 * (mouse_x - x);
    buttons.tilt = 0.003 * (y - mouse_y);
    mouse_x = x;
    mouse_y = y;
    return buttons;
}

static void on_key(GLFWwindow* window, int key, int, int action, int) {
    auto& screens = *static_cast<Screens*>(glfwGetWindowUserPointer(window));
    if (action == GLFW_REPEAT) return;
    if (key == GLFW_KEY_ESCAPE) screens.input({pause_or_back, action == GLFW_PRESS});
    if (key == GLFW_KEY_SPACE || key == GLFW_KEY_ENTER) screens.input({go_on, action == GLFW_PRESS});
}

static int in_window(Screens& screens) {
    if (glfwInit() == GLFW_FALSE) return complain("no display; try --seconds 20 --image game.png");
    glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 3);
    glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
    glfwWindowHint(GLFW_SAMPLES, 4);
    GLFWwindow* const window = glfwCreateWindow(1280, 720, "Coins", nullptr, nullptr);
    if (window == nullptr) return glfwTerminate(), complain("no window with OpenGL 3.3");
    glfwMakeContextCurrent(window);
    glfwSetInputMode(window, GLFW_CURSOR, GLFW_CURSOR_DISABLED);
    glfwSetInputMode(window, GLFW_STICKY_KEYS,
                     GLFW_TRUE);  // a key that is pressed and released within a frame
    glfwSetWindowUserPointer(window, &screens);
    glfwSetKeyCallback(window, on_key);
    const Result<GlTable> gl = load_gl_table(glfwGetProcAddress);
    if (gl) {
        GlGraphics graphics(*gl);
        double mouse_x = 0.0, mouse_y = 0.0, begun = glfwGetTime();
        glfwGetCursorPos(window, &mouse_x, &mouse_y);
        while (glfwWindowShouldClose(window) == GLFW_FALSE && !screens.empty()) {
            glfwPollEvents();
            if (screens.empty()) break;
            Buttons buttons = pressed(window, mouse_x, mouse_y);
            // As many ticks as time went by, but no more than a quarter of a second's.
            begun = std::max(begun, glfwGetTime() - 0.25);
            for (; begun + Game::dt <= glfwGetTime(); begun += Game::dt) {
                if (auto* const play = dynamic_cast<Play*>(screens.top())) play->buttons = buttons;
                screens.tick(Game::dt);
                buttons.turn = buttons.tilt = 0.0;
            }
            int width = 0, height = 0;
            glfwGetFramebufferSize(window, &width, &height);
            draw(screens, graphics, width, height);
            glfwSwapBuffers(window);
            glfwSetWindowTitle(window, ("Coins: " + top(screens).status()).c_str());
        }
    }
    glfwDestroyWindow(window);
    glfwTerminate();
    return gl ? 0 : complain(gl.error().text());
}

int main(int count, char** words) {
    const char *level = "assets/levels/island.obj", *image = nullptr;
    double seconds = -1.0;
    for (int i = 1; i < count; ++i) {
        if (std::strcmp(words[i], "--seconds") == 0 && i + 1 < count)
            seconds = std::atof(words[++i]);
        else if (std::strcmp(words[i], "--image") == 0 && i + 1 < count)
            image = words[++i];
        else
            level = words[i];
    }
    Result<std::unique_ptr<Game>> game = Game::open(level);
    if (!game) return complain(game.error().text());
    Screens screens;
    screens.push(std::make_unique<Title>(std::move(*game)));
    return seconds >= 0.0 ? without_window(screens, seconds, image) : in_window(screens);
}
