// Sums of three doubles: (x + y) + z, whatever the compiler makes of Eigen's expressions.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "slipface/base/types.h"

namespace slipface {
namespace {

using Mat3 = Eigen::Matrix3d;

double in_order(const Vec3& terms) {
    return (terms.x() + terms.y()) + terms.z();
}

class SumOrder : public ::testing::Test {
  protected:
    Vec3 vector() { return {number_(random_), number_(random_), number_(random_)}; }
    Mat3 matrix() {
        Mat3 m;
        m << vector(), vector(), vector();
        return m;
    }

  private:
    std::mt19937 random_{20261};
    std::uniform_real_distribution<double> number_{-1.0, 1.0};
};

TEST_F(SumOrder, OfVectors) {
    for (int i = 0; i < 10000; ++i) {
        const Vec3 a = vector(), b = vector();
        EXPECT_EQ(a.dot(b), in_order(a.cwiseProduct(b)));
        EXPECT_EQ(a.squaredNorm(), in_order(a.cwiseAbs2()));
        EXPECT_EQ((a - b).norm(), std::sqrt(in_order((a - b).cwiseAbs2())));
        EXPECT_EQ((a + b).sum(), in_order(a + b));
    }
}

TEST_F(SumOrder, OfMatrices) {
    for (int i = 0; i < 10000; ++i) {
        const Mat3 m = matrix(), n = matrix();
        const Vec3 a = vector(), moved = m * a, back = m.transpose() * a;
        const Mat3 product = m * n;
        for (int row = 0; row < 3; ++row) {
            const Vec3 across = m.row(row);
            EXPECT_EQ(m.row(row).dot(a), in_order(across.cwiseProduct(a)));
            EXPECT_EQ(m.row(row).sum(), in_order(across));
            EXPECT_EQ(moved[row], in_order(across.cwiseProduct(a)));
            EXPECT_EQ(back[row], in_order(m.col(row).cwiseProduct(a)));
            for (int column = 0; column < 3; ++column)
                EXPECT_EQ(product(row, column), in_order(across.cwiseProduct(n.col(column))));
        }
    }
}

// The test data can tell the two orders apart.
TEST_F(SumOrder, Matters) {
    int other = 0;
    for (int i = 0; i < 1000; ++i) {
        const Vec3 a = vector();
        other += in_order(a) != a.x() + (a.y() + a.z());
    }
    EXPECT_GT(other, 10);
}

}  // namespace
}  // namespace slipface
