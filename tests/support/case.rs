//! Queries as plain data, for generators, the corpus and messages about failures.

use crate::models::{self, Mesh, Shape};
use crate::query::{MovingShape, Query};
use ccd_core::glam::{DQuat, DVec3};
use ccd_core::{Motion, Pose, Settings, StartPolicy};
use serde::{Deserialize, Serialize};

/// A query with its settings, and the reason why it is tested.
#[derive(Clone, Debug, Deserialize, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Case {
    /// The name of the case, for messages.
    #[serde(default)]
    pub name: String,
    /// The fault that the case revealed, or might reveal.
    #[serde(default)]
    pub why: String,
    /// The end of the time interval, which begins at 0.
    pub duration: f64,
    /// The tolerance of the query, for [`Settings::tolerance`].
    #[serde(default = "default_tolerance")]
    pub tolerance: f64,
    /// The margin of the query, for [`Settings::margin`].
    #[serde(default)]
    pub margin: f64,
    /// The policy for contacts at the start, for [`Settings::start_policy`].
    #[serde(default)]
    pub start: StartPolicyText,
    /// Body A and its motion.
    pub a: MovingModel,
    /// Body B and its motion.
    pub b: MovingModel,
}

/// The text form of a [`StartPolicy`] in a file.
#[derive(Clone, Copy, Debug, Default, Deserialize, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum StartPolicyText {
    /// Stands for [`StartPolicy::Report`].
    #[default]
    Report,
    /// Stands for [`StartPolicy::Leave`].
    Leave,
}

/// A body of a [`Case`], with its motion.
#[derive(Clone, Debug, Deserialize, Serialize)]
#[serde(deny_unknown_fields)]
pub struct MovingModel {
    /// The shape of the body, as a model with its parameters.
    pub shape: Model,
    /// The factor by which every coordinate of the shape is multiplied.
    #[serde(default = "default_scale")]
    pub scale: f64,
    /// The position of the body's origin in the world at the start.
    #[serde(default)]
    pub position: [f64; 3],
    /// The rotation at the start, as a rotation vector in radians.
    #[serde(default)]
    pub turned: [f64; 3],
    /// The velocity of the center of rotation, per unit of time.
    #[serde(default)]
    pub velocity: [f64; 3],
    /// The angular velocity in the world, in radians per unit of time.
    #[serde(default)]
    pub spin: [f64; 3],
    /// The center of rotation, in the body's frame.
    #[serde(default)]
    pub center: [f64; 3],
}

/// A shape, given by the name and the arguments of a function in `models`.
#[derive(Clone, Debug, Deserialize, Serialize)]
#[serde(tag = "model", rename_all = "kebab-case")]
#[allow(missing_docs)] // Named as the functions of `models` and their arguments.
pub enum Model {
    Cuboid {
        half: [f64; 3],
    },
    Ellipsoid {
        radii: [f64; 3],
        levels: u32,
    },
    LPrism,
    UHook,
    Torus {
        major: f64,
        minor: f64,
        rings: usize,
        sides: usize,
    },
    TorusKnot {
        rings: usize,
        sides: usize,
    },
    DentedCube {
        half: f64,
        depth: f64,
    },
    HollowCube {
        half: f64,
        cavity: f64,
    },
    Boulder {
        levels: u32,
        roughness: f64,
        seed: u32,
    },
    Pile {
        size: usize,
        seed: u32,
    },
    Gear {
        spokes: usize,
    },
    Soup {
        triangles: Vec<[[f64; 3]; 3]>,
    },
    Plate {
        cells: usize,
    },
    Needles {
        count: usize,
        width: f64,
    },
}

impl Case {
    /// Returns the query of the case, with its shapes and motions built.
    pub fn query(&self) -> Query {
        Query {
            a: self.a.moving_shape(),
            b: self.b.moving_shape(),
            duration: self.duration,
        }
    }

    /// Returns the settings of the query.
    pub fn config(&self) -> Settings {
        Settings {
            tolerance: self.tolerance,
            margin: self.margin,
            start_policy: match self.start {
                StartPolicyText::Report => StartPolicy::Report,
                StartPolicyText::Leave => StartPolicy::Leave,
            },
            ..Settings::DEFAULT
        }
    }

    /// Formats the case as TOML for the corpus.
    pub fn to_toml(&self) -> String {
        toml::to_string(self).unwrap_or_else(|error| format!("# {error}\n{self:?}"))
    }
}

impl MovingModel {
    /// Returns a body with the given shape, at rest at the origin.
    pub fn new(shape: Model) -> Self {
        MovingModel {
            shape,
            scale: 1.0,
            position: [0.0; 3],
            turned: [0.0; 3],
            velocity: [0.0; 3],
            spin: [0.0; 3],
            center: [0.0; 3],
        }
    }

    fn moving_shape(&self) -> MovingShape {
        let turned = DQuat::from_scaled_axis(self.turned.into());
        let start = Pose::new(self.position, turned).expect("a pose");
        let motion = Motion::about(start, self.velocity, self.spin, self.center);
        MovingShape {
            shape: self.shape.shape().scaled(self.scale),
            motion: motion.expect("finite velocities"),
        }
    }
}

impl Model {
    fn shape(&self) -> Shape {
        match self {
            Model::Cuboid { half } => models::cuboid((*half).into()),
            Model::Ellipsoid { radii, levels } => {
                models::icosphere(1.0, *levels).stretched((*radii).into())
            }
            Model::LPrism => models::l_prism(),
            Model::UHook => models::u_hook(0.2, 0.6, 0.8),
            Model::Torus {
                major,
                minor,
                rings,
                sides,
            } => models::torus(*major, *minor, *rings, *sides),
            Model::TorusKnot { rings, sides } => models::torus_knot(*rings, *sides),
            Model::DentedCube { half, depth } => models::dented_cube(*half, *depth),
            Model::HollowCube { half, cavity } => {
                let cube = |half| models::cuboid(DVec3::splat(half));
                models::hollow(&cube(*half), &cube(*cavity))
            }
            Model::Boulder {
                levels,
                roughness,
                seed,
            } => models::boulder(*levels, *roughness, u64::from(*seed)),
            Model::Pile { size, seed } => {
                let unit = 1.0 / *size as f64;
                models::pile(*size, u64::from(*seed)).scaled(unit)
            }
            Model::Gear { spokes } => models::gear(*spokes),
            Model::Soup { triangles } => Shape::from_open_mesh(soup(triangles)),
            Model::Plate { cells } => models::square_plate(*cells),
            Model::Needles { count, width } => models::needles(*count, *width),
        }
    }
}

fn soup(triangles: &[[[f64; 3]; 3]]) -> Mesh {
    Mesh {
        vertices: triangles
            .iter()
            .flatten()
            .map(|&p| DVec3::from(p))
            .collect(),
        faces: (0..triangles.len() as u32)
            .map(|k| [3 * k, 3 * k + 1, 3 * k + 2])
            .collect(),
    }
}

fn default_tolerance() -> f64 {
    Settings::DEFAULT.tolerance
}

fn default_scale() -> f64 {
    1.0
}
