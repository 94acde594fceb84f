// Archives: what is written is read, tar reads it, too, and damage is refused.
#include <gmock/gmock.h>

#include <random>

#include "slipface/image/archive.h"
#include "slipface/image/pack.h"

namespace slipface::test {
namespace {

using testing::HasSubstr;

std::vector<ArchiveEntry> random_entries(std::mt19937& random) {
    std::vector<ArchiveEntry> entries;
    for (std::size_t i = 0, count = random() % 6; i < count; ++i) {
        ArchiveEntry entry{"f" + std::to_string(i) + std::string(random() % 40, 'x'), {}};
        if (random() % 2 == 0) entry.name = "folder/" + entry.name;
        entry.bytes.resize(random() % 3 == 0 ? 512 * (random() % 3) : random() % 2000);
        for (char& c : entry.bytes)
            c = static_cast<char>(random());
        entries.push_back(std::move(entry));
    }
    return entries;
}

TEST(Archive, ReadsWhatItWrites) {
    std::mt19937 random(5);
    for (int i = 0; i < 200; ++i) {
        const std::vector<ArchiveEntry> entries = random_entries(random);
        const Result<std::string> bytes = archive_of(entries);
        ASSERT_TRUE(bytes);
        EXPECT_EQ(*archive_of(entries), *bytes);
        const Result<std::vector<ArchiveEntry>> again = read_archive(*bytes, "a");
        ASSERT_TRUE(again) << again.error().text();
        EXPECT_EQ(*again, entries);
    }
}

TEST(Archive, RefusesNamesThatLeadOut) {
    for (const char* name : {"../a", "/a", "a/../../b", "", "a//b", "c:/a", "a\\b", "a/./b", "line\nbreak"})
        EXPECT_FALSE(archive_of(std::vector<ArchiveEntry>{{name, ""}})) << name;
    EXPECT_FALSE(archive_of(std::vector<ArchiveEntry>{{std::string(101, 'a'), ""}}));
    // As another program would write it: the name in a good archive is changed, and its sum with it.
    std::string tar = *unpack_gzip(*archive_of(std::vector<ArchiveEntry>{{"aaaa", "text"}}), 1 << 20);
    for (const std::string bad : {"../a", "/aaa", "a//a"}) {
        std::size_t sum = 0;
        std::copy(bad.begin(), bad.end(), tar.begin());
        for (std::size_t i = 0; i < 512; ++i)
            sum += i >= 148 && i < 156 ? ' ' : static_cast<unsigned char>(tar[i]);
        std::string digits;
        for (int i = 0; i < 6; ++i, sum /= 8)
            digits.insert(digits.begin(), static_cast<char>('0' + sum % 8));
        std::copy(digits.begin(), digits.end(), tar.begin() + 148);
        const auto read = read_archive(pack_gzip(tar), "a.capsule");
        ASSERT_FALSE(read) << bad;
        EXPECT_THAT(read.error().text(), HasSubstr("inside the archive's folder"));
    }
}

TEST(Archive, RefusesDamage) {
    std::mt19937 random(6);
    const std::string bytes =
        *archive_of(std::vector<ArchiveEntry>{{"a", std::string(3000, 'q')}, {"b", "text"}});
    for (std::size_t size = 0; size < bytes.size(); ++size)
        EXPECT_FALSE(read_archive(bytes.substr(0, size), "a"));
    const std::string tar = *unpack_gzip(bytes, 1 << 20);
    for (int i = 0; i < 2000; ++i) {
        std::string changed = tar;
        changed[random() % changed.size()] = static_cast<char>(random());
        (void)read_archive(pack_gzip(changed), "a");  // an error or other contents, and no crash
        EXPECT_FALSE(read_archive(pack_gzip(tar.substr(0, random() % 3500)), "a"));
    }
    EXPECT_FALSE(read_archive(pack_gzip(""), "a"));
    // One that claims four gigabytes.
    std::string huge = bytes;
    huge.replace(huge.size() - 4, 4, "\xff\xff\xff\xff");
    EXPECT_FALSE(read_archive(huge, "a"));
}

}  // namespace
}  // namespace slipface::test
