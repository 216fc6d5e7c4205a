#![doc = include_str!("../README.md")]
#![no_std]
#![forbid(unsafe_code, clippy::float_arithmetic)]

extern crate alloc;

mod body;
mod cover;
mod leaf;
mod number;
mod reader;
mod rotation;
mod sha256;
mod statement;

pub use body::Body;
pub use cover::check;
pub use sha256::sha256;

/// Why a certificate proves nothing. A check that returns none of these has proven the statement in the certificate.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stop {
    /// The certificate, or the mesh, is broken for this reason, at this byte of the file.
    Broken(Fault, usize),
    /// Numbers are beyond the range in which the checker computes; nothing is said.
    Unverifiable(Fault),
}

/// What is wrong with a certificate, or beyond the range of the checker.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Fault {
    /// The file ends too early, goes on after its end, or has a number that means nothing.
    Format,
    /// The digest of a mesh is another one.
    OtherMesh,
    /// A body was read in another unit.
    OtherUnit,
    /// A triangle has a corner that is no vertex.
    NoVertex,
    /// A tree leaves a triangle out, or has one twice.
    Triangles,
    /// A tree has too many levels, or a node without triangles.
    Tree,
    /// A triangle is split, or a time that cannot be.
    Split,
    /// An axis is longer than 1.
    Axis,
    /// A leaf does not keep its parts apart by more than the margin.
    NotApart,
    /// Witnesses are no points of their triangles, or too far from each other.
    Witnesses,
    /// A number is not finite, or too large in the unit of the certificate.
    Number,
    /// The quaternion of a pose is not of unit length.
    Quaternion,
    /// A body turns by more than 256 radians about an axis.
    Turns,
}
