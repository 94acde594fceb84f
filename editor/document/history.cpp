// Steps, transactions, undo and redo.
#include <algorithm>
#include <exception>
#include <type_traits>
#include <utility>

#include "document/document.h"

namespace slipface {
namespace {

bool changes_nothing(const Edit& edit) {
    return std::visit(
        [](const auto& one) {
            if constexpr (requires { one.faces; })
                return one.faces.empty();
            else
                return one.before == one.after;
        },
        edit);
}

// A face that was painted several times keeps its first `before` and its last `after`.
void compact(FaceEdit& edit) {
    std::stable_sort(edit.faces.begin(), edit.faces.end(),
                     [](const FaceEdit::Face& a, const FaceEdit::Face& b) { return a.face < b.face; });
    std::size_t kept = 0;
    for (std::size_t i = 0; i < edit.faces.size();) {
        FaceEdit::Face merged = edit.faces[i];
        for (++i; i < edit.faces.size() && edit.faces[i].face == merged.face; ++i)
            merged.after = edit.faces[i].after;
        if (merged.before != merged.after) edit.faces[kept++] = merged;
    }
    edit.faces.resize(kept);
}

// After it faces have other numbers.
bool renumbers(const Edit& edit) {
    return std::holds_alternative<GeometryEdit>(edit) || std::holds_alternative<PropsEdit>(edit) ||
           std::holds_alternative<LevelEdit>(edit);
}

// The edit that `next` can be merged into: the last of its kind, if the numbers of faces mean the same in
// all that lies between. Null: none.
Edit* same_kind(std::vector<Edit>& edits, const Edit& next) {
    for (auto edit = edits.rbegin(); edit != edits.rend(); ++edit) {
        if (edit->index() == next.index()) return &*edit;
        if (renumbers(*edit) || renumbers(next)) break;
    }
    return nullptr;
}

void merge_into(Edit& earlier, Edit&& later, const Level& now) {
    std::visit(
        [&](auto& one) {
            auto& other = std::get<std::remove_reference_t<decltype(one)>>(later);
            if constexpr (std::is_same_v<decltype(one), PropsEdit&>)
                slipface::merge_into(one, std::move(other), now.props);
            else if constexpr (requires { one.faces; })
                one.faces.insert(one.faces.end(), other.faces.begin(), other.faces.end());
            else
                one.after = std::move(other.after);
        },
        earlier);
}

}  // namespace

bool HistoryStep::changes_file() const {
    return !keeps_file && std::any_of(edits.begin(), edits.end(), [](const Edit& edit) {
        return !std::holds_alternative<SelectionEdit>(edit);
    });
}

// So that push_back() cannot fail.
template <class T>
static void make_room(std::vector<T>& list) {
    if (list.size() == list.capacity()) list.reserve(2 * list.size() + 1);
}

void Document::perform(std::string step_name, Edit edit) {
    make_room(history_);
    HistoryStep step{std::move(step_name), {}, false};
    step.edits.push_back(std::move(edit));
    apply(step, true);
    record(std::move(step));
}

void Document::record(HistoryStep step) {
    if (depth_ == 0) return push(std::move(step));
    Edit& edit = step.edits.front();
    try {
        if (Edit* const earlier = same_kind(open_step_.edits, edit))
            merge_into(*earlier, std::move(edit), level_);
        else
            open_step_.edits.push_back(std::move(edit));
    } catch (const std::exception&) {
        apply(step, false);
        throw;
    }
}

void Document::push(HistoryStep step) {
    if (saved_cursor_ && *saved_cursor_ > cursor_) {
        // The saved state is about to leave the history, unless all steps from here to it only select.
        const auto first = history_.begin() + static_cast<std::ptrdiff_t>(cursor_);
        const auto last = history_.begin() + static_cast<std::ptrdiff_t>(*saved_cursor_);
        if (std::any_of(first, last, [](const HistoryStep& undone) { return undone.changes_file(); }))
            saved_cursor_.reset();
        else
            saved_cursor_ = cursor_;
    }
    history_.erase(history_.begin() + static_cast<std::ptrdiff_t>(cursor_), history_.end());
    history_.push_back(std::move(step));
    ++cursor_;
    forget_oldest();
}

void Document::begin(std::string name) {
    if (depth_++ == 0) open_step_ = {std::move(name), {}, false};
}

void Document::commit() {
    if (depth_ == 0) return;
    if (depth_ > 1) {
        --depth_;
        return;
    }
    make_room(history_);
    for (Edit& edit : open_step_.edits)
        if (auto* faces = std::get_if<FaceEdit>(&edit)) compact(*faces);
    std::erase_if(open_step_.edits, changes_nothing);
    --depth_;
    HistoryStep step = std::exchange(open_step_, {});
    if (!step.edits.empty()) push(std::move(step));
}

void Document::cancel() {
    if (depth_ == 0) return;
    --depth_;
    const HistoryStep step = std::exchange(open_step_, {});
    if (!step.edits.empty()) apply(step, false);
}

void Document::roll_back(std::size_t mark) {
    while (depth_ > 0)
        cancel();
    if (history_mark() > mark) go_to(std::max(mark, forgotten_) - forgotten_);
}

void Document::undo() {
    if (!can_undo()) return;
    apply(history_[cursor_ - 1], false);
    --cursor_;
}

void Document::redo() {
    if (!can_redo()) return;
    apply(history_[cursor_], true);
    ++cursor_;
}

void Document::go_to(std::size_t cursor) {
    while (cursor_ > cursor && can_undo())
        undo();
    while (cursor_ < cursor && can_redo())
        redo();
}

void Document::mark_saved(LevelBase now) {
    if (depth_ > 0) return;
    base_ = std::move(now);
    saved_cursor_ = cursor_;
    ++revision_;
}

void Document::mark_unsaved(LevelBase now) {
    base_ = std::move(now);
    saved_cursor_.reset();
    ++revision_;
}

bool Document::dirty() const {
    if (!saved_cursor_ || open_step_.changes_file()) return true;
    const auto [first, last] = std::minmax(*saved_cursor_, cursor_);
    return std::any_of(history_.begin() + static_cast<std::ptrdiff_t>(first),
                       history_.begin() + static_cast<std::ptrdiff_t>(last),
                       [](const HistoryStep& step) { return step.changes_file(); });
}

}  // namespace slipface
