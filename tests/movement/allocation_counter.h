// How often this program has allocated. Lives in its own file: where the compiler sees both the replaced
// operators and their callers it takes them for mismatched.
#pragma once

namespace slipface::test {

long allocation_count();

}  // namespace slipface::test
