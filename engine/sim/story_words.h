// Numbers and faces as text, for stories and headlines.
#pragma once

#include "slipface/sim/story.h"

namespace slipface {

// Appends to a text, and stores the numbers in it.
class Words {
  public:
    Words(std::string& text, std::vector<StoryNumber>& numbers) : text_(text), numbers_(numbers) {}

    Words& say(std::string_view words) {
        text_ += words;
        return *this;
    }
    Words& length(double metres);                 // of motions
    Words& length_of(double part, double whole);  // "2.0 of 16.7 mm"
    Words& size(double metres);                   // of things: "0.25 m", "3 mm"
    Words& speed(double metres_per_second);
    Words& degrees(double degrees);
    Words& percent(double fraction);
    Words& ratio(double value);  // without unit: "0.25"
    Words& count(double whole);
    Words& seconds(double seconds);
    // A decision's sentence with its numbers.
    Words& decision(const DecisionRecord& decision);

  private:
    Words& number(double value, std::string_view unit, std::string text);

    std::string& text_;
    std::vector<StoryNumber>& numbers_;
};

// Degrees: 0 is horizontal ground, 90 a wall, 180 a ceiling.
double slope_degrees(const Vec3& normal);

// "face 12 of `stairs`, `tiles`, ice": the group if there is more than one, the material if it has a name,
// the type if it is not `default`. "the terrain" for no face.
std::string face_text(const StoryNames& names, FaceId face, SurfaceId surface);
// "`stairs`": the group if there is more than one, else the material; empty if neither has a name.
std::string object_text(const StoryNames& names, FaceId face);

// Whether a player can stand on ground with that normal and type.
bool is_walkable(const StoryNames& names, const MovementSettings& settings, const Vec3& normal,
                 SurfaceId surface);

}  // namespace slipface
