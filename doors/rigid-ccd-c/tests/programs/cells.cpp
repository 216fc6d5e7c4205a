// The questions about robots: edges measured one by one and on several threads, curves, and failures as exceptions.
#include "rigid_ccd_cell.hpp"

#include <cstdio>
#include <cstdlib>
#include <string>

namespace {

int line = 0;
void expect(bool holds) {
    ++line;
    if (holds) return;
    std::fprintf(stderr, "expectation %d fails\n", line);
    std::exit(1);
}

// Like types of Eigen: a vector, a row of a matrix with a stride, and a matrix.
template <int IS_VECTOR, int STRIDE>
struct OfEigen {
    enum { IsVectorAtCompileTime = IS_VECTOR, InnerStrideAtCompileTime = STRIDE };
    const double *data() const;
    std::ptrdiff_t size() const;
};
template <typename Container>
constexpr bool is_view = std::is_constructible_v<rigid_ccd::View<double>, const Container &>;
static_assert(is_view<std::vector<double>> && is_view<OfEigen<1, 1>>);
// A pool refers to its cell, so the cell must outlive it.
static_assert(std::is_constructible_v<rigid_ccd::SolverPool, rigid_ccd::Cell &>);
static_assert(!std::is_constructible_v<rigid_ccd::SolverPool, rigid_ccd::Cell>);
static_assert(!is_view<OfEigen<1, 3>> && !is_view<OfEigen<1, -1>> && !is_view<OfEigen<0, 1>> && !is_view<std::vector<float>>);

} // namespace

int main(int, char **argv) {
    auto cell = rigid_ccd::Cell::load(argv[1]);
    const std::size_t joints = cell.joint_count();
    const std::vector<double> start(joints, 0.0), end(joints, 0.3);
    rigid_ccd::CellSolver before(cell);
    expect(before.measure_edge(start, end).completely_free());
    expect(std::string(cell.joint(0).name).size() > 0 && cell.joint(0).lower < cell.joint(0).upper);

    cell.add_obstacle("everywhere", rigid_ccd::Body::sphere(10), rigid_ccd::pose_at({0, 0, 0}));
    bool is_of_before = false;
    try {
        before.measure_edge(start, end);
    } catch (const rigid_ccd::Error &error) {
        is_of_before = std::string(error.what()).find("make a new solver") != std::string::npos;
    }
    expect(is_of_before);
    rigid_ccd::CellSolver inside(cell);
    expect(!inside.measure_edge(start, end).partially_free());
    expect(inside.first_contact(start).hit() && inside.any_contact(start).name_b() == "everywhere");
    cell.move_obstacle("everywhere", rigid_ccd::pose_at({100, 0, 0}));
    expect(rigid_ccd::CellSolver(cell).closest_approach(start).lower > 0);
    cell.set_clearance("everywhere", argv[2], 1000);
    expect(rigid_ccd::CellSolver(cell).first_contact(start).hit());
    cell.remove_obstacle("everywhere");

    bool is_cut = true;
    try {
        cell.add_obstacle(std::string("po\0st", 5), rigid_ccd::Body::sphere(1), rigid_ccd::pose_at({0, 0, 0}));
    } catch (const rigid_ccd::Error &) {
        is_cut = false;
    }
    expect(!is_cut);
    std::vector<double> no_accelerations;
    no_accelerations.reserve(4);
    const auto ease = rigid_ccd::JointCurve::through({0, 1}, {0, 1}, {0, 0}, no_accelerations);
    expect(ease.get() != nullptr);

    std::vector<double> edges;
    for (int k = 0; k < 50; ++k) {
        edges.insert(edges.end(), start.begin(), start.end());
        edges.insert(edges.end(), joints, 0.03 * k);
    }
    // The pool starts at most as many threads as there are edges.
    rigid_ccd::SolverPool pool(cell);
    expect(pool.measure_edges(edges, 1u << 31).size() == 50);
    const auto one = pool.measure_edges(edges, 1), two = pool.measure_edges(edges, 2);
    expect(one.size() == 50 && two.size() == 50);
    std::size_t free = 0;
    for (std::size_t k = 0; k < 50; ++k) {
        expect(one[k].alpha() == two[k].alpha());
        free += one[k].completely_free();
    }
    edges.back() = 1e9;
    bool thrown = false;
    try {
        pool.measure_edges(edges, 2);
    } catch (const rigid_ccd::Error &error) {
        thrown = error.status() == rccd_status::RCCD_STATUS_INVALID_INPUT;
    }
    expect(thrown);

    rigid_ccd::CellSolver now(cell);
    const auto refusal = [&](const std::vector<double> &path) -> std::string {
        try {
            now.first_contact(path);
        } catch (const rigid_ccd::Error &error) {
            return error.what();
        }
        return "";
    };
    expect(refusal(std::vector<double>(joints + 1)) == "configurations: a multiple of " + std::to_string(joints) +
                                                            " numbers is needed, not " + std::to_string(joints + 1));

    const std::vector<double> times = {0, 1}, velocities(2 * joints, 0.0);
    std::vector<double> positions = start;
    positions.insert(positions.end(), end.begin(), end.end());
    const auto curve = rigid_ccd::JointCurve::through(times, positions, velocities);
    expect(now.first_contact(curve).free() && now.any_contact(curve).free());
    rigid_ccd::CellSolver moved = std::move(now);
    bool is_error = false;
    try {
        now.measure_edge(start, end);
    } catch (const rigid_ccd::Error &) {
        is_error = true;
    }
    expect(is_error && moved.measure_edge(start, end).completely_free());
    expect(!rigid_ccd::PathAnswer().free() && !rigid_ccd::Answer().free());
    bool refused = false;
    try {
        const rigid_ccd::PathAnswer answer = moved.first_contact(start);
        rigid_ccd::write_evidence(cell, {}, start, answer, "/no such folder/stop.json");
    } catch (const rigid_ccd::Error &error) {
        refused = std::string(error.what()).find("no such folder") != std::string::npos;
    }
    expect(refused);
    std::printf("%zu of 50 edges are free\n", free);
}
