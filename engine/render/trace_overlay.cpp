#include "slipface/render/trace_overlay.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace slipface {

namespace {

class TraceDrawing {
  public:
    TraceDrawing(Overlay& overlay, const Vec3& radii, const TraceStyle& style)
        : overlay_(overlay), radii_(radii), style_(style), size_(radii.maxCoeff()) {}

    void operator()(const SweepRecord& sweep) {
        const Color color = sweep_color(index_++);
        if (!started_) start(sweep.from);
        position_ = sweep.contact ? Vec3(sweep.from + sweep.contact->t * sweep.move) : sweep.reached;
        overlay_.line(sweep.from, sweep.reached, tint(color, 0.75f), 5.0f, true);
        ghost(sweep.reached, color);
        if (sweep.contact) contact(*sweep.contact);
    }

    void operator()(const ResponseRecord& response) {
        if (!style_.remainders || !started_) return;
        remainders_.push_back({position_, response.remainder_before, trace_colors::remainder_before});
        remainders_.push_back({position_, response.remainder_after, trace_colors::remainder_after});
    }

    void operator()(const PushOutRecord& push) {
        if (!started_) start(push.from);
        position_ = push.to;
        overlay_.arrow(push.from, push.to, tint(trace_colors::push_out, 1.0f), 3.0f);
        ghost(push.to, trace_colors::push_out);
    }

    void operator()(const DecisionRecord&) {}

    // The next sweep usually follows the remainder, so these thin arrows lie on the broad paths.
    void draw_remainders() {
        for (const Remainder& remainder : remainders_) {
            if (!(remainder.vector.squaredNorm() > 0.0)) continue;
            overlay_.arrow(remainder.from, remainder.from + remainder.vector, tint(remainder.color, 1.0f),
                           2.0f);
        }
    }

  private:
    Color tint(Color color, float alpha) const {
        color.alpha *= alpha * style_.opacity;
        return color;
    }

    void start(const Vec3& centre) {
        started_ = true;
        position_ = centre;
        if (style_.ghosts) {
            overlay_.ellipsoid(centre, radii_, tint(trace_colors::start, 0.06f),
                               tint(trace_colors::start, 1.0f));
        }
        overlay_.cross(centre, 0.16 * size_, tint(trace_colors::start, 1.0f), 2.0f);
    }

    void ghost(const Vec3& centre, const Color& color) {
        if (style_.ghosts) overlay_.ellipsoid(centre, radii_, tint(color, 0.20f), tint(color, 0.9f));
    }

    void contact(const Contact& contact) {
        if (style_.planes) {
            overlay_.disc(contact.point, contact.normal, 0.75 * size_, tint(trace_colors::normal, 0.14f),
                          tint(trace_colors::normal, 0.55f));
        }
        if (!style_.contacts) return;
        overlay_.arrow(contact.point, contact.point + contact.normal * (0.7 * size_),
                       tint(trace_colors::normal, 1.0f), 2.5f);
        // A short line with round ends is a dot of constant size on the screen.
        const Color dark{0.10f, 0.09f, 0.04f, style_.opacity};
        overlay_.line(contact.point, contact.point, dark, 11.0f, true);
        overlay_.line(contact.point, contact.point, tint(trace_colors::contact, 1.0f), 8.0f, true);
    }

    struct Remainder {
        Vec3 from, vector;
        Color color;
    };

    Overlay& overlay_;
    const Vec3 radii_;
    const TraceStyle style_;
    const double size_;
    bool started_ = false;
    int index_ = 0;
    Vec3 position_ = Vec3::Zero();
    std::vector<Remainder> remainders_;
};

}  // namespace

Color sweep_color(int index) {
    static constexpr std::array<Color, 6> colors{{{0.20f, 0.66f, 1.00f, 1.0f},
                                                  {0.40f, 0.50f, 1.00f, 1.0f},
                                                  {0.60f, 0.42f, 1.00f, 1.0f},
                                                  {0.76f, 0.38f, 1.00f, 1.0f},
                                                  {0.89f, 0.40f, 0.95f, 1.0f},
                                                  {0.98f, 0.47f, 0.84f, 1.0f}}};
    return colors[static_cast<std::size_t>(std::clamp(index, 0, static_cast<int>(colors.size()) - 1))];
}

void draw_trace(Overlay& overlay, std::span<const TraceRecord> records, const Vec3& radii,
                const TraceStyle& style) {
    TraceDrawing drawing(overlay, radii, style);
    for (const TraceRecord& record : records)
        std::visit(drawing, record);
    drawing.draw_remainders();
}

}  // namespace slipface
