// Without exceptions, failures are values.
#define RIGID_CCD_EXPECTED
#include "rigid_ccd_cell.hpp"

#include <cstdio>

int main() {
    const auto ball = rigid_ccd::Body::sphere(0.5);
    const auto refused = rigid_ccd::Body::sphere(-1);
    auto solver = rigid_ccd::Solver::make();
    if (!ball || refused || !solver) return 1;
    auto falls = rigid_ccd::at_rest(rigid_ccd::pose_at({0, 0, 3}));
    falls.velocity[2] = -1;
    const auto answer = solver->first_contact({*ball, falls}, {*ball}, 5);
    const auto no_cell = rigid_ccd::Cell::load("no such file.urdf");
    if (!answer || no_cell) return 2;
    std::printf("%.2f; %s; %s\n", answer->time, refused.error().what(), no_cell.error().what());
}
