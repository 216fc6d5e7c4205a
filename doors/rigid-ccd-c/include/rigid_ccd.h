/* The C interface of rigid-ccd: certified continuous collision detection of rigid bodies.
 *
 * When do two moving bodies first touch? No contact happens before the reported time, in floating point.
 * Functions return a status; rccd_last_error() has the reason of a failure. A query that reaches a limit has not failed:
 * its outcome is RCCD_OUTCOME_UNRESOLVED, with a time until which nothing touches.
 *
 * Lengths are in any one unit, times in the motions' unit, angles in radians. Bodies and trajectories may be shared by
 * threads; each thread needs a solver of its own. Written by cbindgen from the crate rigid-ccd-c: do not edit.
 */

#ifndef RIGID_CCD_H
#define RIGID_CCD_H

#include <math.h>
#include <stddef.h>
#include <stdint.h>

// The settings that `rccd_settings_default` fills in: `rccd_settings settings = RCCD_SETTINGS_INIT;`.
#define RCCD_SETTINGS_INIT {sizeof(rccd_settings), 0.001, 0.0, 4194304, HUGE_VAL, RCCD_START_POLICY_REPORT, RCCD_CONTACT_NORMALS_REFINED, NULL}

// Whether a call has worked.
enum rccd_status
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : int32_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
    // The call has worked. A query that reached a limit has worked too: its answer is unresolved.
    RCCD_STATUS_OK = 0,
    // An argument is null, or no value of its type.
    RCCD_STATUS_INVALID_ARGUMENT = 1,
    // A number, such as a radius or a duration, is out of range.
    RCCD_STATUS_INVALID_INPUT = 2,
    // A body cannot be made from the mesh or file.
    RCCD_STATUS_INVALID_BODY = 3,
    // A defect of this library. The objects of the call may be freed, and nothing else.
    RCCD_STATUS_PANIC = 4,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum rccd_status rccd_status;
#else
typedef int32_t rccd_status;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

// What a query has found.
enum rccd_outcome
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : int32_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
    // A limit was reached before the answer was known; until `safe_until` nothing touches. It is 0: an answer of zeros, which no
    // call has filled, proves nothing.
    RCCD_OUTCOME_UNRESOLVED = 0,
    // The bodies stay apart over the whole duration.
    RCCD_OUTCOME_FREE = 1,
    // The bodies are in contact at `time`; for a first contact nothing touches before.
    RCCD_OUTCOME_CONTACT = 2,
    // The bodies are within margin + tolerance at the start.
    RCCD_OUTCOME_TOUCHING = 3,
    // The bodies overlap at the start.
    RCCD_OUTCOME_OVERLAPPING = 4,
    // The bodies are in contact at `time` first, and at `last_time` last.
    RCCD_OUTCOME_INTERVAL = 5,
    // The least distance is from `lower` to `upper`, the latter at `time`.
    RCCD_OUTCOME_LEAST_DISTANCE = 6,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum rccd_outcome rccd_outcome;
#else
typedef int32_t rccd_outcome;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

// The limit that has ended a query.
enum rccd_limit
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : int32_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
    // No limit was reached.
    RCCD_LIMIT_NONE = 0,
    // The budget is spent.
    RCCD_LIMIT_BUDGET = 1,
    // The deadline has passed.
    RCCD_LIMIT_DEADLINE = 2,
    // The query was stopped.
    RCCD_LIMIT_STOPPED = 3,
    // No further step can be certified.
    RCCD_LIMIT_STALLED = 4,
    // The distance of two pieces could not be computed.
    RCCD_LIMIT_ORACLE_GAVE_UP = 5,
    // Rounding leaves it undecided whether the bodies overlap at the start.
    RCCD_LIMIT_OVERLAP_UNDECIDED = 6,
    // A limit that this interface has no name for.
    RCCD_LIMIT_OTHER = 255,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum rccd_limit rccd_limit;
#else
typedef int32_t rccd_limit;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

// The kind of a feature, which says what its indices mean.
enum rccd_feature_kind
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : uint32_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
    // There is no feature: both indices are 0.
    RCCD_FEATURE_KIND_NONE = 0,
    // The vertex `first` of the mesh.
    RCCD_FEATURE_KIND_VERTEX = 1,
    // The edge between the vertices `first` and `second`.
    RCCD_FEATURE_KIND_EDGE = 2,
    // The face `first` of the mesh.
    RCCD_FEATURE_KIND_FACE = 3,
    // The piece `first`, whose facets are unknown or no faces of the mesh.
    RCCD_FEATURE_KIND_PIECE = 4,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum rccd_feature_kind rccd_feature_kind;
#else
typedef uint32_t rccd_feature_kind;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

// How triangles in arrays become a body.
enum rccd_detail
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : uint32_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
    // The fewest exact pieces: one hull for a convex solid, else patches or triangles, whichever is faster.
    RCCD_DETAIL_AUTO = 0,
    // One piece for each triangle. A closed mesh is solid.
    RCCD_DETAIL_TRIANGLES = 1,
    // One piece for each triangle. A closed mesh is hollow.
    RCCD_DETAIL_SURFACE = 2,
    // One piece, the convex hull. It encloses any mesh, and queries account for what it exceeds.
    RCCD_DETAIL_OUTER_HULL = 3,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum rccd_detail rccd_detail;
#else
typedef uint32_t rccd_detail;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

// What to do about bodies that are in contact at the start.
enum rccd_start_policy
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : uint32_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
    // The contact is the answer.
    RCCD_START_POLICY_REPORT = 0,
    // The contact is ignored until the bodies approach: of motions at constant velocities, in questions about the first or any
    // contact. In others the contact is the answer.
    RCCD_START_POLICY_LEAVE = 1,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum rccd_start_policy rccd_start_policy;
#else
typedef uint32_t rccd_start_policy;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

// How the normals and features of contacts are found.
enum rccd_contact_normals
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : uint32_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
    // Where bodies touch up to rounding, the normal is that of the surfaces around them. To find it may take some hundred
    // microseconds beyond a deadline, and allocates.
    RCCD_CONTACT_NORMALS_REFINED = 0,
    // The normal is that of the two triangles or convex pieces, which is mostly rounding where they touch. For queries that keep
    // a deadline or must not allocate. Questions about paths in a cell always use these.
    RCCD_CONTACT_NORMALS_OF_PIECES = 1,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum rccd_contact_normals rccd_contact_normals;
#else
typedef uint32_t rccd_contact_normals;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

// A body: the shape that moves. Many queries and threads may share it.
typedef struct rccd_body rccd_body;

// A robot among obstacles that rest in the frame of its base. Obstacles and bodies that the robot holds have names, which no
// link has. A change of the cell ends its solvers: their questions are errors from then on, and a new solver takes some 30 µs.
typedef struct rccd_cell rccd_cell;

// A solver for paths in a cell, until the cell is changed: from then on its questions are errors. It keeps memory from one
// question to the next. Each thread needs its own.
typedef struct rccd_cell_solver rccd_cell_solver;

// A path of a robot whose joints follow polynomials of the time. Many questions and threads may share it.
typedef struct rccd_joint_curve rccd_joint_curve;

// A solver: settings, and memory that it reuses from query to query. Each thread needs its own.
typedef struct rccd_solver rccd_solver;

// A flag that stops the queries of all solvers whose settings name it. Any thread may set and clear it at any time.
typedef struct rccd_stop rccd_stop;

// A trajectory. Many queries and threads may share it.
typedef struct rccd_trajectory rccd_trajectory;

// A text in UTF-8 that belongs to a cell or to a solver, and that does not end with a zero.
typedef struct rccd_text {
    // The first byte; null for no text.
    const char *data;
    // The number of bytes.
    size_t length;
} rccd_text;

// A position and an orientation of a body in the world.
typedef struct rccd_pose {
    // The position of the body's origin.
    double position[3];
    // The orientation as a quaternion in the order x, y, z, w, of any length but zero.
    double orientation[4];
} rccd_pose;

// The settings of queries. Set `size`, call `rccd_settings_default`, then change what differs.
typedef struct rccd_settings {
    // The size of this struct in the caller's header; set it first.
    size_t size;
    // A contact is reported at a distance of at most margin + tolerance. In the unit of length of the bodies.
    double tolerance;
    // The distance at which bodies count as touching; 0 reports actual contact.
    double margin;
    // The largest amount of work, in visits of about a microsecond or less. Along a trajectory it is for each part between two
    // poses or pieces of a curve. A visit of a curve of a high degree takes longer. In a cell it is for each query of two bodies;
    // a question about a path takes at most 8 budgets for each segment, all pairs together, and the closest approach up to half
    // as much again.
    uint64_t budget;
    // The time in seconds after which a query ends as unresolved, from 0 to 1e19; infinity for none.
    double deadline;
    // One of `rccd_start_policy`.
    uint32_t start_policy;
    // One of `rccd_contact_normals`.
    uint32_t contact_normals;
    // A flag that stops queries, or null. Solvers share it: it may be freed.
    const struct rccd_stop *stop;
} rccd_settings;

// A path of a robot: either configurations one after the other, between which all joints move at constant rates, or a curve.
// One configuration is a robot at rest, two are an edge.
typedef struct rccd_path {
    // The positions of the robot's free joints, for each configuration; null for a curve.
    const double *configurations;
    // The number of configurations.
    size_t configuration_count;
    // The curve, or null.
    const struct rccd_joint_curve *curve;
} rccd_path;

// A feature of a body, by the numbers of the mesh, from 0.
typedef struct rccd_feature {
    // What the indices mean.
    rccd_feature_kind kind;
    // The vertex, face or piece; the first vertex of an edge.
    uint32_t first;
    // The second vertex of an edge; 0 for others.
    uint32_t second;
} rccd_feature;

// An answer about a path. Numbers that the outcome does not have are NaN, and names are null.
typedef struct rccd_path_answer {
    // The size of this struct in the caller's header; set it before the call.
    size_t size;
    // What was found: free, a contact, the least distance, or unresolved.
    rccd_outcome outcome;
    // The limit that has ended the search.
    rccd_limit limit;
    // The number of the segment of the contact, or of the least distance found; the first segment is 0. For a free path it
    // is the last one, and for an unresolved one it is that until whose `share` the path is free.
    size_t segment;
    // The share of that segment that is passed, from 0 to 1. Nothing touches before a first contact.
    double share;
    // A lower bound of the distance: at the contact, or on the whole path.
    double lower;
    // An upper bound of it.
    double upper;
    // The link, held body or obstacle that touches or is nearest; it belongs to the solver.
    struct rccd_text item_a;
    // The other one.
    struct rccd_text item_b;
    // The point of the first one that is nearest to the other, in the frame of the robot's base.
    double witness_a[3];
    // The point of the other one that is nearest to the first.
    double witness_b[3];
    // What of the first one's mesh is in contact.
    struct rccd_feature feature_a;
    // What of the other one's mesh is in contact.
    struct rccd_feature feature_b;
    // The tolerance that the answer meets: that of the settings, unless the rounding of positions allows only a larger one.
    double tolerance;
} rccd_path_answer;

// A motion at constant velocities: the centre of rotation moves straight, and the body turns about it.
typedef struct rccd_motion {
    // The pose at time 0.
    struct rccd_pose start;
    // The velocity of the centre of rotation.
    double velocity[3];
    // The angular velocity in the world, in radians per unit of time.
    double spin[3];
    // The centre of rotation, in the body's frame.
    double centre[3];
} rccd_motion;

// A body and what moves it: a motion or a trajectory. With neither the body rests at the origin.
typedef struct rccd_moving_body {
    // The body.
    const struct rccd_body *body;
    // Its motion, or null.
    const struct rccd_motion *motion;
    // Its trajectory, or null.
    const struct rccd_trajectory *trajectory;
} rccd_moving_body;

// An answer. Numbers that the outcome does not have are NaN.
typedef struct rccd_answer {
    // The size of this struct in the caller's header; set it before the call.
    size_t size;
    // What the query has found.
    rccd_outcome outcome;
    // The limit that has ended it, also if what was found until then is enough for the outcome.
    rccd_limit limit;
    // The time of the contact, or of the least distance found.
    double time;
    // The time of the last contact of an interval.
    double last_time;
    // The time until which nothing touches: the duration for free bodies, the time of a first contact, or what was proven
    // before a limit.
    double safe_until;
    // A lower bound of the distance that was asked for; for contacts, of the distance at all times.
    double lower;
    // An upper bound of that distance; infinite if none is known.
    double upper;
    // The unit normal from the first body to the second at the contact or at the least distance, in the world.
    double normal[3];
    // The point of the first body that is nearest to the second one.
    double witness_a[3];
    // The point of the second body that is nearest to the first one.
    double witness_b[3];
    // What of the first body is in contact.
    struct rccd_feature feature_a;
    // What of the second body is in contact.
    struct rccd_feature feature_b;
    // The distance beyond the margin within which a contact is reported; for distances, their accuracy.
    double tolerance;
    // The work that the query took, in the unit of the budget.
    uint64_t work;
} rccd_answer;

// How a body turns while its origin follows a curve: orientations, each at its time, in ascending order, and between two of
// them the shortest rotation at a constant rate.
typedef struct rccd_turns {
    // The times.
    const double *times;
    // For each time a quaternion in the order x, y, z, w.
    const double *orientations;
    // The number of times.
    size_t count;
} rccd_turns;

#ifdef __cplusplus
extern "C" {
#endif // __cplusplus

// Makes a ball around the origin.
//
// # Safety
// `out` is null, or points to a place for a handle.
rccd_status rccd_body_sphere(double radius, struct rccd_body **out);

// Makes a capsule along z: the points within `radius` of the segment from `−half_length` to `half_length`.
//
// # Safety
// `out` is null, or points to a place for a handle.
rccd_status rccd_body_capsule(double radius, double half_length, struct rccd_body **out);

// Makes a box around the origin, from half of its length along x, y and z.
//
// # Safety
// `out` is null, or points to a place for a handle.
rccd_status rccd_body_box(double half_x, double half_y, double half_z, struct rccd_body **out);

// Makes a cylinder along z, as a polytope about it. Queries account for what the polytope exceeds.
//
// # Safety
// `out` is null, or points to a place for a handle.
rccd_status rccd_body_cylinder(double radius, double half_length, struct rccd_body **out);

// Makes a cone along z, as a polytope about it, with its base at `−half_length` and its apex at `half_length`. Queries
// account for what the polytope exceeds.
//
// # Safety
// `out` is null, or points to a place for a handle.
rccd_status rccd_body_cone(double radius,
                           double half_length,
                           struct rccd_body **out);

// Makes a body of triangles. `vertices` has three numbers for each vertex, `triangles` three indices of vertices for each
// triangle; `detail` is one of `rccd_detail`. A mesh that is not closed is a surface: see `rccd_body_is_solid`.
//
// # Safety
// `vertices` is null or points to `3 · vertex_count` numbers, `triangles` is null or points to `3 · triangle_count` indices,
// and `out` is null or points to a place for a handle.
rccd_status rccd_body_from_triangles(const double *vertices,
                                     size_t vertex_count,
                                     const uint32_t *triangles,
                                     size_t triangle_count,
                                     uint32_t detail,
                                     struct rccd_body **out);

// Prepares a body of triangles, and stores it in a file, by convention `NAME.ccd`. `rccd_body_load` reads it without the work
// of the preparation, and gives the same answers. The arguments are those of `rccd_body_from_triangles`.
//
// # Safety
// Those of `rccd_body_from_triangles`; `path` is null or a text that ends with a zero.
rccd_status rccd_body_prepare(const double *vertices,
                              size_t vertex_count,
                              const uint32_t *triangles,
                              size_t triangle_count,
                              uint32_t detail,
                              const char *path);

// Loads a body from a file: OBJ, STL, PLY, OFF, glTF, GLB, DAE, or one that `rccd_body_prepare` or `ccd decompose` has stored.
//
// # Safety
// `path` is null or a text that ends with a zero, and `out` is null or points to a place for a handle.
rccd_status rccd_body_load(const char *path,
                           struct rccd_body **out);

// Frees a body; null is nothing.
//
// # Safety
// The handle is null, or comes from this library, is not in use, and has not been freed.
void rccd_body_free(struct rccd_body *body);

// Stores the number of convex pieces of a body.
//
// # Safety
// `body` is null or a handle; `out` is null or points to a place for a number.
rccd_status rccd_body_piece_count(const struct rccd_body *body, size_t *out);

// Stores whether a body is solid, 1, or a surface, 0. What is inside a surface does not touch it. A mesh is solid if it is closed
// and its triangles are turned the same way.
//
// # Safety
// `body` is null or a handle; `out` is null or points to a place for a number.
rccd_status rccd_body_is_solid(const struct rccd_body *body,
                               int32_t *out);

// Stores by how much a body exceeds the shape that it was made of, at most: cylinders, cones and outer hulls do.
//
// # Safety
// `body` is null or a handle; `out` is null or points to a place for a number.
rccd_status rccd_body_excess(const struct rccd_body *body,
                             double *out);

// Loads the robot of a URDF or MJCF file, with its meshes, as a cell without obstacles. All pairs of links are checked but
// neighbours, links that never move relative to each other, and those that an SRDF file disables; null stands for no such
// file. `package_folder` is searched first for `package://` names; null stands for none. Meshes are taken as they are; MuJoCo takes
// their convex hulls, so that it finds contacts in hollows that are free here.
//
// # Safety
// Each text is null or ends with a zero; `out` is null or points to a place for a handle.
rccd_status rccd_cell_load(const char *robot,
                           const char *srdf,
                           const char *package_folder,
                           struct rccd_cell **out);

// Makes a cell of the text of a URDF or MJCF, such as ROS's parameter `robot_description`. `folder` is where meshes with relative
// names are; null stands for the working folder. The other arguments are those of `rccd_cell_load`.
//
// # Safety
// Each text is null or ends with a zero; `out` is null or points to a place for a handle.
rccd_status rccd_cell_from_text(const char *robot,
                                const char *folder,
                                const char *srdf,
                                const char *package_folder,
                                struct rccd_cell **out);

// Frees a cell; null is nothing. Its solvers go on to answer.
//
// # Safety
// The handle is null, or comes from this library, is not in use, and has not been freed.
void rccd_cell_free(struct rccd_cell *cell);

// Stores the number of free joints, which is the number of positions of a configuration.
//
// # Safety
// `cell` is null or a handle; `out` is null or points to a place for a number.
rccd_status rccd_cell_joint_count(const struct rccd_cell *cell, size_t *out);

// Stores the name and the limits of a free joint, by its number in configurations. Joints without limits have infinite ones.
// The name is valid until the cell is freed.
//
// # Safety
// `cell` is null or a handle; `name`, `lower` and `upper` are null or point to places for their values.
rccd_status rccd_cell_joint(const struct rccd_cell *cell,
                            size_t number,
                            struct rccd_text *name,
                            double *lower,
                            double *upper);

// Adds an obstacle at a pose in the frame of the robot's base. The cell shares the body, which may be freed.
//
// # Safety
// `cell` is null or a handle that no other call uses; `name` is null or a text that ends with a zero; `body` is null or a
// handle; `pose` is null or points to a pose.
rccd_status rccd_cell_add_obstacle(struct rccd_cell *cell,
                                   const char *name,
                                   const struct rccd_body *body,
                                   const struct rccd_pose *pose);

// Moves an obstacle to a pose in the frame of the robot's base.
//
// # Safety
// `cell` is null or a handle that no other call uses; `name` is null or a text that ends with a zero; `pose` is null or points
// to a pose.
rccd_status rccd_cell_move_obstacle(struct rccd_cell *cell,
                                    const char *name,
                                    const struct rccd_pose *pose);

// Removes an obstacle.
//
// # Safety
// `cell` is null or a handle that no other call uses; `name` is null or a text that ends with a zero.
rccd_status rccd_cell_remove_obstacle(struct rccd_cell *cell, const char *name);

// Attaches a body to a link, such as an object that a gripper holds, at a pose in the link's frame. It may touch that link,
// links that no joint moves against it, and the links, held bodies and obstacles that are named.
//
// # Safety
// `cell` is null or a handle that no other call uses; `name` and `link` are null or texts that end with a zero; `body` is null
// or a handle; `pose` is null or points to a pose; `may_touch` is null or points to `may_touch_count` such texts.
rccd_status rccd_cell_attach(struct rccd_cell *cell,
                             const char *name,
                             const struct rccd_body *body,
                             const char *link,
                             const struct rccd_pose *pose,
                             const char *const *may_touch,
                             size_t may_touch_count);

// Removes a body that is attached to a link.
//
// # Safety
// `cell` is null or a handle that no other call uses; `name` is null or a text that ends with a zero.
rccd_status rccd_cell_detach(struct rccd_cell *cell, const char *name);

// Allows two items to touch, also if they have a clearance: two links, or a link, a held body and an obstacle. What is removed
// takes this away, and so do `rccd_cell_forbid_contact` and `rccd_cell_set_clearance`.
//
// # Safety
// `cell` is null or a handle that no other call uses; `a` and `b` are null or texts that end with a zero.
rccd_status rccd_cell_allow_contact(struct rccd_cell *cell,
                                    const char *a,
                                    const char *b);

// Compares two items again that were allowed to touch, or two links that were not checked.
//
// # Safety
// That of `rccd_cell_allow_contact`.
rccd_status rccd_cell_forbid_contact(struct rccd_cell *cell, const char *a, const char *b);

// Stores what of the cell is checked, as lines of text: counts, then all remarks on the cell. A line that begins with `warning: `
// says that something is probably a mistake, such as a size in another unit or an SRDF of another robot, or that most of the robot
// is not checked. The other lines say what is not checked and why. The text is valid until the next such call for the cell, or
// until the cell is freed.
//
// # Safety
// `cell` is null or a handle that no other call uses; `out` is null or points to a place for a text.
rccd_status rccd_cell_check_summary(struct rccd_cell *cell,
                                    struct rccd_text *out);

// Sets how much farther than the margin obstacles have to stay from a link; 0 takes it back.
//
// # Safety
// `cell` is null or a handle that no other call uses; `link` is null or a text that ends with a zero.
rccd_status rccd_cell_set_padding(struct rccd_cell *cell, const char *link, double distance);

// Sets the distance at which two links, held bodies or obstacles count as touching, instead of margin and paddings. Two links
// that were not checked are checked from now on, and so are two items that were allowed to touch.
//
// # Safety
// `cell` is null or a handle that no other call uses; `a` and `b` are null or texts that end with a zero.
rccd_status rccd_cell_set_clearance(struct rccd_cell *cell,
                                    const char *a,
                                    const char *b,
                                    double distance);

// Makes a solver for a cell with these settings; null stands for the default ones. The margin is the distance at which bodies
// count as touching, and a deadline is for a whole question. A cell of which no pair is compared is an error: links that a joint
// connects are not, unless `rccd_cell_set_clearance` names them. Normals of contacts play no role.
//
// With the start policy `RCCD_START_POLICY_LEAVE` pairs in contact at the start may part or slide, but not come nearer, in questions
// about the first or any contact; that about the closest approach is an error.
//
// # Safety
// `cell` is null or a handle; `settings` is null or points to settings, whose flag is null or a handle; `out` is null or points
// to a place for a handle.
rccd_status rccd_cell_solver_new(const struct rccd_cell *cell,
                                 const struct rccd_settings *settings,
                                 struct rccd_cell_solver **out);

// Changes the settings of the questions that follow; null stands for the default ones.
//
// # Safety
// `solver` is null or a handle that no other call uses; `settings` is null or points to settings, whose flag is null or a handle.
rccd_status rccd_cell_solver_set_settings(struct rccd_cell_solver *solver,
                                          const struct rccd_settings *settings);

// Frees a solver; null is nothing.
//
// # Safety
// The handle is null, or comes from this library, is not in use, and has not been freed.
void rccd_cell_solver_free(struct rccd_cell_solver *solver);

// Finds the first contact on a path. Nothing touches before it; if a limit is reached, nothing touches before the point of the
// answer.
//
// # Safety
// `solver` is null or a handle that no other call uses; `path` is null or points to a path, whose configurations are null or
// point to as many numbers as the robot has free joints for each configuration, and whose curve is null or a handle; `answer`
// is null or points to an answer whose `size` is set.
rccd_status rccd_cell_first_contact(struct rccd_cell_solver *solver,
                                    const struct rccd_path *path,
                                    struct rccd_path_answer *answer);

// Finds some contact on a path, perhaps not the first one, or proves that there is none: what a planner asks about an edge. If
// a limit is reached, nothing is known of the path.
//
// # Safety
// That of `rccd_cell_first_contact`.
rccd_status rccd_cell_any_contact(struct rccd_cell_solver *solver,
                                  const struct rccd_path *path,
                                  struct rccd_path_answer *answer);

// Brackets how near any pair comes to touching on a path, to within the tolerance. Margin, paddings and clearances play no
// role.
//
// # Safety
// That of `rccd_cell_first_contact`.
rccd_status rccd_cell_closest_approach(struct rccd_cell_solver *solver,
                                       const struct rccd_path *path,
                                       struct rccd_path_answer *answer);

// Writes a record of an answer to `rccd_cell_first_contact` to a file, as JSON: the path and the settings in full, digests of
// all bodies of the cell, the answer. `ccd replay` asks the same again, without the deadline, and says whether the answer holds.
// The cell is to be as it was when the solver was made. Null stands for the default settings.
//
// # Safety
// `cell` is null or a handle; `settings` is null or points to settings, whose flag is null or a handle; `path` is as in
// `rccd_cell_first_contact`; `answer` is null or points to an answer of it, whose solver lives; `file` is null or a text that
// ends with a zero.
rccd_status rccd_evidence_write(const struct rccd_cell *cell,
                                const struct rccd_settings *settings,
                                const struct rccd_path *path,
                                const struct rccd_path_answer *answer,
                                const char *file);

// Makes a curve through configurations, each at its time, in ascending order: cubic polynomials with the given velocities
// there, or quintic ones if accelerations are given, too. Null stands for no accelerations.
//
// # Safety
// `times` is null or points to `count` numbers; `positions`, `velocities` and `accelerations` are null or point to
// `count · joint_count` numbers, those of a configuration one after the other; `out` is null or points to a place for a handle.
rccd_status rccd_joint_curve_through(const double *times,
                                     const double *positions,
                                     const double *velocities,
                                     const double *accelerations,
                                     size_t count,
                                     size_t joint_count,
                                     struct rccd_joint_curve **out);

// Makes a curve from polynomials of the time since each segment's start, of a degree of at most 9: for each segment, and for
// each joint within it, `degree + 1` coefficients, that of the lowest power first. `times` are the ends of all segments, one
// more than segments.
//
// # Safety
// `times` is null or points to `segment_count + 1` numbers; `coefficients` is null or points to
// `segment_count · joint_count · (degree + 1)` numbers; `out` is null or points to a place for a handle.
rccd_status rccd_joint_curve_from_polynomials(const double *times,
                                              const double *coefficients,
                                              size_t segment_count,
                                              size_t joint_count,
                                              size_t degree,
                                              struct rccd_joint_curve **out);

// Frees a curve; null is nothing.
//
// # Safety
// The handle is null, or comes from this library, is not in use, and has not been freed.
void rccd_joint_curve_free(struct rccd_joint_curve *curve);

// Returns the motion of a body that rests at the origin, to be changed before use.
struct rccd_motion rccd_motion_at_rest(void);

// Computes the motion from one pose at time 0 to another at time `duration`, by the shortest rotation about `centre`, a
// point in the body's frame that moves straight. Null stands for the body's origin.
//
// # Safety
// `start` and `end` are null or point to poses, `centre` is null or points to three numbers, and `out` is null or points
// to a place for a motion.
rccd_status rccd_motion_between(const struct rccd_pose *start,
                                const struct rccd_pose *end,
                                const double *centre,
                                double duration,
                                struct rccd_motion *out);

// Fills settings, whose `size` is set, with the default ones: tolerance 0.001, margin 0, contacts at the start reported, a
// budget of 4,194,304, no deadline.
//
// # Safety
// `settings` is null or points to a place of the size that its first field says.
rccd_status rccd_settings_default(struct rccd_settings *settings);

// Makes a solver with these settings; null stands for the default ones.
//
// # Safety
// `settings` is null or points to settings, whose flag is null or a handle; `out` is null or points to a place for a handle.
rccd_status rccd_solver_new(const struct rccd_settings *settings,
                            struct rccd_solver **out);

// Changes the settings of the queries that follow; null stands for the default ones.
//
// # Safety
// `solver` is null or a handle that no other call uses; `settings` is null or points to settings, whose flag is null or a handle.
rccd_status rccd_solver_set_settings(struct rccd_solver *solver,
                                     const struct rccd_settings *settings);

// Frees a solver; null is nothing.
//
// # Safety
// The handle is null, or comes from this library, is not in use, and has not been freed.
void rccd_solver_free(struct rccd_solver *solver);

// Finds the first contact of two moving bodies, from time 0 to `duration`. Nothing touches before it.
//
// # Safety
// `solver` is null or a handle that no other call uses; `a` and `b` are null or point to moving bodies whose pointers are
// null or point to values of their types; `answer` is null or points to an answer whose `size` is set.
rccd_status rccd_first_contact(struct rccd_solver *solver,
                               const struct rccd_moving_body *a,
                               const struct rccd_moving_body *b,
                               double duration,
                               struct rccd_answer *answer);

// Finds some contact of two moving bodies, perhaps not the first one, or proves that there is none. For bodies that touch
// it costs less than the first contact.
//
// # Safety
// That of `rccd_first_contact`.
rccd_status rccd_any_contact(struct rccd_solver *solver,
                             const struct rccd_moving_body *a,
                             const struct rccd_moving_body *b,
                             double duration,
                             struct rccd_answer *answer);

// Finds when two moving bodies first and last touch. They do not touch before the first time nor after the last.
//
// # Safety
// That of `rccd_first_contact`.
rccd_status rccd_contact_interval(struct rccd_solver *solver,
                                  const struct rccd_moving_body *a,
                                  const struct rccd_moving_body *b,
                                  double duration,
                                  struct rccd_answer *answer);

// Brackets the least distance of two moving bodies to within the tolerance. With a duration of 0 it is the distance at the
// start.
//
// # Safety
// That of `rccd_first_contact`.
rccd_status rccd_closest_approach(struct rccd_solver *solver,
                                  const struct rccd_moving_body *a,
                                  const struct rccd_moving_body *b,
                                  double duration,
                                  struct rccd_answer *answer);

// Decides whether two moving bodies keep a distance: the outcome is free if they do, and a contact, at a time at which they are
// nearer, if they do not. If the bounds of the distance are too far apart to decide, it is the least distance. Bodies that may
// touch keep no distance, not even 0.
//
// # Safety
// That of `rccd_first_contact`.
rccd_status rccd_keeps_clearance(struct rccd_solver *solver,
                                 const struct rccd_moving_body *a,
                                 const struct rccd_moving_body *b,
                                 double duration,
                                 double clearance,
                                 struct rccd_answer *answer);

// Returns the version of the library, such as `0.1.0`.
const char *rccd_version(void);

// Returns the message of the last call of this thread that has not worked, in UTF-8; it is empty before. The text is valid
// until the next call of this thread that does not work: ask for it after the call, in a statement of its own.
const char *rccd_last_error(void);

// Makes a flag, which is not set.
//
// # Safety
// `out` is null, or points to a place for a handle.
rccd_status rccd_stop_new(struct rccd_stop **out);

// Sets the flag: queries end as unresolved, and further ones do, until it is cleared. A question that takes no search is still answered.
//
// # Safety
// `stop` is null or a handle.
rccd_status rccd_stop_set(const struct rccd_stop *stop);

// Clears the flag.
//
// # Safety
// `stop` is null or a handle.
rccd_status rccd_stop_clear(const struct rccd_stop *stop);

// Frees a flag; null is nothing. Solvers whose settings name it keep it as it is.
//
// # Safety
// The handle is null, or comes from this library, is not in use, and has not been freed.
void rccd_stop_free(struct rccd_stop *stop);

// Makes a path through poses, each at its time, in ascending order. Between two poses the body's origin moves straight,
// and the body takes the shortest rotation. It rests before the first pose and after the last one.
//
// # Safety
// `times` and `poses` are null or point to `count` values; `out` is null or points to a place for a handle.
rccd_status rccd_trajectory_through_poses(const double *times,
                                          const struct rccd_pose *poses,
                                          size_t count,
                                          struct rccd_trajectory **out);

// Makes the trajectory of a thrown body: a motion whose centre accelerates, in free fall for instance.
//
// # Safety
// `thrown` is null or points to a motion, `acceleration` is null or points to three numbers, and `out` is null or points to
// a place for a handle.
rccd_status rccd_trajectory_thrown(const struct rccd_motion *thrown,
                                   const double *acceleration,
                                   struct rccd_trajectory **out);

// Makes the trajectory of a body whose origin follows a Bézier curve of any degree from time 0 to `duration`. `points` are the
// control points, three numbers each. With null for `turns` the body does not turn.
//
// # Safety
// `points` is null or points to `3 · count` numbers; `turns` is null or points to turns, whose times and orientations are null
// or point to as many numbers as their count says; `out` is null or points to a place for a handle.
rccd_status rccd_trajectory_bezier(const double *points,
                                   size_t count,
                                   double duration,
                                   const struct rccd_turns *turns,
                                   struct rccd_trajectory **out);

// Makes the trajectory of a body whose origin follows a uniform cubic B-spline from time 0 to `duration`. `points` are at least
// four control points, three numbers each: the curve begins near the second one and ends near the last but one. With null for
// `turns` the body does not turn.
//
// # Safety
// That of `rccd_trajectory_bezier`.
rccd_status rccd_trajectory_b_spline(const double *points,
                                     size_t count,
                                     double duration,
                                     const struct rccd_turns *turns,
                                     struct rccd_trajectory **out);

// Frees a trajectory; null is nothing.
//
// # Safety
// The handle is null, or comes from this library, is not in use, and has not been freed.
void rccd_trajectory_free(struct rccd_trajectory *trajectory);

#ifdef __cplusplus
}  // extern "C"
#endif  // __cplusplus

#endif  /* RIGID_CCD_H */
