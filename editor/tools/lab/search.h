// What a background thread searches for, begun anew where the question is another.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <utility>

#include "document/background.h"

namespace slipface {

template <class T>
struct Search {
    struct Key {
        std::uint64_t revision = 0;  // of what is searched
        std::size_t run = 0, first = 0;
        bool operator==(const Key&) const = default;
    } key = {};
    std::unique_ptr<Background<Result<T>>> work = {};
    std::optional<T> found = {};
};

// How the editor waits for searches.
struct SearchWait {
    bool beside = false;         // frames go on while the search runs, else the first call waits for it
    std::function<void()> wake;  // called once it is ready
    std::function<void(const Error&)> report;  // called once where it failed
};

// What was found for this key; T{} where the search failed. Null while the search, which this starts, is
// running. `begin` makes the work, which must own all that it uses.
template <class T, class Begin>
const T* seek(Search<T>& search, const typename Search<T>::Key& key, const SearchWait& wait,
              const Begin& begin) {
    if (!search.work || !(search.key == key)) {
        search.work.reset();
        search = Search<T>{.key = key};
        search.work = std::make_unique<Background<Result<T>>>(begin(), wait.wake);
    }
    if (!search.found) {
        if (wait.beside && !search.work->ready()) return nullptr;
        Result<T> found = search.work->take();
        if (!found) wait.report(found.error());
        search.found = found ? std::move(*found) : T{};
    }
    return &*search.found;
}

}  // namespace slipface
