// Paths as people read and type them, and what lies in folders.
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <chrono>
#include <random>

#include "document/path_text.h"
#include "level_fixture.h"

namespace slipface {
namespace {

namespace fs = std::filesystem;

class Paths : public LevelFixture {
  protected:
    void SetUp() override {
        LevelFixture::SetUp();
        home = folder / "home";
        fs::create_directories(home / "levels");
        if (const char* before = std::getenv("HOME")) home_before = before;
        ::setenv("HOME", home.c_str(), 1);
    }
    void TearDown() override {
        ::setenv("HOME", home_before.c_str(), 1);
        LevelFixture::TearDown();
    }
    static std::vector<std::string> names(const FolderListing& listing) {
        std::vector<std::string> result;
        for (const FolderEntry& entry : listing.entries)
            result.push_back(entry.name);
        return result;
    }
    FolderListing levels_in(const fs::path& where) {
        FolderListing listing = list_folder(where, {is_level_name, false, true});
        sort_listing(listing.entries, ListingOrder::name, false);
        return listing;
    }
    PathCompletion complete(const std::string& text) {
        return complete_path(text, folder, {is_level_name, false, true});
    }

    fs::path home;
    std::string home_before;
};

TEST_F(Paths, PrintableTextIsUtf8WithoutControls) {
    EXPECT_EQ(printable("easy.obj"), "easy.obj");
    EXPECT_EQ(printable("Gr\xc3\xbc\xc3\x9f \xe2\x82\xac \xf0\x9f\x98\x80"),
              "Gr\xc3\xbc\xc3\x9f \xe2\x82\xac \xf0\x9f\x98\x80");
    EXPECT_EQ(printable("two\nlines"), "two\xef\xbf\xbdlines");
    EXPECT_EQ(printable("\xff"
                        "a\xc3"),
              "\xef\xbf\xbd"
              "a\xef\xbf\xbd");
    EXPECT_EQ(printable("\xc0\xaf"), "\xef\xbf\xbd\xef\xbf\xbd") << "longer than needed";
    EXPECT_EQ(printable("\xed\xa0\x80").find('\xed'), std::string::npos) << "half of a UTF-16 pair";
    // Whatever comes in, what comes out is printable, and stays as it is.
    std::mt19937 random(3);
    for (int i = 0; i < 2000; ++i) {
        std::string bytes(random() % 12, ' ');
        for (char& byte : bytes)
            byte = static_cast<char>(random());
        const std::string once = printable(bytes);
        EXPECT_EQ(printable(once), once);
    }
}

TEST_F(Paths, TheTildeIsTheHomeFolder) {
    EXPECT_EQ(expand_tilde("~/a b.obj"), home / "a b.obj");
    EXPECT_EQ(expand_tilde("~"), home / "");
    EXPECT_EQ(expand_tilde("~other/a"), fs::path("~other/a"));
    EXPECT_EQ(expand_tilde("a/~/b"), fs::path("a/~/b"));
    EXPECT_EQ(with_tilde(home / "levels" / "easy.obj"), "~/levels/easy.obj");
    EXPECT_EQ(with_tilde(home), "~");
    EXPECT_EQ(with_tilde(home.string() + "less/easy.obj"), home.string() + "less/easy.obj");
    EXPECT_EQ(with_tilde("levels/easy.obj"), "levels/easy.obj");
}

TEST_F(Paths, FoldersTellFilesOfOneNameApart) {
    const std::vector<fs::path> paths{"/x/a/levels/easy.obj", "/x/b/levels/easy.obj", "/y/hard.obj",
                                      "/easy.obj", "/x/b/levels/easy.obj"};
    EXPECT_EQ(distinguishing_folders(paths),
              (std::vector<std::string>{"a/levels", "b/levels", "y", "/", "b/levels"}));
    const std::vector<fs::path> nested{"/a/easy.obj", "/b/a/easy.obj"};
    EXPECT_NE(distinguishing_folders(nested)[0], distinguishing_folders(nested)[1]);
    EXPECT_TRUE(distinguishing_folders({}).empty());
}

TEST_F(Paths, TabCompletesAsFarAsItIsCertain) {
    write_text(folder / "easy.obj", "");
    write_text(folder / "easy.mtl", "");
    write_text(folder / "easter.gltf", "");
    write_text(folder / ".secret.obj", "");
    EXPECT_EQ(complete("e").text, "eas");
    EXPECT_EQ(complete("e").others, (std::vector<std::string>{"easter.gltf", "easy.obj"}));
    EXPECT_EQ(complete("easy").text, "easy.obj") << "the MTL is no level";
    write_text(folder / "easy.slipface.json", "");
    EXPECT_EQ(complete("easy").text, "easy.obj") << "and its level file is the same level";
    EXPECT_TRUE(complete("easy").others.empty());
    EXPECT_EQ(complete("ho").text, "home/");
    EXPECT_EQ(complete("home/").text, "home/levels/");
    EXPECT_EQ(complete("~").text, "~/levels/");
    EXPECT_EQ(complete("~/l").text, "~/levels/");
    EXPECT_EQ(complete((folder / "easy").string()).text, (folder / "easy.obj").string());
    EXPECT_EQ(complete(".s").text, ".secret.obj");
    EXPECT_EQ(complete("nothing").text, "nothing");
    EXPECT_EQ(complete("nowhere/a").text, "nowhere/a");
    // Never into the middle of a character.
    write_text(home / "\xc3\xa4.obj", "");
    write_text(home / "\xc3\xb6.obj", "");
    write_text(home / "\xff.obj", "");
    fs::remove(home / "levels");
    EXPECT_EQ(complete("~/").text, "~/");
    EXPECT_EQ(complete("~/").others.size(), 2u) << "a name that is no UTF-8 cannot be typed";
}

TEST_F(Paths, ALevelIsOneRow) {
    const fs::path here = folder / "here";
    fs::create_directories(here / "zoo");
    for (const char* name : {"a.obj", "a.slipface.json", "B.OBJ", "q.bsp", "q.slipface.json", "c.glb",
                             "lone.slipface.json", "notes.txt", "a.mtl", ".hidden.obj"})
        write_text(here / name, name);
    const fs::file_time_type newer = fs::last_write_time(here / "a.obj") + std::chrono::hours(1);
    fs::last_write_time(here / "a.slipface.json", newer);
    const FolderListing listing = levels_in(here);
    EXPECT_EQ(names(listing),
              (std::vector<std::string>{"zoo", "a.obj", "B.OBJ", "c.glb", "lone.slipface.json", "q.bsp"}));
    EXPECT_TRUE(listing.entries[1].has_level_file);
    EXPECT_FALSE(listing.entries[2].has_level_file);
    EXPECT_TRUE(listing.entries[5].has_level_file);
    EXPECT_EQ(listing.entries[1].bytes, 5u);
    EXPECT_GE(listing.entries[1].changed_s, listing.entries[2].changed_s + 3599) << "the newer file's date";
    EXPECT_EQ(list_folder(here, {is_level_name, true, false}).entries.size(), 9u) << "hidden, and every file";
}

TEST_F(Paths, ListsAreSortedAsAsked) {
    std::vector<FolderEntry> entries{{"b", false, false, 3, 30},
                                     {"A", false, false, 1, 30},
                                     {"z", true, false, 0, 10},
                                     {"c", false, false, 2, 20}};
    const auto sorted = [&](ListingOrder order, bool descending) {
        sort_listing(entries, order, descending);
        std::string text;
        for (const FolderEntry& entry : entries)
            text += entry.name;
        return text;
    };
    EXPECT_EQ(sorted(ListingOrder::name, false), "zAbc");
    EXPECT_EQ(sorted(ListingOrder::name, true), "zcbA");
    EXPECT_EQ(sorted(ListingOrder::size, false), "zAcb");
    EXPECT_EQ(sorted(ListingOrder::size, true), "zbcA");
    EXPECT_EQ(sorted(ListingOrder::date, true), "zAbc");
}

TEST_F(Paths, OddFoldersAreSaidOrListed) {
    EXPECT_FALSE(levels_in(folder / "missing").problem.empty());
    EXPECT_FALSE(levels_in(obj).problem.empty()) << "a file";
    const fs::path odd = folder / "odd";
    fs::create_directory(odd);
    write_text(odd / "two\nlines.obj", "");
    write_text(odd / "\xff\xfe.obj", "");
    write_text(odd / (std::string(251, 'x') + ".obj"), "");
    write_text(odd / "a##b.obj", "");
    fs::create_symlink("nowhere", odd / "broken.obj");
    ASSERT_EQ(::mkfifo((odd / "pipe.obj").c_str(), 0600), 0);
    EXPECT_EQ(levels_in(odd).entries.size(), 6u);
    const fs::path closed = folder / "closed";
    fs::create_directory(closed);
    fs::permissions(closed, fs::perms::none);
    if (::geteuid() != 0) {
        EXPECT_FALSE(levels_in(closed).problem.empty());
    }
    fs::permissions(closed, fs::perms::owner_all);
}

TEST_F(Paths, FiftyThousandFilesAreListedInAMoment) {
    const fs::path many = folder / "many";
    fs::create_directory(many);
    for (int i = 0; i < 50'000; ++i) {
        const int file = ::creat((many / ("level" + std::to_string(i) + ".obj")).c_str(), 0600);
        ASSERT_GE(file, 0);
        ::close(file);
    }
    const auto begin = std::chrono::steady_clock::now();
    EXPECT_EQ(levels_in(many).entries.size(), 50'000u);
    EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(10));
}

TEST_F(Paths, MountedMediaArePlaces) {
    const auto places = usual_folders(
        "proc /proc proc rw 0 0\n/dev/sdb1 /media/me/My\\040disk vfat rw 0 0\nshort\n/dev/sdc /mnt ext4 rw 0 "
        "0\n");
    ASSERT_GE(places.size(), 4u);
    EXPECT_EQ(places[0].folder, home);
    EXPECT_EQ(places[places.size() - 2].folder, "/media/me/My disk");
    EXPECT_EQ(places[places.size() - 2].name, "My disk");
    EXPECT_EQ(places.back().folder, "/mnt");
}

}  // namespace
}  // namespace slipface
