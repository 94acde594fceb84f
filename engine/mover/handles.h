// What callers hold instead of pointers. A handle that was freed is recognised, and what a handle
// stands for is neither changed nor freed while another thread is in it.
#pragma once

#include <cstdint>
#include <memory>

#include "slipface.h"

namespace slipface::c {

struct Object {
    virtual ~Object() = default;
};

enum class Kind : std::uint64_t { world = 1, settings = 2 };

// 0: there are too many.
std::uint64_t new_handle(Kind kind, std::unique_ptr<Object> object);
slipface_status free_handle(Kind kind, std::uint64_t id);

enum class Use { shared, alone };

// While it lives, the object cannot be freed, and with Use::alone nobody else is in it.
class Access {
  public:
    Access(Kind kind, std::uint64_t id, Use use);
    ~Access();
    Access(const Access&) = delete;
    Access& operator=(const Access&) = delete;

    slipface_status status() const { return status_; }
    Object* object() const { return object_; }  // null unless status() is SLIPFACE_OK

  private:
    std::uint64_t slot_ = 0;
    Use use_;
    slipface_status status_ = SLIPFACE_OK;
    Object* object_ = nullptr;
};

}  // namespace slipface::c
