//! rapier in double precision: its query of a scene, and its own simulation.
//!
//! Both hold body B still, so that a B that moves straight is taken out of A's velocity, and queries in
//! which B turns are not answered.

mod simulated;

pub use simulated::Simulated;

use super::parry::double::shapes::{pose, rigid_motion, tri_mesh, vector};
use super::{PeerError, contact_at};
use crate::contender::{Claim, Contender, Reply};
use crate::motions::Query;
use ccd_core::glam::DVec3;
use ccd_decomp::TriangleMesh;
use rapier3d_f64::parry::query::NonlinearRigidMotion;
use rapier3d_f64::parry::shape::TriMesh;
use rapier3d_f64::prelude::{ColliderBuilder, ColliderHandle, PhysicsWorld, SharedShape};

/// `QueryPipeline::cast_shape_nonlinear` of A's mesh against a scene that holds B's; it tells no steps.
///
/// # Tolerance
/// None is taken. Below the scene's own hierarchy it is [parry's cast](super::parry::double::cast), with
/// the bodies the other way round.
///
/// # Guarantee
/// As parry's: none.
pub struct SceneCast {
    a: TriMesh,
    world: PhysicsWorld,
    b: ColliderHandle,
}

impl SceneCast {
    /// Of two meshes.
    ///
    /// # Errors
    /// When parry takes one for no mesh.
    pub fn new(a: &TriangleMesh, b: &TriangleMesh) -> Result<Self, PeerError> {
        let mut world = PhysicsWorld::new();
        let b = ColliderBuilder::new(SharedShape::new(tri_mesh(b)?)).build();
        Ok(SceneCast {
            a: tri_mesh(a)?,
            b: world.insert_collider(b, None),
            world,
        })
    }

    /// Puts B where it starts.
    fn place(&mut self, query: &Query) {
        let at = pose(&query.b, 0.0);
        if let Some(collider) = self.world.colliders.get_mut(self.b) {
            collider.set_position(at);
            let aabb = collider.compute_aabb();
            let parameters = &self.world.integration_parameters;
            self.world.broad_phase.set_aabb(parameters, self.b, aabb);
        }
    }
}

impl Contender for SceneCast {
    fn answer(&mut self, query: &Query) -> Reply {
        if query.b.spin() != DVec3::ZERO {
            let claim = Claim::Refused;
            return Reply { claim, steps: 0 };
        }
        self.place(query);
        let motion = NonlinearRigidMotion {
            linvel: vector(query.a.velocity() - query.b.velocity()),
            ..rigid_motion(&query.a)
        };
        let pipeline = self.world.query_pipeline();
        let hit = pipeline.cast_shape_nonlinear(&motion, &self.a, 0.0, query.duration, true);
        let claim = match hit {
            Some((_, hit)) => contact_at(hit.time_of_impact, query.duration),
            None => Claim::Free,
        };
        Reply { claim, steps: 0 }
    }
}
