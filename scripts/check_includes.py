#!/usr/bin/env python3
"""What a file uses of the standard library, it includes, itself or through a header of this project.

Precompiled headers, unity builds and the headers of other libraries hide a missing include until one of them changes. The table
says which header declares a name; a name that several declare needs one of them.
"""
import re
import subprocess
import sys
from functools import lru_cache
from pathlib import Path

root = Path(__file__).resolve().parent.parent
declared = """
algorithm: sort stable_sort min max clamp find_if find any_of all_of none_of lower_bound upper_bound copy_if copy fill fill_n transform
 reverse rotate nth_element adjacent_find max_element min_element equal unique remove_if partition count_if binary_search minmax shuffle
 mismatch is_sorted lexicographical_compare equal_range partial_sort swap_ranges push_heap pop_heap
array: array | atomic: atomic atomic_bool memory_order_relaxed atomic_flag | bit: bit_cast popcount countr_zero countl_zero bit_width rotl
bitset: bitset | charconv: from_chars to_chars | chrono: chrono | cmath: sqrt abs sin cos tan atan2 acos asin pow floor ceil round lround
 hypot isfinite isnan copysign fmod trunc exp log log2 fma nextafter cbrt | compare: strong_ordering partial_ordering weak_ordering
condition_variable: condition_variable | cstdint: uint8_t uint16_t uint32_t uint64_t int8_t int16_t int32_t int64_t uintptr_t
cstdio: fopen fclose fputs puts printf snprintf fprintf fflush fread fwrite FILE rename | cstdlib: getenv exit abort malloc free strtod
 strtoul system quick_exit _Exit | cstring: memcpy memcmp memset strlen strcmp memchr strerror | ctime: time_t tm strftime
deque: deque | exception: exception exception_ptr current_exception rethrow_exception terminate | filesystem: filesystem
fstream: ifstream ofstream fstream | functional: function hash less greater ref reference_wrapper
future: future promise async | initializer_list: initializer_list | iomanip: setw setprecision setfill | iostream: cout cerr cin
iterator: back_inserter distance next prev istreambuf_iterator inserter make_move_iterator forward_iterator_tag
limits: numeric_limits | list: list | map: map multimap | memory: unique_ptr shared_ptr weak_ptr make_unique make_shared make_unique_for_overwrite
 addressof | mutex: mutex lock_guard unique_lock scoped_lock once_flag call_once | new: bad_alloc nothrow launder
numbers: numbers | numeric: accumulate iota gcd partial_sum reduce midpoint | optional: optional nullopt | random: mt19937 mt19937_64 random_device
ranges: views | set: set multiset | span: span | sstream: istringstream ostringstream stringstream | stdexcept: runtime_error logic_error out_of_range
stop_token: stop_token stop_source | string: string to_string getline stoi stod u8string | string_view: string_view
system_error: error_code errc system_error generic_category | thread: thread jthread this_thread | tuple: tuple tie make_tuple
type_traits: is_same_v decay_t conditional_t enable_if_t is_integral_v is_floating_point_v is_invocable_v remove_cvref_t underlying_type_t
 is_enum_v invoke_result_t | unordered_map: unordered_map | unordered_set: unordered_set
utility: move pair forward exchange swap in_place make_pair declval index_sequence make_index_sequence in_range cmp_less unreachable
variant: variant visit get_if holds_alternative monostate | vector: vector
"""
headers_of = {}
for header, names in re.findall(r"(\w+): ([^:|]*?)(?=\s*(?:\||$|\n\w+:|\s\w+:))", declared):
    for name in names.split():
        headers_of.setdefault(name, set()).add(header)
first_of = {name: sorted(headers)[0] for name, headers in headers_of.items()}
# What else the standard promises with a header, or names in two.
for name, more in {
        "move": {"algorithm"}, "pair": {"map", "unordered_map", "tuple"}, "abs": {"cstdlib"}, "swap": {"algorithm", "vector", "string"},
        "hash": {"string", "string_view", "optional"}, "less": {"map", "set"}, "exchange": {"atomic"},
        "initializer_list": {"vector", "string", "map", "set", "algorithm", "array", "utility", "valarray"},
        "string": {"sstream", "iostream"}, "string_view": {"string"}, "exception": {"stdexcept", "new"}, "getline": {"iostream"},
        "in_place": {"optional", "variant"}, "forward": {"tuple"}, "strong_ordering": {"utility", "array", "vector", "string"},
        "find": {"string"}, "copy": {"string"}, "unique_lock": {"condition_variable"}, "tuple": {"map", "memory"},
        "next": {"vector", "string", "map", "set"}, "prev": {"vector", "string", "map", "set"}, "distance": {"vector", "string", "map", "set"},
        "error_code": {"filesystem"}, "errc": {"charconv"}, "system_error": {"mutex", "thread"}, "back_inserter": {"algorithm"},
        "get_if": set(), "rename": {"filesystem"}, "remove_if": set(), "fill": {"array"}, "views": set()}.items():
    headers_of.setdefault(name, set()).update(more)
# The C headers' own names.
spelled = {"math.h": "cmath", "stdint.h": "cstdint", "stdio.h": "cstdio", "stdlib.h": "cstdlib", "string.h": "cstring", "time.h": "ctime"}

files = subprocess.check_output(["git", "ls-files", "*.h", "*.cpp", "*.inc"], cwd=root, text=True).split()
files = [name for name in files if name.split("/")[0] in {"engine", "editor", "tests", "assets", "bench", "examples"}]
by_tail = {}
for name in files:
    parts = name.split("/")
    for i in range(len(parts)):
        by_tail.setdefault("/".join(parts[i:]), []).append(name)


@lru_cache(None)
def text_of(name):
    text = (root / name).read_text()
    return re.sub(r"//[^\n]*|/\*.*?\*/", "", text, flags=re.S)


def own(including, path):
    near = str((Path(including).parent / path))
    found = by_tail.get(path, [])
    return near if near in found else found[0] if found else None


def brought(name, seen):
    """The standard headers that a file includes, itself and through this project's headers."""
    result = set()
    for path in re.findall(r'#\s*include\s*[<"]([^>"]+)[>"]', text_of(name)):
        target = own(name, path)
        if target is None:
            result.add(spelled.get(path, path))
        elif target not in seen:
            seen.add(target)
            result |= brought(target, seen)
    return result


bad = 0
for name in files:
    if name.endswith(".inc"):
        continue
    text = re.sub(r'R"\((.*?)\)"|"(?:\\.|[^"\\\n])*"', '""', text_of(name), flags=re.S)
    there = brought(name, {name})
    lacks = {}
    for used in re.findall(r"\bstd::(?:ranges::)?(\w+)", text):
        wanted = headers_of.get(used)
        if wanted and not wanted & there:
            lacks.setdefault(first_of[used], used)
    if re.search(r"\bfmt::", text) and not {"fmt/format.h", "fmt/chrono.h", "fmt/ranges.h"} & there:
        lacks["fmt/format.h"] = "fmt"
    if re.search(r"\bfmt::join\b", text) and "fmt/ranges.h" not in there:
        lacks["fmt/ranges.h"] = "join"  # until fmt 10 in fmt/format.h, too
    for header, used in sorted(lacks.items()):
        print(f"{name}: uses {used}, and neither it nor a header of this project that it includes includes <{header}>")
        bad += 1
sys.exit(bad > 0)
