// The shipped levels from their cameras: lit floors are neither white nor black, and whatever marks a face is
// seen on the ground that is there. Brightness and contrast as WCAG 2 defines them.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "drawing.h"
#include "slipface/collision/collision_world.h"
#include "slipface/level/level_file.h"

namespace slipface::test {
namespace {

constexpr int width = 320, height = 180;
constexpr std::size_t max_cameras = 4;
constexpr double least_contrast = 3.0;

double linear(std::uint8_t value) {
    const double s = value / 255.0;
    return s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4);
}
double luminance(const std::uint8_t* pixel) {
    return 0.2126 * linear(pixel[0]) + 0.7152 * linear(pixel[1]) + 0.0722 * linear(pixel[2]);
}
double contrast(const std::uint8_t* a, const std::uint8_t* b) {
    const double la = luminance(a) + 0.05, lb = luminance(b) + 0.05;
    return std::max(la, lb) / std::min(la, lb);
}
// 0 black, 1 white, as a screen's values are.
double brightness(const std::uint8_t* pixel) {
    const double y = luminance(pixel);
    return y <= 0.0031308 ? 12.92 * y : 1.055 * std::pow(y, 1.0 / 2.4) - 0.055;
}

struct Seen {
    FaceId face = no_id;
    bool floor = false;
};

// A shipped level from one of its cameras.
struct View {
    Camera camera;
    std::vector<Seen> seen;  // [y * width + x]
    Image ground;            // without types
    const Seen& at(int x, int y) const { return seen[static_cast<std::size_t>(y * width + x)]; }
};

class ShippedLevel : public DrawingTest, public testing::WithParamInterface<const char*> {
  protected:
    void SetUp() override {
        const std::filesystem::path folder = std::filesystem::path(SLIPFACE_SOURCE_DIR) / "assets/levels";
        auto loaded = load_level(folder / (std::string(GetParam()) + ".obj"));
        ASSERT_TRUE(loaded.ok()) << loaded.error().text();
        level = std::move(loaded->level);
        faces = resolve_surfaces(level).surface;
        auto made = build_collision_world(level);
        ASSERT_TRUE(made.ok());
        renderer = std::make_unique<LevelRenderer>(gl());
        renderer->set_mesh(level.mesh.whole(), folder);
        renderer->set_light(level.light, level.mesh.whole(), folder);
        renderer->set_surface_types(level.surfaces);
        renderer->set_face_surfaces(faces);
        plain.overlay = 0.0f;
        ASSERT_FALSE(level.cameras.empty());
        for (std::size_t i = 0; i < std::min(max_cameras, level.cameras.size()); ++i)
            views.push_back(view_of(level.cameras[i], *made));
    }

    View view_of(const CameraBookmark& bookmark, const CollisionWorld& world) {
        View view;
        view.camera.eye = bookmark.eye;
        view.camera.target = bookmark.target;
        view.camera.fov_y = bookmark.fov_y;
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x) {
                const Ray ray = pixel_ray(view.camera, {x + 0.5, y + 0.5}, {width, height});
                const auto hit = cast_ray(world, ray.origin, ray.direction);
                view.seen.push_back(hit ? Seen{hit->face, hit->normal.y() > 0.7 && !hit->back_face} : Seen{});
            }
        view.ground = draw(*renderer, view.camera, width, height, plain);
        return view;
    }

    // The faces of floors that take the most pixels.
    static std::vector<FaceId> large_floors(const View& view, std::size_t maximum) {
        std::map<FaceId, int> pixels;
        for (const Seen& seen : view.seen)
            if (seen.floor) ++pixels[seen.face];
        std::vector<std::pair<int, FaceId>> sorted;
        for (const auto& [face, count] : pixels)
            if (count > 100) sorted.emplace_back(count, face);
        std::sort(sorted.rbegin(), sorted.rend());
        std::vector<FaceId> faces_;
        for (std::size_t i = 0; i < std::min(maximum, sorted.size()); ++i)
            faces_.push_back(sorted[i].second);
        return faces_;
    }

    Level level;
    std::vector<SurfaceId> faces;
    std::unique_ptr<LevelRenderer> renderer;
    LevelStyle plain;
    std::vector<View> views;
};

TEST_P(ShippedLevel, LitFloorsLieBetweenAQuarterAndThreeQuartersOfWhite) {
    std::vector<double> values;
    for (const View& view : views)
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x)
                if (view.at(x, y).floor) values.push_back(brightness(view.ground.pixel(x, y)));
    ASSERT_GT(values.size(), 1000u);
    std::sort(values.begin(), values.end());
    const auto quantile = [&](double part) {
        return values[static_cast<std::size_t>(part * static_cast<double>(values.size() - 1))];
    };
    RecordProperty("quantiles", fmt::format("{:.2f} {:.2f} {:.2f} {:.2f} {:.2f}", quantile(0.05),
                                            quantile(0.25), quantile(0.5), quantile(0.75), quantile(0.95)));
    // The brighter half is lit; the other lies in shadow, which may be dark.
    EXPECT_GE(quantile(0.5), 0.25);
    EXPECT_LE(quantile(0.95), 0.75);
}

TEST_P(ShippedLevel, AHoveredAndASelectedFaceAreOutlinedAgainstTheGround) {
    std::size_t looked_at = 0;
    for (const View& view : views) {
        for (const FaceId face : large_floors(view, 2)) {
            for (const std::uint8_t bit : {std::uint8_t{1}, std::uint8_t{2}}) {
                std::vector<std::uint8_t> marks(level.mesh.face_count(), 0);
                marks[face] = bit;
                renderer->set_face_highlights(marks);
                const Image marked = draw(*renderer, view.camera, width, height, plain);
                const auto changed = [&](int x, int y) {
                    return x < 0 || y < 0 || x >= width || y >= height ||
                           delta(marked, view.ground, x, y) > 8;
                };
                int border = 0, clear = 0;
                for (int y = 0; y < height; ++y)
                    for (int x = 0; x < width; ++x) {
                        if (!changed(x, y)) continue;
                        if (!changed(x - 1, y) || !changed(x + 1, y) || !changed(x, y - 1) ||
                            !changed(x, y + 1))
                            ++border;
                        if (contrast(marked.pixel(x, y), view.ground.pixel(x, y)) >= least_contrast) ++clear;
                    }
                ++looked_at;
                EXPECT_GT(border, 20) << "face " << face;
                // Parts of the border are hidden by what stands before the face, and have no outline.
                EXPECT_GE(clear, 6 * border / 10) << "face " << face << ", bit " << int{bit};
            }
        }
    }
    renderer->set_face_highlights(std::vector<std::uint8_t>(level.mesh.face_count(), 0));
    EXPECT_GT(looked_at, 4u);
}

// The strokes of a type's hatch, which become thin far away, differ enough from the ground.
TEST_P(ShippedLevel, EveryTypeIsSeenOnItsGround) {
    std::map<SurfaceId, std::pair<int, int>> pixels;  // clear, all
    for (const View& view : views) {
        const Image typed = draw(*renderer, view.camera, width, height, LevelStyle{});
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x) {
                const Seen& seen = view.at(x, y);
                if (seen.face == no_id || faces[seen.face] == default_surface) continue;
                auto& [clear, all] = pixels[faces[seen.face]];
                ++all;
                if (contrast(typed.pixel(x, y), view.ground.pixel(x, y)) >= least_contrast) ++clear;
            }
    }
    for (const auto& [type, count] : pixels) {
        if (count.second < 200 || level.surfaces[type].hatch == Hatch::none) continue;
        EXPECT_GE(count.first, count.second / 33)
            << level.surfaces[type].name << ": " << count.first << " of " << count.second;
    }
}

// Colours that mean something of their own in the view differ from each other.
TEST_P(ShippedLevel, TheSelectionHasAColourOfItsOwn) {
    const View& view = views.front();
    const std::vector<FaceId> floors = large_floors(view, 1);
    ASSERT_FALSE(floors.empty());
    std::vector<std::uint8_t> marks(level.mesh.face_count(), 0);
    marks[floors[0]] = 2;
    renderer->set_face_highlights(marks);
    const Image selected = draw(*renderer, view.camera, width, height, plain);
    renderer->set_face_highlights(std::vector<std::uint8_t>(level.mesh.face_count(), 0));
    const auto mean_hue = [&](const Image& image) {
        Vec3 sum = Vec3::Zero();
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x)
                if (view.at(x, y).face == floors[0]) {
                    const std::uint8_t* p = image.pixel(x, y);
                    sum += Vec3(p[0], p[1], p[2]);
                }
        return Vec3((sum.array() - sum.mean()) / sum.mean());  // without brightness
    };
    const Vec3 own = mean_hue(selected);
    for (const SurfaceType& type : level.surfaces) {
        if (type.name == "default") continue;
        renderer->set_face_surfaces(std::vector<SurfaceId>(
            level.mesh.face_count(), static_cast<SurfaceId>(&type - level.surfaces.data())));
        const Vec3 other = mean_hue(draw(*renderer, view.camera, width, height, LevelStyle{}));
        EXPECT_GT((own - other).norm(), 0.2) << type.name;
    }
    renderer->set_face_surfaces(faces);
    LevelStyle walkable;
    walkable.colors = FaceColors::walkable;
    for (const double limit : {0.01, 1.5}) {  // all floors too steep, none is
        walkable.max_slope = limit;
        EXPECT_GT((own - mean_hue(draw(*renderer, view.camera, width, height, walkable))).norm(), 0.2)
            << limit;
    }
}

INSTANTIATE_TEST_SUITE_P(Levels, ShippedLevel, testing::Values("easy", "hard", "island", "playground"),
                         [](const auto& test) { return std::string(test.param); });

}  // namespace
}  // namespace slipface::test
