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

// The status of a call.
enum rccd_status
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : int32_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
    // Success. A query that reaches a limit also succeeds: its outcome is unresolved.
    RCCD_STATUS_OK = 0,
    // An argument is null but must not be, or is not a value of its type.
    RCCD_STATUS_INVALID_ARGUMENT = 1,
    // A number, such as a radius or a duration, is out of range.
    RCCD_STATUS_INVALID_INPUT = 2,
    // The mesh or file does not give a body.
    RCCD_STATUS_INVALID_BODY = 3,
    // A defect of this library. Afterwards the objects passed to the call may only be freed.
    RCCD_STATUS_PANIC = 4,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum rccd_status rccd_status;
#else
typedef int32_t rccd_status;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

// The outcome of a query.
enum rccd_outcome
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : int32_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
    // A limit was reached before the query was decided. Nothing touches until `safe_until`. The value is 0, so that an
    // answer of zeros, which no call has filled, is unresolved.
    RCCD_OUTCOME_UNRESOLVED = 0,
    // The bodies stay apart over the whole duration.
    RCCD_OUTCOME_FREE = 1,
    // The bodies are in contact at `time`. In answers about the first contact, nothing touches before.
    RCCD_OUTCOME_CONTACT = 2,
    // The bodies are within margin + tolerance at the start.
    RCCD_OUTCOME_TOUCHING = 3,
    // The bodies overlap at the start.
    RCCD_OUTCOME_OVERLAPPING = 4,
    // The first contact is at `time`, and the last one at `last_time`.
    RCCD_OUTCOME_INTERVAL = 5,
    // The least distance is between `lower` and `upper`. At `time` the distance is at most `upper`.
    RCCD_OUTCOME_LEAST_DISTANCE = 6,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum rccd_outcome rccd_outcome;
#else
typedef int32_t rccd_outcome;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

// The limit that ended a query.
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
    // The oracle could not compute the distance of two pieces.
    RCCD_LIMIT_ORACLE_GAVE_UP = 5,
    // Rounding leaves it undecided whether the bodies overlap at the start.
    RCCD_LIMIT_OVERLAP_UNDECIDED = 6,
    // A limit without a name in this interface.
    RCCD_LIMIT_OTHER = 255,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum rccd_limit rccd_limit;
#else
typedef int32_t rccd_limit;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

// The kind of a feature. It determines the meaning of the indices.
enum rccd_feature_kind
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : uint32_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
    // No feature. Both indices are 0.
    RCCD_FEATURE_KIND_NONE = 0,
    // The vertex `first` of the mesh.
    RCCD_FEATURE_KIND_VERTEX = 1,
    // The edge between the vertices `first` and `second`.
    RCCD_FEATURE_KIND_EDGE = 2,
    // The face `first` of the mesh.
    RCCD_FEATURE_KIND_FACE = 3,
    // The convex piece `first`, for a piece without known facets, or with facets that are not faces of the mesh.
    RCCD_FEATURE_KIND_PIECE = 4,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum rccd_feature_kind rccd_feature_kind;
#else
typedef uint32_t rccd_feature_kind;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

// The convex pieces that represent triangles in arrays.
enum rccd_pieces
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : uint32_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
    // The fewest pieces that represent the mesh exactly: one hull for a convex solid, and otherwise patches or
    // triangles, whichever are faster.
    RCCD_PIECES_AUTO = 0,
    // One piece for each triangle. A closed mesh is solid.
    RCCD_PIECES_TRIANGLES = 1,
    // One piece for each triangle. A closed mesh is hollow.
    RCCD_PIECES_SURFACE = 2,
    // One piece: the convex hull, which encloses any mesh. Bounds in answers account for its excess.
    RCCD_PIECES_OUTER_HULL = 3,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum rccd_pieces rccd_pieces;
#else
typedef uint32_t rccd_pieces;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

// How queries treat bodies that are in contact at the start.
enum rccd_start_policy
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : uint32_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
    // The contact is the answer.
    RCCD_START_POLICY_REPORT = 0,
    // The contact is ignored until the bodies approach. This applies to questions about the first or any contact, of two
    // bodies at constant velocities or on a path in a cell. In other questions about two bodies the contact is the answer.
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
    // If the distance at a contact is only rounding error, the normal is computed from the surfaces around the contact.
    // This may exceed the deadline by some hundred microseconds, and allocates memory.
    RCCD_CONTACT_NORMALS_REFINED = 0,
    // The normal is computed from the two triangles or convex pieces in contact. If they touch, it is mostly rounding
    // error. Use it for queries that must keep a deadline or must not allocate. Questions about paths in a cell always
    // use it.
    RCCD_CONTACT_NORMALS_OF_PIECES = 1,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum rccd_contact_normals rccd_contact_normals;
#else
typedef uint32_t rccd_contact_normals;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

// A body: a rigid shape. Many queries and threads may share it.
typedef struct rccd_body rccd_body;

// A cell (planning scene): a robot among obstacles that are static in the frame of its base. The names of obstacles,
// attached bodies and links are all different. Changing the cell invalidates its solvers: their questions fail from then
// on. Making a new solver takes about 30 µs.
typedef struct rccd_cell rccd_cell;

// A solver for paths in a cell. It reuses memory between questions. Each thread needs a solver of its own. After a change
// of the cell, all questions to the solver fail.
typedef struct rccd_cell_solver rccd_cell_solver;

// A curve in joint space: the path of a robot whose joints follow polynomials in time. Many questions and threads may
// share it.
typedef struct rccd_joint_curve rccd_joint_curve;

// A solver: settings, and memory that is reused between queries. Each thread needs a solver of its own.
typedef struct rccd_solver rccd_solver;

// A flag that stops the queries of all solvers whose settings point to it. Any thread may set or clear it at any time.
typedef struct rccd_stop rccd_stop;

// The trajectory of a body. Many queries and threads may share it.
typedef struct rccd_trajectory rccd_trajectory;

// A text in UTF-8 without a terminating zero. It is owned by a cell or a solver.
typedef struct rccd_text {
    // The first byte; null if there is no text.
    const char *data;
    // The number of bytes.
    size_t length;
} rccd_text;

// The pose of a body in the world.
typedef struct rccd_pose {
    // The position of the body's origin.
    double position[3];
    // The rotation as a quaternion in the order x, y, z, w. It need not be normalised, but must not be zero.
    double rotation[4];
} rccd_pose;

// The settings of queries. Set `size`, call `rccd_settings_default`, then change fields.
typedef struct rccd_settings {
    // The size of this struct in the caller's header. Set it first.
    size_t size;
    // The accuracy of contacts: a contact is reported at a distance of at most margin + tolerance. In the unit of
    // length of the bodies.
    double tolerance;
    // The distance at which bodies count as touching; 0 reports actual contact.
    double margin;
    // The largest number of visits of a query. A visit takes about a microsecond or less, and longer for curves of a
    // high degree. Along a trajectory the budget is for each segment between two poses, or for each polynomial of a
    // curve. In a cell the budget is for each query of two bodies: a question about a path takes at most 8 budgets
    // for each segment, all pairs together, and a closest approach at most 12.
    uint64_t budget;
    // The time in seconds after which a query ends as unresolved, from 0 to 1e19. Infinity is no deadline.
    double deadline;
    // A value of `rccd_start_policy`.
    uint32_t start_policy;
    // A value of `rccd_contact_normals`.
    uint32_t contact_normals;
    // A flag that stops queries, or null. Solvers share its ownership: the caller may free it at any time.
    const struct rccd_stop *stop;
} rccd_settings;

// A path of a robot: either a sequence of configurations or a curve. Between configurations all joints move at constant
// rates. One configuration is a static robot, two are an edge.
typedef struct rccd_path {
    // For each configuration, the positions of the robot's independent joints; null for a curve.
    const double *configurations;
    // The number of configurations.
    size_t configuration_count;
    // The curve, or null.
    const struct rccd_joint_curve *curve;
} rccd_path;

// A feature of a body. Indices are those of the mesh and start at 0.
typedef struct rccd_feature {
    // The kind of the feature.
    rccd_feature_kind kind;
    // The index of the vertex, face or piece, or of the first vertex of an edge.
    uint32_t first;
    // The index of the second vertex of an edge; 0 for other kinds.
    uint32_t second;
} rccd_feature;

// An answer about a path. Numbers that do not apply to the outcome are NaN, and such names are null.
typedef struct rccd_path_answer {
    // The size of this struct in the caller's header. Set it before the call.
    size_t size;
    // The outcome: free, contact, least distance, or unresolved.
    rccd_outcome outcome;
    // The limit that ended the search.
    rccd_limit limit;
    // The index of the segment, from 0, with the contact or the least distance found. For a free path it is the last
    // segment. An unresolved path is free up to `fraction` of this segment.
    size_t segment;
    // The position within that segment, from 0 at its start to 1 at its end. Nothing touches before a first contact.
    double fraction;
    // A lower bound of the distance at the contact, or of the least distance on the whole path.
    double lower;
    // An upper bound of the same distance.
    double upper;
    // The name of the first item of the pair: a link, attached body or obstacle that touches or is nearest. The solver owns
    // the text.
    struct rccd_text item_a;
    // The name of the second item of the pair.
    struct rccd_text item_b;
    // The point of the first item that is nearest to the second, in the frame of the robot's base.
    double witness_a[3];
    // The point of the second item that is nearest to the first, in the same frame.
    double witness_b[3];
    // The feature of the first item that is in contact.
    struct rccd_feature feature_a;
    // The feature of the second item that is in contact.
    struct rccd_feature feature_b;
    // The tolerance of the answer. It is the tolerance of the settings, or larger if rounding of positions requires it.
    double tolerance;
} rccd_path_answer;

// A motion at constant velocities: the center of rotation moves on a straight line, and the body rotates about it.
typedef struct rccd_motion {
    // The pose at time 0.
    struct rccd_pose start;
    // The velocity of the center of rotation.
    double velocity[3];
    // The angular velocity in the world, in radians per unit of time.
    double angular_velocity[3];
    // The center of rotation, in the body's frame.
    double center[3];
} rccd_motion;

// A body with a motion or a trajectory. With neither, the body is static at the origin.
typedef struct rccd_moving_body {
    // The body.
    const struct rccd_body *body;
    // Its motion, or null.
    const struct rccd_motion *motion;
    // Its trajectory, or null.
    const struct rccd_trajectory *trajectory;
} rccd_moving_body;

// An answer. Numbers that do not apply to the outcome are NaN.
typedef struct rccd_answer {
    // The size of this struct in the caller's header. Set it before the call.
    size_t size;
    // The outcome of the query.
    rccd_outcome outcome;
    // The limit that ended the query, even if the outcome was already certain.
    rccd_limit limit;
    // The time of the contact, or the time at which the least distance was found.
    double time;
    // The time of the last contact of an interval.
    double last_time;
    // The time until which nothing touches: the duration if the bodies stay apart, the time of a first contact, or the
    // time that was proven before a limit.
    double safe_until;
    // A lower bound of the requested distance. For questions about contacts it holds at all times.
    double lower;
    // An upper bound of the same distance; infinity if none is known.
    double upper;
    // The unit normal from the first body to the second, in world coordinates, at the contact or at the least distance.
    double normal[3];
    // The point of the first body that is nearest to the second one.
    double witness_a[3];
    // The point of the second body that is nearest to the first one.
    double witness_b[3];
    // The feature of the first body that is in contact.
    struct rccd_feature feature_a;
    // The feature of the second body that is in contact.
    struct rccd_feature feature_b;
    // For contacts, the largest distance beyond the margin at which one is reported. For distances, their accuracy.
    double tolerance;
    // The number of visits that the query took, in the unit of the budget.
    uint64_t work;
} rccd_answer;

// The rotation of a body whose origin follows a curve: rotations at ascending times. Between two rotations the
// body takes the shortest rotation at a constant rate.
typedef struct rccd_rotations {
    // The times.
    const double *times;
    // A quaternion for each time, in the order x, y, z, w.
    const double *rotations;
    // The number of times.
    size_t count;
} rccd_rotations;

#ifdef __cplusplus
extern "C" {
#endif // __cplusplus

// Makes a ball around the origin.
//
// # Safety
// `out` is null, or points to memory for a handle.
rccd_status rccd_body_sphere(double radius, struct rccd_body **out);

// Makes a capsule along z: the points within `radius` of the segment from `−half_height` to `half_height`.
//
// # Safety
// `out` is null, or points to memory for a handle.
rccd_status rccd_body_capsule(double radius, double half_height, struct rccd_body **out);

// Makes a box around the origin. The arguments are half extents along x, y and z.
//
// # Safety
// `out` is null, or points to memory for a handle.
rccd_status rccd_body_box(double half_x, double half_y, double half_z, struct rccd_body **out);

// Makes a cylinder along z. It is represented by a polytope that encloses it. Bounds in answers account for its excess.
//
// # Safety
// `out` is null, or points to memory for a handle.
rccd_status rccd_body_cylinder(double radius,
                               double half_height,
                               struct rccd_body **out);

// Makes a cone along z, with its base at `−half_height` and its apex at `half_height`. It is represented by a polytope
// that encloses it. Bounds in answers account for its excess.
//
// # Safety
// `out` is null, or points to memory for a handle.
rccd_status rccd_body_cone(double radius,
                           double half_height,
                           struct rccd_body **out);

// Makes a body of triangles. `vertices` has three coordinates for each vertex, and `triangles` three vertex indices for
// each triangle. `pieces` is one of `rccd_pieces`. A mesh that is not closed is a surface: see `rccd_body_is_solid`.
//
// # Safety
// `vertices` is null or points to `3 · vertex_count` numbers, `triangles` is null or points to `3 · triangle_count`
// indices, and `out` is null or points to memory for a handle.
rccd_status rccd_body_from_triangles(const double *vertices,
                                     size_t vertex_count,
                                     const uint32_t *triangles,
                                     size_t triangle_count,
                                     uint32_t pieces,
                                     struct rccd_body **out);

// Prepares a body of triangles, and stores it in a file, by convention `NAME.ccd`. `rccd_body_load` reads the file
// without repeating the preparation. The loaded body gives the same answers. The arguments are those of
// `rccd_body_from_triangles`.
//
// # Safety
// As for `rccd_body_from_triangles`; `path` is null or a text that ends with a zero.
rccd_status rccd_body_prepare(const double *vertices,
                              size_t vertex_count,
                              const uint32_t *triangles,
                              size_t triangle_count,
                              uint32_t pieces,
                              const char *path);

// Loads a body from a file: OBJ, STL, PLY, OFF, glTF, GLB, DAE, or a file written by `rccd_body_prepare` or `ccd
// decompose`.
//
// # Safety
// `path` is null or a text that ends with a zero, and `out` is null or points to memory for a handle.
rccd_status rccd_body_load(const char *path,
                           struct rccd_body **out);

// Frees a body. Does nothing for null.
//
// # Safety
// The handle is null, or comes from this library, is not in use, and has not been freed.
void rccd_body_free(struct rccd_body *body);

// Stores the number of convex pieces of a body.
//
// # Safety
// `body` is null or a handle; `out` is null or points to memory for a number.
rccd_status rccd_body_piece_count(const struct rccd_body *body, size_t *out);

// Stores 1 if a body is solid, and 0 if it is a surface. A body inside a surface does not touch it. A mesh is solid if
// it is closed and its triangles are consistently oriented.
//
// # Safety
// `body` is null or a handle; `out` is null or points to memory for a number.
rccd_status rccd_body_is_solid(const struct rccd_body *body,
                               int32_t *out);

// Stores an upper bound of how far a body extends beyond the shape that it represents. The bound is 0 except for
// cylinders, cones and outer hulls.
//
// # Safety
// `body` is null or a handle; `out` is null or points to memory for a number.
rccd_status rccd_body_excess(const struct rccd_body *body,
                             double *out);

// Loads the robot of a URDF or MJCF file, with its meshes, as a cell without obstacles. All pairs of links are checked
// except neighbours, links that never move relative to each other, and pairs that the SRDF file disables. `srdf` may be
// null. `package_folder` is the folder searched first for `package://` names; it may be null. Meshes are exact.
// MuJoCo uses their convex hulls instead, so it finds contacts in concavities that are free here.
//
// # Safety
// Each text is null or ends with a zero; `out` is null or points to memory for a handle.
rccd_status rccd_cell_load(const char *robot,
                           const char *srdf,
                           const char *package_folder,
                           struct rccd_cell **out);

// Makes a cell from the text of a URDF or MJCF, such as ROS's parameter `robot_description`. Relative paths of meshes
// are resolved in `folder`, or in the working directory if it is null. The other arguments are as for `rccd_cell_load`.
//
// # Safety
// Each text is null or ends with a zero; `out` is null or points to memory for a handle.
rccd_status rccd_cell_from_text(const char *robot,
                                const char *folder,
                                const char *srdf,
                                const char *package_folder,
                                struct rccd_cell **out);

// Frees a cell. Its solvers stay usable. Does nothing for null.
//
// # Safety
// The handle is null, or comes from this library, is not in use, and has not been freed.
void rccd_cell_free(struct rccd_cell *cell);

// Stores the number of independent joints. A configuration has one position for each of them.
//
// # Safety
// `cell` is null or a handle; `out` is null or points to memory for a number.
rccd_status rccd_cell_joint_count(const struct rccd_cell *cell, size_t *out);

// Stores the name and the limits of an independent joint. `number` is its index in configurations. Limits are infinite for
// joints without limits. The name is valid until the cell is freed.
//
// # Safety
// `cell` is null or a handle; `name`, `lower` and `upper` are null or point to memory for their values.
rccd_status rccd_cell_joint(const struct rccd_cell *cell,
                            size_t number,
                            struct rccd_text *name,
                            double *lower,
                            double *upper);

// Adds an obstacle at a pose in the frame of the robot's base. The cell shares ownership of the body: the caller may
// free it.
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

// Attaches a body to a link, such as an object that a gripper holds, at a pose in the link's frame. The body may touch
// that link, links that are rigidly attached to it, and the items named in `may_touch`: links, attached bodies and
// obstacles.
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

// Detaches a body from its link, and removes it.
//
// # Safety
// `cell` is null or a handle that no other call uses; `name` is null or a text that ends with a zero.
rccd_status rccd_cell_detach(struct rccd_cell *cell, const char *name);

// Allows two items to touch, even if they have a clearance. An item is a link, an attached body or an obstacle. The
// permission lasts until one of them is removed, or until `rccd_cell_forbid_contact` or `rccd_cell_set_clearance` is
// called for them.
//
// # Safety
// `cell` is null or a handle that no other call uses; `a` and `b` are null or texts that end with a zero.
rccd_status rccd_cell_allow_contact(struct rccd_cell *cell,
                                    const char *a,
                                    const char *b);

// Revokes the permission of two items to touch. For two links that are not checked, adds them to the checked pairs.
//
// # Safety
// As for `rccd_cell_allow_contact`.
rccd_status rccd_cell_forbid_contact(struct rccd_cell *cell,
                                     const char *a,
                                     const char *b);

// Stores a summary of the checked pairs of the cell, as lines of text: counts, then all remarks. A line that begins
// with `warning: ` reports a probable mistake, such as a size in another unit or the SRDF of another robot, or that
// most of the robot is not checked. The other lines list pairs and links that are not checked, with reasons. The text
// is valid until this function is called again for the cell, or until the cell is freed.
//
// # Safety
// `cell` is null or a handle that no other call uses; `out` is null or points to memory for a text.
rccd_status rccd_cell_check_summary(struct rccd_cell *cell,
                                    struct rccd_text *out);

// Sets the padding of a link: the distance, in addition to the margin, that obstacles have to keep from it. 0 removes
// it.
//
// # Safety
// `cell` is null or a handle that no other call uses; `link` is null or a text that ends with a zero.
rccd_status rccd_cell_set_padding(struct rccd_cell *cell,
                                  const char *link,
                                  double distance);

// Sets the distance at which two items count as touching. For this pair it replaces the margin and paddings. An item is
// a link, an attached body or an obstacle. The pair is checked from now on, even if it was not checked or was allowed to
// touch.
//
// # Safety
// `cell` is null or a handle that no other call uses; `a` and `b` are null or texts that end with a zero.
rccd_status rccd_cell_set_clearance(struct rccd_cell *cell,
                                    const char *a,
                                    const char *b,
                                    double distance);

// Makes a solver for a cell. If `settings` is null, it uses the defaults. The margin is the distance at which bodies
// count as touching. The deadline is for a whole question. A cell without a pair to check is an error: links that are
// connected by a joint are not checked, unless `rccd_cell_set_clearance` is called for them. `contact_normals` has no effect.
//
// With the start policy `RCCD_START_POLICY_LEAVE`, pairs in contact at the start may separate or slide, but not come
// nearer. This applies to questions about the first or any contact. `rccd_cell_closest_approach` fails with this policy.
//
// # Safety
// `cell` is null or a handle; `settings` is null or points to settings, whose flag is null or a handle; `out` is null
// or points to memory for a handle.
rccd_status rccd_cell_solver_new(const struct rccd_cell *cell,
                                 const struct rccd_settings *settings,
                                 struct rccd_cell_solver **out);

// Changes the settings of later questions. If `settings` is null, sets the defaults.
//
// # Safety
// `solver` is null or a handle that no other call uses; `settings` is null or points to settings, whose flag is null or a handle.
rccd_status rccd_cell_solver_set_settings(struct rccd_cell_solver *solver,
                                          const struct rccd_settings *settings);

// Frees a solver. Does nothing for null.
//
// # Safety
// The handle is null, or comes from this library, is not in use, and has not been freed.
void rccd_cell_solver_free(struct rccd_cell_solver *solver);

// Finds the first contact on a path. Nothing touches before it. If a limit is reached, nothing touches before the
// segment and fraction in the answer.
//
// # Safety
// `solver` is null or a handle that no other call uses; `path` is null or points to a path, whose configurations are null or
// point to as many numbers as the robot has independent joints for each configuration, and whose curve is null or a handle; `answer`
// is null or points to an answer whose `size` is set.
rccd_status rccd_cell_first_contact(struct rccd_cell_solver *solver,
                                    const struct rccd_path *path,
                                    struct rccd_path_answer *answer);

// Finds some contact on a path, not necessarily the first one, or proves that there is none. Planners ask this about
// edges. If a limit is reached, nothing is known about the path.
//
// # Safety
// As for `rccd_cell_first_contact`.
rccd_status rccd_cell_any_contact(struct rccd_cell_solver *solver,
                                  const struct rccd_path *path,
                                  struct rccd_path_answer *answer);

// Computes bounds of the least distance of all checked pairs on a path, to within the tolerance. The margin, paddings and
// clearances have no effect.
//
// # Safety
// As for `rccd_cell_first_contact`.
rccd_status rccd_cell_closest_approach(struct rccd_cell_solver *solver,
                                       const struct rccd_path *path,
                                       struct rccd_path_answer *answer);

// Writes an answer of `rccd_cell_first_contact` and its question to a JSON file. The file has the path, the settings,
// digests of all bodies of the cell, and the answer. `ccd replay` repeats the question without the deadline, and
// reports whether the answer holds. The cell must be unchanged since the solver was made. If `settings` is null, the
// defaults are written.
//
// # Safety
// `cell` is null or a handle; `settings` is null or points to settings, whose flag is null or a handle; `path` is as
// for `rccd_cell_first_contact`; `answer` is null or points to an answer to it, whose solver is not freed; `file` is
// null or a text that ends with a zero.
rccd_status rccd_evidence_write(const struct rccd_cell *cell,
                                const struct rccd_settings *settings,
                                const struct rccd_path *path,
                                const struct rccd_path_answer *answer,
                                const char *file);

// Makes a curve through configurations at ascending times, with the velocity at each of them. Segments are cubic
// polynomials. If `accelerations` is not null, they are quintic, and also have these accelerations.
//
// # Safety
// `times` is null or points to `count` numbers; `positions`, `velocities` and `accelerations` are null or point to
// `count · joint_count` numbers, configuration by configuration; `out` is null or points to memory for a handle.
rccd_status rccd_joint_curve_through(const double *times,
                                     const double *positions,
                                     const double *velocities,
                                     const double *accelerations,
                                     size_t count,
                                     size_t joint_count,
                                     struct rccd_joint_curve **out);

// Makes a curve from polynomials in the time since each segment's start. The degree is at most 9. `coefficients` has
// `degree + 1` numbers for each joint of each segment, lowest power first. `times` has the start of each segment, then
// the end of the last one.
//
// # Safety
// `times` is null or points to `segment_count + 1` numbers; `coefficients` is null or points to `segment_count ·
// joint_count · (degree + 1)` numbers; `out` is null or points to memory for a handle.
rccd_status rccd_joint_curve_from_polynomials(const double *times,
                                              const double *coefficients,
                                              size_t segment_count,
                                              size_t joint_count,
                                              size_t degree,
                                              struct rccd_joint_curve **out);

// Frees a curve. Does nothing for null.
//
// # Safety
// The handle is null, or comes from this library, is not in use, and has not been freed.
void rccd_joint_curve_free(struct rccd_joint_curve *curve);

// Returns the motion of a static body at the origin. Change its fields to make the body move.
struct rccd_motion rccd_motion_at_rest(void);

// Computes the motion from one pose at time 0 to another at time `duration`, by the shortest rotation. `center` is the
// point in the body's frame that moves on a straight line; null stands for the body's origin.
//
// # Safety
// `start` and `end` are null or point to poses, `center` is null or points to three numbers, and `out` is null or
// points to memory for a motion.
rccd_status rccd_motion_between(const struct rccd_pose *start,
                                const struct rccd_pose *end,
                                const double *center,
                                double duration,
                                struct rccd_motion *out);

// Fills settings with the defaults: tolerance 0.001, margin 0, contacts at the start reported, budget 4,194,304, no
// deadline. Set `size` before.
//
// # Safety
// `settings` is null or points to memory of the size in its first field.
rccd_status rccd_settings_default(struct rccd_settings *settings);

// Makes a solver. If `settings` is null, it uses the defaults.
//
// # Safety
// `settings` is null or points to settings, whose flag is null or a handle; `out` is null or points to memory for a
// handle.
rccd_status rccd_solver_new(const struct rccd_settings *settings,
                            struct rccd_solver **out);

// Changes the settings of later queries. If `settings` is null, sets the defaults.
//
// # Safety
// `solver` is null or a handle that no other call uses; `settings` is null or points to settings, whose flag is null or a handle.
rccd_status rccd_solver_set_settings(struct rccd_solver *solver,
                                     const struct rccd_settings *settings);

// Frees a solver. Does nothing for null.
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

// Finds some contact of two moving bodies, not necessarily the first one, or proves that there is none. If the bodies
// touch, this takes less work than the first contact.
//
// # Safety
// As for `rccd_first_contact`.
rccd_status rccd_any_contact(struct rccd_solver *solver,
                             const struct rccd_moving_body *a,
                             const struct rccd_moving_body *b,
                             double duration,
                             struct rccd_answer *answer);

// Finds the first and the last contact of two moving bodies. They do not touch before the first contact or after the last
// one.
//
// # Safety
// As for `rccd_first_contact`.
rccd_status rccd_contact_interval(struct rccd_solver *solver,
                                  const struct rccd_moving_body *a,
                                  const struct rccd_moving_body *b,
                                  double duration,
                                  struct rccd_answer *answer);

// Computes bounds of the least distance of two moving bodies, to within the tolerance. With a duration of 0, it is the
// distance at the start.
//
// # Safety
// As for `rccd_first_contact`.
rccd_status rccd_closest_approach(struct rccd_solver *solver,
                                  const struct rccd_moving_body *a,
                                  const struct rccd_moving_body *b,
                                  double duration,
                                  struct rccd_answer *answer);

// Decides whether two moving bodies always keep a distance of at least `clearance`. If they do, the outcome is
// `RCCD_OUTCOME_FREE`. If they do not, it is `RCCD_OUTCOME_CONTACT`, at a time at which they are nearer. If the bounds of
// the distance do not decide, it is `RCCD_OUTCOME_LEAST_DISTANCE`. Bodies that possibly touch do not keep a clearance of
// 0.
//
// # Safety
// As for `rccd_first_contact`.
rccd_status rccd_keeps_clearance(struct rccd_solver *solver,
                                 const struct rccd_moving_body *a,
                                 const struct rccd_moving_body *b,
                                 double duration,
                                 double clearance,
                                 struct rccd_answer *answer);

// Returns the version of the library, such as `0.1.0`.
const char *rccd_version(void);

// Returns the message of this thread's last failed call, in UTF-8; empty if no call has failed. The text is valid until
// this thread's next failed call. Call this in a separate statement after the failed call.
const char *rccd_last_error(void);

// Makes a flag that is not set.
//
// # Safety
// `out` is null, or points to memory for a handle.
rccd_status rccd_stop_new(struct rccd_stop **out);

// Sets the flag. Until it is cleared, running and later queries end as unresolved. Questions that need no search are
// still answered.
//
// # Safety
// `stop` is null or a handle.
rccd_status rccd_stop_set(const struct rccd_stop *stop);

// Clears the flag.
//
// # Safety
// `stop` is null or a handle.
rccd_status rccd_stop_clear(const struct rccd_stop *stop);

// Frees a flag. Solvers that use it keep its last value. Does nothing for null.
//
// # Safety
// The handle is null, or comes from this library, is not in use, and has not been freed.
void rccd_stop_free(struct rccd_stop *stop);

// Makes a trajectory through poses at ascending times. Between two poses the body's origin moves on a straight line,
// and the body takes the shortest rotation. The body is at rest before the first pose and after the last one.
//
// # Safety
// `times` and `poses` are null or point to `count` values; `out` is null or points to memory for a handle.
rccd_status rccd_trajectory_pose_path(const double *times,
                                      const struct rccd_pose *poses,
                                      size_t count,
                                      struct rccd_trajectory **out);

// Makes the trajectory of a body in free fall: `thrown` with a constant acceleration of its center.
//
// # Safety
// `thrown` is null or points to a motion, `acceleration` is null or points to three numbers, and `out` is null or
// points to memory for a handle.
rccd_status rccd_trajectory_ballistic(const struct rccd_motion *thrown,
                                      const double *acceleration,
                                      struct rccd_trajectory **out);

// Makes the trajectory of a body whose origin follows a Bézier curve of any degree from time 0 to `duration`. `points`
// are the control points, three numbers each. If `rotations` is null, the body does not rotate.
//
// # Safety
// `points` is null or points to `3 · count` numbers; `rotations` is null or points to rotations, whose times and
// quaternions are null or point to as many numbers as their count says; `out` is null or points to memory for a handle.
rccd_status rccd_trajectory_bezier(const double *points,
                                   size_t count,
                                   double duration,
                                   const struct rccd_rotations *rotations,
                                   struct rccd_trajectory **out);

// Makes the trajectory of a body whose origin follows a uniform cubic B-spline from time 0 to `duration`. `points` are
// at least four control points, three numbers each. The curve begins near the second point and ends near
// the last but one. If `rotations` is null, the body does not rotate.
//
// # Safety
// As for `rccd_trajectory_bezier`.
rccd_status rccd_trajectory_b_spline(const double *points,
                                     size_t count,
                                     double duration,
                                     const struct rccd_rotations *rotations,
                                     struct rccd_trajectory **out);

// Frees a trajectory. Does nothing for null.
//
// # Safety
// The handle is null, or comes from this library, is not in use, and has not been freed.
void rccd_trajectory_free(struct rccd_trajectory *trajectory);

#ifdef __cplusplus
}  // extern "C"
#endif  // __cplusplus

#endif  /* RIGID_CCD_H */
