//! Bodies made from shapes, from triangles in arrays, and from files.

use crate::arguments::{array, free, give, reference, store, text};
use crate::status::{Failure, RccdStatus, status_of};
use rigid_ccd::body::Solidity;
use rigid_ccd::mesh::{PieceChoice, TriangleMesh, body_from_mesh, prepare};
use rigid_ccd::{Body, InputError, load};
use std::ffi::c_char;
use std::sync::Arc;

/// A body: a rigid shape. Many queries and threads may share it.
pub struct RccdBody(pub(crate) Arc<Body>);

/// The convex pieces that represent triangles in arrays.
#[repr(u32)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RccdPieces {
    /// The fewest pieces that represent the mesh exactly: one hull for a convex solid, and otherwise patches or
    /// triangles, whichever are faster.
    Auto = 0,
    /// One piece for each triangle. A closed mesh is solid.
    Triangles = 1,
    /// One piece for each triangle. A closed mesh is hollow.
    Surface = 2,
    /// One piece: the convex hull, which encloses any mesh. Bounds in answers account for its excess.
    OuterHull = 3,
}

/// Makes a ball around the origin.
///
/// # Safety
/// `out` is null, or points to memory for a handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn rccd_body_sphere(radius: f64, out: *mut *mut RccdBody) -> RccdStatus {
    // SAFETY: the contract of this function.
    unsafe { give_shape(Body::sphere(radius), out) }
}

/// Makes a capsule along z: the points within `radius` of the segment from `−half_height` to `half_height`.
///
/// # Safety
/// `out` is null, or points to memory for a handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn rccd_body_capsule(
    radius: f64,
    half_height: f64,
    out: *mut *mut RccdBody,
) -> RccdStatus {
    // SAFETY: the contract of this function.
    unsafe { give_shape(Body::capsule(radius, half_height), out) }
}

/// Makes a box around the origin. The arguments are half extents along x, y and z.
///
/// # Safety
/// `out` is null, or points to memory for a handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn rccd_body_box(
    half_x: f64,
    half_y: f64,
    half_z: f64,
    out: *mut *mut RccdBody,
) -> RccdStatus {
    // SAFETY: the contract of this function.
    unsafe { give_shape(Body::cuboid([half_x, half_y, half_z]), out) }
}

/// Makes a cylinder along z. It is represented by a polytope that encloses it. Bounds in answers account for its excess.
///
/// # Safety
/// `out` is null, or points to memory for a handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn rccd_body_cylinder(
    radius: f64,
    half_height: f64,
    out: *mut *mut RccdBody,
) -> RccdStatus {
    // SAFETY: the contract of this function.
    unsafe { give_shape(Body::cylinder(radius, half_height), out) }
}

/// Makes a cone along z, with its base at `−half_height` and its apex at `half_height`. It is represented by a polytope
/// that encloses it. Bounds in answers account for its excess.
///
/// # Safety
/// `out` is null, or points to memory for a handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn rccd_body_cone(
    radius: f64,
    half_height: f64,
    out: *mut *mut RccdBody,
) -> RccdStatus {
    // SAFETY: the contract of this function.
    unsafe { give_shape(Body::cone(radius, half_height), out) }
}

/// Makes a body of triangles. `vertices` has three coordinates for each vertex, and `triangles` three vertex indices for
/// each triangle. `pieces` is one of `rccd_pieces`. A mesh that is not closed is a surface: see `rccd_body_is_solid`.
///
/// # Safety
/// `vertices` is null or points to `3 · vertex_count` numbers, `triangles` is null or points to `3 · triangle_count`
/// indices, and `out` is null or points to memory for a handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn rccd_body_from_triangles(
    vertices: *const f64,
    vertex_count: usize,
    triangles: *const u32,
    triangle_count: usize,
    pieces: u32,
    out: *mut *mut RccdBody,
) -> RccdStatus {
    let counts = [vertex_count, triangle_count];
    status_of(|| {
        let pieces = parse_pieces(pieces)?;
        // SAFETY: the contract of this function.
        let mesh = unsafe { read_mesh(vertices, triangles, counts) }?;
        let body = body_from_mesh(&mesh, pieces).map_err(Failure::body)?.body;
        // SAFETY: the contract of this function.
        unsafe { give(out, RccdBody(Arc::new(body))) }
    })
}

/// Prepares a body of triangles, and stores it in a file, by convention `NAME.ccd`. `rccd_body_load` reads the file
/// without repeating the preparation. The loaded body gives the same answers. The arguments are those of
/// `rccd_body_from_triangles`.
///
/// # Safety
/// As for `rccd_body_from_triangles`; `path` is null or a text that ends with a zero.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn rccd_body_prepare(
    vertices: *const f64,
    vertex_count: usize,
    triangles: *const u32,
    triangle_count: usize,
    pieces: u32,
    path: *const c_char,
) -> RccdStatus {
    let counts = [vertex_count, triangle_count];
    status_of(|| {
        let pieces = parse_pieces(pieces)?;
        // SAFETY: the contract of this function.
        let (path, mesh) =
            unsafe { (text("path", path)?, read_mesh(vertices, triangles, counts)?) };
        let content = prepare(&mesh, pieces).map_err(Failure::body)?;
        content.save(path).map_err(Failure::body)
    })
}

/// Loads a body from a file: OBJ, STL, PLY, OFF, glTF, GLB, DAE, or a file written by `rccd_body_prepare` or `ccd
/// decompose`.
///
/// # Safety
/// `path` is null or a text that ends with a zero, and `out` is null or points to memory for a handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn rccd_body_load(
    path: *const c_char,
    out: *mut *mut RccdBody,
) -> RccdStatus {
    status_of(|| {
        // SAFETY: the contract of this function.
        let path = unsafe { text("path", path) }?;
        let body = load(path).map_err(Failure::body)?;
        // SAFETY: the contract of this function.
        unsafe { give(out, RccdBody(Arc::new(body))) }
    })
}

/// Frees a body. Does nothing for null.
///
/// # Safety
/// The handle is null, or comes from this library, is not in use, and has not been freed.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn rccd_body_free(body: *mut RccdBody) {
    // SAFETY: the contract of this function.
    unsafe { free(body) }
}

/// Stores the number of convex pieces of a body.
///
/// # Safety
/// `body` is null or a handle; `out` is null or points to memory for a number.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn rccd_body_piece_count(
    body: *const RccdBody,
    out: *mut usize,
) -> RccdStatus {
    status_of(|| {
        // SAFETY: the contract of this function.
        let body = unsafe { reference("body", body) }?;
        let count = body.0.pieces().len();
        // SAFETY: the contract of this function.
        unsafe { store("out", out, count) }
    })
}

/// Stores 1 if a body is solid, and 0 if it is a surface. A body inside a surface does not touch it. A mesh is solid if
/// it is closed and its triangles are consistently oriented.
///
/// # Safety
/// `body` is null or a handle; `out` is null or points to memory for a number.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn rccd_body_is_solid(body: *const RccdBody, out: *mut i32) -> RccdStatus {
    status_of(|| {
        // SAFETY: the contract of this function.
        let body = unsafe { reference("body", body) }?;
        let is_solid = i32::from(body.0.solidity() == Solidity::Solid);
        // SAFETY: the contract of this function.
        unsafe { store("out", out, is_solid) }
    })
}

/// Stores an upper bound of how far a body extends beyond the shape that it represents. The bound is 0 except for
/// cylinders, cones and outer hulls.
///
/// # Safety
/// `body` is null or a handle; `out` is null or points to memory for a number.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn rccd_body_excess(body: *const RccdBody, out: *mut f64) -> RccdStatus {
    status_of(|| {
        // SAFETY: the contract of this function.
        let body = unsafe { reference("body", body) }?;
        let excess = body.0.excess();
        // SAFETY: the contract of this function.
        unsafe { store("out", out, excess) }
    })
}

/// # Safety
/// `out` is null, or points to memory for a handle.
unsafe fn give_shape(body: Result<Body, InputError>, out: *mut *mut RccdBody) -> RccdStatus {
    status_of(|| {
        let body = body.map_err(Failure::input)?;
        // SAFETY: the contract of this function.
        unsafe { give(out, RccdBody(Arc::new(body))) }
    })
}

/// # Safety
/// `vertices` is null or points to three numbers for each vertex; `triangles` is null or points to three indices for
/// each triangle.
unsafe fn read_mesh(
    vertices: *const f64,
    triangles: *const u32,
    [vertex_count, triangle_count]: [usize; 2],
) -> Result<TriangleMesh, Failure> {
    // SAFETY: the contract of this function.
    let (vertices, triangles) = unsafe {
        (
            array("vertices", vertices.cast::<[f64; 3]>(), vertex_count)?,
            array("triangles", triangles.cast::<[u32; 3]>(), triangle_count)?,
        )
    };
    TriangleMesh::new(vertices.to_vec(), triangles).map_err(Failure::body)
}

fn parse_pieces(pieces: u32) -> Result<PieceChoice, Failure> {
    match pieces {
        pieces if pieces == RccdPieces::Auto as u32 => Ok(PieceChoice::Auto),
        pieces if pieces == RccdPieces::Triangles as u32 => Ok(PieceChoice::Triangles),
        pieces if pieces == RccdPieces::Surface as u32 => Ok(PieceChoice::Surface),
        pieces if pieces == RccdPieces::OuterHull as u32 => Ok(PieceChoice::OuterHull),
        other => Err(Failure::argument(format!(
            "pieces {other} is none of rccd_pieces"
        ))),
    }
}
