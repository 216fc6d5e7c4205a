// Poses of Eigen: rotations are converted, and other linear maps are errors. `.ci/doors` runs it.
#include <Eigen/Geometry>

#include "rigid_ccd.hpp"

#include <cmath>
#include <cstdio>

namespace {

bool is_refused(const Eigen::Matrix3d &linear) {
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    pose.matrix().topLeftCorner<3, 3>() = linear;
    try {
        rigid_ccd::to_pose(pose);
    } catch (const rigid_ccd::Error &) {
        return true;
    }
    return false;
}

} // namespace

int main() {
    const Eigen::AngleAxisd turn(1.0, Eigen::Vector3d(1, 2, 3).normalized());
    const rigid_ccd::Pose pose = rigid_ccd::to_pose(Eigen::Translation3d(1, 2, 3) * turn);
    const Eigen::Quaterniond expected(turn);
    bool holds = std::fabs(pose.rotation[3] - expected.w()) < 1e-15 && pose.position[2] == 3;
    const Eigen::Matrix3d one = Eigen::Matrix3d::Identity();
    holds = holds && !is_refused(one) && is_refused(0.001 * one) && is_refused(-one) && is_refused(0 * one);
    holds = holds && is_refused(NAN * one);
    std::puts(holds ? "poses of Eigen: as expected" : "poses of Eigen: wrong");
    return holds ? 0 : 1;
}
