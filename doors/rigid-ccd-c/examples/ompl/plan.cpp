// Plans paths of an arm of seven joints past boxes by OMPL's RRT-Connect, on certified edges, then checks each path once more:
//   plan [FOLDER OF arm.urdf] [QUERIES] [FILE FOR THE PATHS]
// judge.py holds the paths against another library.
#include "rigid_ccd_ompl.hpp"

#include <ompl/base/spaces/RealVectorStateSpace.h>
#include <ompl/geometric/SimpleSetup.h>
#include <ompl/geometric/planners/rrt/RRTConnect.h>
#include <ompl/util/Console.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iomanip>
#include <memory>
#include <string>
#include <vector>

namespace ob = ompl::base;

namespace {

rigid_ccd::Cell cell_with_boxes(const std::string &folder) {
    rigid_ccd::Cell cell = rigid_ccd::Cell::load(folder + "/arm.urdf", folder + "/arm.srdf");
    const rigid_ccd::Body box = rigid_ccd::Body::box({0.1, 0.1, 0.3});
    for (int k = 0; k < 5; ++k) {
        const double turn = 1.2566 * k;
        const rigid_ccd::Vector place = {0.8 * std::cos(turn), 0.8 * std::sin(turn), 0.3 * k - 0.5};
        cell.add_obstacle("box " + std::to_string(k), box, rigid_ccd::pose_at(place));
    }
    return cell;
}

ob::StateSpacePtr joint_space(const rigid_ccd::Cell &cell) {
    const auto joints = static_cast<unsigned>(cell.joint_count());
    ob::RealVectorBounds bounds(joints);
    for (unsigned k = 0; k < joints; ++k) {
        const rigid_ccd::Joint joint = cell.joint(k);
        bounds.setLow(k, std::max(joint.lower, -3.0));
        bounds.setHigh(k, std::min(joint.upper, 3.0));
    }
    auto space = std::make_shared<ob::RealVectorStateSpace>(joints);
    space->setBounds(bounds);
    return space;
}

} // namespace

int main(int argc, char **argv) {
    const std::string folder = argc > 1 ? argv[1] : "rigid-ccd-robot/examples/edges";
    const int queries = argc > 2 ? std::atoi(argv[2]) : 20;
    std::ofstream paths(argc > 3 ? argv[3] : "");
    ompl::msg::setLogLevel(ompl::msg::LOG_WARN);
    ompl::RNG::setSeed(1);
    const rigid_ccd::Cell cell = cell_with_boxes(folder);
    const ob::StateSpacePtr space = joint_space(cell);
    const auto information = std::make_shared<ob::SpaceInformation>(space);
    information->setStateValidityChecker(std::make_shared<rigid_ccd::OmplStateValidityChecker>(information, cell));
    information->setMotionValidator(std::make_shared<rigid_ccd::OmplMotionValidator>(information, cell));
    information->setup();

    rigid_ccd::CellSolver solver(cell);
    ob::StateSamplerPtr sampler = space->allocStateSampler();
    int planned = 0, touching = 0, edges = 0;
    for (int query = 0; query < queries; ++query) {
        ompl::geometric::SimpleSetup setup(information);
        ob::ScopedState<> start(space), goal(space);
        do sampler->sampleUniform(start.get()); while (!information->isValid(start.get()));
        do sampler->sampleUniform(goal.get()); while (!information->isValid(goal.get()));
        setup.setStartAndGoalStates(start, goal);
        setup.setPlanner(std::make_shared<ompl::geometric::RRTConnect>(information));
        if (setup.solve(2.0) != ob::PlannerStatus::EXACT_SOLUTION) continue;
        ++planned;
        std::vector<double> path, state;
        for (const ob::State *at : setup.getSolutionPath().getStates()) {
            space->copyToReals(state, at);
            path.insert(path.end(), state.begin(), state.end());
            paths << query;
            for (const double position : state) paths << ',' << std::setprecision(17) << position;
            paths << '\n';
        }
        edges += static_cast<int>(setup.getSolutionPath().getStateCount()) - 1;
        if (!solver.first_contact(path).free()) ++touching;
    }
    std::printf("%d of %d paths planned, of %d edges; paths that touch: %d\n", planned, queries, edges, touching);
    return planned > 0 && touching == 0 ? 0 : 1;
}
