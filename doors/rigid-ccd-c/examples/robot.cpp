// An arm reaches past a post, then carries a can: what does it touch, and how near does anything come?
#include "rigid_ccd_cell.hpp"

#include <cstdio>

// As ROS has it in the parameter robot_description. Cell::load reads a file, with its meshes.
const char *const ARM = R"(<robot name="arm">
  <link name="base"><collision><geometry><box size="0.3 0.3 0.2"/></geometry></collision></link>
  <link name="upper"><collision><origin xyz="0 0 0.5"/><geometry><box size="0.1 0.1 0.8"/></geometry></collision></link>
  <link name="hand"><collision><origin xyz="0 0 0.3"/><geometry><box size="0.1 0.1 0.4"/></geometry></collision></link>
  <joint name="shoulder" type="revolute"><parent link="base"/><child link="upper"/><axis xyz="0 1 0"/>
    <limit lower="-2" upper="2" effort="1" velocity="1"/></joint>
  <joint name="elbow" type="revolute"><parent link="upper"/><child link="hand"/><origin xyz="0 0 1"/><axis xyz="0 1 0"/>
    <limit lower="-2" upper="2" effort="1" velocity="1"/></joint>
</robot>)";

int main() {
    auto cell = rigid_ccd::Cell::from_text(ARM);
    cell.add_obstacle("post", rigid_ccd::Body::box({0.1, 0.1, 0.5}), rigid_ccd::pose_at({1, 0, 0.5}));
    // Three configurations, one after the other: a position of each joint, in this order.
    for (std::size_t k = 0; k < cell.joint_count(); ++k) std::printf("joint %zu: %s\n", k, cell.joint(k).name.c_str());
    const std::vector<double> path = {0, 0, 0.4, 0.5, 0.8, 1};

    rigid_ccd::CellSolver solver(cell);
    const rigid_ccd::PathAnswer hit = solver.first_contact(path);
    if (hit.hit())
        std::printf("%s touches %s at %.3f of segment %zu, and nothing touches before\n", hit.name_a().c_str(),
                    hit.name_b().c_str(), hit.fraction, hit.segment);
    else if (!hit.resolved())
        std::printf("a limit was reached; free until %.3f of segment %zu\n", hit.fraction, hit.segment);

    // A cell that was changed needs a new solver.
    cell.move_obstacle("post", rigid_ccd::pose_at({2, 0, 0.5}));
    cell.attach("can", rigid_ccd::Body::cylinder(0.05, 0.1), "hand", rigid_ccd::pose_at({0, 0, 0.6}));
    rigid_ccd::CellSolver carrying(cell);
    const rigid_ccd::PathAnswer near = carrying.closest_approach(path);
    std::printf("%s; %s comes as near to %s as %.2f\n", carrying.first_contact(path).free() ? "free" : "not free",
                near.name_a().c_str(), near.name_b().c_str(), near.upper);
    try {
        solver.first_contact(path);
    } catch (const rigid_ccd::Error &error) {
        std::printf("%s\n", error.what());
    }
}
