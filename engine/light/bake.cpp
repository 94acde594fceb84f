#include "slipface/light/bake.h"

#include <algorithm>
#include <atomic>
#include <cmath>

#include "lit_geometry.h"
#include "slipface/base/files.h"
#include "slipface/base/parallel.h"
#include "slipface/base/system.h"
#include "slipface/level/level_file.h"

namespace slipface {
namespace {

constexpr double faintest = 0.003;       // emitters that contribute less light are skipped
constexpr double occlusion_m = 0.9;      // at this distance half of the ambient light remains
constexpr double behind_fraction = 0.4;  // of rays that hit backs of faces: above it the texel is in a solid
constexpr double brightest_glow = 1.2;   // upper limit of an emitting face in the image

// Points spread evenly over the unit disc: the R2 sequence without the points outside.
// Source: Roberts, "The unreasonable effectiveness of quasirandom sequences", 2018.
std::vector<Vec2> disc_points(int count) {
    std::vector<Vec2> points;
    double x = 0.5, y = 0.5;
    while (points.size() < static_cast<std::size_t>(std::max(count, 1))) {
        const Vec2 point(2.0 * x - 1.0, 2.0 * y - 1.0);
        if (point.squaredNorm() < 0.998) points.push_back(point);
        x += 0.7548776662466927;
        y += 0.5698402909980532;
        x -= std::floor(x);
        y -= std::floor(y);
    }
    return points;
}

std::uint8_t encoded(double light) {
    const double fraction = std::clamp(light / light_map_range, 0.0, 1.0);
    return static_cast<std::uint8_t>(255.0 * std::sqrt(fraction) + 0.5);
}

struct Texels {
    std::vector<Vec3> light;
    std::vector<bool> valid;
};

// Gives texels without a value the mean of their neighbours that have one, ring by ring.
void fill_gaps(Texels& texels, int width, int height) {
    for (int round = 0; round < width + height; ++round) {
        const std::vector<bool> before = texels.valid;
        bool missing = false;
        for (int y = 0; y < height; ++y) {
            for (int x = 0; x < width; ++x) {
                const auto at = static_cast<std::size_t>(y * width + x);
                if (before[at]) continue;
                Vec3 sum = Vec3::Zero();
                int count = 0;
                const auto look = [&](int i, int j) {
                    const auto beside = static_cast<std::size_t>(j * width + i);
                    if (i < 0 || j < 0 || i >= width || j >= height || !before[beside]) return;
                    sum += texels.light[beside];
                    ++count;
                };
                look(x - 1, y);
                look(x + 1, y);
                look(x, y - 1);
                look(x, y + 1);
                missing = missing || count == 0;
                if (count == 0) continue;
                texels.light[at] = sum / count;
                texels.valid[at] = true;
            }
        }
        if (!missing) return;
    }
}

}  // namespace

struct LightBaker::Impl {
    LitGeometry lit;
    std::vector<Vec2> sky_points, sun_points;
    std::vector<std::size_t> first_texel;  // [face + 1]

    Vec3f direct(FaceId face, int i, int j) const;
    Vec3 gather(FaceId face, int i, int j, std::span<const Vec3f> known, bool& valid) const;
    std::vector<std::uint8_t> face_bytes(FaceId face, std::span<const Vec3f> known) const;
    double sun_fraction(FaceId face, int i, int j) const;
};

// The fraction of the sun that a texel sees, times the cosine; each ray starts at another point of the texel.
double LightBaker::Impl::sun_fraction(FaceId face, int i, int j) const {
    const LightChart& chart = lit.charts.charts[face];
    const double cosine = lit.normal[face].dot(lit.sun);
    if (cosine <= 0.0) return 0.0;
    const Vec3 side =
        (std::abs(lit.sun.y()) < 0.9 ? Vec3::UnitY() : Vec3::UnitX()).cross(lit.sun).normalized();
    const Vec3 other = lit.sun.cross(side);
    int seen = 0;
    for (const Vec2& point : sun_points) {
        const Vec3 from =
            point_on_face(lit, face, chart.texel_position(i + 0.5 * point.x(), j + 0.5 * point.y()));
        const Vec3 towards = lit.sun + lit.light.sun_size * (point.y() * side - point.x() * other);
        const auto hit = cast_ray(lit.world, from, towards);
        if (hit ? lit.window[lit.mesh->face_material[hit->face]] : lit.open) ++seen;
    }
    return cosine * seen / static_cast<double>(sun_points.size());
}

Vec3f LightBaker::Impl::direct(FaceId face, int i, int j) const {
    const LightChart& chart = lit.charts.charts[face];
    Vec3 light = sun_fraction(face, i, j) * lit.light.sun_color;
    const Vec3 from = point_on_face(lit, face, chart.texel_position(i, j));
    for (const Emitter& emitter : lit.emitters) {
        const Vec3 path = emitter.position - from;
        const double here = path.dot(lit.normal[face]), there = -path.dot(emitter.normal);
        if (here <= 0.0 || there <= 0.0) continue;
        const double square = path.squaredNorm();
        const double fraction = here * there * emitter.area / (square * (3.14159265 * square + emitter.area));
        if (fraction * emitter.color.maxCoeff() < faintest) continue;
        if (!cast_ray(lit.world, from, path, 1.0)) light += fraction * emitter.color;
    }
    return light.cast<float>();
}

// Light from the sky and reflected by other faces. `valid` is set to false if the texel lies behind faces.
Vec3 LightBaker::Impl::gather(FaceId face, int i, int j, std::span<const Vec3f> known, bool& valid) const {
    const LightChart& chart = lit.charts.charts[face];
    const Vec3& normal = lit.normal[face];
    const Vec3 from = point_on_face(lit, face, chart.texel_position(i, j));
    Vec3 sum = Vec3::Zero();
    int behind = 0;
    for (const Vec2& point : sky_points) {
        const Vec3 towards =
            point.x() * chart.u + point.y() * chart.v + std::sqrt(1.0 - point.squaredNorm()) * normal;
        const auto hit = cast_ray(lit.world, from, towards);
        if (!hit) {
            sum += lit.sky(towards);
            continue;
        }
        if (hit->back_face) ++behind;
        if (lit.glows(hit->face)) continue;  // counted by direct()
        const LightChart& other = lit.charts.charts[hit->face];
        if (other.width == 0) continue;
        const Vec2 at = other.coordinate(hit->point);
        const int x = static_cast<int>(at.x() + 0.5), y = static_cast<int>(at.y() + 0.5);
        const Vec3f falls =
            known.empty() ? direct(hit->face, x, y)
                          : known[first_texel[hit->face] + static_cast<std::size_t>(y * other.width + x)];
        const double square = hit->t * hit->t;
        const Vec3 reflected =
            falls.cast<double>() + square / (square + occlusion_m * occlusion_m) * lit.light.ambient;
        sum += reflected.cwiseProduct(lit.albedo[lit.mesh->face_material[hit->face]]);
    }
    valid = behind <= behind_fraction * static_cast<double>(sky_points.size());
    return sum / static_cast<double>(sky_points.size());
}

std::vector<std::uint8_t> LightBaker::Impl::face_bytes(FaceId face, std::span<const Vec3f> known) const {
    const LightChart& chart = lit.charts.charts[face];
    const auto count = static_cast<std::size_t>(chart.width) * chart.height;
    Texels texels{std::vector<Vec3>(count, Vec3::Zero()), std::vector<bool>(count, true)};
    const Vec3& glow = lit.emission[lit.mesh->face_material[face]];
    for (int j = 0; j < chart.height; ++j) {
        for (int i = 0; i < chart.width; ++i) {
            const auto at = static_cast<std::size_t>(j * chart.width + i);
            if (glow.maxCoeff() > 0.0) {
                texels.light[at] = glow * std::min(1.0, brightest_glow / glow.maxCoeff());
                continue;
            }
            const Vec3f falls = known.empty() ? direct(face, i, j) : known[first_texel[face] + at];
            bool valid = true;
            texels.light[at] = falls.cast<double>() + gather(face, i, j, known, valid);
            texels.valid[at] = valid;
        }
    }
    fill_gaps(texels, chart.width, chart.height);
    std::vector<std::uint8_t> bytes;
    bytes.reserve(3 * count);
    for (const Vec3& light : texels.light) {
        for (int channel = 0; channel < 3; ++channel)
            bytes.push_back(encoded(light[channel]));
    }
    return bytes;
}

LightBaker::LightBaker(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
LightBaker::~LightBaker() = default;
LightBaker::LightBaker(LightBaker&&) noexcept = default;
LightBaker& LightBaker::operator=(LightBaker&&) noexcept = default;

Result<LightBaker> LightBaker::make(const Level& level, const LightQuality& quality) {
    Result<LitGeometry> lit = make_lit_geometry(level);
    if (!lit) return lit.error();
    auto impl = std::make_unique<Impl>();
    impl->lit = std::move(*lit);
    impl->sky_points = disc_points(quality.sky_rays);
    impl->sun_points = disc_points(quality.sun_rays);
    std::size_t texels = 0;
    for (const LightChart& chart : impl->lit.charts.charts) {
        impl->first_texel.push_back(texels);
        texels += static_cast<std::size_t>(chart.width) * chart.height;
    }
    impl->first_texel.push_back(texels);
    return LightBaker(std::move(impl));
}

const LightCharts& LightBaker::charts() const {
    return impl_->lit.charts;
}

Image LightBaker::bake(const std::function<void(double)>& progress) const {
    const LightCharts& charts = impl_->lit.charts;
    const std::size_t faces = charts.charts.size();
    std::vector<Vec3f> known(impl_->first_texel.back(), Vec3f::Zero());
    std::atomic<std::size_t> done = 0;
    const auto report = [&](std::size_t count, double start, double length) {
        const std::size_t now = done += count;
        if (progress) progress(start + length * static_cast<double>(now) / static_cast<double>(faces));
    };
    parallel_for(faces, 32, [&](std::size_t begin, std::size_t end) {
        for (std::size_t face = begin; face < end; ++face) {
            const LightChart& chart = charts.charts[face];
            for (int j = 0; j < chart.height; ++j) {
                for (int i = 0; i < chart.width; ++i) {
                    known[impl_->first_texel[face] + static_cast<std::size_t>(j * chart.width + i)] =
                        impl_->direct(static_cast<FaceId>(face), i, j);
                }
            }
        }
        report(end - begin, 0.0, 0.2);
    });
    done = 0;
    Image image = make_image(charts.width, charts.height, 0, 0, 0);
    parallel_for(faces, 32, [&](std::size_t begin, std::size_t end) {
        for (std::size_t face = begin; face < end; ++face) {
            const LightChart& chart = charts.charts[face];
            const std::vector<std::uint8_t> bytes = impl_->face_bytes(static_cast<FaceId>(face), known);
            for (std::size_t at = 0; 3 * at < bytes.size(); ++at) {
                std::uint8_t* pixel = image.pixel(chart.x + static_cast<int>(at % chart.width),
                                                  chart.y + static_cast<int>(at / chart.width));
                std::copy_n(&bytes[3 * at], 3, pixel);
            }
        }
        report(end - begin, 0.2, 0.8);
    });
    return image;
}

std::vector<std::uint8_t> LightBaker::bake_face(FaceId face) const {
    return impl_->face_bytes(face, {});
}

Status bake_level_light(Level& level, const LightQuality& quality,
                        const std::function<void(double)>& progress) {
    if (!level.light) {
        level.light.emplace();
        level.light->sun_color = {1.0, 0.95, 0.85};
    }
    const Result<LightBaker> baker = LightBaker::make(level, quality);
    if (!baker) return baker.error();
    const std::string name = level.mesh_path.stem().string() + ".light.png";
    const Result<std::string> image = encode_png(baker->bake(progress));
    if (!image) return image.error();
    level.light->image = name;
    level.light->geometry = baker->charts().geometry;
    const std::string text = level_to_json(level);
    const FileToWrite files[] = {{level.file_path.parent_path() / path_of(name), *image},
                                 {level.file_path, text}};
    return write_files_atomic(files);
}

}  // namespace slipface
