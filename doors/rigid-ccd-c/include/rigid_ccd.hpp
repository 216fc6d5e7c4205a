// Certified continuous collision detection of rigid bodies, for C++17: handles that free themselves, and exceptions or expected
// values by choice. Header only, over rigid_ccd.h, where the structs and the meaning of their fields are. Robots are in
// rigid_ccd_cell.hpp.
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

// Files of a program may differ in whether failures are exceptions: what they link has the choice in its names.
#ifdef RIGID_CCD_EXPECTED
#define RIGID_CCD_FAILURES with_expected
#else
#define RIGID_CCD_FAILURES with_exceptions
#endif

namespace rigid_ccd {
inline namespace RIGID_CCD_FAILURES {

// A failure of a call. A query that reaches a limit is none: its answer is unresolved.
class Error : public std::runtime_error {
public:
    // The failure of the last call of this thread.
    explicit Error(rccd_status status) : Error(status, rccd_last_error()) {}
    Error(rccd_status status, const std::string &message) : std::runtime_error(message), status_(status) {}
    rccd_status status() const noexcept { return status_; }

private:
    rccd_status status_;
};

#ifdef RIGID_CCD_EXPECTED
// A value or the error instead of it, with the names of std::expected of C++23.
template <typename T>
class [[nodiscard]] Expected {
public:
    Expected(T value) : content_(std::in_place_index<0>, std::move(value)) {}
    Expected(Error error) : content_(std::in_place_index<1>, std::move(error)) {}
    bool has_value() const noexcept { return content_.index() == 0; }
    explicit operator bool() const noexcept { return has_value(); }
    // What follows needs a value.
    T &operator*() { return *std::get_if<0>(&content_); }
    const T &operator*() const { return *std::get_if<0>(&content_); }
    T *operator->() { return std::get_if<0>(&content_); }
    const T *operator->() const { return std::get_if<0>(&content_); }
    // Needs an error.
    const Error &error() const { return *std::get_if<1>(&content_); }

private:
    std::variant<T, Error> content_;
};

// What a function returns that can fail: a value, or the error. Nothing throws.
template <typename T>
using Result = Expected<T>;
#else
// What a function returns that can fail: the value. A failure is an exception, rigid_ccd::Error. With RIGID_CCD_EXPECTED
// defined before this header is included, it is Expected<T> instead, and the header works without exceptions.
template <typename T>
using Result = T;
#endif

// What a function returns that can fail and has no value.
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

// Returns what a function makes after a call has worked.
template <typename Make>
auto after(rccd_status status, Make &&make) -> Result<decltype(make())> {
    if (status != RCCD_STATUS_OK) return fail<decltype(make())>(Error(status));
    return make();
}

inline Result<Done> done(rccd_status status) {
    return after(status, [] { return Done{}; });
}

// Returns an object around a handle that a call gives.
template <typename Object, typename Handle, typename Give>
Result<Object> hold(Give &&give) {
    Handle *handle = nullptr;
    const rccd_status status = give(&handle);
    return after(status, [&] { return Object(handle); });
}

// Returns the error of numbers of which there are too many or too few.
inline Error wrong_count(const std::string &what, std::size_t needed, std::size_t given) {
    return {RCCD_STATUS_INVALID_ARGUMENT, what + ": " + std::to_string(needed) + " numbers are needed, not " + std::to_string(given)};
}

// Returns a text for a call; null, which is an error there, if a zero would end it too early.
inline bool has_zero(const std::string &text) { return text.find('\0') != std::string::npos; }
inline const char *c_text(const std::string &text) { return has_zero(text) ? nullptr : text.c_str(); }

// Whether a container has its values one after the other, in an order that is no question. Types of Eigen say so: a matrix is in
// memory column by column or row by row, and a row of one has gaps.
template <typename Container, typename = void>
struct InOneRow : std::true_type {};
template <typename Container>
struct InOneRow<Container, std::void_t<decltype(Container::InnerStrideAtCompileTime)>>
    : std::bool_constant<bool(Container::IsVectorAtCompileTime) && Container::InnerStrideAtCompileTime == 1> {};

} // namespace detail

// An array that belongs to somebody else, as std::span of C++20.
template <typename T>
class View {
public:
    View() = default;
    View(const T *data, std::size_t size) : data_(data), size_(size) {}
    // Values in braces live as long as the call to which they are passed, which GCC does not know.
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
    // Anything with data() and size(): std::vector, std::array, std::span, vectors of Eigen without gaps. Of a matrix pass data()
    // and size(), if its columns or rows are in memory one after the other as you mean them.
    template <typename Container, typename Data = decltype(std::declval<const Container &>().data()),
              typename = std::enable_if_t<std::is_convertible_v<Data, const T *> && detail::InOneRow<Container>::value>>
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
inline Result<Motion> between(const Pose &start, const Pose &end, double duration, const Vector &centre = {0, 0, 0}) {
    Motion motion;
    const rccd_status status = rccd_motion_between(&start, &end, centre.data(), duration, &motion);
    return detail::after(status, [&] { return motion; });
}

#ifdef RIGID_CCD_HAS_EIGEN
// Converts a pose of Eigen. One that scales or mirrors is an error: each number of a rotation is right to a millionth.
inline Result<Pose> to_pose(const Eigen::Isometry3d &pose) {
    const Eigen::Matrix3d linear = pose.linear();
    const Eigen::Matrix3d skew = linear.transpose() * linear - Eigen::Matrix3d::Identity();
    // Written so that NaN is an error.
    if (!(skew.cwiseAbs().maxCoeff() <= 2e-6 && linear.determinant() > 0))
        return detail::fail<Pose>({RCCD_STATUS_INVALID_ARGUMENT, "the linear part of a pose is no rotation"});
    const Eigen::Quaterniond turned(linear);
    const auto &at = pose.translation();
    return Pose{{at.x(), at.y(), at.z()}, {turned.x(), turned.y(), turned.z(), turned.w()}};
}
#endif

// A body: the shape that moves. Copies share it, threads may too.
class Body {
public:
    static Result<Body> sphere(double radius) {
        return make([&](rccd_body **out) { return rccd_body_sphere(radius, out); });
    }
    static Result<Body> capsule(double radius, double half_length) {
        return make([&](rccd_body **out) { return rccd_body_capsule(radius, half_length, out); });
    }
    static Result<Body> box(const Vector &half) {
        return make([&](rccd_body **out) { return rccd_body_box(half[0], half[1], half[2], out); });
    }
    static Result<Body> cylinder(double radius, double half_length) {
        return make([&](rccd_body **out) { return rccd_body_cylinder(radius, half_length, out); });
    }
    static Result<Body> cone(double radius, double half_length) {
        return make([&](rccd_body **out) { return rccd_body_cone(radius, half_length, out); });
    }
    // Makes a body of triangles, which are indices of vertices.
    static Result<Body> from_triangles(View<Vector> vertices, View<Triangle> triangles,
                                       std::uint32_t detail = static_cast<std::uint32_t>(RCCD_DETAIL_AUTO)) {
        return make([&](rccd_body **out) {
            return rccd_body_from_triangles(numbers(vertices), vertices.size(), numbers(triangles), triangles.size(),
                                            detail, out);
        });
    }
    // Prepares a body of triangles, and stores it in a file that `load` reads without that work.
    static Result<Done> prepare(View<Vector> vertices, View<Triangle> triangles, const std::string &path,
                                std::uint32_t detail = static_cast<std::uint32_t>(RCCD_DETAIL_AUTO)) {
        return detail::done(rccd_body_prepare(numbers(vertices), vertices.size(), numbers(triangles),
                                              triangles.size(), detail, detail::c_text(path)));
    }
    // Loads a body from a file.
    static Result<Body> load(const std::string &path) {
        return make([&](rccd_body **out) { return rccd_body_load(detail::c_text(path), out); });
    }
    Result<std::size_t> piece_count() const {
        std::size_t count = 0;
        const rccd_status status = rccd_body_piece_count(get(), &count);
        return detail::after(status, [&] { return count; });
    }
    // Returns whether the body is solid; what is inside a surface does not touch it.
    Result<bool> is_solid() const {
        std::int32_t solid = 0;
        const rccd_status status = rccd_body_is_solid(get(), &solid);
        return detail::after(status, [&] { return solid != 0; });
    }
    // Returns by how much the body exceeds the shape that it was made of, at most.
    Result<double> excess() const {
        double excess = 0;
        const rccd_status status = rccd_body_excess(get(), &excess);
        return detail::after(status, [&] { return excess; });
    }
    // Takes a handle.
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

// A trajectory that is no motion at constant velocities. Copies share it, threads may too.
class Trajectory {
public:
    // A path through poses, each at its time, in ascending order.
    static Result<Trajectory> through_poses(View<double> times, View<Pose> poses) {
        if (times.size() != poses.size())
            return detail::fail<Trajectory>({RCCD_STATUS_INVALID_ARGUMENT, "as many times as poses are needed"});
        return make([&](rccd_trajectory **out) {
            return rccd_trajectory_through_poses(times.data(), poses.data(), poses.size(), out);
        });
    }
    // A motion whose centre accelerates, in free fall for instance.
    static Result<Trajectory> thrown(const Motion &thrown, const Vector &acceleration) {
        return make([&](rccd_trajectory **out) {
            return rccd_trajectory_thrown(&thrown, acceleration.data(), out);
        });
    }
    // A body whose origin follows a Bézier curve by its control points.
    static Result<Trajectory> bezier(View<Vector> points, double duration, const rccd_turns *turns = nullptr) {
        const double *numbers = points.size() ? points.data()->data() : nullptr;
        return make([&](rccd_trajectory **out) {
            return rccd_trajectory_bezier(numbers, points.size(), duration, turns, out);
        });
    }
    // A body whose origin follows a uniform cubic B-spline by its control points.
    static Result<Trajectory> b_spline(View<Vector> points, double duration, const rccd_turns *turns = nullptr) {
        const double *numbers = points.size() ? points.data()->data() : nullptr;
        return make([&](rccd_trajectory **out) {
            return rccd_trajectory_b_spline(numbers, points.size(), duration, turns, out);
        });
    }
    // Takes a handle.
    explicit Trajectory(rccd_trajectory *handle) : handle_(handle, rccd_trajectory_free) {}
    // A move is a copy: without a trajectory a body rests.
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

// A body and what moves it; with neither motion nor trajectory it rests at the origin. It keeps both alive.
class MovingBody {
public:
    MovingBody(const Body &body) : body_(body) {}
    MovingBody(const Body &body, const Motion &motion) : body_(body), motion_(motion) {}
    MovingBody(const Body &body, const Trajectory &along) : body_(body), along_(along) {}
    // Returns what a call takes; it refers to this object. Without a trajectory's handle there is no body either, which is an error.
    rccd_moving_body get() const noexcept {
        const rccd_trajectory *along = along_ ? along_->get() : nullptr;
        const bool lost = along_ && along == nullptr;
        return {lost ? nullptr : body_.get(), motion_ ? &*motion_ : nullptr, along};
    }

private:
    Body body_;
    std::optional<Motion> motion_;
    std::optional<Trajectory> along_;
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
    Settings() : rccd_settings{} {
        size = sizeof(rccd_settings);
        rccd_settings_default(this);
    }
};

// A flag that stops the queries of all solvers whose settings name it: `settings.stop = flag.get()`. Any thread may use it.
class Stop {
public:
    static Result<Stop> make() { return detail::hold<Stop, rccd_stop>(rccd_stop_new); }
    // Takes a handle.
    explicit Stop(rccd_stop *handle) : handle_(handle, rccd_stop_free) {}
    // A move is a copy: without a flag nothing is stopped.
    Stop(const Stop &) = default;
    Stop &operator=(const Stop &) = default;
    void set() const noexcept { rccd_stop_set(get()); }
    void clear() const noexcept { rccd_stop_clear(get()); }
    const rccd_stop *get() const noexcept { return handle_.get(); }

private:
    std::shared_ptr<const rccd_stop> handle_;
};

// A solver: settings, and memory that it reuses from query to query. Each thread needs its own.
class Solver {
public:
    static Result<Solver> make(const Settings &settings = {}) {
        return detail::hold<Solver, rccd_solver>([&](rccd_solver **out) { return rccd_solver_new(&settings, out); });
    }
    // Takes a handle.
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
    // Finds some contact, perhaps not the first one, or proves that there is none.
    Result<Answer> any_contact(const MovingBody &a, const MovingBody &b, double duration) {
        return ask(rccd_any_contact, a, b, duration);
    }
    // Finds when the bodies first and last touch.
    Result<Answer> contact_interval(const MovingBody &a, const MovingBody &b, double duration) {
        return ask(rccd_contact_interval, a, b, duration);
    }
    // Brackets the least distance; with a duration of 0 the distance at the start.
    Result<Answer> closest_approach(const MovingBody &a, const MovingBody &b, double duration) {
        return ask(rccd_closest_approach, a, b, duration);
    }
    // Decides whether the bodies keep a distance.
    Result<Answer> keeps_clearance(const MovingBody &a, const MovingBody &b, double duration, double clearance) {
        Answer answer;
        const rccd_moving_body moving_a = a.get(), moving_b = b.get();
        const rccd_status status =
            rccd_keeps_clearance(handle_.get(), &moving_a, &moving_b, duration, clearance, &answer);
        return detail::after(status, [&] { return answer; });
    }

private:
    template <typename Question>
    Result<Answer> ask(Question question, const MovingBody &a, const MovingBody &b, double duration) {
        Answer answer;
        const rccd_moving_body moving_a = a.get(), moving_b = b.get();
        const rccd_status status = question(handle_.get(), &moving_a, &moving_b, duration, &answer);
        return detail::after(status, [&] { return answer; });
    }
    std::unique_ptr<rccd_solver, void (*)(rccd_solver *)> handle_;
};

} // namespace RIGID_CCD_FAILURES
} // namespace rigid_ccd

#endif
