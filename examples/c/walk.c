/* A game loop in C: a world of triangles with a lift, a player that walks, jumps and rides, and what stopped it.
 *     cc -std=c99 walk.c $(pkg-config --cflags --libs slipface-mover) -lm -o walk && ./walk
 */
#include <math.h>
#include <slipface.h>
#include <stdio.h>
#include <stdlib.h>

static void check(slipface_status status, const slipface_error* error) {
    if (status == SLIPFACE_OK) return;
    fprintf(stderr, "slipface: %s\n", error->text);
    exit(1);
}

int main(void) {
    /* A floor of 20 x 20 m, and a wall 5 m ahead of the player. */
    static const float positions[] = {-10, 0, -10, 10, 0, -10, 10, 0, 10, -10, 0, 10,
                                      -10, 0, -5,  10, 0, -5,  10, 3, -5, -10, 3, -5};
    static const uint32_t indices[] = {0, 2, 1, 0, 3, 2, 4, 5, 6, 4, 6, 7};
    const slipface_triangles level = {sizeof level, positions, 8, indices, 4, NULL, NULL};
    /* A lift: a square of 2 x 2 m. */
    static const float lift_positions[] = {-1, 0, -1, 1, 0, -1, 1, 0, 1, -1, 0, 1};
    static const uint32_t lift_indices[] = {0, 2, 1, 0, 3, 2};
    const slipface_triangles lift_shape = {sizeof lift_shape, lift_positions, 4, lift_indices, 2, NULL, NULL};

    slipface_error error;
    slipface_world world;
    slipface_settings settings;
    uint32_t lift;
    slipface_player player;
    int tick;
    const double dt = 1.0 / 60.0;
    /* What a step touched, and what happened in it. */
    slipface_contact contacts[8], wall = {.t = 2.0};
    slipface_event events[8];
    slipface_report report = {.size = sizeof report, .contact_room = 8, .event_room = 8};
    uint32_t i;

    if (slipface_interface() != SLIPFACE_INTERFACE) return 1;
    check(slipface_world_from_triangles(&level, &world, &error), &error);
    check(slipface_world_add_platform(world, &lift_shape, &lift, &error), &error);
    check(slipface_settings_new("platformer", &settings, &error), &error);
    check(slipface_settings_set(settings, "walk_speed=5", &error), &error);
    {
        const slipface_vec3 start = {0, 1.0, 4};
        check(slipface_player_at(world, start, &player, &error), &error);
    }
    report.contacts = contacts;
    report.events = events;
    for (tick = 0; tick < 240; ++tick) {
        /* Two seconds up to the wall, with a jump on the way, then nothing. The lift goes up at x = 5. */
        const slipface_input input = {sizeof input, tick > 30 && tick < 40 ? SLIPFACE_JUMP : 0, 0.0,
                                      tick < 120 ? -1.0 : 0.0};
        const slipface_vec3 lift_at = {5.0, 0.01 * tick, 0.0};
        check(slipface_world_move_platform(world, lift, lift_at, NULL, dt, &error), &error);
        check(slipface_step(world, settings, &player, &input, dt, NULL, &report, &player, &error), &error);
        for (i = 0; i < report.contact_count; ++i)
            if (fabs(contacts[i].normal.y) < 0.1) wall = contacts[i];
        for (i = 0; i < report.event_count && i < report.event_room; ++i)
            if (events[i].kind == SLIPFACE_LANDED) printf("landed at %.1f m/s\n", events[i].value);
        if (tick % 60 == 59)
            printf("%.0f s: %.3f %.3f %.3f %s\n", (tick + 1) * dt, player.position.x, player.position.y,
                   player.position.z, player.flags & SLIPFACE_GROUNDED ? "stands" : "flies");
    }
    if (wall.t <= 1.0) printf("met face %u at z = %.3f\n", (unsigned)wall.face, wall.point.z);
    {
        /* What is above the lift? And onto the lift with the player. */
        const slipface_vec3 above = {5.0, 10.0, 0.0}, down = {0.0, -1.0, 0.0};
        slipface_ray_hit hit;
        check(slipface_ray(world, above, down, INFINITY, NULL, &hit, &error), &error);
        printf("the lift is at y = %.3f, platform %u\n", hit.point.y, (unsigned)hit.platform);
        {
            const slipface_vec3 on_it = {5.0, hit.point.y + 0.92, 0.0};
            check(slipface_player_at(world, on_it, &player, &error), &error);
        }
    }
    for (; tick < 300; ++tick) {
        const slipface_input rest = {sizeof rest, 0, 0.0, 0.0};
        const slipface_vec3 lift_at = {5.0, 0.01 * tick, 0.0};
        check(slipface_world_move_platform(world, lift, lift_at, NULL, dt, &error), &error);
        check(slipface_step(world, settings, &player, &rest, dt, NULL, NULL, &player, &error), &error);
    }
    printf("rides at y = %.3f, platform %u\n", player.position.y, (unsigned)player.ground_platform);
    check(slipface_settings_free(settings, &error), &error);
    check(slipface_world_free(world, &error), &error);
    /* A handle that was freed is recognised. */
    return slipface_world_free(world, &error) == SLIPFACE_WRONG_HANDLE ? 0 : 1;
}
