#include "motion_fit.h"

#include <algorithm>
#include <cmath>

namespace slipface {
namespace {

// The 48 ways to turn and mirror a box along the axes.
std::vector<Eigen::Matrix3d> axis_turns() {
    std::vector<Eigen::Matrix3d> turns;
    int axes[3] = {0, 1, 2};
    do {
        for (int signs = 0; signs < 8; ++signs) {
            Eigen::Matrix3d turn = Eigen::Matrix3d::Zero();
            for (int row = 0; row < 3; ++row)
                turn(row, axes[row]) = (signs >> row & 1) != 0 ? -1.0 : 1.0;
            turns.push_back(turn);
        }
    } while (std::next_permutation(axes, axes + 3));
    return turns;
}

}  // namespace

double scale_of(const PartMotion& motion) {
    return std::cbrt(std::abs(motion.linear.determinant()));
}

bool is_rigid(const PartMotion& motion) {
    return (motion.linear.transpose() * motion.linear).isIdentity(1e-3);
}

double effort(const PartMotion& motion, const Vec3& centre, double size) {
    const double scale = std::max(1e-9, scale_of(motion));
    const double mirrored = motion.linear.determinant() < 0.0 ? 2.0 : 0.0;
    return mirrored + std::abs(std::log(scale)) +
           (motion.linear / scale - Eigen::Matrix3d::Identity()).norm() +
           1e-3 * (motion(centre) - centre).norm() / (size + 1e-9);
}

std::optional<PartMotion> fit_affine(const Eigen::Matrix3Xd& from, const Eigen::Matrix3Xd& to,
                                     bool mirrored) {
    const Vec3 old_centre = from.rowwise().mean();
    const Vec3 new_centre = to.rowwise().mean();
    const Eigen::Matrix3Xd a = from.colwise() - old_centre;
    const Eigen::Matrix3Xd b = to.colwise() - new_centre;
    const Eigen::JacobiSVD<Eigen::Matrix3Xd> svd(a, Eigen::ComputeThinU | Eigen::ComputeThinV);
    const Vec3 sizes = svd.singularValues();
    if (!(sizes[1] > 1e-4 * sizes[0])) return std::nullopt;
    const bool flat = !(sizes[2] > 1e-4 * sizes[0]);
    if (!flat && mirrored) return std::nullopt;  // the fit decides
    Eigen::Matrix3d moved;                       // columns: where the three directions go
    for (int k = 0; k < 3; ++k)
        moved.col(k) = k == 2 && flat ? Vec3(Vec3::Zero()) : Vec3(b * svd.matrixV().col(k) / sizes[k]);
    if (flat) {
        const Vec3 normal = moved.col(0).cross(moved.col(1));
        if (!(normal.norm() > 0.0)) return std::nullopt;
        const double side = svd.matrixU().determinant() < 0.0 ? -1.0 : 1.0;
        moved.col(2) = (mirrored ? -side : side) * normal / std::sqrt(normal.norm());
    }
    PartMotion motion;
    motion.linear = moved * svd.matrixU().transpose();
    motion.offset = new_centre - motion.linear * old_centre;
    if (!motion.linear.allFinite() || std::abs(motion.linear.determinant()) < 1e-12) return std::nullopt;
    return motion;
}

std::optional<PartMotion> fit_similarity(Eigen::Matrix3Xd from, const Eigen::Matrix3Xd& to, bool mirrored) {
    if (mirrored) from.row(0) *= -1.0;
    const Eigen::Matrix4d fitted = Eigen::umeyama(from, to, true);
    if (!fitted.allFinite()) return std::nullopt;
    PartMotion motion;
    motion.linear = fitted.topLeftCorner<3, 3>();
    if (mirrored) motion.linear.col(0) *= -1.0;
    motion.offset = fitted.topRightCorner<3, 1>();
    if (std::abs(scale_of(motion) - 1.0) < 1e-5) motion.linear /= scale_of(motion);
    return motion;
}

std::vector<PartMotion> box_motions(const Aabb& from, const Aabb& to) {
    static const std::vector<Eigen::Matrix3d> turns = axis_turns();
    std::vector<PartMotion> motions;
    const Vec3 old_size = from.size();
    const Vec3 new_size = to.size();
    for (const Eigen::Matrix3d& turn : turns) {
        PartMotion motion;
        const Vec3 turned = turn.cwiseAbs() * old_size;
        Vec3 scale = Vec3::Ones();
        bool possible = true;
        double sum = 0.0;
        int thick = 0;
        for (int axis = 0; axis < 3; ++axis) {
            const bool flat = turned[axis] < 1e-6 * old_size.maxCoeff();
            possible = possible && flat == (new_size[axis] < 1e-5 * new_size.maxCoeff());
            if (flat) continue;
            scale[axis] = new_size[axis] / turned[axis];
            sum += scale[axis];
            ++thick;
        }
        if (!possible || thick == 0) continue;
        for (int axis = 0; axis < 3; ++axis)
            if (turned[axis] < 1e-6 * old_size.maxCoeff()) scale[axis] = sum / thick;
        // Sizes in a file are rounded: what is nearly rigid is rigid.
        if ((scale - Vec3::Ones()).isZero(1e-5)) scale.setOnes();
        motion.linear = scale.asDiagonal() * turn;
        motion.offset = to.centre() - motion.linear * from.centre();
        motions.push_back(motion);
    }
    return motions;
}

}  // namespace slipface
