// A run of the stepping protocol (docs/course.md): triangles, bodies that a caller moves, and one player.
#pragma once

#include <memory>
#include <vector>

#include "cli/request.h"
#include "slipface/movement/step.h"

namespace slipface::cli {

inline constexpr int course_protocol = 1;  // a change that breaks a speaker raises it

class CourseRun {
  public:
    // Of the members `body`, `feet`, `settings` and `meshes` of a request. Throws Refused.
    explicit CourseRun(const Placed& load);
    CourseRun(const CourseRun&) = delete;
    CourseRun& operator=(const CourseRun&) = delete;

    struct Answer {
        Vec3 feet, velocity;  // m, m/s; of the lowest point of the body, in the level
        bool grounded = false;
    };
    // Of the members `dt`, `wish`, `buttons` and `poses`. Throws Refused, and then nothing has changed.
    Answer step(const Placed& request);

    std::size_t triangle_count() const { return triangles_; }

  private:
    CollisionWorld still_;
    std::vector<std::unique_ptr<CollisionWorld>> bodies_;  // [moving body], as given
    std::vector<std::size_t> body_of_mesh_;                // [mesh]; no_body: it stands still
    std::vector<MovingPart> parts_;                        // [moving body]
    std::vector<SurfaceType> types_ = preset_surface_types();
    PlatformTree tree_;
    MovementSettings settings_;
    PlayerState state_;
    std::size_t triangles_ = 0;
};

}  // namespace slipface::cli
