// glTF files that a writer of this test makes in all forms that the specification allows, against what they
// say.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gmock/gmock.h>

#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>
#include <random>

#include "mesh_test_tools.h"
#include "slipface/base/base64.h"
#include "slipface/mesh/animation.h"

namespace slipface {
namespace {

using nlohmann::json;
using testing::HasSubstr;

// Numbers that are the same with every library.
class Draw {
  public:
    explicit Draw(unsigned seed) : engine_(seed) {}
    int below(int n) { return static_cast<int>(engine_() % static_cast<unsigned>(n)); }
    double number(double low, double high) {
        return low + (high - low) * (static_cast<double>(engine_() % 65536U) / 65535.0);
    }
    Eigen::Vector3d vector(double low, double high) {
        const double x = number(low, high), y = number(low, high), z = number(low, high);
        return {x, y, z};
    }
    Eigen::Quaterniond turn() {
        const double a = number(-3, 3);
        const Eigen::Vector3d axis = vector(-1, 1) + Eigen::Vector3d(0, 2, 0);
        return Eigen::Quaterniond(Eigen::AngleAxisd(a, axis.normalized()));
    }

  private:
    std::mt19937 engine_;
};

template <class Number>
std::string bytes_of(const std::vector<Number>& numbers) {
    return {reinterpret_cast<const char*>(numbers.data()), numbers.size() * sizeof(Number)};
}

// A file with one buffer.
class Writer {
  public:
    json root = {{"asset", {{"version", "2.0"}}}};

    std::size_t view(const std::string& bytes) {
        bytes_.resize((bytes_.size() + 3) / 4 * 4);
        root["bufferViews"].push_back(
            {{"buffer", 0}, {"byteOffset", bytes_.size()}, {"byteLength", bytes.size()}});
        bytes_ += bytes;
        return root["bufferViews"].size() - 1;
    }
    std::size_t accessor(json members) {
        root["accessors"].push_back(std::move(members));
        return root["accessors"].size() - 1;
    }
    template <class Number>
    std::size_t numbers(const std::vector<Number>& list, int component, const char* type, std::size_t per,
                        bool normal = false) {
        json made = {{"bufferView", view(bytes_of(list))},
                     {"componentType", component},
                     {"count", list.size() / per},
                     {"type", type}};
        if (normal) made["normalized"] = true;
        return accessor(std::move(made));
    }
    std::size_t floats(const std::vector<float>& list, const char* type, std::size_t per) {
        return numbers(list, 5126, type, per);
    }

    std::string text() {
        root["buffers"] = json::array(
            {{{"byteLength", bytes_.size()},
              {"uri", "data:application/octet-stream;base64," + to_base64(bytes_, Base64::padded)}}});
        return root.dump();
    }

  private:
    std::string bytes_;
};

class ImportGltf : public ScratchFolder {
  protected:
    Result<ImportedMesh> import_text(const std::string& text, const std::string& name = "level.gltf") {
        write(name, text);
        return import_mesh(folder / name);
    }
    std::string refusal(const std::string& text) {
        const auto result = import_text(text);
        return result ? "read" : result.error().text();
    }
};

std::vector<float> flat(const std::vector<Eigen::Vector3d>& points) {
    std::vector<float> list;
    for (const Eigen::Vector3d& p : points)
        for (int i = 0; i < 3; ++i)
            list.push_back(static_cast<float>(p[i]));
    return list;
}

Eigen::Matrix4d matrix_of(const Eigen::Vector3d& t, const Eigen::Quaterniond& r, const Eigen::Vector3d& s) {
    Eigen::Affine3d affine = Eigen::Translation3d(t) * r * Eigen::Scaling(s);
    return affine.matrix();
}

json as_list(const Eigen::Quaterniond& q) {
    return {q.x(), q.y(), q.z(), q.w()};
}

json as_list(const Eigen::Vector3d& v) {
    return {v.x(), v.y(), v.z()};
}

// Positions of a mesh in one of the ways to store them; `points` becomes what they mean.
std::size_t positions_in_some_form(Writer& file, std::vector<Eigen::Vector3d>& points, Draw& draw) {
    const int form = draw.below(4);
    if (form == 0) return file.floats(flat(points), "VEC3", 3);
    if (form == 1) {  // between other numbers
        std::vector<float> mixed{7.0F};
        for (const Eigen::Vector3d& p : points)
            for (const double v : {p.x(), p.y(), p.z(), 99.0, 98.0})
                mixed.push_back(static_cast<float>(v));
        const std::size_t view = file.view(bytes_of(mixed));
        file.root["bufferViews"][view]["byteStride"] = 20;
        return file.accessor({{"bufferView", view},
                              {"byteOffset", 4},
                              {"componentType", 5126},
                              {"count", points.size()},
                              {"type", "VEC3"}});
    }
    if (form == 2) {  // zeros, of which all are changed
        std::vector<std::uint16_t> places;
        for (std::size_t i = 0; i < points.size(); ++i)
            places.push_back(static_cast<std::uint16_t>(i));
        const std::size_t at = file.view(bytes_of(places)), values = file.view(bytes_of(flat(points)));
        return file.accessor({{"componentType", 5126},
                              {"count", points.size()},
                              {"type", "VEC3"},
                              {"sparse",
                               {{"count", points.size()},
                                {"indices", {{"bufferView", at}, {"componentType", 5123}}},
                                {"values", {{"bufferView", values}}}}}});
    }
    file.root["extensionsUsed"] = file.root["extensionsRequired"] = {"KHR_mesh_quantization"};
    std::vector<std::int16_t> whole;
    for (Eigen::Vector3d& p : points) {
        for (int i = 0; i < 3; ++i) {
            whole.push_back(static_cast<std::int16_t>(std::lround(p[i] * 1000.0)));
            p[i] = whole.back() / 32767.0;
        }
        whole.push_back(0);
    }
    const std::size_t view = file.view(bytes_of(whole));
    file.root["bufferViews"][view]["byteStride"] = 8;
    return file.accessor({{"bufferView", view},
                          {"componentType", 5122},
                          {"normalized", true},
                          {"count", points.size()},
                          {"type", "VEC3"}});
}

// A primitive of random triangles in some mode, with indices of some type or none; `triangles` are what it
// means.
json random_primitive(Writer& file, Draw& draw, std::vector<std::array<Eigen::Vector3d, 3>>& triangles) {
    std::vector<Eigen::Vector3d> points;
    const int count = 3 + draw.below(9);
    for (int i = 0; i < count; ++i)
        points.push_back(draw.vector(-5, 5));
    json primitive = {{"attributes", {{"POSITION", positions_in_some_form(file, points, draw)}}}};
    std::vector<std::uint32_t> order;
    const int index_type = draw.below(4);
    for (int i = 0; i < count + draw.below(6); ++i)
        order.push_back(static_cast<std::uint32_t>(index_type == 3 && i < count ? i : draw.below(count)));
    if (index_type == 3) order.resize(static_cast<std::size_t>(count));
    if (index_type == 0)
        primitive["indices"] =
            file.numbers(std::vector<std::uint8_t>(order.begin(), order.end()), 5121, "SCALAR", 1);
    if (index_type == 1)
        primitive["indices"] =
            file.numbers(std::vector<std::uint16_t>(order.begin(), order.end()), 5123, "SCALAR", 1);
    if (index_type == 2) primitive["indices"] = file.numbers(order, 5125, "SCALAR", 1);
    const int mode = 4 + draw.below(3);
    if (mode != 4 || draw.below(2) == 0) primitive["mode"] = mode;
    const auto add = [&](std::size_t a, std::size_t b, std::size_t c) {
        triangles.push_back({points[order[a]], points[order[b]], points[order[c]]});
    };
    for (std::size_t i = 2; i < order.size(); ++i) {
        if (mode == 4 && i % 3 == 2) add(i - 2, i - 1, i);
        if (mode == 5) i % 2 == 0 ? add(i - 2, i - 1, i) : add(i - 1, i - 2, i);
        if (mode == 6) add(0, i - 1, i);
    }
    return primitive;
}

bool same_triangle(const Mesh& mesh, std::size_t face, const std::array<Eigen::Vector3d, 3>& expected,
                   bool mirrored) {
    for (std::uint32_t i = 0; i < 3; ++i) {
        const Vec3f at = mesh.corner_position(mesh.face_first_corner[face] + i);
        if ((at.cast<double>() - expected[mirrored ? 2 - i : i]).norm() > 1e-4) return false;
    }
    return true;
}

TEST_F(ImportGltf, EveryFormOfAMeshIsWhatItSays) {
    for (unsigned seed = 1; seed <= 200; ++seed) {
        SCOPED_TRACE(seed);
        Draw draw(seed);
        Writer file;
        std::vector<std::vector<std::array<Eigen::Vector3d, 3>>> meshes;
        for (int i = 0; i < 1 + draw.below(3); ++i) {
            std::vector<std::array<Eigen::Vector3d, 3>> triangles;
            json made;
            for (int k = 0; k < 1 + draw.below(2); ++k)
                made["primitives"].push_back(random_primitive(file, draw, triangles));
            file.root["meshes"].push_back(made);
            meshes.push_back(triangles);
        }
        std::vector<std::pair<std::array<Eigen::Vector3d, 3>, bool>> expected;
        std::vector<Eigen::Matrix4d> worlds;
        json roots = json::array();
        const int nodes = 1 + draw.below(5);
        for (int i = 0; i < nodes; ++i) {
            const int parent = draw.below(i + 1) - 1;
            const Eigen::Vector3d t = draw.vector(-20, 20);
            const Eigen::Quaterniond r = draw.turn();
            Eigen::Vector3d s = draw.vector(0.5, 2);
            if (draw.below(3) == 0) s.x() = -s.x();
            json node;
            const Eigen::Matrix4d local = matrix_of(t, r, s);
            if (draw.below(2) == 0) {
                for (int k = 0; k < 16; ++k)
                    node["matrix"].push_back(local.data()[k]);
            } else {
                node = {{"translation", as_list(t)}, {"rotation", as_list(r)}, {"scale", as_list(s)}};
            }
            worlds.push_back(parent < 0 ? local
                                        : Eigen::Matrix4d(worlds[static_cast<std::size_t>(parent)] * local));
            node["mesh"] = draw.below(static_cast<int>(meshes.size()));
            file.root["nodes"].push_back(node);
            if (parent < 0)
                roots.push_back(i);
            else
                file.root["nodes"][static_cast<std::size_t>(parent)]["children"].push_back(i);
        }
        file.root["scenes"] = json::array({{{"nodes", roots}}});
        // In the order of the tree.
        std::vector<std::size_t> open(roots.rbegin(), roots.rend());
        while (!open.empty()) {
            const std::size_t node = open.back();
            open.pop_back();
            const bool mirrored = worlds[node].topLeftCorner<3, 3>().determinant() < 0.0;
            for (const auto& triangle : meshes[file.root["nodes"][node]["mesh"].get<std::size_t>()]) {
                std::array<Eigen::Vector3d, 3> moved;
                for (std::size_t i = 0; i < 3; ++i)
                    moved[i] = (worlds[node] * triangle[i].homogeneous()).head<3>();
                expected.emplace_back(moved, mirrored);
            }
            if (file.root["nodes"][node].contains("children")) {
                const json& children = file.root["nodes"][node]["children"];
                for (auto child = children.rbegin(); child != children.rend(); ++child)
                    open.push_back(child->get<std::size_t>());
            }
        }
        const auto result = import_text(file.text());
        ASSERT_TRUE(result) << result.error().text();
        ASSERT_EQ(result->mesh->face_count(), expected.size());
        for (std::size_t face = 0; face < expected.size(); ++face)
            ASSERT_TRUE(same_triangle(*result->mesh, face, expected[face].first, expected[face].second))
                << face;
        // With a clip that keeps a node where it is, the pose is that of rest.
        file.root["animations"] = json::array(
            {{{"samplers", json::array({{{"input", file.floats({0}, "SCALAR", 1)},
                                         {"output", file.floats({1, 1, 1}, "VEC3", 3)}}})},
              {"channels", json::array({{{"sampler", 0}, {"target", {{"node", 0}, {"path", "scale"}}}}})}}});
        const auto moving = import_text(file.text());
        ASSERT_TRUE(moving) << moving.error().text();
        RigPose pose;
        pose_rig(*moving->mesh->rig, no_id, 0.0, pose);
        for (std::uint32_t corner = 0; corner < moving->mesh->corner_vertex.size(); ++corner)
            ASSERT_LT(
                (posed_position(*moving->mesh->rig, pose, corner) - moving->mesh->corner_position(corner))
                    .norm(),
                1e-3F);
    }
}

// A triangle with a skin of two joints, a morph target and a clip, in random places; `file` is complete.
struct Puppet {
    Writer file;
    std::vector<Eigen::Vector3d> points, deltas;
    std::vector<std::array<double, 2>> weights;  // [vertex] of the joints
    Eigen::Vector3d offset[2], scale[2];         // of the joints at rest
    Eigen::Quaterniond turn[2];
    Eigen::Matrix4d bind[2];
    double morph = 0.0;
    std::vector<float> times;
    std::vector<Eigen::Quaterniond> turns;  // of joint 1
    std::vector<float> morphs;
    int between = 0;  // step, linear

    explicit Puppet(Draw& draw) {
        for (int i = 0; i < 3; ++i) {
            points.push_back(draw.vector(-2, 2));
            deltas.push_back(draw.vector(-1, 1));
            const double w = draw.number(0, 1);
            weights.push_back({w, 1.0 - w});
        }
        std::vector<float> weight_list, binds;
        std::vector<std::uint8_t> joint_list;
        for (const auto& w : weights) {
            weight_list.insert(weight_list.end(), {static_cast<float>(w[0]), static_cast<float>(w[1]), 0, 0});
            joint_list.insert(joint_list.end(), {0, 1, 0, 0});
        }
        for (int i = 0; i < 2; ++i) {
            offset[i] = draw.vector(-3, 3);
            turn[i] = draw.turn();
            scale[i] = draw.vector(0.5, 1.5);
            bind[i] = matrix_of(draw.vector(-1, 1), draw.turn(), {1, 1, 1});
            for (int k = 0; k < 16; ++k)
                binds.push_back(static_cast<float>(bind[i].data()[k]));
        }
        morph = draw.number(-1, 1);
        between = draw.below(2);
        float at = draw.below(2) == 0 ? 0.0F : 0.25F;
        const int keys = 1 + draw.below(5);
        for (int i = 0; i < keys; ++i) {
            times.push_back(at);
            at += static_cast<float>(draw.number(0.1, 1.0));
            turns.push_back(draw.turn());
            morphs.push_back(static_cast<float>(draw.number(-1, 1)));
        }
        std::vector<float> turn_list;
        for (const Eigen::Quaterniond& q : turns)
            for (const double v : {q.x(), q.y(), q.z(), q.w()})
                turn_list.push_back(static_cast<float>(v));
        json& root = file.root;
        root["meshes"] = json::array(
            {{{"weights", {morph}},
              {"primitives",
               json::array(
                   {{{"attributes",
                      {{"POSITION", file.floats(flat(points), "VEC3", 3)},
                       {"JOINTS_0", file.numbers(joint_list, 5121, "VEC4", 4)},
                       {"WEIGHTS_0", file.floats(weight_list, "VEC4", 4)}}},
                     {"targets", json::array({{{"POSITION", file.floats(flat(deltas), "VEC3", 3)}}})}}})}}});
        root["skins"] =
            json::array({{{"joints", {1, 2}}, {"inverseBindMatrices", file.floats(binds, "MAT4", 16)}}});
        // The node of a skin has no say where it stands.
        root["nodes"] =
            json::array({{{"mesh", 0}, {"skin", 0}, {"translation", as_list(draw.vector(-50, 50))}},
                         {{"translation", as_list(offset[0])},
                          {"rotation", as_list(turn[0])},
                          {"scale", as_list(scale[0])},
                          {"children", {2}}},
                         {{"translation", as_list(offset[1])},
                          {"rotation", as_list(turn[1])},
                          {"scale", as_list(scale[1])}}});
        root["scenes"] = json::array({{{"nodes", {0, 1}}}});
        const std::size_t time = file.floats(times, "SCALAR", 1);
        const char* const word = between == 0 ? "STEP" : "LINEAR";
        root["animations"] = json::array(
            {{{"name", "wave"},
              {"samplers",
               json::array(
                   {{{"input", time}, {"interpolation", word}, {"output", file.floats(turn_list, "VEC4", 4)}},
                    {{"input", time},
                     {"interpolation", word},
                     {"output", file.floats(morphs, "SCALAR", 1)}}})},
              {"channels",
               json::array({{{"sampler", 0}, {"target", {{"node", 2}, {"path", "rotation"}}}},
                            {{"sampler", 1}, {"target", {{"node", 0}, {"path", "weights"}}}}})}}});
    }

    // Where the clip has vertex `i` at `at` seconds; nothing: at rest.
    Eigen::Vector3d expected(std::size_t i, std::optional<double> at) const {
        Eigen::Quaterniond second = turn[1];
        double weight = morph;
        if (at) {
            std::size_t key = 0;
            while (key + 1 < times.size() && static_cast<double>(times[key + 1]) <= *at)
                ++key;
            second = turns[key];
            weight = static_cast<double>(morphs[key]);
            if (between == 1 && key + 1 < times.size() && *at > static_cast<double>(times[key])) {
                const double begin = static_cast<double>(times[key]);
                const double t = (*at - begin) / (static_cast<double>(times[key + 1]) - begin);
                second = turns[key].slerp(t, turns[key + 1]);
                weight = (1 - t) * weight + t * static_cast<double>(morphs[key + 1]);
            }
        }
        const Eigen::Matrix4d first_world = matrix_of(offset[0], turn[0], scale[0]);
        const Eigen::Matrix4d second_world = first_world * matrix_of(offset[1], second, scale[1]);
        const Eigen::Vector4d own = (points[i] + weight * deltas[i]).homogeneous();
        return weights[i][0] * (first_world * bind[0] * own).head<3>() +
               weights[i][1] * (second_world * bind[1] * own).head<3>();
    }
};

TEST_F(ImportGltf, SkinsMorphTargetsAndClipsAreWhatTheySay) {
    for (unsigned seed = 1; seed <= 100; ++seed) {
        SCOPED_TRACE(seed);
        Draw draw(seed);
        Puppet puppet(draw);
        const auto result = import_text(puppet.file.text());
        ASSERT_TRUE(result) << result.error().text();
        const Mesh& mesh = *result->mesh;
        ASSERT_TRUE(mesh.rig);
        const std::uint32_t clip = find_clip(*mesh.rig, "wave");
        ASSERT_EQ(clip, 0U);
        ASSERT_EQ(find_clip(*mesh.rig, "run"), no_id);
        RigPose pose;
        for (std::uint32_t i = 0; i < 3; ++i)
            EXPECT_LT((mesh.corner_position(i).cast<double>() - puppet.expected(i, std::nullopt)).norm(),
                      1e-4);
        pose_rig(*mesh.rig, no_id, 0.0, pose);
        for (std::uint32_t i = 0; i < 3; ++i)
            EXPECT_LT((posed_position(*mesh.rig, pose, i) - mesh.corner_position(i)).norm(), 1e-4F)
                << "at rest";
        const double length = static_cast<double>(puppet.times.back());
        EXPECT_EQ(mesh.rig->clips[0].seconds, puppet.times.back());
        for (int k = 0; k < 10; ++k) {
            const double at = 0.999 * length * draw.number(0, 1);
            pose_rig(*mesh.rig, clip, at, pose);
            for (std::uint32_t i = 0; i < 3; ++i)
                EXPECT_LT((posed_position(*mesh.rig, pose, i).cast<double>() - puppet.expected(i, at)).norm(),
                          1e-3)
                    << at;
            if (length == 0.0) continue;
            // Clips repeat, and an animation may be ahead of others, quicker, or backwards.
            RigPose other;
            Animation animation{.clip = "wave", .speed = -2.0, .phase_s = at + 20.0 * length};
            pose_at(mesh, animation, 5.0 * length, other);
            for (std::uint32_t i = 0; i < 3; ++i)
                EXPECT_LT((posed_position(*mesh.rig, pose, i) - posed_position(*mesh.rig, other, i)).norm(),
                          0.05F);
        }
    }
}

TEST_F(ImportGltf, InstancesAreObjects) {
    Writer file;
    const std::size_t places = file.floats({0, 0, 0, 10, 0, 0, 0, 0, 20}, "VEC3", 3);
    file.root["meshes"] = json::array(
        {{{"primitives",
           json::array(
               {{{"attributes", {{"POSITION", file.floats({0, 0, 0, 0, 0, 1, 1, 0, 0}, "VEC3", 3)}}}}})}}});
    file.root["nodes"] = json::array(
        {{{"name", "tree"},
          {"mesh", 0},
          {"translation", {0, 5, 0}},
          {"extensions", {{"EXT_mesh_gpu_instancing", {{"attributes", {{"TRANSLATION", places}}}}}}}}});
    file.root["scenes"] = json::array({{{"nodes", {0}}}});
    const auto result = import_text(file.text());
    ASSERT_TRUE(result) << result.error().text();
    EXPECT_EQ(result->mesh->face_count(), 3U);
    EXPECT_EQ(result->mesh->bounds.min, Vec3(0, 5, 0));
    EXPECT_EQ(result->mesh->bounds.max, Vec3(11, 5, 21));
    EXPECT_THAT(result->mesh->groups, testing::ElementsAre("tree 1", "tree 2", "tree 3"));
}

TEST_F(ImportGltf, NormalisedTexturePositionsAndEscapedNamesAreRead) {
    Writer file;
    file.root["meshes"] = json::array(
        {{{"primitives",
           json::array({{{"attributes",
                          {{"POSITION", file.floats({0, 0, 0, 0, 0, 1, 1, 0, 0}, "VEC3", 3)},
                           {"TEXCOORD_0", file.numbers(std::vector<std::uint16_t>{0, 0, 65535, 0, 0, 65535},
                                                       5123, "VEC2", 2, true)}}}}})}}});
    file.root["nodes"] = json::array({{{"mesh", 0}}});
    std::string text = file.text();
    json root = json::parse(text);
    const auto uri = root["buffers"][0]["uri"].get<std::string>();
    write("my file.bin",
          *from_base64(std::string_view(uri).substr(uri.find(',') + 1,
                                                    uri.find('=') == std::string::npos
                                                        ? std::string::npos
                                                        : uri.find('=', uri.find(',')) - uri.find(',') - 1),
                       Base64::plain));
    root["buffers"][0]["uri"] = "my%20file.bin";
    const auto result = import_text(root.dump());
    ASSERT_TRUE(result) << result.error().text();
    EXPECT_EQ(result->mesh->corner_uv[0], Vec2f(0, 1));
    EXPECT_EQ(result->mesh->corner_uv[1], Vec2f(1, 1));
    EXPECT_EQ(result->mesh->corner_uv[2], Vec2f(0, 0));
    EXPECT_EQ(result->mesh->other_files.size(), 1U);
}

// Every number, text, list and object of a file is replaced by something else, one at a time: read or refused
// with a place, never anything else.
TEST_F(ImportGltf, AnyMemberMayBeWrong) {
    Draw draw(3);
    Puppet puppet(draw);
    const json whole = json::parse(puppet.file.text());
    const json replacements[] = {nullptr, -1, 4294967295U, 0.5, "x", json::array({1, 2, 3})};
    std::size_t refused = 0, tried = 0;
    const json paths = whole.flatten();
    for (const auto& [path, value] : paths.items()) {
        for (const json& replacement : replacements) {
            json changed = whole;
            changed[json::json_pointer(path)] = replacement;
            const std::string said = refusal(changed.dump());
            ++tried;
            if (said == "read") continue;
            ++refused;
            EXPECT_THAT(said, HasSubstr("level.gltf")) << path << " " << replacement;
        }
    }
    EXPECT_GT(refused, tried / 3);
    EXPECT_LT(refused, tried);
}

TEST_F(ImportGltf, WhatIsNotReadIsRefusedByName) {
    Writer file;
    file.root["meshes"] = json::array(
        {{{"primitives",
           json::array(
               {{{"attributes", {{"POSITION", file.floats({0, 0, 0, 0, 0, 1, 1, 0, 0}, "VEC3", 3)}}}}})}}});
    file.root["nodes"] = json::array({{{"mesh", 0}}});
    EXPECT_EQ(refusal(file.text()), "read");
    file.root["extensionsRequired"] = {"ACME_shape"};
    EXPECT_THAT(refusal(file.text()),
                HasSubstr("/extensionsRequired/0: the file requires the extension 'ACME_shape'"));
    file.root.erase("extensionsRequired");
    file.root["asset"]["version"] = "3.0";
    EXPECT_THAT(refusal(file.text()), HasSubstr("is glTF '3.0'; expected 2.0"));
    file.root["asset"]["version"] = "2.0";
    file.root["nodes"][0]["children"] = {0};
    EXPECT_THAT(refusal(file.text()), HasSubstr("has no faces")) << "no node is a root";
    file.root["scenes"] = json::array({{{"nodes", {0}}}});
    EXPECT_THAT(refusal(file.text()), HasSubstr("/nodes/0: stands at two places"));
}

}  // namespace
}  // namespace slipface
