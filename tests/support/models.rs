//! Generates shapes: triangle meshes, and their convex parts if known.

mod boxes;
mod catalog;
mod cells;
mod lumps;
mod round;
mod thread;
mod voxels;

pub use boxes::{
    comb, cuboid, frame_plate, l_prism, mace, needles, post, rod, slit_plate, square_plate, u_hook,
    wall_at,
};
pub use catalog::{Model, convex_solids, flat_faced_solids, solids};
use ccd_core::order::greater;
pub use cells::{
    divided_cube, divided_l_prism, gear, interlocking_combs, perforated_plate, slotted_plate,
    terrain,
};
pub use lumps::{blob, boulder, dented_cube, disjoint_solids, hollow};
pub use round::{icosphere, inradius, torus, torus_knot};
pub use thread::{PITCH, nut_thread, screw};
pub use voxels::pile;

use ccd_core::glam::{DQuat, DVec3};
use ccd_core::{Body, Facet, FacetOrigin, InputError, Pieces, Polytope, Solidity};
use ccd_decomp::{PatchOrder, PieceChoice, TriangleMesh, build_hull_tree, prepare};

/// A triangle mesh, the common input of the referee and of the engine.
#[derive(Clone, Debug, PartialEq)]
pub struct Mesh {
    /// The vertices in the body's frame.
    pub vertices: Vec<DVec3>,
    /// The faces, counter-clockwise seen from outside if there is an outside.
    pub faces: Vec<[u32; 3]>,
}

/// A shape in every form that the engine accepts.
#[derive(Clone, Debug)]
pub struct Shape {
    /// The triangle mesh of the shape's surface.
    pub mesh: Mesh,
    /// Convex parts whose union has the mesh as its surface; empty if none are known.
    pub parts: Vec<Polytope>,
    /// Whether the mesh bounds a solid.
    pub volume: Solidity,
}

/// The kind of pieces of which a body is made.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PieceKind {
    /// Makes one piece of each triangle.
    Triangles,
    /// Makes one piece of each known convex part.
    ConvexParts,
    /// Makes one piece of each convex patch of the surface.
    Patches,
    /// Makes one piece of the whole shape, its convex hull.
    Hull,
}

impl PieceKind {
    /// All kinds of pieces.
    pub const ALL: [PieceKind; 4] = [
        PieceKind::Triangles,
        PieceKind::ConvexParts,
        PieceKind::Patches,
        PieceKind::Hull,
    ];

    /// Returns true if pieces of this kind may extend into the interior of the mesh.
    pub fn may_fill_interior(self) -> bool {
        self != PieceKind::Triangles
    }
}

impl Shape {
    /// Creates the solid of a closed mesh without known parts.
    pub fn from_closed_mesh(mesh: Mesh) -> Self {
        Shape {
            mesh,
            parts: Vec::new(),
            volume: Solidity::Solid,
        }
    }

    /// Creates the shape of a mesh that encloses no solid.
    pub fn from_open_mesh(mesh: Mesh) -> Self {
        Shape {
            volume: Solidity::Surface,
            ..Shape::from_closed_mesh(mesh)
        }
    }

    /// Creates the solid of a closed convex mesh, with the whole solid as its only part.
    pub fn from_convex_mesh(mesh: Mesh) -> Self {
        let facets = mesh.faces.iter().enumerate();
        let part = Polytope {
            points: mesh.vertices.clone(),
            facets: facets
                .map(|(id, face)| Facet {
                    origin: FacetOrigin::Face(id as u32),
                    corners: face.to_vec(),
                })
                .collect(),
            ..Polytope::default()
        };
        Shape {
            parts: vec![part],
            ..Shape::from_closed_mesh(mesh)
        }
    }

    /// Returns several shapes as one shape, a surface. Vertices and faces are numbered consecutively.
    pub fn union(shapes: impl IntoIterator<Item = Shape>) -> Self {
        let mut out = Shape::from_open_mesh(Mesh {
            vertices: Vec::new(),
            faces: Vec::new(),
        });
        let mut all_parts = true;
        for shape in shapes {
            let (vertex, face) = (out.mesh.vertices.len(), out.mesh.faces.len());
            all_parts &= !shape.parts.is_empty();
            out.parts.extend(shape.parts.into_iter().map(|mut part| {
                part.vertex_ids = (0..part.points.len() as u32)
                    .map(|k| k + vertex as u32)
                    .collect();
                part.faces.iter_mut().for_each(|it| it.id += face as u32);
                for facet in &mut part.facets {
                    if let FacetOrigin::Face(id) = &mut facet.origin {
                        *id += face as u32;
                    }
                }
                part
            }));
            out.mesh.append(&shape.mesh);
        }
        if !all_parts {
            out.parts.clear();
        }
        out
    }

    /// Rotates the shape, then translates it, within the body's frame.
    pub fn placed(mut self, rotation: DQuat, offset: DVec3) -> Self {
        self.map_points(|p| rotation * p + offset);
        self
    }

    /// Translates the shape within the body's frame.
    pub fn moved(self, offset: DVec3) -> Self {
        self.placed(DQuat::IDENTITY, offset)
    }

    /// Multiplies every coordinate by a positive factor.
    pub fn scaled(mut self, factor: f64) -> Self {
        self.map_points(|p| factor * p);
        self
    }

    /// Multiplies each coordinate by a positive factor for its axis.
    pub fn stretched(mut self, factors: DVec3) -> Self {
        self.map_points(|p| factors * p);
        self
    }

    /// Returns true if the shape is a solid.
    pub fn is_solid(&self) -> bool {
        self.volume == Solidity::Solid
    }

    /// Returns true if the shape is known to be convex.
    pub fn is_convex(&self) -> bool {
        matches!(&self.parts[..], [part] if part.radius == 0.0) && self.is_solid()
    }

    /// Returns the kinds of pieces that the shape can be made of.
    pub fn piece_kinds(&self) -> impl Iterator<Item = PieceKind> {
        PieceKind::ALL.into_iter().filter(|kind| match kind {
            PieceKind::Triangles => !self.mesh.faces.is_empty(),
            PieceKind::ConvexParts => !self.parts.is_empty(),
            PieceKind::Patches => self.is_solid() && !self.mesh.faces.is_empty(),
            PieceKind::Hull => self.is_convex() && !self.mesh.faces.is_empty(),
        })
    }

    /// Returns true if the shape can be made of a kind of pieces.
    pub fn can_be_made_of(&self, kind: PieceKind) -> bool {
        self.piece_kinds().any(|known| known == kind)
    }

    /// Builds the engine's body of the shape. A body of parts is a surface, because its parts are filled anyway.
    ///
    /// # Panics
    /// If the shape cannot be built of these pieces.
    pub fn body(&self, kind: PieceKind) -> Body {
        match kind {
            PieceKind::Triangles => expect_body(self.mesh.pieces(), self.volume),
            PieceKind::ConvexParts => {
                let body = expect_body(Pieces::from_polytopes(&self.parts), Solidity::Surface);
                let tree = build_hull_tree(body.pieces()).expect("a hull tree");
                body.with_hull_tree(tree).expect("its own hull tree")
            }
            PieceKind::Patches => self.prepare_body(PieceChoice::Patches(PatchOrder::Cresting)),
            PieceKind::Hull => self.prepare_body(PieceChoice::Hull),
        }
    }

    fn prepare_body(&self, choice: PieceChoice) -> Body {
        let model = prepare(&self.mesh.to_triangle_mesh(), choice).expect("a closed mesh");
        let model = model.with_hull_tree().expect("a hull tree");
        model.body().expect("a good body")
    }

    fn map_points<'a>(&'a mut self, map: impl Fn(DVec3) -> DVec3) {
        let of_part = |part: &'a mut Polytope| {
            let corners = part.faces.iter_mut().flat_map(|face| &mut face.corners);
            part.points.iter_mut().chain(corners)
        };
        let parts = self.parts.iter_mut().flat_map(of_part);
        for p in self.mesh.vertices.iter_mut().chain(parts) {
            *p = map(*p);
        }
    }
}

impl Mesh {
    /// Appends the vertices and faces of another mesh, with its vertex numbers shifted.
    pub fn append(&mut self, other: &Mesh) {
        let base = self.vertices.len() as u32;
        self.vertices.extend_from_slice(&other.vertices);
        self.faces
            .extend(other.faces.iter().map(|f| f.map(|v| v + base)));
    }

    /// Returns the corner points of a face.
    pub fn triangle(&self, face: usize) -> [DVec3; 3] {
        self.faces[face].map(|v| self.vertices[v as usize])
    }

    /// Returns the largest distance of a vertex from a point.
    pub fn radius_about(&self, center: DVec3) -> f64 {
        self.vertices
            .iter()
            .map(|v| v.distance(center))
            .fold(0.0, greater)
    }

    /// Returns the enclosed volume, which is negative if faces are oriented inward.
    pub fn signed_volume(&self) -> f64 {
        let of_face = |face| {
            let [a, b, c] = self.triangle(face);
            a.dot(b.cross(c)) / 6.0
        };
        (0..self.faces.len()).map(of_face).sum()
    }

    /// Returns the mesh with every face reversed.
    pub fn with_reversed_faces(mut self) -> Self {
        self.faces.iter_mut().for_each(|f| f.swap(1, 2));
        self
    }

    /// Converts the mesh to the type that `ccd_decomp` reads.
    ///
    /// # Panics
    /// If the mesh has no faces, or a coordinate that is not finite.
    pub fn to_triangle_mesh(&self) -> TriangleMesh {
        TriangleMesh::new(self.vertices.clone(), &self.faces).expect("a mesh")
    }

    fn pieces(&self) -> Result<Pieces, InputError> {
        let ids: Vec<u32> = (0..self.faces.len() as u32).collect();
        Pieces::from_triangles(&self.vertices, &self.faces, &ids)
    }
}

fn expect_body(pieces: Result<Pieces, InputError>, volume: Solidity) -> Body {
    Body::new(&pieces.expect("good pieces"), volume).expect("a good body")
}

/// Returns two triangles for each cell of a grid of `rows × columns` vertices, row by row. A closed direction wraps
/// around. Faces are counter-clockwise seen from where rows run to the right and columns upwards.
fn grid_faces(rows: GridExtent, columns: GridExtent) -> Vec<[u32; 3]> {
    let vertex =
        |i: usize, j: usize| ((i % rows.count()) * columns.count() + j % columns.count()) as u32;
    let mut faces = Vec::new();
    for i in 0..rows.cell_count() {
        for j in 0..columns.cell_count() {
            let [a, b, c, d] = [
                vertex(i, j),
                vertex(i + 1, j),
                vertex(i + 1, j + 1),
                vertex(i, j + 1),
            ];
            faces.extend([[a, b, c], [a, c, d]]);
        }
    }
    faces
}

/// The number of vertices of a grid in one direction, which may wrap around.
#[derive(Clone, Copy)]
enum GridExtent {
    Bounded(usize),
    Wrapping(usize),
}

impl GridExtent {
    fn count(self) -> usize {
        let (GridExtent::Bounded(n) | GridExtent::Wrapping(n)) = self;
        n
    }

    fn cell_count(self) -> usize {
        match self {
            GridExtent::Bounded(n) => n.saturating_sub(1),
            GridExtent::Wrapping(n) => n,
        }
    }
}
