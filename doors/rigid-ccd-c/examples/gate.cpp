// A gate before an arm: a chunk of waypoints passes if it is certainly free, within half a millisecond.
//   gate ROBOT.urdf     (of two joints)
#include "rigid_ccd_cell.hpp"

#include <cstdio>

int main(int count, char **argv) {
    if (count != 2) {
        std::fprintf(stderr, "usage: gate ROBOT.urdf\n");
        return 2;
    }
    auto cell = rigid_ccd::Cell::load(argv[1]);
    cell.add_obstacle("table", rigid_ccd::Body::box({1, 1, 0.02}), rigid_ccd::pose_at({0, 0, -0.12}));
    rigid_ccd::Settings settings;
    settings.margin = 0.002;
    settings.deadline = 0.0005;
    rigid_ccd::CellSolver solver(cell, settings);

    const std::vector<double> chunk = {0, 0, 0.1, 0.1, 0.3, 0.1, 0.6, 0.1}; // two joints, four waypoints
    const rigid_ccd::PathAnswer answer = solver.first_contact(chunk);
    if (answer.free()) {
        std::printf("go\n");
        return 0;
    }
    std::printf("go until waypoint %zu and %.3f of the way to the next\n", answer.segment, answer.fraction);
    rigid_ccd::write_evidence(cell, settings, chunk, answer, "stop.json");
}
