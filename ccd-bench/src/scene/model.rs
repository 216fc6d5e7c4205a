//! Makes the meshes of the scenes by code, or reads them from files of the same names.

mod blob;
mod cuboid;
mod grid;
mod ring;
pub(crate) mod sphere;
#[cfg(test)]
mod tests;
mod torus_knot;

pub use blob::Blob;
pub use cuboid::cuboid;
pub(crate) use ring::torus_mesh;
pub use torus_knot::torus_knot;

use crate::names::name_of;
use ccd_decomp::{MeshError, TriangleMesh};
use clap::ValueEnum;
use std::path::Path;

/// A mesh of the scenes `[FAST06 §6.2]`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, ValueEnum)]
pub enum Model {
    /// A torus knot of 216 triangles, few enough to process all pairs.
    Knot216,
    /// A torus knot of 2,880 triangles.
    Knot2880,
    /// A torus knot of 11,520 triangles.
    Knot11520,
    /// A torus knot of 34,560 triangles.
    Knot34560,
    /// A torus of 10,000 triangles.
    Ring,
    /// A thin board of 12 triangles.
    Board,
    /// A stand-in for the Stanford bunny with 69,664 triangles.
    Bunny70k,
    /// A stand-in for the Stanford bunny with 26,000 triangles.
    Bunny26k,
    /// A stand-in for the Santa model with 37,888 triangles.
    Santa,
}

/// The radius of the tube along each torus knot.
const KNOT_TUBE_RADIUS: f64 = 0.16;

impl Model {
    /// Returns the name of the model's file, without the extension.
    pub fn name(self) -> String {
        name_of(&self)
    }

    /// Returns the mesh in the file `NAME.obj` of a directory if that exists, else the one made by code.
    ///
    /// # Errors
    /// If the file exists but is no mesh.
    pub fn load_or_generate(self, directory: Option<&Path>) -> Result<TriangleMesh, MeshError> {
        let file = directory.map(|directory| directory.join(self.name()).with_extension("obj"));
        match file.filter(|file| file.exists()) {
            Some(file) => TriangleMesh::read(file),
            None => self.generate(),
        }
    }

    /// Makes the mesh of the model by code, without reading a file.
    ///
    /// # Errors
    /// None, since every model has a valid size.
    pub fn generate(self) -> Result<TriangleMesh, MeshError> {
        match self {
            Model::Knot216 => torus_knot([27, 4], KNOT_TUBE_RADIUS),
            Model::Knot2880 => torus_knot([120, 12], KNOT_TUBE_RADIUS),
            Model::Knot11520 => torus_knot([240, 24], KNOT_TUBE_RADIUS),
            Model::Knot34560 => torus_knot([480, 36], KNOT_TUBE_RADIUS),
            Model::Ring => torus_mesh([250, 20], 0.8, 0.2),
            Model::Board => cuboid(1.5, 1.5, 0.01),
            Model::Bunny70k => Blob::BUNNY.mesh(34_834),
            Model::Bunny26k => Blob::BUNNY.mesh(13_002),
            Model::Santa => Blob::SANTA.mesh(18_946),
        }
    }
}
