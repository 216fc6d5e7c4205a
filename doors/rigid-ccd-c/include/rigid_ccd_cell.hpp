// Robots among obstacles, for C++17. Checks edges of motion planners and motions of controllers. This header wraps
// rigid_ccd.h, and needs rigid_ccd.hpp.
#ifndef RIGID_CCD_CELL_HPP
#define RIGID_CCD_CELL_HPP

#include "rigid_ccd.hpp"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>

namespace rigid_ccd {
inline namespace RIGID_CCD_FAILURES {

namespace detail {

// Returns the error for an array of `count` numbers, if that is not a multiple of `length`. `length` is the number of
// joints for a path, and twice the number of joints for edges.
inline Error wrong_configurations(std::size_t length, std::size_t count) {
    return {RCCD_STATUS_INVALID_ARGUMENT, "configurations: a multiple of " + std::to_string(length) + " numbers is needed, not " +
                                              std::to_string(count)};
}

} // namespace detail

// An independent joint. Its limits are infinite if it has none.
struct Joint {
    std::string name;
    double lower, upper;
};

// A cell (planning scene): a robot among obstacles that are static in the frame of its base. Changing the cell
// invalidates its solvers: their questions fail from then on. Making a new solver takes about 30 µs.
class Cell {
public:
    // Loads the robot of a URDF or MJCF file, with its meshes. `package_folder` is the folder searched first for
    // `package://` names. Pass empty texts if there is no SRDF file or no folder.
    static Result<Cell> load(const std::string &robot, const std::string &srdf = "",
                             const std::string &package_folder = "") {
        if (detail::contains_zero_byte(srdf) || detail::contains_zero_byte(package_folder)) return zero_in_path();
        return detail::hold<Cell, rccd_cell>([&](rccd_cell **out) {
            return rccd_cell_load(detail::c_text(robot), or_null(srdf), or_null(package_folder), out);
        });
    }
    // Makes a cell from the text of a URDF or MJCF. Relative paths of meshes are resolved in `folder`, or in the working
    // directory if it is empty.
    static Result<Cell> from_text(const std::string &robot, const std::string &folder = "", const std::string &srdf = "",
                                  const std::string &package_folder = "") {
        if (detail::contains_zero_byte(folder) || detail::contains_zero_byte(srdf) || detail::contains_zero_byte(package_folder)) return zero_in_path();
        return detail::hold<Cell, rccd_cell>([&](rccd_cell **out) {
            return rccd_cell_from_text(detail::c_text(robot), or_null(folder), or_null(srdf), or_null(package_folder), out);
        });
    }
    // Takes ownership of a handle.
    explicit Cell(rccd_cell *handle) : handle_(handle, rccd_cell_free) {}
    // Returns the number of independent joints. A configuration has one position for each.
    std::size_t joint_count() const {
        std::size_t count = 0;
        rccd_cell_joint_count(get(), &count);
        return count;
    }
    // Returns an independent joint. `number` is its index in configurations.
    Result<Joint> joint(std::size_t number) const {
        rccd_text name{};
        Joint joint{};
        const rccd_status status = rccd_cell_joint(get(), number, &name, &joint.lower, &joint.upper);
        return detail::after(status, [&] {
            joint.name.assign(name.data, name.length);
            return joint;
        });
    }
    Result<Done> add_obstacle(const std::string &name, const Body &body, const Pose &pose) {
        return detail::done(rccd_cell_add_obstacle(handle_.get(), detail::c_text(name), body.get(), &pose));
    }
    Result<Done> move_obstacle(const std::string &name, const Pose &pose) {
        return detail::done(rccd_cell_move_obstacle(handle_.get(), detail::c_text(name), &pose));
    }
    Result<Done> remove_obstacle(const std::string &name) {
        return detail::done(rccd_cell_remove_obstacle(handle_.get(), detail::c_text(name)));
    }
    // Attaches a body to a link, such as an object that a gripper holds, at a pose in the link's frame. The body may
    // touch that link, links that are rigidly attached to it, and the items named in `may_touch`: links, attached bodies and
    // obstacles.
    Result<Done> attach(const std::string &name, const Body &body, const std::string &link, const Pose &pose,
                        const std::vector<std::string> &may_touch = {}) {
        std::vector<const char *> names;
        for (const std::string &item : may_touch) names.push_back(detail::c_text(item));
        return detail::done(rccd_cell_attach(handle_.get(), detail::c_text(name), body.get(), detail::c_text(link), &pose,
                                             names.data(), names.size()));
    }
    Result<Done> detach(const std::string &name) { return detail::done(rccd_cell_detach(handle_.get(), detail::c_text(name))); }
    // Allows two items to touch. An item is a link, an attached body or an obstacle. The permission lasts until one of them
    // is removed, or until forbid_contact or set_clearance is called for them.
    Result<Done> allow_contact(const std::string &a, const std::string &b) {
        return detail::done(rccd_cell_allow_contact(handle_.get(), detail::c_text(a), detail::c_text(b)));
    }
    // Revokes the permission of two items to touch. For two links that are not checked, adds them to the checked pairs.
    Result<Done> forbid_contact(const std::string &a, const std::string &b) {
        return detail::done(rccd_cell_forbid_contact(handle_.get(), detail::c_text(a), detail::c_text(b)));
    }
    // Returns a summary of the checked pairs, as lines of text: counts, then all remarks. Lines about probable mistakes
    // begin with `warning: `.
    Result<std::string> check_summary() {
        rccd_text text{};
        const rccd_status status = rccd_cell_check_summary(handle_.get(), &text);
        return detail::after(status, [&] { return std::string(text.data, text.length); });
    }
    // Sets the padding of a link: the distance, in addition to the margin, that obstacles have to keep from it.
    Result<Done> set_padding(const std::string &link, double distance) {
        return detail::done(rccd_cell_set_padding(handle_.get(), detail::c_text(link), distance));
    }
    // Sets the distance at which a pair counts as touching. It replaces margin and paddings.
    Result<Done> set_clearance(const std::string &a, const std::string &b, double distance) {
        return detail::done(rccd_cell_set_clearance(handle_.get(), detail::c_text(a), detail::c_text(b), distance));
    }
    const rccd_cell *get() const noexcept { return handle_.get(); }

private:
    static Result<Cell> zero_in_path() {
        return detail::fail<Cell>({RCCD_STATUS_INVALID_ARGUMENT, "the path of a file or folder contains a zero byte"});
    }
    static const char *or_null(const std::string &text) { return text.empty() ? nullptr : text.c_str(); }
    std::unique_ptr<rccd_cell, void (*)(rccd_cell *)> handle_;
};

// A curve in joint space: joints follow polynomials in time. Copies share it, and so may threads.
class JointCurve {
public:
    // Makes a curve through configurations at ascending times, with the velocities at those times. Each array has the
    // values of one configuration after another. Segments are cubic polynomials, or quintic ones with accelerations.
    static Result<JointCurve> through(View<double> times, View<double> positions, View<double> velocities,
                                      View<double> accelerations = {}) {
        const std::size_t joints = times.size() ? positions.size() / times.size() : 0;
        const std::size_t total = joints * times.size();
        if (positions.size() != total)
            return detail::fail<JointCurve>(detail::wrong_count(
                "positions of each joint at " + std::to_string(times.size()) + " times", total, positions.size()));
        if (velocities.size() != total)
            return detail::fail<JointCurve>(detail::wrong_count("velocities", total, velocities.size()));
        if (accelerations.size() != 0 && accelerations.size() != total)
            return detail::fail<JointCurve>(detail::wrong_count("accelerations", total, accelerations.size()));
        return detail::hold<JointCurve, rccd_joint_curve>([&](rccd_joint_curve **out) {
            const double *const accelerations_or_null = accelerations.size() ? accelerations.data() : nullptr;
            return rccd_joint_curve_through(times.data(), positions.data(), velocities.data(), accelerations_or_null, times.size(),
                                            joints, out);
        });
    }
    // Takes ownership of a handle.
    explicit JointCurve(rccd_joint_curve *handle) : handle_(handle, rccd_joint_curve_free) {}
    const rccd_joint_curve *get() const noexcept { return handle_.get(); }

private:
    std::shared_ptr<const rccd_joint_curve> handle_;
};

// An answer about a path, with the fields of rccd_path_answer.
struct PathAnswer : rccd_path_answer {
    PathAnswer() : rccd_path_answer{} { size = sizeof(rccd_path_answer); }
    bool free() const noexcept { return outcome == Outcome::RCCD_OUTCOME_FREE; }
    bool resolved() const noexcept { return outcome != Outcome::RCCD_OUTCOME_UNRESOLVED; }
    bool hit() const noexcept { return outcome == Outcome::RCCD_OUTCOME_CONTACT; }
    std::string name_a() const { return name(item_a); }
    std::string name_b() const { return name(item_b); }

private:
    static std::string name(const rccd_text &text) {
        return text.data ? std::string(text.data, text.length) : std::string();
    }
};

// The part of an edge that is certified free. The functions have the names of Drake's EdgeMeasure.
class EdgeMeasure {
public:
    explicit EdgeMeasure(double alpha) : alpha_(alpha) {}
    bool completely_free() const noexcept { return alpha_ >= 1; }
    // Returns whether some initial part of the edge is certainly free.
    bool partially_free() const noexcept { return alpha_ > 0; }
    // Returns the fraction of the edge, from its start, that is certainly free. Returns 0 if no part is certainly free.
    double alpha() const noexcept { return alpha_; }

private:
    double alpha_;
};

// A solver for paths in a cell. It reuses memory between questions. Each thread needs a solver of its own.
class CellSolver {
public:
    static Result<CellSolver> make(const Cell &cell, const Settings &settings = {}) {
        rccd_cell_solver *handle = nullptr;
        const rccd_status status = rccd_cell_solver_new(cell.get(), &settings, &handle);
        return detail::after(status, [&] { return CellSolver(handle, cell.joint_count()); });
    }
    // Takes ownership of the handle of a solver for a robot with `joint_count` independent joints.
    CellSolver(rccd_cell_solver *handle, std::size_t joint_count)
        : handle_(handle, rccd_cell_solver_free), joint_count_(joint_count), edge_(2 * joint_count) {}
#ifndef RIGID_CCD_EXPECTED
    explicit CellSolver(const Cell &cell, const Settings &settings = {}) : CellSolver(make(cell, settings)) {}
#endif
    Result<Done> set_settings(const Settings &settings) {
        return detail::done(rccd_cell_solver_set_settings(handle_.get(), &settings));
    }
    // Finds the first contact on a path: an array with one configuration after another, or a curve.
    Result<PathAnswer> first_contact(View<double> configurations) { return ask(rccd_cell_first_contact, configurations); }
    Result<PathAnswer> first_contact(const JointCurve &curve) { return ask(rccd_cell_first_contact, curve); }
    // Finds some contact on a path, not necessarily the first one, or proves that there is none.
    Result<PathAnswer> any_contact(View<double> configurations) { return ask(rccd_cell_any_contact, configurations); }
    Result<PathAnswer> any_contact(const JointCurve &curve) { return ask(rccd_cell_any_contact, curve); }
    // Computes bounds of the least distance of all checked pairs on a path.
    Result<PathAnswer> closest_approach(View<double> configurations) {
        return ask(rccd_cell_closest_approach, configurations);
    }
    Result<PathAnswer> closest_approach(const JointCurve &curve) { return ask(rccd_cell_closest_approach, curve); }
    // Returns the certified free part of the edge between two configurations.
    Result<EdgeMeasure> measure_edge(View<double> start, View<double> end) {
        if (start.size() != joint_count_)
            return detail::fail<EdgeMeasure>(detail::wrong_count("start", joint_count_, start.size()));
        if (end.size() != joint_count_)
            return detail::fail<EdgeMeasure>(detail::wrong_count("end", joint_count_, end.size()));
        // A moved-from solver has no memory for an edge.
        edge_.resize(2 * joint_count_);
        std::copy(start.data(), start.data() + joint_count_, edge_.begin());
        std::copy(end.data(), end.data() + joint_count_, edge_.begin() + static_cast<std::ptrdiff_t>(joint_count_));
        PathAnswer answer;
        const rccd_path edge = {edge_.data(), 2, nullptr};
        const rccd_status status = rccd_cell_first_contact(handle_.get(), &edge, &answer);
        return detail::after(status, [&] { return EdgeMeasure(answer.free() ? 1.0 : answer.fraction); });
    }

private:
    template <typename Question>
    Result<PathAnswer> ask(Question question, View<double> configurations) {
        const std::size_t count = joint_count_ ? configurations.size() / joint_count_ : 0;
        if (configurations.size() != count * joint_count_)
            return detail::fail<PathAnswer>(detail::wrong_configurations(joint_count_, configurations.size()));
        return ask(question, rccd_path{configurations.data(), count, nullptr});
    }
    template <typename Question>
    Result<PathAnswer> ask(Question question, const JointCurve &curve) {
        return ask(question, rccd_path{nullptr, 0, curve.get()});
    }
    template <typename Question>
    Result<PathAnswer> ask(Question question, const rccd_path &path) {
        return detail::stored<PathAnswer>([&](PathAnswer *out) { return question(handle_.get(), &path, out); });
    }
    std::unique_ptr<rccd_cell_solver, void (*)(rccd_cell_solver *)> handle_;
    std::size_t joint_count_;
    std::vector<double> edge_;
};

// Writes an answer of `first_contact` and its question to a file. `ccd replay` repeats the question.
inline Result<Done> write_evidence(const Cell &cell, const Settings &settings, View<double> configurations,
                                   const PathAnswer &answer, const std::string &file) {
    const std::size_t joints = cell.joint_count(), count = joints ? configurations.size() / joints : 0;
    if (configurations.size() != count * joints)
        return detail::fail<Done>(detail::wrong_configurations(joints, configurations.size()));
    const rccd_path path = {configurations.data(), count, nullptr};
    return detail::done(rccd_evidence_write(cell.get(), &settings, &path, &answer, detail::c_text(file)));
}
inline Result<Done> write_evidence(const Cell &cell, const Settings &settings, const JointCurve &curve,
                                   const PathAnswer &answer, const std::string &file) {
    const rccd_path path = {nullptr, 0, curve.get()};
    return detail::done(rccd_evidence_write(cell.get(), &settings, &path, &answer, detail::c_text(file)));
}

#ifndef RIGID_CCD_EXPECTED
// A pool of solvers for one cell, for planners with many threads. Each call borrows a solver. Do not change the cell
// during the lifetime of the pool.
class SolverPool {
public:
    explicit SolverPool(const Cell &cell, const Settings &settings = {}) : cell_(cell), settings_(settings) {}
    // Refuses temporaries: the cell must outlive the pool.
    explicit SolverPool(Cell &&cell, const Settings &settings = {}) = delete;

    // Calls a function with a solver that no other call uses.
    template <typename Call>
    auto with_solver(Call &&call) {
        Loan loan(*this);
        return call(loan.solver);
    }

    // Measures edges on several threads. `edges` has the start and the end configuration of each edge, one edge after
    // another. If the system cannot start all threads, fewer threads measure the edges.
    std::vector<EdgeMeasure> measure_edges(View<double> edges, unsigned thread_count) {
        const std::size_t joints = cell_.joint_count(), count = joints ? edges.size() / (2 * joints) : 0;
        if (edges.size() != 2 * joints * count) throw detail::wrong_configurations(2 * joints, edges.size());
        std::vector<EdgeMeasure> measured(count, EdgeMeasure(0));
        std::atomic<std::size_t> next{0};
        std::mutex failure_mutex;
        std::exception_ptr failure;
        const auto work = [&] {
            try {
                with_solver([&](CellSolver &solver) {
                    for (std::size_t k = next++; k < count; k = next++) {
                        const double *edge = edges.data() + 2 * joints * k;
                        measured[k] = solver.measure_edge({edge, joints}, {edge + joints, joints});
                    }
                });
            } catch (...) {
                const std::lock_guard<std::mutex> lock(failure_mutex);
                failure = std::current_exception();
                next = count;
            }
        };
        std::vector<std::thread> threads;
        try {
            for (std::size_t k = 1; k < thread_count && k < count; ++k) threads.emplace_back(work);
        } catch (const std::exception &) {
        }
        work();
        for (std::thread &thread : threads) thread.join();
        if (failure) std::rethrow_exception(failure);
        return measured;
    }

private:
    struct Loan {
        explicit Loan(SolverPool &owner) : pool(owner), solver(owner.take()) {}
        Loan(const Loan &) = delete;
        Loan &operator=(const Loan &) = delete;
        ~Loan() {
            const std::lock_guard<std::mutex> lock(pool.mutex_);
            pool.idle_solvers_.push_back(std::move(solver));
        }
        SolverPool &pool;
        CellSolver solver;
    };
    CellSolver take() {
        const std::lock_guard<std::mutex> lock(mutex_);
        if (idle_solvers_.empty()) return CellSolver(cell_, settings_);
        CellSolver solver = std::move(idle_solvers_.back());
        idle_solvers_.pop_back();
        return solver;
    }
    const Cell &cell_;
    Settings settings_;
    std::mutex mutex_;
    std::vector<CellSolver> idle_solvers_;
};
#endif

} // namespace RIGID_CCD_FAILURES
} // namespace rigid_ccd

#endif
