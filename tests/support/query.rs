//! Queries that both the engine and the referee can answer.

use crate::models::{PieceKind, Shape};
use crate::tolerance::rounding;
use ccd_core::glam::DVec3;
use ccd_core::order::greater;
use ccd_core::{Body, Motion, MovingBody, Pose, Settings};
use std::rc::Rc;

/// A shape and its motion.
#[derive(Clone, Debug)]
pub struct MovingShape {
    /// The shape in the body's frame.
    pub shape: Shape,
    /// The motion of the body in the world.
    pub motion: Motion,
}

/// Two shapes with motions, over a duration.
#[derive(Clone, Debug)]
pub struct Query {
    /// The shape and motion of body A.
    pub a: MovingShape,
    /// The shape and motion of body B.
    pub b: MovingShape,
    /// The end of the time interval, which begins at 0.
    pub duration: f64,
}

/// The engine's bodies for a query.
pub struct Bodies {
    a: Rc<Body>,
    b: Rc<Body>,
    /// The kinds of pieces of bodies A and B.
    pub piece_kinds: [PieceKind; 2],
}

impl Query {
    /// Returns the query of two moving shapes over a duration of 1.
    pub fn new(a: MovingShape, b: MovingShape) -> Self {
        let duration = 1.0;
        Query { a, b, duration }
    }

    /// Returns the query with bodies A and B exchanged.
    pub fn swapped(&self) -> Query {
        Query {
            a: self.b.clone(),
            b: self.a.clone(),
            duration: self.duration,
        }
    }

    /// Returns the query with shapes and motions transformed into another frame.
    pub fn seen_from(&self, frame: &Pose) -> Query {
        Query {
            a: self.a.seen_from(frame),
            b: self.b.seen_from(frame),
            duration: self.duration,
        }
    }

    /// Returns the query with both motions reversed in time.
    pub fn reversed(&self) -> Query {
        Query {
            a: self.a.reversed(self.duration),
            b: self.b.reversed(self.duration),
            duration: self.duration,
        }
    }

    /// Returns a bound on the rounding error of any distance in the query.
    pub fn rounding(&self) -> f64 {
        rounding(self.a.reach(self.duration) + self.b.reach(self.duration))
    }

    /// Returns the bodies for several combinations of kinds of pieces: each kind with itself and with triangles, and
    /// the two kinds with the fewest pieces.
    pub fn bodies_of_kind_pairs(&self) -> Vec<Bodies> {
        let (all_a, all_b) = (self.a.bodies(), self.b.bodies());
        let fewest = [&all_a, &all_b].map(|all| all.last().map(|it| it.0));
        let both = |(ka, a): &(PieceKind, Rc<Body>), (kb, b): &(PieceKind, Rc<Body>)| {
            let kinds = [*ka, *kb];
            let plain = ka == kb || kinds.contains(&PieceKind::Triangles);
            (plain || kinds.map(Some) == fewest).then(|| Bodies {
                a: Rc::clone(a),
                b: Rc::clone(b),
                piece_kinds: kinds,
            })
        };
        let with_a = |a| all_b.iter().filter_map(move |b| both(a, b));
        all_a.iter().flat_map(with_a).collect()
    }

    /// Returns the bodies made of triangles.
    pub fn bodies_of_triangles(&self) -> Bodies {
        self.bodies([PieceKind::Triangles; 2])
    }

    /// Returns the bodies made of given kinds of pieces.
    pub fn bodies(&self, kinds: [PieceKind; 2]) -> Bodies {
        Bodies {
            a: Rc::new(self.a.shape.body(kinds[0])),
            b: Rc::new(self.b.shape.body(kinds[1])),
            piece_kinds: kinds,
        }
    }

    /// Builds the engine's query of given bodies.
    ///
    /// # Panics
    /// If the engine refuses the query.
    pub fn problem<'a>(&self, bodies: &'a Bodies, config: &'a Settings) -> ccd_core::Query<'a> {
        let a = MovingBody::from((bodies.a(), self.a.motion));
        let b = MovingBody::from((bodies.b(), self.b.motion));
        ccd_core::Query::new(a, b, self.duration, config).expect("a well-posed problem")
    }
}

impl Bodies {
    /// Returns the number of pairs of pieces, one piece of each body.
    pub fn piece_pair_count(&self) -> usize {
        self.a.pieces().len() * self.b.pieces().len()
    }

    /// Returns the engine's body A.
    pub fn a(&self) -> &Body {
        &self.a
    }

    /// Returns the engine's body B.
    pub fn b(&self) -> &Body {
        &self.b
    }
}

impl MovingShape {
    /// Returns a shape at rest at a position.
    pub fn still(shape: Shape, at: DVec3) -> Self {
        MovingShape::moving(shape, at, DVec3::ZERO, DVec3::ZERO)
    }

    /// Returns a shape that starts unrotated at a position and moves at a constant velocity, without rotation.
    pub fn translating_shape(shape: Shape, at: DVec3, velocity: DVec3) -> Self {
        MovingShape::moving(shape, at, velocity, DVec3::ZERO)
    }

    /// Returns a shape that starts unrotated at a position and rotates about it.
    pub fn rotating_shape(shape: Shape, at: DVec3, spin: DVec3) -> Self {
        MovingShape::moving(shape, at, DVec3::ZERO, spin)
    }

    /// Returns a shape that starts unrotated at a position, with a velocity and an angular velocity.
    ///
    /// # Panics
    /// If a number is not finite.
    pub fn moving(shape: Shape, at: DVec3, velocity: DVec3, spin: DVec3) -> Self {
        let start = Pose::at(at).expect("a finite position");
        MovingShape {
            shape,
            motion: Motion::new(start, velocity, spin).expect("finite velocities"),
        }
    }

    /// Returns a bound on the coordinates of the shape's points, in proportion to which they are rounded. The radius
    /// counts once more for every radian of rotation.
    pub fn reach(&self, duration: f64) -> f64 {
        let motion = &self.motion;
        let points = self.shape.parts.iter().flat_map(|part| &part.points);
        let radii = self
            .shape
            .parts
            .iter()
            .map(|part| part.radius)
            .fold(0.0, greater);
        let radius = points
            .chain(&self.shape.mesh.vertices)
            .map(|p| p.distance(motion.center()))
            .fold(motion.center().length(), greater);
        let travel = duration * motion.velocity().length();
        let turn = 1.0 + duration * motion.angular_velocity().length();
        motion.start().translation().length() + travel + turn * (radius + radii)
    }

    /// Returns the engine's bodies of the shape, one for every kind of pieces that it can be made of.
    fn bodies(&self) -> Vec<(PieceKind, Rc<Body>)> {
        let built = |kind| (kind, Rc::new(self.shape.body(kind)));
        self.shape.piece_kinds().map(built).collect()
    }

    fn seen_from(&self, frame: &Pose) -> MovingShape {
        let motion = &self.motion;
        let (start, turn) = (motion.start(), frame.rotation());
        let position = frame.transform_point(start.translation());
        let start = Pose::new(position, turn * start.rotation()).expect("a pose");
        MovingShape {
            shape: self.shape.clone(),
            motion: Motion::about(
                start,
                turn * motion.velocity(),
                turn * motion.angular_velocity(),
                motion.center(),
            )
            .expect("finite"),
        }
    }

    fn reversed(&self, duration: f64) -> MovingShape {
        let motion = &self.motion;
        let end = motion.pose(duration);
        MovingShape {
            shape: self.shape.clone(),
            motion: Motion::about(
                end,
                -motion.velocity(),
                -motion.angular_velocity(),
                motion.center(),
            )
            .expect("finite"),
        }
    }
}
