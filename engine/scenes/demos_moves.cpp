// Demos of the moves that have buttons of their own, and of the glide.
#include "demos.h"
#include "shapes.h"

namespace slipface {

namespace {

const auto move_rows = std::to_array<DemoInfo>({
    {"dash", "dash", "Dash", "A jump falls short in a gap of 7 m.", "Dash: fast and level for a moment.",
     [] {
         MovementSettings on = basic_settings();
         on.dash = true;
         Shapes shapes;
         shapes.material("plaster").box({-5, -4.5, -16}, {5, -4, 10});
         shapes.material("stone").box({-2, -4, 0}, {2, 0, 8}).box({-2, -4, -14}, {2, 0, -7});
         return demo_of(shapes.level(), {0, standing_on_flat(on, 0), 6}, on,
                        "5 wish 0,0\n60 wish 0,-1\n24 wish 0,-1 jump\n6 wish 0,-1 jump dash\n60 wish 0,-1\n"
                        "20 wish 0,0\n",
                        {12, 3.5, -1}, {0, 0, -3.5});
     }},
    {"crouch", "crouch", "Crouch", "A passage is lower than the player.",
     "Lower the body while the button is held, and stand up behind.",
     [] {
         MovementSettings on = basic_settings();
         on.crouch = true;
         Shapes shapes;
         shapes.material("plaster").box({-5, -0.5, -9}, {5, 0, 6});
         shapes.material("brick").box({-5, 0, -3}, {-1, 3, 0}).box({1, 0, -3}, {5, 3, 0});
         shapes.material("stone").box({-1, 1.2, -3}, {1, 3, 0});
         return demo_of(shapes.level(), {0, standing_on_flat(on, 0), 4}, on,
                        "5 wish 0,0\n30 wish 0,-1\n120 wish 0,-1 crouch\n40 wish 0,-1\n20 wish 0,0\n",
                        {7, 4.5, 8}, {0, 0.5, -1});
     }},
    {"ledge-grab", "ledge_grab", "Ledge grab", "A wall is higher than a jump.",
     "Hold its edge with the hands, and climb up.",
     [] {
         MovementSettings on = basic_settings();
         on.ledge_grab = true;
         Shapes shapes;
         shapes.material("plaster").box({-5, -0.5, -8}, {5, 0, 6});
         shapes.material("brick").box({-3, 0, -6}, {3, 2.8, -1});
         return demo_of(
             shapes.level(), {0, standing_on_flat(on, 0), 3}, on,
             "5 wish 0,0\n32 wish 0,-1\n40 wish 0,-1 jump\n20 wish 0,0\n25 wish 0,-1\n20 wish 0,0\n",
             {9, 4, 7}, {0, 1.4, -1});
     }},
    {"drop-through", "drop_through", "Drop through", "A one-sided grate holds the player above the floor.",
     "While drop is held, let one-sided faces pass it.",
     [] {
         MovementSettings on = basic_settings();
         on.drop_through = true;
         Shapes shapes;
         shapes.material("plaster").box({-5, -0.5, -5}, {5, 0, 5});
         shapes.material("metal__grate").polygon({{-2, 3, -2}, {-2, 3, 2}, {2, 3, 2}, {2, 3, -2}});
         Demo demo = demo_of(shapes.level(), {0, standing_on_flat(on, 3), 1}, on,
                             "10 wish 0,0\n10 wish 0,-1\n8 wish 0,0\n10 wish 0,0 drop\n50 wish 0,0\n",
                             {7, 5, 8}, {0, 1.6, 0});
         SurfaceType grate = painted("grate", {0.35F, 0.55F, 0.45F});
         grate.one_sided = true;
         demo.level.surfaces.push_back(grate);
         return demo;
     }},
    {"glide", "glide", "Glide", "A jump from a tower falls into a gap of 12 m.",
     "Limit the falling speed while jump is held.",
     [] {
         MovementSettings on = basic_settings();
         on.glide = true;
         Shapes shapes;
         shapes.material("plaster").box({-5, -4.5, -22}, {5, -4, 10});
         shapes.material("stone").box({-2, -4, 0}, {2, 3, 8}).box({-3, -4, -20}, {3, 0, -12});
         return demo_of(shapes.level(), {0, standing_on_flat(on, 3), 6}, on,
                        "5 wish 0,0\n60 wish 0,-1\n150 wish 0,-1 jump\n20 wish 0,0\n", {17, 5, -4},
                        {0, 0, -6});
     }},
});

}  // namespace

std::span<const DemoInfo> move_demos() {
    return move_rows;
}

}  // namespace slipface
