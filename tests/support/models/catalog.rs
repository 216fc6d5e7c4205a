//! Lists the solids for tests of decompositions.

use super::{
    Shape, blob, boulder, cuboid, dented_cube, disjoint_solids, divided_cube, divided_l_prism,
    gear, hollow, icosphere, interlocking_combs, l_prism, perforated_plate, pile, post,
    slotted_plate, terrain, torus, torus_knot,
};
use ccd_core::glam::{DQuat, DVec3};

/// A solid with its name for messages.
pub struct Model {
    /// The name of the solid, for messages.
    pub name: String,
    /// The shape of the solid.
    pub shape: Shape,
}

impl Model {
    fn new(name: &str, shape: Shape) -> Self {
        Model {
            name: name.into(),
            shape,
        }
    }

    /// Returns the solid rotated into general position, where rounding makes coplanar features slightly non-coplanar.
    #[must_use]
    pub fn turned(&self) -> Self {
        let turn = DQuat::from_scaled_axis(DVec3::new(0.3, -0.7, 1.1));
        Model {
            name: format!("{}, turned", self.name),
            shape: self
                .shape
                .clone()
                .placed(turn, DVec3::new(0.123, -4.56, 7.89)),
        }
    }
}

/// Returns non-convex solids of many kinds for tests of decompositions. Most have up to a thousand faces.
pub fn solids() -> Vec<Model> {
    let mut all = flat_faced_solids();
    all.extend(curved_solids());
    all.extend((0..6).map(|seed| {
        let levels = 1 + (seed % 2) as u32;
        let roughness = 0.15 * (1 + seed % 4) as f64;
        let name = format!("boulder {seed}");
        Model::new(&name, boulder(levels, roughness, seed))
    }));
    all.extend((0..3).map(|seed| Model::new(&format!("terrain {seed}"), terrain(8, seed))));
    all
}

/// Returns solids with large regions of coplanar triangles.
pub fn flat_faced_solids() -> Vec<Model> {
    let far = 0.2 * DVec3::X;
    vec![
        Model::new("gear", gear(4)),
        Model::new("L-prism", l_prism()),
        Model::new("fine L-prism", divided_l_prism(6)),
        Model::new("perforated plate", perforated_plate(4, 3)),
        Model::new("slit plate", slotted_plate(1e-3)),
        Model::new("hair's breadth plate", slotted_plate(1e-12)),
        Model::new("combs", interlocking_combs(5)),
        Model::new("pile of cubes", pile(4, 1)),
        Model::new("dented cube", dented_cube(0.5, 0.3)),
        Model::new("deeply dented cube", dented_cube(0.5, 1.0 - 1e-9)),
        Model::new(
            "hollow cube",
            hollow(&cuboid(DVec3::ONE), &cuboid(DVec3::splat(0.5)).moved(far)),
        ),
        Model::new(
            "two cubes",
            disjoint_solids(
                &cuboid(DVec3::ONE),
                &cuboid(DVec3::ONE).moved(2.5 * DVec3::X),
            ),
        ),
    ]
}

fn curved_solids() -> Vec<Model> {
    let ball = |radius| icosphere(radius, 2);
    vec![
        Model::new("torus", torus(1.0, 0.25, 24, 8)),
        Model::new("coarse torus", torus(0.6, 0.25, 4, 3)),
        Model::new("fat torus", torus(1.0, 0.95, 20, 16)),
        Model::new("knot", torus_knot(48, 6)),
        Model::new("blob", blob(3)),
        Model::new("hollow ball", hollow(&ball(1.0), &ball(0.9))),
        Model::new(
            "ball in a cavity",
            disjoint_solids(&hollow(&ball(1.0), &ball(0.8)), &ball(0.7)),
        ),
    ]
}

/// Returns convex solids of several shapes for tests of decompositions.
pub fn convex_solids() -> Vec<Model> {
    vec![
        Model::new("cube", cuboid(DVec3::ONE)),
        Model::new("cuboid", cuboid(DVec3::new(0.01, 1.0, 3.0))),
        Model::new("post", post(1.3, 1.0)),
        Model::new("icosahedron", icosphere(1.0, 0)),
        Model::new("ball", icosphere(1.0, 2)),
        Model::new("fine ball", icosphere(1.0, 3)),
        Model::new("divided cube", divided_cube(5)),
    ]
}
