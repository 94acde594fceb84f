#include "handles.h"

#include <array>
#include <atomic>
#include <mutex>
#include <utility>
#include <vector>

namespace slipface::c {
namespace {

// A handle's number: 40 bits count how often the slot was used, 4 are the kind, 20 the slot.
constexpr std::uint64_t slot_bits = 20, kind_bits = 4;
constexpr std::uint64_t slot_count = std::uint64_t{1} << 16;
constexpr std::int32_t alone = -(1 << 30);  // added to `users` by one that is alone

struct Slot {
    std::atomic<std::uint64_t> id{0};  // 0: free
    std::atomic<std::int32_t> users{0};
    std::unique_ptr<Object> object{};
    std::uint64_t uses = 0;
};

// The only thing that all callers of the library share: without it nobody could know that a handle was freed.
struct Table {
    std::array<Slot, slot_count> slots;
    std::mutex mutex;  // of the rest, and of `object` and `uses` of free slots
    std::vector<std::uint64_t> free;
    std::uint64_t fresh = 0;  // slots from here on were never used
};
Table& table() {
    static Table* const one = new Table;  // never destroyed: a thread may outlive main()
    return *one;
}

std::uint64_t slot_of(std::uint64_t id) {
    return id & ((std::uint64_t{1} << slot_bits) - 1);
}
bool is_handle(Kind kind, std::uint64_t id) {
    return slot_of(id) < slot_count && ((id >> slot_bits) & 15) == static_cast<std::uint64_t>(kind);
}

}  // namespace

std::uint64_t new_handle(Kind kind, std::unique_ptr<Object> object) {
    Table& all = table();
    const std::lock_guard lock(all.mutex);
    std::uint64_t at = all.fresh;
    if (!all.free.empty()) {
        at = all.free.back();
        all.free.pop_back();
    } else if (at == slot_count) {
        return 0;
    } else {
        all.free.reserve(++all.fresh);  // so that freeing never needs memory
    }
    Slot& slot = all.slots[at];
    slot.object = std::move(object);
    const std::uint64_t id =
        (++slot.uses << (slot_bits + kind_bits)) | (static_cast<std::uint64_t>(kind) << slot_bits) | at;
    slot.id.store(id);
    return id;
}

slipface_status free_handle(Kind kind, std::uint64_t id) {
    if (!is_handle(kind, id)) return SLIPFACE_WRONG_HANDLE;
    Slot& slot = table().slots[slot_of(id)];
    std::unique_ptr<Object> object;
    {
        const Access access(kind, id, Use::alone);
        if (access.status() != SLIPFACE_OK) return access.status();
        slot.id.store(0);
        object = std::move(slot.object);
    }
    const std::lock_guard lock(table().mutex);
    table().free.push_back(slot_of(id));
    return SLIPFACE_OK;
}

Access::Access(Kind kind, std::uint64_t id, Use use) : slot_(slot_of(id)), use_(use) {
    if (!is_handle(kind, id)) {
        status_ = SLIPFACE_WRONG_HANDLE;
        return;
    }
    Slot& slot = table().slots[slot_];
    std::int32_t none = 0;
    const bool entered =
        use == Use::shared ? slot.users.fetch_add(1) >= 0 : slot.users.compare_exchange_strong(none, alone);
    if (entered && slot.id.load() == id) {
        object_ = slot.object.get();
        return;
    }
    // A thread that looks into a slot of somebody else leaves it at once. If another one comes for the object
    // at that moment, it is refused, although the object is free.
    status_ = slot.id.load() == id ? SLIPFACE_IN_USE : SLIPFACE_WRONG_HANDLE;
    if (use == Use::shared)
        slot.users.fetch_sub(1);
    else if (entered)
        slot.users.fetch_sub(alone);
}

Access::~Access() {
    if (object_ == nullptr) return;
    Slot& slot = table().slots[slot_];
    if (use_ == Use::shared)
        slot.users.fetch_sub(1);
    else
        slot.users.fetch_sub(alone);
}

}  // namespace slipface::c
