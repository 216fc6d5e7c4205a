// Tests moved-from handles, temporaries of an earlier statement, and exceptions beside a source file with expected
// values.
#include "rigid_ccd_cell.hpp"

#include <string>
#include <utility>

int failures_as_values();

namespace {

// Returns whether a call throws an error with a text in it.
template <typename Call>
bool refuses(Call &&call, const std::string &text) {
    try {
        call();
    } catch (const rigid_ccd::Error &error) {
        return std::string(error.what()).find(text) != std::string::npos;
    }
    return false;
}

} // namespace

int main() {
    using namespace rigid_ccd;
    const auto ball = Body::sphere(0.5), wall = Body::box({0.1, 5, 5});
    const Motion stands = at_rest(pose_at({1, 0, 0}));
    Solver solver;

    auto path = Trajectory::pose_path({0, 1}, {pose_at({3, 0, 0}), pose_at({-3, 0, 0})});
    const Trajectory kept = std::move(path), &same_path = path;
    for (const Trajectory *along : {&same_path, &kept})
        if (!solver.first_contact({ball, *along}, {wall, stands}, 1).hit()) return 1;
    if (!refuses([&] { solver.first_contact({ball, Trajectory(nullptr)}, {wall, stands}, 1); }, "")) return 2;

    const MovingBody there{Body::sphere(0.5), at_rest(pose_at({1, 0, 0}))};
    const MovingBody far{Body::sphere(0.5), at_rest(pose_at({9, 0, 0}))};
    if (!solver.first_contact(there, {wall, stands}, 1).hit() || !solver.first_contact(far, {wall, stands}, 1).free()) return 3;

    Stop stop = Stop::make();
    const Stop same = std::move(stop);
    if (stop.get() == nullptr || stop.get() != same.get()) return 4;

    const std::string cut("a\0b", 3);
    if (!refuses([&] { Cell::load("arm.urdf", cut); }, "zero") || !refuses([&] { Cell::from_text("<robot/>", cut); }, "zero")) return 5;

    if (!refuses([] { Body::sphere(-1); }, "radius is -1") || ball.piece_count() != 1) return 6;
    return failures_as_values();
}
