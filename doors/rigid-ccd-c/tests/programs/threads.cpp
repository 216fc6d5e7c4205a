// A program for sanitisers that uses all headers, with OMPL also its header. Threads share bodies, trajectories,
// curves and a flag, and measure edges on four threads. Calls fail, and handles are freed before objects that share
// them.
#include "rigid_ccd_cell.hpp"
#ifdef RIGID_CCD_WITH_OMPL
#include "rigid_ccd_ompl.hpp"
#include <ompl/base/ScopedState.h>
#include <ompl/base/spaces/RealVectorStateSpace.h>
#endif

#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <thread>

namespace {

void expect(bool holds, const char *what) {
    if (holds) return;
    std::fprintf(stderr, "expected: %s\n", what);
    std::exit(1);
}

// Asks about shared bodies with a solver of its own; returns the number of contacts.
int contacts(const rigid_ccd::Body &ball, const rigid_ccd::Body &box, const rigid_ccd::Trajectory &flies,
             const rigid_ccd::Stop &stop) {
    rigid_ccd::Settings settings;
    settings.stop = stop.get();
    rigid_ccd::Solver solver(settings);
    int count = 0;
    for (int k = 0; k < 200; ++k) {
        auto falls = rigid_ccd::at_rest(rigid_ccd::pose_at({0.01 * k, 0, 3}));
        falls.velocity[2] = -2;
        count += solver.first_contact({ball, falls}, {box}, 2).hit();
        count += solver.any_contact({ball, flies}, {box}, 2).hit();
        count += solver.closest_approach({ball, flies}, {box, falls}, 1).lower > 0;
    }
    return count;
}

void share_bodies() {
    const auto ball = rigid_ccd::Body::sphere(0.5), box = rigid_ccd::Body::box({1, 1, 0.5});
    const auto flies = rigid_ccd::Trajectory::ballistic(rigid_ccd::at_rest(rigid_ccd::pose_at({0, 0, 3})), {0, 0, -9});
    const auto stop = rigid_ccd::Stop::make();
    const int alone = contacts(ball, box, flies, stop);
    std::atomic<int> wrong{0};
    std::vector<std::thread> threads;
    for (int k = 0; k < 3; ++k)
        threads.emplace_back([&, copy = ball] { wrong += contacts(copy, box, flies, stop) != alone; });
    // A flag for the solvers of this thread only.
    const auto own = rigid_ccd::Stop::make();
    std::atomic<bool> is_done{false};
    std::thread setter([&] {
        while (!is_done.load(std::memory_order_relaxed)) own.set(), own.clear();
    });
    contacts(ball, box, flies, own);
    is_done.store(true, std::memory_order_relaxed);
    setter.join();
    for (auto &thread : threads) thread.join();
    expect(wrong == 0, "each thread has the same contacts");
}

void measure_edges(const rigid_ccd::Cell &cell) {
    const std::size_t joints = cell.joint_count();
    std::vector<double> edges;
    for (int k = 0; k < 200; ++k) {
        edges.insert(edges.end(), joints, 0.0);
        edges.insert(edges.end(), joints, 0.01 * k);
    }
    rigid_ccd::SolverPool pool(cell);
    const auto one = pool.measure_edges(edges, 1), four = pool.measure_edges(edges, 4);
    for (std::size_t k = 0; k < one.size(); ++k) expect(one[k].alpha() == four[k].alpha(), "equal shares");
    const auto refused = [&](const std::vector<double> &wrong) {
        try {
            pool.measure_edges(wrong, 4);
            return false;
        } catch (const rigid_ccd::Error &) {
            return true;
        }
    };
    edges[joints] = 1e9;
    expect(refused(edges), "an edge beyond the limits is refused");
    expect(refused({edges.begin(), edges.begin() + 3}), "a part of an edge is refused");
}

// Checks that a name stays valid after the cell was changed and the solver that shared it was freed.
void keep_names(rigid_ccd::Cell cell) {
    rccd_text name{};
    double lower = 0, upper = 0;
    expect(rccd_cell_joint(cell.get(), 0, &name, &lower, &upper) == RCCD_STATUS_OK, "a joint");
    {
        rigid_ccd::CellSolver solver(cell);
        cell.add_obstacle("ball", rigid_ccd::Body::sphere(0.1), rigid_ccd::pose_at({5, 0, 0}));
    }
    expect(std::string(name.data, name.length) == cell.joint(0).name, "the name of a joint is valid");
}

#ifdef RIGID_CCD_WITH_OMPL
void validate(const rigid_ccd::Cell &cell) {
    namespace ob = ompl::base;
    const auto joints = static_cast<unsigned>(cell.joint_count());
    const auto space = std::make_shared<ob::RealVectorStateSpace>(joints);
    space->setBounds(-2, 2);
    const auto information = std::make_shared<ob::SpaceInformation>(space);
    const auto states = std::make_shared<rigid_ccd::OmplStateValidityChecker>(information, cell);
    const auto motions = std::make_shared<rigid_ccd::OmplMotionValidator>(information, cell);
    information->setStateValidityChecker(states);
    information->setMotionValidator(motions);
    information->setup();
    const auto check = [&] {
        ob::ScopedState<> from(space), to(space);
        for (unsigned k = 0; k < joints; ++k) from[k] = 0, to[k] = 0.1;
        for (int k = 0; k < 50; ++k) states->isValid(from.get());
        return motions->checkMotion(from.get(), to.get());
    };
    expect(check(), "a motion is free");
}
#endif

} // namespace

int main(int, char **argv) {
    share_bodies();
    measure_edges(rigid_ccd::Cell::load(argv[1]));
    keep_names(rigid_ccd::Cell::load(argv[1]));
#ifdef RIGID_CCD_WITH_OMPL
    validate(rigid_ccd::Cell::load(argv[1]));
#endif
    std::printf("threads agree\n");
}
