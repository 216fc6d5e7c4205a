//! Parses the descriptions of bodies on a command line.

pub(crate) mod error;
mod mesh_source;

use crate::file::has_stored_body_extension;
use crate::load::error::{AdjustedStoredBody, BodyError};
use crate::load::load_stored_body;
use crate::load::mesh_source::MeshSource;
use crate::mesh::adjustments::Adjustments;
use crate::mesh::mesh_file::source_paths;
use crate::mesh::unit::Unit;
use crate::prepare::PieceChoice;
use crate::prepare::model::PreparedBody;
use ccd_core::glam::DVec3;
use ccd_core::limits::MAX_COORDINATE;
use ccd_core::{Body, SolidOfRevolution};
use error::SourceError;
use std::path::PathBuf;
use std::str::FromStr;

/// The description of a body: a shape, or a file. All lengths are from 0 to [`MAX_COORDINATE`], in the
/// scene's unit of length.
///
/// ```
/// use ccd_decomp::BodySource;
/// assert_eq!("sphere:0.5".parse(), Ok(BodySource::Sphere { radius: 0.5 }));
/// assert_eq!("part.ccd".parse(), Ok(BodySource::StoredBody("part.ccd".into())));
/// let lid = "scene.glb#lid@mm".parse()?;
/// assert_eq!("scene.glb#lid@mm".parse(), Ok(BodySource::Mesh(lid)));
/// let error = "ball:0.5".parse::<BodySource>().unwrap_err();
/// assert!(error.to_string().contains("sphere:0.5"));
/// # Ok::<(), ccd_decomp::UnknownAdjustment>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub enum BodySource {
    /// A box around the origin, `box:hx,hy,hz`; see [`Body::cuboid`].
    Box {
        /// The half length of each side.
        half_extents: DVec3,
    },
    /// A sphere around the origin, `sphere:r`; see [`Body::sphere`].
    Sphere {
        /// The radius of the sphere.
        radius: f64,
    },
    /// A capsule along z, `capsule:r,h`; see [`Body::capsule`].
    Capsule {
        /// The radius of the capsule.
        radius: f64,
        /// The half length of the segment along z that the capsule surrounds.
        half_height: f64,
    },
    /// A cylinder along z, `cylinder:r,h` or `cylinder:r,h,excess`; see [`Body::cylinder`] and [`SolidOfRevolution::enclosing_polytope`].
    Cylinder {
        /// The radius of the cylinder.
        radius: f64,
        /// The half length of the cylinder along z.
        half_height: f64,
        /// The maximum excess of the cylinder's polytope; `None` for the [usual](SolidOfRevolution::default_excess)
        /// excess.
        max_excess: Option<f64>,
    },
    /// A cone along z, `cone:r,h` or `cone:r,h,excess`; see [`Body::cone`] and [`SolidOfRevolution::enclosing_polytope`].
    Cone {
        /// The radius of the cone's base.
        radius: f64,
        /// The half length of the cone along z; the apex is up.
        half_height: f64,
        /// The maximum excess of the cone's polytope; `None` for the [usual](SolidOfRevolution::default_excess) excess.
        excess: Option<f64>,
    },
    /// A [stored](crate::StoredBodyContent::save) body, by the path of a file that ends in `.ccd`.
    StoredBody(PathBuf),
    /// A mesh file or a part of a mesh file, with adjustments: any text that describes no other kind of body. All parts
    /// of a file are one body.
    Mesh(MeshSource),
}

impl BodySource {
    /// Creates the body that the source describes. The choice applies to meshes only. Shapes are single pieces, and a
    /// stored body keeps its pieces.
    ///
    /// # Errors
    /// [`BodyError::Mesh`] and [`BodyError::UnloadableStoredBody`] if the file cannot be read, [`BodyError::FileContent`] if its content
    /// cannot be made into a body, [`BodyError::InvalidShape`] if a length is out of range.
    pub fn load(&self, choice: PieceChoice) -> Result<PreparedBody, BodyError> {
        self.load_adjusted(&Adjustments::NONE, choice)
    }

    /// Creates the body like [`BodySource::load`], with coordinates in the given unit. The coordinates of a mesh file
    /// that states its unit are [converted](crate::MeshFile::converted_to_unit); all other lengths, including those of shapes and
    /// stored bodies, are assumed to be in that unit.
    ///
    /// # Errors
    /// Those of [`BodySource::load`].
    pub fn load_in_unit(&self, unit: Unit, choice: PieceChoice) -> Result<PreparedBody, BodyError> {
        self.load_adjusted(&Adjustments::NONE.with_target_unit(unit), choice)
    }

    /// Creates the body like [`BodySource::load`], with adjustments to mesh files in addition to those of the
    /// description. Shapes do not change.
    ///
    /// # Errors
    /// Those of [`BodySource::load`]; [`BodyError::AdjustedStoredBody`] for a stored body, unless only the unit is given.
    pub fn load_adjusted(
        &self,
        adjustments: &Adjustments,
        choice: PieceChoice,
    ) -> Result<PreparedBody, BodyError> {
        let prepared = match *self {
            BodySource::Box { half_extents } => {
                PreparedBody::from_primitive(Body::cuboid(half_extents)?)
            }
            BodySource::Sphere { radius } => PreparedBody::from_primitive(Body::sphere(radius)?),
            BodySource::Capsule {
                radius,
                half_height,
            } => PreparedBody::from_primitive(Body::capsule(radius, half_height)?),
            BodySource::Cylinder {
                radius,
                half_height,
                max_excess: excess,
            } => PreparedBody::from_solid_of_revolution(
                &SolidOfRevolution::cylinder(radius, half_height)?,
                excess,
            )?,
            BodySource::Cone {
                radius,
                half_height,
                excess,
            } => PreparedBody::from_solid_of_revolution(
                &SolidOfRevolution::cone(radius, half_height)?,
                excess,
            )?,
            BodySource::StoredBody(ref file) => return load_stored_body(file, adjustments),
            BodySource::Mesh(ref source) => {
                let adjustments = source.adjustments.combined_with(adjustments)?;
                let source = MeshSource {
                    adjustments,
                    ..source.clone()
                };
                return source.load(choice);
            }
        };
        let unit = adjustments.target_unit;
        Ok(PreparedBody { unit, ..prepared })
    }

    /// Returns the paths of all files that the body is read from, including buffer files of a glTF.
    ///
    /// # Errors
    /// [`BodyError::Mesh`] if a glTF cannot be read.
    pub fn file_paths(&self) -> Result<Vec<PathBuf>, BodyError> {
        Ok(match self {
            BodySource::StoredBody(path) => vec![path.clone()],
            BodySource::Mesh(source) => source_paths(&source.file)?,
            _ => Vec::new(),
        })
    }
}

impl FromStr for BodySource {
    type Err = SourceError;

    fn from_str(text: &str) -> Result<Self, SourceError> {
        let text = text.trim();
        if text.is_empty() {
            return Err(SourceError::Empty);
        }
        let (shape, given) = match text.split_once(':') {
            Some((shape, given)) => (shape, given.split(',').map(str::trim).collect()),
            None => (text, Vec::new()),
        };
        if let Some(&(shape, expected)) = SHAPE_LENGTH_COUNTS
            .iter()
            .find(|(known, _)| *known == shape)
        {
            return parse_shape(shape, expected, &given);
        }
        match text.split_once(':') {
            // A single letter is a drive letter.
            Some((shape, _)) if shape.len() > 1 && shape.chars().all(char::is_alphanumeric) => {
                Err(SourceError::UnknownShape {
                    shape: shape.into(),
                })
            }
            _ => {
                let source: MeshSource = text.parse()?;
                if !has_stored_body_extension(&source.file) || source.part.is_some() {
                    Ok(BodySource::Mesh(source))
                } else if source.adjustments == Adjustments::NONE {
                    Ok(BodySource::StoredBody(source.file))
                } else {
                    Err(AdjustedStoredBody { file: source.file }.into())
                }
            }
        }
    }
}

/// The names of the shapes, with the number of lengths that each takes.
const SHAPE_LENGTH_COUNTS: [(&str, usize); 5] = [
    ("box", 3),
    ("sphere", 1),
    ("capsule", 2),
    ("cylinder", 2),
    ("cone", 2),
];

/// Parses the lengths of a shape, such as `1,2,3` of `box:1,2,3`, and returns the shape. A cylinder and a cone may have
/// one more length, the excess.
fn parse_shape(
    shape: &'static str,
    expected: usize,
    words: &[&str],
) -> Result<BodySource, SourceError> {
    let given = words.len();
    let is_round = ["cylinder", "cone"].contains(&shape);
    if given != expected && !(is_round && given == expected + 1) {
        return Err(SourceError::WrongLengthCount {
            shape,
            expected_count: expected,
            given_count: given,
        });
    }
    let lengths = words.iter().map(|word| parse_length(shape, word));
    let lengths: Vec<f64> = lengths.collect::<Result<_, _>>()?;
    let (radius, excess) = (lengths[0], lengths.get(2).copied());
    Ok(match shape {
        "box" => BodySource::Box {
            half_extents: DVec3::from_slice(&lengths),
        },
        "sphere" => BodySource::Sphere { radius },
        "capsule" => BodySource::Capsule {
            radius,
            half_height: lengths[1],
        },
        "cylinder" => BodySource::Cylinder {
            radius,
            half_height: lengths[1],
            max_excess: excess,
        },
        _ => BodySource::Cone {
            radius,
            half_height: lengths[1],
            excess,
        },
    })
}

fn parse_length(shape: &'static str, word: &str) -> Result<f64, SourceError> {
    let length = word.to_owned();
    match word.parse::<f64>() {
        Ok(value) if (0.0..=MAX_COORDINATE).contains(&value) => Ok(value),
        Ok(value) if value > MAX_COORDINATE && value.is_finite() => {
            Err(SourceError::LengthTooLarge { shape, length })
        }
        _ => Err(SourceError::BadLength { shape, length }),
    }
}

#[cfg(test)]
mod tests;
