// Certified continuous collision detection of rigid bodies, for C++17. Objects free their handles. Failures are
// exceptions, or errors in return values if RIGID_CCD_EXPECTED is defined. This header wraps rigid_ccd.h, which documents
// the structs and their fields. Robots are in rigid_ccd_cell.hpp.
#ifndef RIGID_CCD_HPP
#define RIGID_CCD_HPP

#include "rigid_ccd.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#if __has_include(<Eigen/Geometry>)
#include <Eigen/Geometry>
#define RIGID_CCD_HAS_EIGEN 1
#endif

// Source files of one program may differ in whether they define RIGID_CCD_EXPECTED. An inline namespace for each choice
// gives their symbols different names.
#ifdef RIGID_CCD_EXPECTED
#define RIGID_CCD_FAILURES with_expected
#else
#define RIGID_CCD_FAILURES with_exceptions
#endif

namespace rigid_ccd {
inline namespace RIGID_CCD_FAILURES {

// A failed call. A query that reaches a limit does not fail: its outcome is unresolved.
class Error : public std::runtime_error {
public:
    // Makes the error with the message of this thread's last failed call.
    explicit Error(rccd_status status) : Error(status, rccd_last_error()) {}
    Error(rccd_status status, const std::string &message) : std::runtime_error(message), status_(status) {}
    rccd_status status() const noexcept { return status_; }

private:
    rccd_status status_;
};

#ifdef RIGID_CCD_EXPECTED
// Either a value or an error, with the interface of std::expected of C++23.
template <typename T>
class [[nodiscard]] Expected {
public:
    Expected(T value) : content_(std::in_place_index<0>, std::move(value)) {}
    Expected(Error error) : content_(std::in_place_index<1>, std::move(error)) {}
    bool has_value() const noexcept { return content_.index() == 0; }
    explicit operator bool() const noexcept { return has_value(); }
    // Precondition of the next four functions: there is a value.
    T &operator*() { return *std::get_if<0>(&content_); }
    const T &operator*() const { return *std::get_if<0>(&content_); }
    T *operator->() { return std::get_if<0>(&content_); }
    const T *operator->() const { return std::get_if<0>(&content_); }
    // Precondition: there is an error.
    const Error &error() const { return *std::get_if<1>(&content_); }

private:
    std::variant<T, Error> content_;
};

// The result of a function that can fail: a value or an error. No function throws.
template <typename T>
using Result = Expected<T>;
#else
// The result of a function that can fail: its value. A failure throws rigid_ccd::Error. If RIGID_CCD_EXPECTED is defined
// before this header is included, the result is Expected<T> instead, and the header works without exceptions.
template <typename T>
using Result = T;
#endif

// An empty value, for functions that can fail but have no result.
struct Done {};

namespace detail {

template <typename T>
Result<T> fail(Error error) {
#ifdef RIGID_CCD_EXPECTED
    return error;
#else
    throw error;
#endif
}

// Returns the result of `make` if `status` is success, and the error otherwise.
template <typename Make>
auto after(rccd_status status, Make &&make) -> Result<decltype(make())> {
    if (status != RCCD_STATUS_OK) return fail<decltype(make())>(Error(status));
    return make();
}

inline Result<Done> done(rccd_status status) {
    return after(status, [] { return Done{}; });
}

// Calls a function with a pointer to a value. Returns the value if the call succeeds, and the error otherwise.
template <typename T, typename Call>
Result<T> stored(Call &&call, T value = {}) {
    const rccd_status status = call(&value);
    return after(status, [&] { return value; });
}

// Calls `give` to make a handle, and returns an object that owns it.
template <typename Object, typename Handle, typename Give>
Result<Object> hold(Give &&give) {
    Handle *handle = nullptr;
    const rccd_status status = give(&handle);
    return after(status, [&] { return Object(handle); });
}

// Returns the error for an array of the wrong length.
inline Error wrong_count(const std::string &argument_name, std::size_t needed, std::size_t count) {
    return {RCCD_STATUS_INVALID_ARGUMENT, argument_name + ": " + std::to_string(needed) + " numbers are needed, not " + std::to_string(count)};
}

inline bool contains_zero_byte(const std::string &text) { return text.find('\0') != std::string::npos; }
// Returns the text for a call in C. If it contains a zero byte, returns null, and the call fails.
inline const char *c_text(const std::string &text) { return contains_zero_byte(text) ? nullptr : text.c_str(); }

// Whether a container is a contiguous array of one dimension. Checks types of Eigen: a matrix has two dimensions, and a
// row of a matrix may have a stride.
template <typename Container, typename = void>
struct IsContiguous : std::true_type {};
template <typename Container>
struct IsContiguous<Container, std::void_t<decltype(Container::InnerStrideAtCompileTime)>>
    : std::bool_constant<bool(Container::IsVectorAtCompileTime) && Container::InnerStrideAtCompileTime == 1> {};

} // namespace detail

// An array that the caller owns, as std::span of C++20.
template <typename T>
class View {
public:
    View() = default;
    View(const T *data, std::size_t size) : data_(data), size_(size) {}
    // Silences a warning of GCC, which does not apply: values in braces live until the end of the call.
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Winit-list-lifetime"
#endif
    View(std::initializer_list<T> values) : data_(values.begin()), size_(values.size()) {}
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic pop
#endif
    template <std::size_t SIZE>
    View(const T (&values)[SIZE]) : data_(values), size_(SIZE) {}
    // Takes any container with data() and size(): std::vector, std::array, std::span, and vectors of Eigen without a
    // stride. For a matrix, pass data() and size(), and check that its storage order is the intended one.
    template <typename Container, typename Data = decltype(std::declval<const Container &>().data()),
              typename = std::enable_if_t<std::is_convertible_v<Data, const T *> && detail::IsContiguous<Container>::value>>
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

// Returns the pose at a position, without rotation.
inline Pose pose_at(const Vector &position) {
    return {{position[0], position[1], position[2]}, {0, 0, 0, 1}};
}

// Returns the motion of a body that is static at a pose. Change its fields to make it move.
inline Motion at_rest(const Pose &pose) {
    Motion motion = rccd_motion_at_rest();
    motion.start = pose;
    return motion;
}

// Returns the motion from one pose at time 0 to another at time `duration`, by the shortest rotation. `center` is the
// point in the body's frame that moves on a straight line.
inline Result<Motion> between(const Pose &start, const Pose &end, double duration, const Vector &center = {0, 0, 0}) {
    return detail::stored<Motion>(
        [&](Motion *out) { return rccd_motion_between(&start, &end, center.data(), duration, out); });
}

#ifdef RIGID_CCD_HAS_EIGEN
// Converts a pose of Eigen. Fails if its linear part is not a rotation, to within a millionth in each entry.
inline Result<Pose> to_pose(const Eigen::Isometry3d &pose) {
    const Eigen::Matrix3d linear = pose.linear();
    const Eigen::Matrix3d deviation = linear.transpose() * linear - Eigen::Matrix3d::Identity();
    // The comparison is written so that NaN is an error.
    if (!(deviation.cwiseAbs().maxCoeff() <= 2e-6 && linear.determinant() > 0))
        return detail::fail<Pose>({RCCD_STATUS_INVALID_ARGUMENT, "the linear part of a pose is no rotation"});
    const Eigen::Quaterniond rotation(linear);
    const auto &position = pose.translation();
    return Pose{{position.x(), position.y(), position.z()}, {rotation.x(), rotation.y(), rotation.z(), rotation.w()}};
}
#endif

// A body: a rigid shape. Copies share it, and so may threads.
class Body {
public:
    static Result<Body> sphere(double radius) {
        return make([&](rccd_body **out) { return rccd_body_sphere(radius, out); });
    }
    static Result<Body> capsule(double radius, double half_height) {
        return make([&](rccd_body **out) { return rccd_body_capsule(radius, half_height, out); });
    }
    static Result<Body> box(const Vector &half_extents) {
        return make([&](rccd_body **out) { return rccd_body_box(half_extents[0], half_extents[1], half_extents[2], out); });
    }
    static Result<Body> cylinder(double radius, double half_height) {
        return make([&](rccd_body **out) { return rccd_body_cylinder(radius, half_height, out); });
    }
    static Result<Body> cone(double radius, double half_height) {
        return make([&](rccd_body **out) { return rccd_body_cone(radius, half_height, out); });
    }
    // Makes a body of triangles. Each triangle is three indices of vertices.
    static Result<Body> from_triangles(View<Vector> vertices, View<Triangle> triangles,
                                       std::uint32_t pieces = static_cast<std::uint32_t>(RCCD_PIECES_AUTO)) {
        return make([&](rccd_body **out) {
            return rccd_body_from_triangles(numbers(vertices), vertices.size(), numbers(triangles), triangles.size(),
                                            pieces, out);
        });
    }
    // Prepares a body of triangles, and stores it in a file. `load` reads the file without repeating the preparation.
    static Result<Done> prepare(View<Vector> vertices, View<Triangle> triangles, const std::string &path,
                                std::uint32_t pieces = static_cast<std::uint32_t>(RCCD_PIECES_AUTO)) {
        return detail::done(rccd_body_prepare(numbers(vertices), vertices.size(), numbers(triangles),
                                              triangles.size(), pieces, detail::c_text(path)));
    }
    // Loads a body from a file.
    static Result<Body> load(const std::string &path) {
        return make([&](rccd_body **out) { return rccd_body_load(detail::c_text(path), out); });
    }
    Result<std::size_t> piece_count() const {
        return detail::stored<std::size_t>([&](std::size_t *out) { return rccd_body_piece_count(get(), out); });
    }
    // Returns whether the body is solid. Otherwise it is a surface, and a body inside it does not touch it.
    Result<bool> is_solid() const {
        std::int32_t solid = 0;
        const rccd_status status = rccd_body_is_solid(get(), &solid);
        return detail::after(status, [&] { return solid != 0; });
    }
    // Returns an upper bound of how far the body extends beyond the shape that it represents.
    Result<double> excess() const {
        return detail::stored<double>([&](double *out) { return rccd_body_excess(get(), out); });
    }
    // Takes ownership of a handle.
    explicit Body(rccd_body *handle) : handle_(handle, rccd_body_free) {}
    const rccd_body *get() const noexcept { return handle_.get(); }

private:
    template <typename Make>
    static Result<Body> make(Make &&make) {
        return detail::hold<Body, rccd_body>(make);
    }
    template <typename Number, std::size_t COUNT>
    static const Number *numbers(View<std::array<Number, COUNT>> rows) {
        static_assert(sizeof(std::array<Number, COUNT>) == COUNT * sizeof(Number));
        return rows.size() ? rows.data()->data() : nullptr;
    }
    std::shared_ptr<const rccd_body> handle_;
};

// A trajectory with velocities that change. Copies share it, and so may threads.
class Trajectory {
public:
    // Makes a trajectory through poses at ascending times.
    static Result<Trajectory> pose_path(View<double> times, View<Pose> poses) {
        if (times.size() != poses.size())
            return detail::fail<Trajectory>({RCCD_STATUS_INVALID_ARGUMENT, "as many times as poses are needed"});
        return make([&](rccd_trajectory **out) {
            return rccd_trajectory_pose_path(times.data(), poses.data(), poses.size(), out);
        });
    }
    // Makes a motion whose center has a constant acceleration, as in free fall.
    static Result<Trajectory> ballistic(const Motion &thrown, const Vector &acceleration) {
        return make([&](rccd_trajectory **out) {
            return rccd_trajectory_ballistic(&thrown, acceleration.data(), out);
        });
    }
    // Makes the trajectory of a body whose origin follows the Bézier curve of these control points.
    static Result<Trajectory> bezier(View<Vector> points, double duration, const rccd_rotations *rotations = nullptr) {
        const double *numbers = points.size() ? points.data()->data() : nullptr;
        return make([&](rccd_trajectory **out) {
            return rccd_trajectory_bezier(numbers, points.size(), duration, rotations, out);
        });
    }
    // Makes the trajectory of a body whose origin follows the uniform cubic B-spline of these control points.
    static Result<Trajectory> b_spline(View<Vector> points, double duration, const rccd_rotations *rotations = nullptr) {
        const double *numbers = points.size() ? points.data()->data() : nullptr;
        return make([&](rccd_trajectory **out) {
            return rccd_trajectory_b_spline(numbers, points.size(), duration, rotations, out);
        });
    }
    // Takes ownership of a handle.
    explicit Trajectory(rccd_trajectory *handle) : handle_(handle, rccd_trajectory_free) {}
    // There are no move operations, so that moving copies: a moved-from object without a handle would be static.
    Trajectory(const Trajectory &) = default;
    Trajectory &operator=(const Trajectory &) = default;
    const rccd_trajectory *get() const noexcept { return handle_.get(); }

private:
    template <typename Make>
    static Result<Trajectory> make(Make &&make) {
        return detail::hold<Trajectory, rccd_trajectory>(make);
    }
    std::shared_ptr<const rccd_trajectory> handle_;
};

// A body with a motion or a trajectory. With neither, the body is static at the origin. It shares ownership of the body
// and the trajectory.
class MovingBody {
public:
    MovingBody(const Body &body) : body_(body) {}
    MovingBody(const Body &body, const Motion &motion) : body_(body), motion_(motion) {}
    MovingBody(const Body &body, const Trajectory &trajectory) : body_(body), trajectory_(trajectory) {}
    // Returns the argument for a call in C, with pointers into this object. If the trajectory has lost its handle, the body
    // is null too, and the call fails.
    rccd_moving_body get() const noexcept {
        const rccd_trajectory *trajectory = trajectory_ ? trajectory_->get() : nullptr;
        const bool is_lost = trajectory_ && trajectory == nullptr;
        return {is_lost ? nullptr : body_.get(), motion_ ? &*motion_ : nullptr, trajectory};
    }

private:
    Body body_;
    std::optional<Motion> motion_;
    std::optional<Trajectory> trajectory_;
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

// Settings. The constructor sets the defaults.
struct Settings : rccd_settings {
    Settings() : rccd_settings{} {
        size = sizeof(rccd_settings);
        rccd_settings_default(this);
    }
};

// A flag that stops the queries of all solvers whose settings point to it: `settings.stop = flag.get()`. Any thread may
// use it.
class Stop {
public:
    static Result<Stop> make() { return detail::hold<Stop, rccd_stop>(rccd_stop_new); }
    // Takes ownership of a handle.
    explicit Stop(rccd_stop *handle) : handle_(handle, rccd_stop_free) {}
    // There are no move operations, so that moving copies: a moved-from object without a handle would stop nothing.
    Stop(const Stop &) = default;
    Stop &operator=(const Stop &) = default;
    void set() const noexcept { rccd_stop_set(get()); }
    void clear() const noexcept { rccd_stop_clear(get()); }
    const rccd_stop *get() const noexcept { return handle_.get(); }

private:
    std::shared_ptr<const rccd_stop> handle_;
};

// A solver: settings, and memory that is reused between queries. Each thread needs a solver of its own.
class Solver {
public:
    static Result<Solver> make(const Settings &settings = {}) {
        return detail::hold<Solver, rccd_solver>([&](rccd_solver **out) { return rccd_solver_new(&settings, out); });
    }
    // Takes ownership of a handle.
    explicit Solver(rccd_solver *handle) : handle_(handle, rccd_solver_free) {}
#ifndef RIGID_CCD_EXPECTED
    explicit Solver(const Settings &settings = {}) : Solver(make(settings)) {}
#endif
    Result<Done> set_settings(const Settings &settings) {
        return detail::done(rccd_solver_set_settings(handle_.get(), &settings));
    }
    // Finds the first contact from time 0 to `duration`. Nothing touches before it.
    Result<Answer> first_contact(const MovingBody &a, const MovingBody &b, double duration) {
        return ask(rccd_first_contact, a, b, duration);
    }
    // Finds some contact, not necessarily the first one, or proves that there is none.
    Result<Answer> any_contact(const MovingBody &a, const MovingBody &b, double duration) {
        return ask(rccd_any_contact, a, b, duration);
    }
    // Finds the first and the last contact.
    Result<Answer> contact_interval(const MovingBody &a, const MovingBody &b, double duration) {
        return ask(rccd_contact_interval, a, b, duration);
    }
    // Computes bounds of the least distance. With a duration of 0, it is the distance at the start.
    Result<Answer> closest_approach(const MovingBody &a, const MovingBody &b, double duration) {
        return ask(rccd_closest_approach, a, b, duration);
    }
    // Decides whether the bodies always keep a distance of at least `clearance`.
    Result<Answer> keeps_clearance(const MovingBody &a, const MovingBody &b, double duration, double clearance) {
        const rccd_moving_body moving_a = a.get(), moving_b = b.get();
        return detail::stored<Answer>([&](Answer *out) {
            return rccd_keeps_clearance(handle_.get(), &moving_a, &moving_b, duration, clearance, out);
        });
    }

private:
    template <typename Question>
    Result<Answer> ask(Question question, const MovingBody &a, const MovingBody &b, double duration) {
        const rccd_moving_body moving_a = a.get(), moving_b = b.get();
        return detail::stored<Answer>(
            [&](Answer *out) { return question(handle_.get(), &moving_a, &moving_b, duration, out); });
    }
    std::unique_ptr<rccd_solver, void (*)(rccd_solver *)> handle_;
};

} // namespace RIGID_CCD_FAILURES
} // namespace rigid_ccd

#endif
