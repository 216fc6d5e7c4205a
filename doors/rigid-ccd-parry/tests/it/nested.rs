//! Tests nested compounds, which parry refuses unless their type is hidden.

use parry3d::bounding_volume::{Aabb, BoundingSphere};
use parry3d::mass_properties::MassProperties;
use parry3d::math::{Pose, Real, Vector};
use parry3d::query::{
    NonlinearRigidMotion, PointProjection, PointQuery, Ray, RayCast, RayIntersection,
};
use parry3d::shape::{Ball, Compound, FeatureId, Shape, ShapeType, SharedShape, TypedShape};
use rigid_ccd_parry::f32::{body, cast_shapes_nonlinear};
use rigid_ccd_parry::{Options, ShapeError};

#[test]
fn parts_of_compounds_may_nest_and_not_without_end() {
    let nested = |depth: usize| {
        let mut shape = SharedShape::ball(1.0);
        for _ in 0..depth {
            let place = Pose::translation(1.0, 0.0, 0.0);
            let inner = Compound::new(vec![(place, shape)]);
            shape = SharedShape::new(CustomCompound(inner));
        }
        shape
    };
    let mut flies = NonlinearRigidMotion::constant_position(Pose::translation(-9.0, 0.0, 0.0));
    flies.linvel = Vector::X;
    let (rests, ball) = (NonlinearRigidMotion::identity(), Ball::new(1.0));
    let hit = cast_shapes_nonlinear(&flies, &*nested(3), &rests, &ball, 0.0, 9.0, true);
    // The ball is at −9 + 3.
    let found = hit.expect("served").expect("they meet").time_of_impact;
    assert!(found <= 4.0 && found > 3.99999, "{found}");
    let options = Options::default();
    assert!(body(&*nested(16), &options).is_ok());
    let mut error = body(&*nested(17), &options).expect_err("refused");
    while let ShapeError::Part { error: inner, .. } = error {
        error = *inner;
    }
    assert_eq!(error, ShapeError::NestedTooDeeply);
}

/// A compound with a hidden type, which parry accepts as a part of another compound.
#[derive(Clone)]
struct CustomCompound(Compound);

impl RayCast for CustomCompound {
    fn cast_local_ray_and_get_normal(
        &self,
        ray: &Ray,
        most: Real,
        solid: bool,
    ) -> Option<RayIntersection> {
        self.0.cast_local_ray_and_get_normal(ray, most, solid)
    }
}

impl PointQuery for CustomCompound {
    fn project_local_point(&self, point: Vector, solid: bool) -> PointProjection {
        self.0.project_local_point(point, solid)
    }

    fn project_local_point_and_get_feature(&self, point: Vector) -> (PointProjection, FeatureId) {
        self.0.project_local_point_and_get_feature(point)
    }
}

impl Shape for CustomCompound {
    fn compute_local_aabb(&self) -> Aabb {
        self.0.compute_local_aabb()
    }

    fn compute_local_bounding_sphere(&self) -> BoundingSphere {
        self.0.compute_local_bounding_sphere()
    }

    fn clone_dyn(&self) -> Box<dyn Shape> {
        Box::new(self.clone())
    }

    fn scale_dyn(&self, scale: Vector, subdivisions: u32) -> Option<Box<dyn Shape>> {
        self.0.scale_dyn(scale, subdivisions)
    }

    fn mass_properties(&self, density: Real) -> MassProperties {
        self.0.mass_properties(density)
    }

    fn shape_type(&self) -> ShapeType {
        ShapeType::Custom
    }

    fn as_typed_shape(&self) -> TypedShape<'_> {
        TypedShape::Compound(&self.0)
    }

    fn ccd_thickness(&self) -> Real {
        self.0.ccd_thickness()
    }

    fn ccd_angular_thickness(&self) -> Real {
        self.0.ccd_angular_thickness()
    }
}
