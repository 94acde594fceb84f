#include "sequence_diff.h"

#include <algorithm>

#include "slipface/base/hash.h"
#include "slipface/base/key_sort.h"

namespace slipface {
namespace {

constexpr std::size_t stretches[] = {24, 6};  // faces that are compared as one, longest first

struct Gap {
    std::uint32_t a0, a1, b0, b1;
    bool open() const { return a0 < a1 && b0 < b1; }
};

// The hashes of all stretches of `length` faces from `begin` to `end`. The area is left out, because it is
// equal if it is nearly so.
std::vector<KeyedIndex> hashes(std::span<const FaceToken> faces, std::uint32_t begin, std::uint32_t end,
                               std::size_t length) {
    std::vector<KeyedIndex> result;
    if (end - begin < length) return result;
    constexpr std::uint64_t base = 0x9e3779b97f4a7c15ULL | 1;
    std::uint64_t leaving = 1, hash = 0;  // base to the power of `length`
    for (std::size_t k = 0; k < length; ++k)
        leaving *= base;
    const auto value = [&](std::uint32_t i) {
        const FaceToken& face = faces[i];
        return ((std::uint64_t{face.topology} << 16 | std::uint64_t{face.corners} << 8 | face.material) + 1) *
               0xbf58476d1ce4e5b9ULL;
    };
    for (std::uint32_t i = begin; i < end; ++i) {
        hash = hash * base + value(i);
        if (i - begin >= length) hash -= leaving * value(i - static_cast<std::uint32_t>(length));
        if (i - begin + 1 >= length) result.push_back({hash, i + 1 - static_cast<std::uint32_t>(length)});
    }
    sort_by_key(result);
    return result;
}

class Diff {
  public:
    Diff(std::span<const FaceToken> old, std::span<const FaceToken> now)
        : old_(old), now_(now), before_(now.size(), no_id) {}

    std::vector<std::uint32_t> run() && {
        std::vector<Gap> gaps{
            {0, static_cast<std::uint32_t>(old_.size()), 0, static_cast<std::uint32_t>(now_.size())}};
        shrink(gaps.front());
        for (const std::size_t length : stretches) {
            std::vector<Gap> smaller;
            for (const Gap& gap : gaps)
                if (gap.open()) split(gap, length, smaller);
            gaps = std::move(smaller);
        }
        return std::move(before_);
    }

  private:
    // Takes equal beginnings and ends away.
    void shrink(Gap& gap) {
        for (; gap.open() && old_[gap.a0].same_as(now_[gap.b0]); ++gap.a0, ++gap.b0)
            before_[gap.b0] = gap.a0;
        for (; gap.open() && old_[gap.a1 - 1].same_as(now_[gap.b1 - 1]); --gap.a1, --gap.b1)
            before_[gap.b1 - 1] = gap.a1 - 1;
    }

    void split(const Gap& gap, std::size_t length, std::vector<Gap>& smaller) {
        const std::vector<Stretch> chain = longest_ascending(anchors(gap, length));
        Gap rest = gap;
        const auto add = [&](Gap one) {
            shrink(one);
            if (one.open()) smaller.push_back(one);
        };
        for (const Stretch& anchor : chain) {
            if (anchor.a < rest.a0 || anchor.b < rest.b0) continue;  // inside the one before
            std::uint32_t a = anchor.a, b = anchor.b;
            while (a > rest.a0 && b > rest.b0 && old_[a - 1].same_as(now_[b - 1])) {
                before_[--b] = --a;
            }
            const Gap ahead{rest.a0, a, rest.b0, b};
            for (a = anchor.a, b = anchor.b; a < gap.a1 && b < gap.b1 && old_[a].same_as(now_[b]); ++a, ++b)
                before_[b] = a;
            add(ahead);
            rest = {a, gap.a1, b, gap.b1};
        }
        add(rest);
    }

    std::vector<Stretch> anchors(const Gap& gap, std::size_t length) const {
        const std::vector<KeyedIndex> olds = hashes(old_, gap.a0, gap.a1, length),
                                      nows = hashes(now_, gap.b0, gap.b1, length);
        const auto once = [](const std::vector<KeyedIndex>& list, std::size_t i) {
            return (i == 0 || list[i - 1].key != list[i].key) &&
                   (i + 1 == list.size() || list[i + 1].key != list[i].key);
        };
        std::vector<Stretch> found;
        std::size_t i = 0;
        for (std::size_t k = 0; k < nows.size(); ++k) {
            if (!once(nows, k)) continue;
            while (i < olds.size() && olds[i].key < nows[k].key)
                ++i;
            if (i == olds.size() || olds[i].key != nows[k].key || !once(olds, i)) continue;
            const std::uint32_t a = olds[i].index, b = nows[k].index;
            bool equal = true;
            for (std::uint32_t offset = 0; offset < length && equal; ++offset)
                equal = old_[a + offset].same_as(now_[b + offset]);
            if (equal) found.push_back({a, b});
        }
        std::sort(found.begin(), found.end(), [](const Stretch& x, const Stretch& y) { return x.b < y.b; });
        return found;
    }

    std::span<const FaceToken> old_, now_;
    std::vector<std::uint32_t> before_;
};

}  // namespace

std::vector<Stretch> longest_ascending(const std::vector<Stretch>& anchors) {
    std::vector<std::size_t> ends;  // [length - 1] the anchor with the lowest `a` that ends so many
    std::vector<std::size_t> previous(anchors.size(), anchors.size());
    for (std::size_t i = 0; i < anchors.size(); ++i) {
        const auto place =
            std::lower_bound(ends.begin(), ends.end(), anchors[i].a,
                             [&](std::size_t one, std::uint32_t a) { return anchors[one].a < a; });
        if (place != ends.begin()) previous[i] = *(place - 1);
        if (place == ends.end())
            ends.push_back(i);
        else
            *place = i;
    }
    std::vector<Stretch> chain;
    for (std::size_t i = ends.empty() ? anchors.size() : ends.back(); i < anchors.size(); i = previous[i])
        chain.push_back(anchors[i]);
    std::reverse(chain.begin(), chain.end());
    return chain;
}

std::vector<std::uint32_t> sequence_diff(std::span<const FaceToken> old, std::span<const FaceToken> now) {
    return Diff(old, now).run();
}

}  // namespace slipface
