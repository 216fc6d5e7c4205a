//! The search for a contact along an edge.
//!
//! The middle of a stretch comes first: the frames of all links there, and a bound of how far each part moves in half the
//! stretch. A pair whose distance in the middle exceeds that is free over the whole stretch. For the others the stretch
//! is halved. What is still open after a few halvings goes to the engine, pair by pair.

use super::boxes::ObstacleBoxes;
use super::displacement::Displacements;
use super::exact::ExactPairs;
use super::kinematics::Kinematics;
use super::rounding::point_error;
use crate::cell::Cell;
use crate::cell::part::Part;
use crate::tuning::{FAR_DISPLACEMENT, MAX_HALVINGS};
use ccd_core::order::lesser;
use ccd_core::vectorize;
use ccd_distance_gjk::{RequiredBounds, Vertex, bound_distance};
use rigid_ccd::glam::DVec3;
use rigid_ccd::oracle::Frame;
use rigid_ccd::{Error, Settings, Solver};
use std::ops::Range;

/// Memory for searches along edges, which is kept from one to the next.
pub(crate) struct Search<'c> {
    parts: &'c [Part],
    kinematics: &'c Kinematics,
    /// The number of parts of the robot; obstacles follow them.
    robot_parts: usize,
    boxes: ObstacleBoxes,
    /// The pairs of the robot's own parts.
    own_pairs: Vec<Candidate>,
    exact: ExactPairs<'c>,
    displacements: Displacements,
    frames: Vec<Frame>,
    candidates: Vec<Candidate>,
    /// Pairs of bodies that are not convex, whose hulls intersect in the middle of the stretch.
    suspects: Vec<Candidate>,
    /// What the engine is to decide.
    open: Vec<OpenPair>,
    solver: Solver,
    pub(crate) settings: Settings,
    // Of the current edge.
    start: Vec<f64>,
    change: Vec<f64>,
    rates: Vec<f64>,
    rounding: f64,
}

/// A pair of parts that may touch in a stretch.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Candidate {
    pub(crate) a: u32,
    pub(crate) b: u32,
    /// The places of the bounds of both parts' displacements, as seen from the nearest frame above both.
    slots: [Option<u32>; 2],
    /// The direction from A to B along which they were farthest apart so far; zero if there was none.
    axis: DVec3,
    /// The distance in the middle of the last stretch, as a share of what would prove it free.
    share: f64,
}

/// A pair that is open in an interval of an edge.
#[derive(Clone, Copy, Debug)]
struct OpenPair {
    pair: Candidate,
    /// The numbers of both bodies.
    bodies: [usize; 2],
    from: f64,
    to: f64,
}

/// What was found at one time.
enum Found {
    /// A pair is in contact.
    Contact(Candidate),
    /// The candidates from an index on may be in contact in the stretch.
    Undecided(usize),
}

/// A stretch of an edge, in shares of the edge.
#[derive(Clone, Copy, Debug)]
struct Stretch {
    from: f64,
    to: f64,
    halvings: u32,
}

impl Candidate {
    fn new([a, b]: [usize; 2], slots: [Option<u32>; 2]) -> Self {
        Candidate {
            a: a as u32,
            b: b as u32,
            slots,
            axis: DVec3::ZERO,
            share: 0.0,
        }
    }

    /// Returns the numbers of both bodies.
    pub(crate) fn owners(&self, parts: &[Part]) -> [usize; 2] {
        [self.a, self.b].map(|part| parts[part as usize].owner)
    }
}

impl<'c> Search<'c> {
    pub(crate) fn new(cell: &'c Cell) -> Self {
        let (parts, kinematics) = (cell.parts(), cell.kinematics());
        let robot_parts = cell.robot_part_count();
        let displacements = Displacements::new(kinematics, parts);
        let own_pairs = cell.own_pairs().map(|([a, b], frame)| {
            let slots = [a, b].map(|part| displacements.slot(kinematics, part, frame));
            Candidate::new([a, b], slots)
        });
        let own_pairs = own_pairs.collect();
        Search {
            boxes: ObstacleBoxes::new(&parts[robot_parts..]),
            exact: ExactPairs::new(cell),
            parts,
            kinematics,
            robot_parts,
            own_pairs,
            displacements,
            frames: Vec::new(),
            candidates: Vec::new(),
            suspects: Vec::new(),
            open: Vec::new(),
            solver: Solver::new(),
            settings: Settings::DEFAULT,
            start: Vec::new(),
            change: Vec::new(),
            rates: Vec::new(),
            rounding: 0.0,
        }
    }

    /// Returns whether all pairs stay apart by more than the margin between two configurations; otherwise a pair in contact.
    pub(crate) fn any_contact(
        &mut self,
        from: &[f64],
        to: &[f64],
    ) -> Result<Option<(f64, Candidate)>, Error> {
        self.begin(from, to);
        let all = Stretch {
            from: 0.0,
            to: 1.0,
            halvings: 0,
        };
        match self.search(all, None)? {
            None => self.ask_engine(),
            contact => Ok(contact),
        }
    }

    /// Converts the two configurations to positions of all moving joints.
    fn begin(&mut self, from: &[f64], to: &[f64]) {
        let sources = self.kinematics.joints().iter().map(|joint| joint.source);
        self.start.clear();
        self.change.clear();
        self.rates.clear();
        for source in sources {
            let start = source.position(from);
            let change = source.position(to) - start;
            self.start.push(start);
            self.change.push(change);
            self.rates.push(change.abs());
        }
        let largest = self.start.iter().zip(&self.rates);
        let largest = largest.map(|(start, rate)| start.abs() + rate);
        self.rounding = point_error(self.kinematics, self.parts, largest);
        self.candidates.clear();
        self.open.clear();
    }

    /// Searches a stretch for a contact of candidates; of all pairs without a list of them. Pairs that stay open are left to
    /// the engine.
    fn search(
        &mut self,
        stretch: Stretch,
        among: Option<Range<usize>>,
    ) -> Result<Option<(f64, Candidate)>, Error> {
        let base = self.candidates.len();
        let middle = 0.5 * (stretch.from + stretch.to);
        let level = self.settings.vector_instructions.level();
        let found = vectorize!(level, _token => self.look(stretch, among));
        let first = match found {
            Found::Contact(pair) => return Ok(Some((middle, pair))),
            Found::Undecided(first) => first,
        };
        if let Some(contact) = self.check_suspects(middle)? {
            return Ok(Some(contact));
        }
        let undecided = first..self.candidates.len();
        if !undecided.is_empty() {
            self.candidates[first..].sort_unstable_by(|a, b| a.share.total_cmp(&b.share));
            let halvings = stretch.halvings + 1;
            let later = Stretch {
                from: middle,
                halvings,
                ..stretch
            };
            let earlier = Stretch {
                to: middle,
                halvings,
                ..stretch
            };
            for half in [later, earlier] {
                if let Some(contact) = self.search(half, Some(undecided.clone()))? {
                    return Ok(Some(contact));
                }
            }
        }
        self.candidates.truncate(base);
        Ok(None)
    }

    /// Asks the engine whether one of the suspects is in contact at a time.
    fn check_suspects(&mut self, share: f64) -> Result<Option<(f64, Candidate)>, Error> {
        if self.suspects.is_empty() {
            return Ok(None);
        }
        self.prepare_solver();
        self.suspects
            .sort_unstable_by(|a, b| a.share.total_cmp(&b.share));
        let positions = self.positions(share);
        for (k, pair) in self.suspects.iter().enumerate() {
            let bodies = pair.owners(self.parts);
            let mut earlier = self.suspects[..k].iter();
            if earlier.any(|other| bodies == other.owners(self.parts)) {
                continue;
            }
            let solver = &mut self.solver;
            let answer = self
                .exact
                .any_contact(solver, bodies, &positions, &positions)?;
            if answer.hit()?.is_some() {
                return Ok(Some((share, *pair)));
            }
        }
        Ok(None)
    }

    /// Returns the positions of all moving joints at a share of the edge.
    fn positions(&self, share: f64) -> Vec<f64> {
        let ends = self.start.iter().zip(&self.change);
        ends.map(|(start, change)| start + share * change).collect()
    }

    /// Sets the margin of the engine, which is larger because the positions that the engine gets are rounded.
    fn prepare_solver(&mut self) {
        self.solver.set_settings(Settings {
            margin: self.settings.margin + 2.0 * self.rounding,
            ..self.settings.clone()
        });
    }

    /// Leaves a pair in a stretch to the engine, together with neighbouring stretches of the pair.
    fn leave_open(&mut self, pair: Candidate, stretch: Stretch) {
        let Stretch { from, to, .. } = stretch;
        let bodies = pair.owners(self.parts);
        let known = self.open.iter_mut();
        // Later stretches are searched first.
        let mut known = known.filter(|open| open.bodies == bodies && open.from <= to);
        match known.next() {
            Some(open) => {
                open.from = lesser(open.from, from);
                open.pair.share = lesser(open.pair.share, pair.share);
            }
            None => self.open.push(OpenPair {
                pair,
                bodies,
                from,
                to,
            }),
        }
    }

    /// Measures the candidates in the middle of a stretch, and appends those that may be in contact within it.
    #[inline(always)]
    fn look(&mut self, stretch: Stretch, among: Option<Range<usize>>) -> Found {
        let half = 0.5 * (stretch.to - stretch.from);
        let middle = stretch.from + half;
        let positions = self.start.iter().zip(&self.change);
        let positions = positions.map(|(start, change)| start + middle * change);
        self.kinematics.place(positions, &mut self.frames);
        self.displacements.update(
            self.kinematics,
            &self.parts[..self.robot_parts],
            &self.frames,
            &self.rates,
            (half, self.rounding),
        );
        let among = among.unwrap_or_else(|| {
            let first = self.candidates.len();
            self.add_all_pairs();
            first..self.candidates.len()
        });
        let first = self.candidates.len();
        self.suspects.clear();
        let is_last = stretch.halvings >= MAX_HALVINGS;
        for k in among {
            let mut pair = self.candidates[k];
            match self.measure(&mut pair, is_last) {
                Measured::Free => {}
                Measured::Contact => return Found::Contact(pair),
                Measured::Undecided if is_last => self.leave_open(pair, stretch),
                Measured::Undecided => self.candidates.push(pair),
                Measured::Suspect => {
                    self.suspects.push(pair);
                    if is_last {
                        self.leave_open(pair, stretch);
                    } else {
                        self.candidates.push(pair);
                    }
                }
            }
        }
        Found::Undecided(first)
    }

    /// Appends all pairs whose bounding boxes come near each other in the stretch.
    #[inline(always)]
    fn add_all_pairs(&mut self) {
        let margin = self.settings.margin + self.settings.tolerance + 2.0 * self.rounding;
        for a in 0..self.robot_parts {
            let part = &self.parts[a];
            if part.frame == 0 {
                continue;
            }
            let slot = self.displacements.slot_at_base(a);
            let (centre, extents) =
                swept_box(part, &self.frames, self.displacements.bound(slot) + margin);
            let candidates = &mut self.candidates;
            self.boxes
                .for_each_meeting(centre - extents, centre + extents, |obstacle| {
                    candidates.push(Candidate::new(
                        [a, self.robot_parts + obstacle],
                        [slot, None],
                    ));
                });
        }
        self.candidates.extend_from_slice(&self.own_pairs);
    }

    #[inline(always)]
    fn measure(&mut self, pair: &mut Candidate, is_last: bool) -> Measured {
        let (a, b) = (&self.parts[pair.a as usize], &self.parts[pair.b as usize]);
        let displacement = pair.slots.map(|slot| self.displacements.bound(slot));
        let displacement = displacement[0] + displacement[1];
        let (frame_a, frame_b) = (self.frames[a.frame], self.frames[b.frame]);
        let margin = self.settings.margin;
        let rounding = 2.0 * self.rounding;
        let centre_a = frame_a.point(a.centre);
        let centre_b = frame_b.point(b.centre);
        let is_obstacle = pair.b as usize >= self.robot_parts;
        // The distance of the bounding volumes in the middle.
        let box_gap = if is_obstacle {
            let extents = box_extents(a, &frame_a) + b.half_extents;
            let gaps = (centre_b - centre_a).abs() - extents;
            gaps.max_element()
        } else {
            (centre_b - centre_a).length() - a.ball_radius - b.ball_radius
        };
        let required = displacement + margin + rounding;
        if box_gap > required {
            return Measured::Free;
        }
        if !is_last && displacement > FAR_DISPLACEMENT && box_gap > margin + self.settings.tolerance
        {
            pair.share = 1.0;
            return Measured::Undecided;
        }
        let first_axis = if pair.axis != DVec3::ZERO {
            pair.axis
        } else if is_obstacle {
            let nearest = centre_a.clamp(centre_b - b.half_extents, centre_b + b.half_extents);
            let axis = nearest - centre_a;
            if axis.length_squared() > 1e-6 {
                axis
            } else {
                centre_b - centre_a
            }
        } else {
            centre_b - centre_a
        };
        let radii = a.radius + b.radius;
        let contact = margin + self.settings.tolerance - rounding;
        let until = RequiredBounds {
            lower: required + radii,
            upper: contact + radii,
        };
        let bounds = bound_distance(
            #[inline(always)]
            |direction: DVec3| {
                let in_a = frame_a.inverse_vector(direction);
                let in_b = -frame_b.inverse_vector(direction);
                let (index_a, index_b) = (
                    a.support.extremal_point(in_a),
                    b.support.extremal_point(in_b),
                );
                let point_a = frame_a.point(a.points[index_a as usize]);
                let point_b = frame_b.point(b.points[index_b as usize]);
                Vertex {
                    point: point_b - point_a,
                    a: index_a,
                    b: index_b,
                }
            },
            first_axis,
            until,
        );
        if bounds.lower > until.lower {
            return Measured::Free;
        }
        if a.is_convex && b.is_convex && bounds.upper <= until.upper {
            return Measured::Contact;
        }
        pair.axis = bounds.axis;
        pair.share = (bounds.lower - radii) / required;
        if bounds.upper <= until.upper {
            return Measured::Suspect;
        }
        Measured::Undecided
    }

    /// Asks the engine for a contact of each open pair.
    fn ask_engine(&mut self) -> Result<Option<(f64, Candidate)>, Error> {
        if self.open.is_empty() {
            return Ok(None);
        }
        self.prepare_solver();
        self.open
            .sort_unstable_by(|a, b| a.pair.share.total_cmp(&b.pair.share));
        for &OpenPair {
            pair,
            bodies,
            from,
            to,
        } in &self.open
        {
            let ends = [from, to].map(|share| self.positions(share));
            let solver = &mut self.solver;
            let answer = self.exact.any_contact(solver, bodies, &ends[0], &ends[1])?;
            if let Some(hit) = answer.hit()? {
                return Ok(Some((from + hit.time * (to - from), pair)));
            }
        }
        Ok(None)
    }
}

/// What the distance of a pair in the middle of a stretch proves.
enum Measured {
    Free,
    Contact,
    Undecided,
    /// The hulls are in contact, but the bodies are not convex.
    Suspect,
}

/// Returns the half extents of the box along the base's axes around a part.
#[inline(always)]
fn box_extents(part: &Part, frame: &Frame) -> DVec3 {
    let rotation = &frame.rotation;
    let extents = part.half_extents;
    rotation.x_axis.abs() * extents.x
        + rotation.y_axis.abs() * extents.y
        + rotation.z_axis.abs() * extents.z
}

/// Returns the centre and the half extents of the box around a part that moves by at most `displacement`.
#[inline(always)]
fn swept_box(part: &Part, frames: &[Frame], displacement: f64) -> (DVec3, DVec3) {
    let frame = &frames[part.frame];
    let extents = box_extents(part, frame) + DVec3::splat(displacement);
    (frame.point(part.centre), extents)
}
