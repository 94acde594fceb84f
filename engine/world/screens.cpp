#include "slipface/world/screens.h"

namespace slipface {

namespace {

// std::function copies what it holds.
using Held = std::shared_ptr<std::unique_ptr<Screen>>;

struct Calling {
    explicit Calling(bool& now) : flag(now) { flag = true; }
    ~Calling() { flag = false; }
    Calling(const Calling&) = delete;
    Calling& operator=(const Calling&) = delete;
    bool& flag;
};

}  // namespace

void Screens::push(std::unique_ptr<Screen> screen) {
    put(std::move(screen), false);
}

void Screens::replace(std::unique_ptr<Screen> screen) {
    put(std::move(screen), true);
}

void Screens::put(std::unique_ptr<Screen> screen, bool instead) {
    if (screen == nullptr) return;
    screen->screens_ = this;
    const Held held = std::make_shared<std::unique_ptr<Screen>>(std::move(screen));
    change([this, held, instead] {
        if (instead && !screens_.empty()) screens_.pop_back();
        screens_.push_back(std::move(*held));
    });
}

void Screens::pop() {
    change([this] {
        if (!screens_.empty()) screens_.pop_back();
    });
}

void Screens::clear() {
    change([this] { screens_.clear(); });
}

void Screens::change(std::function<void()> how) {
    changes_.push_back(std::move(how));
    if (calling_) return;
    call([](Screen&) {});
}

// Calls the top screen, then makes the changes that were asked for, and those that on_show() asks for.
void Screens::call(const std::function<void(Screen&)>& what) {
    if (calling_) return;
    const Calling calling(calling_);
    if (Screen* const screen = top()) what(*screen);
    while (!changes_.empty()) {
        const Screen* const before = top();
        std::vector<std::function<void()>> changes;
        changes.swap(changes_);
        for (const auto& how : changes)
            how();
        if (top() != nullptr && top() != before) top()->on_show();
    }
}

void Screens::tick(double seconds) {
    call([&](Screen& screen) { screen.on_tick(seconds); });
}

void Screens::input(const ScreenInput& input) {
    call([&](Screen& screen) { screen.on_input(input); });
}

void Screens::draw(Graphics& graphics) {
    std::size_t lowest = screens_.size();
    while (lowest > 0 && (lowest == screens_.size() || screens_[lowest]->shows_below()))
        --lowest;
    for (std::size_t i = lowest; i < screens_.size(); ++i)
        screens_[i]->on_draw(graphics);
}

}  // namespace slipface
