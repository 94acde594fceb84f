// The search for the motions of parts, in stages: each part by itself, then together.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "face_matcher.h"
#include "part_support.h"
#include "part_types.h"
#include "similar_corners.h"

namespace slipface {

inline constexpr std::size_t max_guesses = 500'000;  // motions examined, of all parts
inline constexpr double enough_anchors = 0.7;        // of the anchor corners, that a motion must explain
inline constexpr double lost_below = 0.3;            // of the anchor corners
inline constexpr double in_place = 0.85;             // fraction of anchor corners of a part that stayed
inline constexpr double as_much = 0.1;               // less is explained nearly as much
inline constexpr std::size_t few_parts = 3;          // of which too little is known to be sure
inline constexpr double vote_slack = 0.3;            // by which parts yield to the motion of other parts

class MotionFinder {
  public:
    MotionFinder(FaceLookup& lookup, SurfaceTable surfaces, const PaintParts& parts,
                 const std::vector<StoredOverride>& stored, const VertexMotions& of_vertices);

    PartMotions run() &&;

  private:
    // Of a part.
    struct Reading {
        std::size_t move;
        PartMotion exact;  // that move, as it is for this part
        MotionSupport support;
    };
    struct Part {
        PartMotion best;
        std::optional<PartMotion> rival;  // explains as much as `best`, which is guessed
        MotionSupport best_support, staying;
        double best_rating = 0.0;
        bool searched = false;
        bool unclear = false;           // PartMotions::unclear_objects
        std::size_t shared = 0;         // other parts that the same motion explains
        std::vector<Reading> readings;  // all that are possible
    };

    struct Move {
        PartMotion motion;
        std::size_t parts = 0;  // that it explains
        std::size_t only = 0;   // of these: parts that nothing else explains
    };

    // part_search.cpp: each part by itself
    void find(std::size_t part);
    void find_flipped();
    void consider(std::size_t part, const PartMotion& motion);
    void try_known(std::size_t part);
    void try_boxes(std::size_t part);
    void try_box(std::size_t part, const Aabb& from, const Aabb& to);
    void try_corners(std::size_t part);
    void refine_and_consider(std::size_t part, const PartMotion& rough);
    void add_candidate(std::size_t part, const PartMotion& motion);
    bool near_vertices(std::size_t part, const PartMotion& rough, std::vector<Vec3>& from,
                       std::vector<Vec3>& to) const;
    std::optional<PartMotion> refitted(std::size_t part, const PartMotion& rough) const;
    static bool same(const Aabb& box, const PartMotion& a, const PartMotion& b);  // for what lies in the box

    // part_choice.cpp: the parts together
    void choose();
    void choose(std::size_t part);
    void find_readings(std::size_t part);
    void add_shared_readings(std::size_t part);
    void one_part_each_place();
    void doubt(std::size_t part);
    void doubt_rows();
    bool is_unexplained(std::size_t part);
    bool lies_as_before(std::size_t part);
    bool is_claimed(std::size_t part, const PartMotion& motion) const;

    FaceLookup& lookup_;
    const Mesh& mesh_;
    const FaceIndex& index_;
    const SurfaceTable surfaces_;
    const PaintParts& stored_;
    const VertexMotions& of_vertices_;
    PartSupport support_;
    PartTypes types_;
    SimilarCorners similar_;
    std::vector<Part> parts_;
    std::vector<std::size_t> painted_;    // [part] its painted faces
    std::vector<PartMotion> known_;       // the parts' best, to be tried with the next parts
    std::vector<Move> moves_;             // all that a part may have made; the first one: it stayed
    std::vector<Aabb> places_;            // [part] of the parts that moved: where; else empty
    std::vector<PartMotion> candidates_;  // all that nearly explain as much
    std::size_t candidates_part_ = 0, candidates_of_part_ = 0, votes_ = 0;
    std::size_t guesses_ = 0;
};

}  // namespace slipface
