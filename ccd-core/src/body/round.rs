//! Cylinders and cones, enclosed in convex polytopes.

use super::facets::fan_triangles;
use super::pieces::Pieces;
use super::polytope::{Facet, FacetOrigin, Polytope};
use super::{Body, Solidity};
use crate::error::{InputError, check, check_shape_length};
use crate::limits::{DEFAULT_RADIUS_EXCESS_SHARE, MAX_CIRCLE_CORNERS, MAX_COORDINATE};
use crate::math::order::{greater, lesser};
use crate::rounding::{LEAST_POSITIVE_F64, POLYGON_ENLARGEMENT};
use glam::DVec3;
use std::f64::consts::{PI, TAU};

/// A cylinder or a cone along z, with its center at the origin.
///
/// A circle is not the hull of finitely many points. The body is therefore a polytope about the shape, an
/// [`EnclosingPolytope`].
///
/// ```
/// use ccd_core::SolidOfRevolution;
/// let wheel = SolidOfRevolution::cylinder(0.5, 0.1)?;
/// let fine = wheel.enclosing_polytope(1e-6)?;
/// assert!(fine.excess() <= 1e-6 && fine.polytope().points.len() > 3000);
/// let coarse = wheel.enclosing_polytope(wheel.default_excess())?;
/// assert_eq!(coarse.polytope().points.len(), 288);
/// # Ok::<(), ccd_core::InputError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SolidOfRevolution {
    kind: SolidKind,
    radius: f64,
    half_height: f64,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum SolidKind {
    Cylinder,
    Cone,
}

/// A convex polytope that encloses a [`SolidOfRevolution`] shape.
///
/// # Guarantee
/// The polytope contains the shape, in exact arithmetic on the stored numbers. None of its points is farther from the
/// shape than the [excess](EnclosingPolytope::excess): contacts may be early by that distance, and are never late. Upper
/// bounds of distances include the excess. The polytope touches the shape in the planes of its flat ends, and along
/// four lines in the planes x = 0 and y = 0.
#[derive(Clone, Debug, PartialEq)]
pub struct EnclosingPolytope {
    enclosing_polytope: Polytope,
    excess: f64,
    is_flat: bool,
}

impl SolidOfRevolution {
    /// Creates a cylinder about the z axis, from `−half_height` to `half_height`.
    ///
    /// # Errors
    /// [`InputError::OutOfRange`] for lengths that are not from 0 to [`MAX_COORDINATE`].
    pub fn cylinder(radius: f64, half_height: f64) -> Result<Self, InputError> {
        SolidOfRevolution::new(SolidKind::Cylinder, radius, half_height)
    }

    /// Creates a cone about the z axis. Its base is at `−half_height` along z, its apex at `half_height`.
    ///
    /// # Errors
    /// [`InputError::OutOfRange`] for lengths that are not from 0 to [`MAX_COORDINATE`].
    pub fn cone(radius: f64, half_height: f64) -> Result<Self, InputError> {
        SolidOfRevolution::new(SolidKind::Cone, radius, half_height)
    }

    fn new(kind: SolidKind, radius: f64, half_height: f64) -> Result<Self, InputError> {
        for (what, value) in [("radius", radius), ("half height", half_height)] {
            check_shape_length(what, value)?;
        }
        Ok(SolidOfRevolution {
            kind,
            radius,
            half_height,
        })
    }

    /// Returns the excess that [`Body::cylinder`] and [`Body::cone`] allow: [`DEFAULT_RADIUS_EXCESS_SHARE`] of the radius.
    pub fn default_excess(&self) -> f64 {
        DEFAULT_RADIUS_EXCESS_SHARE * self.radius
    }

    /// Returns the smallest excess that [`SolidOfRevolution::enclosing_polytope`] accepts: a little less than 1.9e-8 of the
    /// radius. It gives about [`MAX_CIRCLE_CORNERS`] corners.
    pub fn least_excess(&self) -> f64 {
        1.01 * self.radius * (1.0 / (PI / MAX_CIRCLE_CORNERS).cos() - 1.0)
    }

    /// Returns a convex polytope that contains the shape, and exceeds it by at most `excess`.
    ///
    /// # Errors
    /// [`InputError::OutOfRange`] for an excess less than the [least](SolidOfRevolution::least_excess), or a radius whose polytope
    /// reaches beyond [`MAX_COORDINATE`].
    pub fn enclosing_polytope(&self, excess: f64) -> Result<EnclosingPolytope, InputError> {
        let ring = Ring::circumscribe(self.radius, excess)?;
        let z = self.half_height;
        let count = ring.corners.len() as u32;
        let level = |z: f64| ring.corners.iter().map(move |[x, y]| DVec3::new(*x, *y, z));
        let base: Vec<u32> = (0..count).rev().collect();
        let sides = (0..count).map(|k| (k, (k + 1) % count));
        let (points, loops): (Vec<DVec3>, Vec<Vec<u32>>) = match self.kind {
            SolidKind::Cylinder => {
                let top = (count..2 * count).collect();
                let sides = sides.map(|(k, next)| vec![k, next, count + next, count + k]);
                let loops = [base, top].into_iter().chain(sides);
                (level(-z).chain(level(z)).collect(), loops.collect())
            }
            SolidKind::Cone => {
                let sides = sides.map(|(k, next)| vec![k, next, count]);
                let points = level(-z).chain([z * DVec3::Z]);
                (points.collect(), [base].into_iter().chain(sides).collect())
            }
        };
        let facet = |(id, corners)| Facet {
            origin: FacetOrigin::Face(id),
            corners,
        };
        Ok(EnclosingPolytope {
            enclosing_polytope: Polytope {
                points,
                facets: (0..).zip(loops).map(facet).collect(),
                ..Polytope::default()
            },
            excess: ring.excess,
            is_flat: self.radius == 0.0 || z == 0.0,
        })
    }
}

impl EnclosingPolytope {
    /// Returns the polytope that encloses the shape, in the body's frame. Its facets are its exact boundary, and plane:
    /// facets that are not triangles have all corners at one height, or in pairs above each other.
    ///
    /// Facet 0 is the base, and facet 1 the other end of a cylinder. The sides follow, counterclockwise about z.
    pub fn polytope(&self) -> &Polytope {
        &self.enclosing_polytope
    }

    /// Returns an upper bound of the distance of any point of the polytope from the enclosed shape.
    pub fn excess(&self) -> f64 {
        self.excess
    }

    /// Creates a solid body of the polytope, with the [excess](Body::excess) of the enclosure. A body that is not flat
    /// also has [triangles](Body::with_surface_triangles).
    ///
    /// # Errors
    /// The errors of [`Body::polytope`].
    pub fn body(&self) -> Result<Body, InputError> {
        let body = Body::polytope(self.enclosing_polytope.clone())?.with_excess(self.excess)?;
        let (triangles, numbers) = self.triangles();
        if triangles.is_empty() {
            return Ok(body);
        }
        let pieces = Pieces::from_triangles(&self.enclosing_polytope.points, &triangles, &numbers)?;
        body.with_surface_triangles(Body::new(&pieces, Solidity::Solid)?)
    }

    /// Returns the facets as triangles, each with the number of its facet. A flat polytope returns no triangles: they
    /// would have no advantage.
    pub fn triangles(&self) -> (Vec<[u32; 3]>, Vec<u32>) {
        let facets = (0..).zip(&self.enclosing_polytope.facets);
        let fans = facets.flat_map(|(number, Facet { corners, .. })| {
            fan_triangles(corners).map(move |fan| (fan, number))
        });
        if self.is_flat {
            Default::default()
        } else {
            fans.unzip()
        }
    }
}

/// The corners of a regular polygon that encloses a circle, counterclockwise.
///
/// The number of corners is a multiple of four. The middles of edges are on the axes, where the polygon touches the
/// circle.
struct Ring {
    corners: Vec<[f64; 2]>,
    /// An upper bound of the distance of any point of the polygon from the enclosed disc.
    excess: f64,
}

impl Ring {
    fn circumscribe(radius: f64, excess: f64) -> Result<Self, InputError> {
        if radius == 0.0 {
            return Ok(Ring {
                corners: vec![[0.0; 2]; 4],
                excess: 0.0,
            });
        }
        let count = polygon_corners_for_excess(radius, excess)?;
        let step = TAU / count;
        // This is the distance of the corners from the middle; the edges are at distance `radius`.
        let reach = radius / (0.5 * step).cos() * POLYGON_ENLARGEMENT + 4.0 * LEAST_POSITIVE_F64;
        let allowed = "less than 1e12, with the excess";
        check("radius", radius, reach <= MAX_COORDINATE, allowed)?;
        let corner = |k: usize| {
            let (sine, cosine) = ((k as f64 + 0.5) * step).sin_cos();
            [reach * cosine, reach * sine]
        };
        Ok(Ring {
            corners: (0..count as usize).map(corner).collect(),
            excess: greater(0.0, reach * POLYGON_ENLARGEMENT - radius),
        })
    }
}

/// Returns a number of corners such that a regular polygon around a circle exceeds it by at most `asked`.
fn polygon_corners_for_excess(radius: f64, asked: f64) -> Result<f64, InputError> {
    // A corner is at `radius / cos(π/n)`. The share of the excess is clamped to a range in which angles lose no
    // digits. The rounding of the corners is subtracted.
    let share = lesser(asked / radius - 4.0 * (POLYGON_ENLARGEMENT - 1.0), 1.0);
    let half_angle = (share * (2.0 + share)).sqrt().atan();
    let count = 4.0 * greater(1.0, (PI / half_angle / 4.0).ceil());
    let allowed = asked >= 0.0 && share > 0.0 && count <= MAX_CIRCLE_CORNERS;
    check("excess", asked, allowed, "at least 1.9e-8 of the radius")?;
    Ok(count)
}

impl Body {
    /// Creates a cylinder about the origin, from `−half_height` to `half_height` along z. The body is a polytope
    /// about it, which exceeds it by at most [`DEFAULT_RADIUS_EXCESS_SHARE`] of the radius. [`SolidOfRevolution::enclosing_polytope`] returns finer ones.
    ///
    /// # Guarantee
    /// The guarantee of [`EnclosingPolytope`]: contacts may be early by the excess, and are never late.
    ///
    /// # Errors
    /// [`InputError::OutOfRange`].
    ///
    /// ```
    /// use ccd_core::Body;
    /// let wheel = Body::cylinder(0.5, 0.1)?;
    /// assert!(wheel.bounding_radius() > 0.5 && wheel.bounding_radius() < 0.52);
    /// assert!(Body::cylinder(-0.5, 0.1).is_err());
    /// # Ok::<(), ccd_core::InputError>(())
    /// ```
    pub fn cylinder(radius: f64, half_height: f64) -> Result<Self, InputError> {
        SolidOfRevolution::cylinder(radius, half_height)?.default_enclosing_body()
    }

    /// Creates a cone about the origin, with the base at `−half_height` along z, and the apex at `half_height`. The
    /// body is a polytope about it, as that of [`Body::cylinder`].
    ///
    /// # Errors
    /// [`InputError::OutOfRange`].
    pub fn cone(radius: f64, half_height: f64) -> Result<Self, InputError> {
        SolidOfRevolution::cone(radius, half_height)?.default_enclosing_body()
    }
}

impl SolidOfRevolution {
    fn default_enclosing_body(&self) -> Result<Body, InputError> {
        self.enclosing_polytope(self.default_excess())?.body()
    }
}

#[cfg(test)]
mod tests;
