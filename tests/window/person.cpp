#include "person.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <cmath>
#include <condition_variable>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <mutex>
#include <optional>

#include "slipface/base/text.h"

namespace slipface {
namespace {

constexpr double longest_wait_s = 10.0;
constexpr double still_s = 0.15;  // without a frame: the window has settled

double now_s() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

}  // namespace

// Xvfb chooses a free display and writes its number.
struct Person::Screen {
    Screen(int width, int height) {
        int numbers[2];
        if (pipe(numbers) != 0) return;
        server = fork();
        if (server == 0) {
            close(numbers[0]);
            const std::string size = std::to_string(width) + "x" + std::to_string(height) + "x24";
            const std::string descriptor = std::to_string(numbers[1]);
            std::freopen("/dev/null", "w", stderr);
            execlp("Xvfb", "Xvfb", "-displayfd", descriptor.c_str(), "-screen", "0", size.c_str(),
                   "-nolisten", "tcp", static_cast<char*>(nullptr));
            _exit(127);
        }
        close(numbers[1]);
        std::string name = ":";
        char letter = 0;
        while (read(numbers[0], &letter, 1) == 1 && letter != '\n')
            name += letter;
        close(numbers[0]);
        started = name.size() > 1;
        if (started) setenv("DISPLAY", name.c_str(), 1);
    }
    ~Screen() {
        if (server > 0) {
            kill(server, SIGTERM);
            waitpid(server, nullptr, 0);
        }
    }
    pid_t server = -1;
    bool started = false;
};

struct Person::Questions {
    std::mutex mutex;
    std::condition_variable answered;
    const std::function<void(App&)>* asked = nullptr;
    std::atomic<bool> closed = false;
    double last_frame_s = 0.0;
    int frames = -1;
};

void Person::use(WindowOptions options, const std::function<void(Person&)>& act) {
    const Screen screen(options.width, options.height);
    ASSERT_TRUE(screen.started) << "Xvfb does not start";
    Questions questions;
    std::atomic<bool> opened = false;
    options.between_turns = [&](App& app) {
        opened = true;
        const std::scoped_lock lock(questions.mutex);
        if (const int frames = ImGui::GetFrameCount(); frames != questions.frames) {
            questions.frames = frames;
            questions.last_frame_s = now_s();
        }
        if (!questions.asked) return;
        (*questions.asked)(app);
        questions.asked = nullptr;
        questions.answered.notify_all();
    };
    std::thread hands([&] {
        while (!opened && !questions.closed)
            std::this_thread::sleep_for(std::chrono::milliseconds(20));
        if (questions.closed) return;
        Person person;
        person.questions_ = &questions;
        person.hands_ = popen("xdotool -", "w");
        person.send("search --onlyvisible --class slipface windowfocus");
        person.settle();
        act(person);
        pclose(person.hands_);
        person.look([](App& app) { app.editor().quit = true; });
    });
    const Status status = run_window(options);
    questions.closed = true;
    questions.answered.notify_all();
    hands.join();
    EXPECT_TRUE(status.ok()) << status.error().text();
}

void Person::look(const std::function<void(App&)>& look) {
    std::unique_lock lock(questions_->mutex);
    if (questions_->closed) return;
    questions_->asked = &look;
    while (questions_->asked && !questions_->closed) {
        glfwPostEmptyEvent();
        questions_->answered.wait_for(lock, std::chrono::milliseconds(50));
    }
    questions_->asked = nullptr;
}

bool Person::wait_for(const std::function<bool(App&)>& question) {
    for (const double end = now_s() + longest_wait_s; now_s() < end; rest(0.02))
        if (truth(question)) return true;
    return truth(question);
}

void Person::settle() {
    rest(0.03);
    const auto still = [&] {
        const std::scoped_lock lock(questions_->mutex);
        return questions_->frames >= 0 && now_s() - questions_->last_frame_s > still_s;
    };
    for (const double end = now_s() + longest_wait_s; now_s() < end; rest(0.03)) {
        if (!still()) continue;
        look([](App&) {});  // a long frame may be in the making
        if (still()) return;
    }
}

void Person::send(const std::string& line) {
    std::fputs((line + "\n").c_str(), hands_);
    std::fflush(hands_);
}

void Person::move_to(ImVec2 to) {
    constexpr int steps = 5;
    const ImVec2 from = at_;
    for (int i = 1; i <= steps; ++i) {
        const float part = static_cast<float>(i) / steps;
        at_ = {std::round(from.x + (to.x - from.x) * part), std::round(from.y + (to.y - from.y) * part)};
        send("mousemove " + std::to_string(static_cast<int>(at_.x)) + " " +
             std::to_string(static_cast<int>(at_.y)));
        rest(0.012);
    }
    wait_for([at = at_](App&) {
        const ImVec2 mouse = ImGui::GetIO().MousePos;
        return std::abs(mouse.x - at.x) <= 1.0f && std::abs(mouse.y - at.y) <= 1.0f;
    });
}

void Person::press(int button) {
    send("mousedown " + std::to_string(button));
    rest(0.05);
}
void Person::release(int button) {
    send("mouseup " + std::to_string(button));
    settle();
}

void Person::click(ImVec2 at, int button) {
    move_to(at);
    rest(0.03);
    press(button);
    move_to({at.x + 1, at.y});
    rest(0.08);
    release(button);
}

void Person::double_click(ImVec2 at) {
    move_to(at);
    rest(0.03);
    for (int i = 0; i < 2; ++i) {
        send("mousedown 1");
        rest(0.05);
        send("mouseup 1");
        rest(0.07);
    }
    settle();
}

void Person::drag(ImVec2 from, ImVec2 to, int button) {
    move_to(from);
    rest(0.03);
    press(button);
    constexpr int steps = 14;
    for (int i = 1; i <= steps; ++i) {
        const float part = static_cast<float>(i) / steps, jitter = i % 2 == 0 ? 1.0f : -1.0f;
        at_ = {std::round(from.x + (to.x - from.x) * part),
               std::round(from.y + (to.y - from.y) * part + jitter)};
        send("mousemove " + std::to_string(static_cast<int>(at_.x)) + " " +
             std::to_string(static_cast<int>(at_.y)));
        rest(0.02);
    }
    move_to(to);
    release(button);
}

void Person::wheel(int notches) {
    for (int i = 0; i < std::abs(notches); ++i) {
        send(std::string("click ") + (notches > 0 ? "4" : "5"));
        rest(0.04);
    }
    settle();
}

void Person::key(const std::string& name) {
    send("key --clearmodifiers " + name);
    rest(0.05);
    settle();
}

void Person::type(const std::string& text) {
    send("type --delay 40 '" + text + "'");
    rest(0.05 + 0.045 * static_cast<double>(text.size()));
    settle();
}

void Person::type_after(const std::string& key, const std::string& text) {
    send("key " + key);
    send("type --delay 5 '" + text + "'");
    rest(0.1);
    settle();
}

bool Person::comes(std::string_view path) {
    return wait_for([&](App&) {
        const auto found = ui::widgets().find(path);
        return found != ui::widgets().end() && found->second.visible;
    });
}

bool Person::shows(std::string_view path) {
    return truth([&](App&) {
        const auto found = ui::widgets().find(path);
        return found != ui::widgets().end() && found->second.visible;
    });
}

ImVec2 Person::widget(std::string_view path) {
    EXPECT_TRUE(comes(path)) << path << " is not in sight";
    return ask<ImVec2>([&](App&) {
        const auto found = ui::widgets().find(path);
        return found == ui::widgets().end() ? at_ : found->second.centre();
    });
}

void Person::click_menu(std::string_view path) {
    std::string so_far = "Menu";
    for (const std::string_view part : split(path, '/')) {
        so_far += "/" + std::string(part);
        // A menu longer than the window scrolls.
        for (int i = 0;
             i < 8 && !shows(so_far) && truth([&](App&) { return ui::widgets().contains(so_far); }); ++i)
            wheel(-3);
        const ImVec2 at = widget(so_far);
        // Into a submenu along its row first, or the menus between would open.
        if (so_far.rfind('/') > 5) move_to({at.x, at_.y});
        click(at);
    }
}

void Person::picture(const std::string& name) {
    const char* const folder = std::getenv("SLIPFACE_WINDOW_PICTURES");
    if (!folder) return;
    char number[16];
    std::snprintf(number, sizeof number, "%02d", ++pictures_);
    const std::string command =
        std::string("import -window root '") + folder + "/" + name + "-" + number + ".png'";
    EXPECT_EQ(std::system(command.c_str()), 0);
}

}  // namespace slipface
