// Certified continuous collision detection of rigid bodies, for C++17: handles that free themselves, and exceptions.
// Header only, over rigid_ccd.h, where the structs and the meaning of their fields are.
#ifndef RIGID_CCD_HPP
#define RIGID_CCD_HPP

#include "rigid_ccd.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#if __has_include(<Eigen/Geometry>)
#include <Eigen/Geometry>
#define RIGID_CCD_HAS_EIGEN 1
#endif

namespace rigid_ccd {

// A failure of a call. A query that reaches a limit is none: its answer is unresolved.
class Error : public std::runtime_error {
public:
    explicit Error(rccd_status status) : std::runtime_error(rccd_last_error()), status_(status) {}
    rccd_status status() const noexcept { return status_; }

private:
    rccd_status status_;
};

inline void check(rccd_status status) {
    if (status != RCCD_STATUS_OK) throw Error(status);
}

// An array that belongs to somebody else, as std::span of C++20.
template <typename T>
class View {
public:
    View() = default;
    View(const T *data, std::size_t size) : data_(data), size_(size) {}
    // Anything with data() and size(): std::vector, std::array, std::span.
    template <typename Container, typename = decltype(std::declval<const Container &>().data())>
    View(const Container &values) : data_(values.data()), size_(values.size()) {}
    const T *data() const noexcept { return data_; }
    std::size_t size() const noexcept { return size_; }

private:
    const T *data_ = nullptr;
    std::size_t size_ = 0;
};

using Vector = std::array<double, 3>;
using Triangle = std::array<std::uint32_t, 3>;
using Pose = rccd_pose;
using Motion = rccd_motion;
using Outcome = rccd_outcome;

// Returns a pose with the world's orientation.
inline Pose pose_at(const Vector &position) {
    return {{position[0], position[1], position[2]}, {0, 0, 0, 1}};
}

// Returns the motion of a body that rests at a pose, to be changed before use.
inline Motion at_rest(const Pose &pose) {
    Motion motion = rccd_motion_at_rest();
    motion.start = pose;
    return motion;
}

// Returns the motion from one pose at time 0 to another at time `duration`, by the shortest rotation about a point of the
// body, in its frame, that moves straight.
inline Motion between(const Pose &start, const Pose &end, double duration, const Vector &centre = {0, 0, 0}) {
    Motion motion;
    check(rccd_motion_between(&start, &end, centre.data(), duration, &motion));
    return motion;
}

#ifdef RIGID_CCD_HAS_EIGEN
// Converts a pose of Eigen.
inline Pose to_pose(const Eigen::Isometry3d &pose) {
    const Eigen::Quaterniond turned(pose.linear());
    const auto &at = pose.translation();
    return {{at.x(), at.y(), at.z()}, {turned.x(), turned.y(), turned.z(), turned.w()}};
}
#endif

// A body: the shape that moves. Copies share it, threads may too.
class Body {
public:
    static Body sphere(double radius) {
        return make([&](rccd_body **out) { return rccd_body_sphere(radius, out); });
    }
    static Body capsule(double radius, double half_length) {
        return make([&](rccd_body **out) { return rccd_body_capsule(radius, half_length, out); });
    }
    static Body box(const Vector &half) {
        return make([&](rccd_body **out) { return rccd_body_box(half[0], half[1], half[2], out); });
    }
    static Body cylinder(double radius, double half_length) {
        return make([&](rccd_body **out) { return rccd_body_cylinder(radius, half_length, out); });
    }
    static Body cone(double radius, double half_length) {
        return make([&](rccd_body **out) { return rccd_body_cone(radius, half_length, out); });
    }
    // Makes a body of triangles, which are indices of vertices.
    static Body from_triangles(View<Vector> vertices, View<Triangle> triangles,
                               std::uint32_t detail = static_cast<std::uint32_t>(RCCD_DETAIL_AUTO)) {
        static_assert(sizeof(Vector) == 3 * sizeof(double) && sizeof(Triangle) == 3 * sizeof(std::uint32_t));
        const double *points = vertices.size() ? vertices.data()->data() : nullptr;
        const std::uint32_t *corners = triangles.size() ? triangles.data()->data() : nullptr;
        return make([&](rccd_body **out) {
            return rccd_body_from_triangles(points, vertices.size(), corners, triangles.size(), detail, out);
        });
    }
    // Loads a body from a file.
    static Body load(const std::string &path) {
        return make([&](rccd_body **out) { return rccd_body_load(path.c_str(), out); });
    }
    std::size_t piece_count() const {
        std::size_t count = 0;
        check(rccd_body_piece_count(get(), &count));
        return count;
    }
    const rccd_body *get() const noexcept { return handle_.get(); }

private:
    explicit Body(rccd_body *handle) : handle_(handle, rccd_body_free) {}
    template <typename Make>
    static Body make(Make &&make) {
        rccd_body *handle = nullptr;
        check(make(&handle));
        return Body(handle);
    }
    std::shared_ptr<const rccd_body> handle_;
};

// A trajectory that is no motion at constant velocities. Copies share it, threads may too.
class Trajectory {
public:
    // A path through poses, each at its time, in ascending order.
    static Trajectory through_poses(View<double> times, View<Pose> poses) {
        if (times.size() != poses.size()) throw std::invalid_argument("as many times as poses are needed");
        return make([&](rccd_trajectory **out) {
            return rccd_trajectory_through_poses(times.data(), poses.data(), poses.size(), out);
        });
    }
    // A motion whose centre accelerates, in free fall for instance.
    static Trajectory thrown(const Motion &thrown, const Vector &acceleration) {
        return make([&](rccd_trajectory **out) {
            return rccd_trajectory_thrown(&thrown, acceleration.data(), out);
        });
    }
    const rccd_trajectory *get() const noexcept { return handle_.get(); }

private:
    explicit Trajectory(rccd_trajectory *handle) : handle_(handle, rccd_trajectory_free) {}
    template <typename Make>
    static Trajectory make(Make &&make) {
        rccd_trajectory *handle = nullptr;
        check(make(&handle));
        return Trajectory(handle);
    }
    std::shared_ptr<const rccd_trajectory> handle_;
};

// A body and what moves it; with neither motion nor trajectory it rests at the origin. It refers to both, and is made for
// one call.
class MovingBody {
public:
    MovingBody(const Body &body) : moving_{body.get(), nullptr, nullptr} {}
    MovingBody(const Body &body, const Motion &motion) : moving_{body.get(), &motion, nullptr} {}
    MovingBody(const Body &body, const Trajectory &along) : moving_{body.get(), nullptr, along.get()} {}
    const rccd_moving_body *get() const noexcept { return &moving_; }

private:
    rccd_moving_body moving_;
};

// An answer, with the fields of rccd_answer.
struct Answer : rccd_answer {
    Answer() : rccd_answer{} { size = sizeof(rccd_answer); }
    bool free() const noexcept { return outcome == Outcome::RCCD_OUTCOME_FREE; }
    bool resolved() const noexcept { return outcome != Outcome::RCCD_OUTCOME_UNRESOLVED; }
    // Returns whether the bodies are in contact at `time`.
    bool hit() const noexcept {
        return outcome == Outcome::RCCD_OUTCOME_CONTACT || outcome == Outcome::RCCD_OUTCOME_TOUCHING ||
               outcome == Outcome::RCCD_OUTCOME_OVERLAPPING || outcome == Outcome::RCCD_OUTCOME_INTERVAL;
    }
};

// Settings, which begin as the default ones.
struct Settings : rccd_settings {
    Settings() : rccd_settings(rccd_settings_default()) {}
};

// A solver: settings, and memory that it reuses from query to query. Each thread needs its own.
class Solver {
public:
    explicit Solver(const Settings &settings = {}) : handle_(nullptr, rccd_solver_free) {
        rccd_solver *handle = nullptr;
        check(rccd_solver_new(&settings, &handle));
        handle_.reset(handle);
    }
    void set_settings(const Settings &settings) { check(rccd_solver_set_settings(handle_.get(), &settings)); }
    // Finds the first contact from time 0 to `duration`. Nothing touches before it.
    Answer first_contact(const MovingBody &a, const MovingBody &b, double duration) {
        return ask(rccd_first_contact, a, b, duration);
    }
    // Finds some contact, perhaps not the first one, or proves that there is none.
    Answer any_contact(const MovingBody &a, const MovingBody &b, double duration) {
        return ask(rccd_any_contact, a, b, duration);
    }
    // Finds when the bodies first and last touch.
    Answer contact_interval(const MovingBody &a, const MovingBody &b, double duration) {
        return ask(rccd_contact_interval, a, b, duration);
    }
    // Brackets the least distance; with a duration of 0 the distance at the start.
    Answer closest_approach(const MovingBody &a, const MovingBody &b, double duration) {
        return ask(rccd_closest_approach, a, b, duration);
    }
    // Decides whether the bodies keep a distance.
    Answer keeps_clearance(const MovingBody &a, const MovingBody &b, double duration, double clearance) {
        Answer answer;
        check(rccd_keeps_clearance(handle_.get(), a.get(), b.get(), duration, clearance, &answer));
        return answer;
    }

private:
    template <typename Question>
    Answer ask(Question question, const MovingBody &a, const MovingBody &b, double duration) {
        Answer answer;
        check(question(handle_.get(), a.get(), b.get(), duration, &answer));
        return answer;
    }
    std::unique_ptr<rccd_solver, void (*)(rccd_solver *)> handle_;
};

// A robot among obstacles that rest in the frame of its base. Solvers keep the cell as it was when they were made.
class Cell {
public:
    // Loads the robot of a URDF or MJCF file, with its meshes. The SRDF file and the folder that is searched first for
    // `package://` names may be empty.
    static Cell load(const std::string &robot, const std::string &srdf = "", const std::string &package_folder = "") {
        rccd_cell *handle = nullptr;
        check(rccd_cell_load(robot.c_str(), or_null(srdf), or_null(package_folder), &handle));
        return Cell(handle);
    }
    // Returns the number of positions of a configuration.
    std::size_t joint_count() const {
        std::size_t count = 0;
        check(rccd_cell_joint_count(get(), &count));
        return count;
    }
    void add_obstacle(const std::string &name, const Body &body, const Pose &pose) {
        check(rccd_cell_add_obstacle(handle_.get(), name.c_str(), body.get(), &pose));
    }
    void move_obstacle(const std::string &name, const Pose &pose) {
        check(rccd_cell_move_obstacle(handle_.get(), name.c_str(), &pose));
    }
    void remove_obstacle(const std::string &name) { check(rccd_cell_remove_obstacle(handle_.get(), name.c_str())); }
    // Attaches a body to a link, such as an object that a gripper holds, at a pose in the link's frame.
    void attach(const std::string &name, const Body &body, const std::string &link, const Pose &pose,
                const std::vector<std::string> &may_touch = {}) {
        std::vector<const char *> links;
        for (const std::string &touched : may_touch) links.push_back(touched.c_str());
        check(rccd_cell_attach(handle_.get(), name.c_str(), body.get(), link.c_str(), &pose, links.data(), links.size()));
    }
    void detach(const std::string &name) { check(rccd_cell_detach(handle_.get(), name.c_str())); }
    const rccd_cell *get() const noexcept { return handle_.get(); }

private:
    explicit Cell(rccd_cell *handle) : handle_(handle, rccd_cell_free) {}
    static const char *or_null(const std::string &text) { return text.empty() ? nullptr : text.c_str(); }
    std::unique_ptr<rccd_cell, void (*)(rccd_cell *)> handle_;
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

// A solver for paths in a cell. It keeps memory from one question to the next; each thread needs its own.
class CellSolver {
public:
    explicit CellSolver(const Cell &cell, const Settings &settings = {})
        : handle_(nullptr, rccd_cell_solver_free), joint_count_(cell.joint_count()) {
        rccd_cell_solver *handle = nullptr;
        check(rccd_cell_solver_new(cell.get(), &settings, &handle));
        handle_.reset(handle);
    }
    void set_settings(const Settings &settings) { check(rccd_cell_solver_set_settings(handle_.get(), &settings)); }
    // Finds the first contact on a path through configurations, one after the other in one array.
    PathAnswer first_contact(View<double> configurations) { return ask(rccd_cell_first_contact, configurations); }
    // Brackets how near any pair comes to touching on such a path.
    PathAnswer closest_approach(View<double> configurations) { return ask(rccd_cell_closest_approach, configurations); }
    // Returns the share of the edge between two configurations that is certainly free: 1 if all of it is.
    double measure_edge(View<double> start, View<double> end) {
        edge_.assign(start.data(), start.data() + start.size());
        edge_.insert(edge_.end(), end.data(), end.data() + end.size());
        const PathAnswer answer = first_contact(edge_);
        return answer.free() ? 1.0 : answer.share;
    }

private:
    template <typename Question>
    PathAnswer ask(Question question, View<double> configurations) {
        if (joint_count_ == 0 || configurations.size() % joint_count_ != 0)
            throw std::invalid_argument("a path is as many positions as the robot has joints, for each configuration");
        PathAnswer answer;
        const std::size_t count = configurations.size() / joint_count_;
        check(question(handle_.get(), configurations.data(), count, &answer));
        return answer;
    }
    std::unique_ptr<rccd_cell_solver, void (*)(rccd_cell_solver *)> handle_;
    std::size_t joint_count_;
    std::vector<double> edge_;
};

} // namespace rigid_ccd

#endif
