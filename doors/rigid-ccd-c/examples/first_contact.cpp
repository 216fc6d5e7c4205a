// A ball falls onto a box: when does it touch?
#include "rigid_ccd.hpp"
#include <cstdio>

int main() {
    const auto ball = rigid_ccd::Body::sphere(0.5), box = rigid_ccd::Body::box({1, 1, 0.5});
    rigid_ccd::Solver solver;
    auto falls = rigid_ccd::at_rest(rigid_ccd::pose_at({0, 0, 3}));
    falls.velocity[2] = -2;
    const rigid_ccd::Answer answer = solver.first_contact({ball, falls}, {box}, 2);
    if (answer.hit())
        std::printf("contact at %.9f in z = %.6f\n", answer.time, answer.witness_b[2]);
    else
        std::printf("free until %g\n", answer.safe_until);
    try {
        rigid_ccd::Body::from_triangles({}, {});
    } catch (const rigid_ccd::Error &error) {
        std::printf("no triangles: %s\n", error.what());
    }
}
