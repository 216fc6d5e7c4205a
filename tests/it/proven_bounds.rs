//! Tests that the bounds that answers prove do not contradict sampled distances along trajectories. Knots are among the
//! samples. All questions, kinds of trajectory and tolerances are tested.

mod samples;

use ccd_core::Unresolved;
use ccd_core::order::greater;
use ccd_core::{Body, Contact, Motion, Outcome, Pose, Settings};
use ccd_tests::checks::CheckResult;
use ccd_tests::courses::{self, TRAJECTORY_KINDS};
use ccd_tests::law;
use ccd_tests::strategies::seeds;
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;
use rigid_ccd::Solver;
use rigid_ccd::trajectory::PosePath;
use samples::{DistanceSamples, ROUNDING, Scene};
use std::io::Write;

/// The number of answers of each kind.
#[derive(Debug, Default)]
struct Tally {
    free_count: u64,
    contact_count: u64,
    start_contact_count: u64,
    least_distance_count: u64,
    unresolved_count: u64,
    /// The number of scenes in which one question reports a contact within the tolerance, and another question reports
    /// none.
    grazing_scene_count: u64,
}

/// A scene, the settings of its queries, and its known distances.
struct Case<'s> {
    scene: &'s Scene,
    config: Settings,
    samples: DistanceSamples,
}

impl<'s> Case<'s> {
    /// Draws the tolerance and the margin, in most cases near the least distance of the scene.
    fn draw(rng: &mut Pcg64, scene: &'s Scene) -> Self {
        let samples = scene.samples();
        let least = samples.least_distance();
        let tolerance = 10f64.powf(rng.random_range(-12.0..0.5));
        let near = least - tolerance * rng.random_range(-1.0..2.0);
        let (margin, tolerance) = match rng.random_range(0..4) {
            0 => (0.0, tolerance),
            1 if least > 0.0 => (0.0, greater(1e-12, least * rng.random_range(0.3..3.0))),
            _ => (greater(near, 0.0), tolerance),
        };
        Case {
            scene,
            config: Settings {
                tolerance,
                margin,
                // At a tolerance of 1e-12, bodies that pass each other within rounding take millions of
                // visits.
                budget: 100_000,
                ..Settings::DEFAULT
            },
            samples,
        }
    }

    /// Checks the bounds of a reported contact, and that its distance is within the margin and the tolerance.
    fn check_contact(&self, time: f64, contact: &Contact, tolerance: f64) -> CheckResult {
        let distance = self.scene.distance(time);
        let (lower, upper) = (contact.separation.lower, contact.separation.upper);
        let reach = self.config.margin + tolerance;
        law!(
            lower <= distance + ROUNDING && distance <= upper + ROUNDING,
            "{distance:e} at {time} is not from {lower:e} to {upper:e}"
        );
        law!(upper <= reach + ROUNDING, "{upper:e} is no contact");
        Ok(())
    }

    /// Checks that the proven gap of free bodies is a lower bound of their distance, and exceeds the margin by at least
    /// half the tolerance.
    fn check_proven_gap(&self, proven_gap: f64) -> CheckResult {
        let Settings {
            margin, tolerance, ..
        } = self.config;
        self.samples
            .check_lower_bound(proven_gap, |_| true, "free")?;
        law!(
            proven_gap >= margin + 0.5 * tolerance - ROUNDING,
            "only {proven_gap:e} is proven"
        );
        Ok(())
    }

    /// Checks that no sampled distance before a time is less than the margin.
    fn check_no_contact_before(&self, until: f64) -> CheckResult {
        let margin = self.config.margin;
        (self.samples).check_lower_bound(margin, |time| time < until, "before a contact")
    }

    fn check_overlapping(&self) -> CheckResult {
        let distance = self.scene.distance(0.0);
        law!(
            distance <= ROUNDING,
            "no overlap: {distance:e} at the start"
        );
        Ok(())
    }

    fn check_first_contact(
        &self,
        outcome: &Outcome,
        tolerance: f64,
        tally: &mut Tally,
    ) -> CheckResult {
        match *outcome {
            Outcome::Contact { time, contact } => {
                tally.contact_count += 1;
                self.check_no_contact_before(time)?;
                self.check_contact(time, &contact, tolerance)
            }
            Outcome::Free { proven_gap } => {
                tally.free_count += 1;
                self.check_proven_gap(proven_gap)
            }
            Outcome::Touching { contact } => {
                tally.start_contact_count += 1;
                self.check_contact(0.0, &contact, tolerance)
            }
            Outcome::Overlapping { .. } => {
                tally.start_contact_count += 1;
                self.check_overlapping()
            }
            Outcome::Unresolved(Unresolved { safe_until, .. }) => {
                tally.unresolved_count += 1;
                self.check_no_contact_before(safe_until)
            }
            other => Err(format!("no outcome of a first contact: {other:?}")),
        }
    }

    fn check_any_contact(
        &self,
        any: &Outcome,
        tolerance: f64,
        first: &Outcome,
        tally: &mut Tally,
    ) -> CheckResult {
        let is_free = matches!(any, Outcome::Free { .. });
        let decided = !matches!(any, Outcome::Unresolved(_));
        if decided && !matches!(first, Outcome::Unresolved(_)) {
            tally.grazing_scene_count +=
                u64::from(is_free != matches!(first, Outcome::Free { .. }));
        }
        match *any {
            Outcome::Contact { time, contact } => self.check_contact(time, &contact, tolerance),
            Outcome::Free { proven_gap } => self.check_proven_gap(proven_gap),
            Outcome::Overlapping { .. } => self.check_overlapping(),
            Outcome::Unresolved(Unresolved { safe_until, .. }) => {
                self.check_no_contact_before(safe_until)
            }
            other => Err(format!("no outcome of any contact: {other:?}")),
        }
    }

    fn check_contact_interval(
        &self,
        interval: &Outcome,
        tolerance: f64,
        first: &Outcome,
    ) -> CheckResult {
        match *interval {
            Outcome::Free { proven_gap } => {
                let agrees =
                    matches!(first, Outcome::Free { proven_gap: other } if *other == proven_gap);
                law!(agrees, "{interval:?} and {first:?}");
                self.check_proven_gap(proven_gap)
            }
            Outcome::Interval { first, last } => {
                self.check_no_contact_before(first.time)?;
                let margin = self.config.margin;
                (self.samples).check_lower_bound(
                    margin,
                    |time| time > last.time,
                    "after the last contact",
                )?;
                for touch in [first, last] {
                    if let Some(contact) = touch.contact() {
                        self.check_contact(touch.time, &contact, tolerance)?;
                    }
                }
                Ok(())
            }
            Outcome::Unresolved(Unresolved {
                safe_until,
                safe_from,
                ..
            }) => {
                self.check_no_contact_before(safe_until)?;
                let margin = self.config.margin;
                (self.samples).check_lower_bound(
                    margin,
                    |time| time > safe_from,
                    "after an interval",
                )
            }
            other => Err(format!("no outcome of an interval: {other:?}")),
        }
    }

    fn check_closest_approach(&self, closest: &Outcome, tally: &mut Tally) -> CheckResult {
        self.samples
            .check_lower_bound(closest.lower(), |_| true, "closest")?;
        if let Outcome::LeastDistance { time, contact, .. } = closest {
            tally.least_distance_count += 1;
            let distance = self.scene.distance(*time);
            let upper = contact.separation.upper;
            law!(
                distance <= upper + ROUNDING,
                "{distance:e} at {time}, not at most {upper:e}"
            );
        }
        Ok(())
    }

    fn check(&self, solver: &mut Solver, tally: &mut Tally) -> CheckResult {
        solver.set_settings(self.config.clone());
        let [a, b] = self.scene.moving_bodies();
        let first = solver.first_contact(a, b, 1.0).expect("in range");
        self.check_first_contact(&first.outcome, first.tolerance, tally)?;
        let any = solver.any_contact(a, b, 1.0).expect("in range");
        self.check_any_contact(&any.outcome, any.tolerance, &first.outcome, tally)?;
        let interval = solver.contact_interval(a, b, 1.0).expect("in range");
        self.check_contact_interval(&interval.outcome, interval.tolerance, &first.outcome)?;
        let closest = solver.closest_approach(a, b, 1.0).expect("in range");
        self.check_closest_approach(&closest.outcome, tally)?;
        if self
            .scene
            .trajectory_kinds
            .iter()
            .all(|&kind| courses::is_motion_kind(kind))
        {
            self.check_single_motion_answers(solver, tally)
        } else {
            Ok(())
        }
    }

    /// Checks the answers of the questions for single motions, which have code of their own, by the same rules.
    fn check_single_motion_answers(&self, solver: &mut Solver, tally: &mut Tally) -> CheckResult {
        let motion = |k: usize| -> Motion {
            let way = self.scene.trajectories[k].stretch_between(0.0, 1.0);
            way.expect("a motion").motion
        };
        let [a, b] = [0, 1].map(|k| (&self.scene.bodies[k], motion(k)));
        let first = solver.first_contact(a, b, 1.0).expect("in range");
        self.check_first_contact(&first.outcome, first.tolerance, tally)?;
        let any = solver.any_contact(a, b, 1.0).expect("in range");
        self.check_any_contact(&any.outcome, any.tolerance, &first.outcome, tally)?;
        let closest = solver.closest_approach(a, b, 1.0).expect("in range");
        self.check_closest_approach(&closest.outcome, tally)
    }
}

#[test]
fn no_bound_is_above_a_sampled_distance() {
    let (mut solver, mut tally) = (Solver::new(), Tally::default());
    let draws = seeds(500);
    let (mut wrong, count) = (Vec::new(), draws.end - draws.start);
    for seed in draws {
        let mut rng = Pcg64::seed_from_u64(seed);
        let scene = Scene::draw(&mut rng);
        let case = Case::draw(&mut rng, &scene);
        if let Err(why) = case.check(&mut solver, &mut tally) {
            let kinds = scene.trajectory_kinds.map(|kind| TRAJECTORY_KINDS[kind]);
            wrong.push(format!(
                "{seed}: {kinds:?}, {:?}, {:?}: {why}",
                scene.solids, case.config
            ));
        }
    }
    writeln!(
        std::io::stderr(),
        "{count} draws, {} false: {tally:?}",
        wrong.len()
    )
    .unwrap();
    let shown = &wrong[..wrong.len().min(20)];
    assert!(
        wrong.is_empty(),
        "{} of {count}:\n{}",
        wrong.len(),
        shown.join("\n")
    );
    let Tally {
        free_count: free,
        contact_count: contact,
        start_contact_count: start,
        least_distance_count: measured,
        unresolved_count: unresolved,
        grazing_scene_count: grazes,
    } = tally;
    let many = count / 20;
    assert!(
        free > many && contact > many && start > many && measured > many,
        "{tally:?}"
    );
    assert!(grazes < many && unresolved < count / 50, "{tally:?}");
}

/// Tests that a ball that comes within the tolerance of a box at a knot is a contact for all questions.
#[test]
fn an_approach_within_the_tolerance_at_a_knot_is_a_contact_for_all_questions() {
    let (ball, wall) = (
        Body::sphere(0.5).unwrap(),
        Body::cuboid([1.0, 5.0, 5.0]).unwrap(),
    );
    let stops = [(0.0, -1.68), (0.4, -1.532), (0.41, -1.65), (1.0, -1.61)];
    let stops = stops.map(|(time, x)| (time, Pose::at([x, 0.0, 0.0]).unwrap()));
    let path = PosePath::new(stops.to_vec()).unwrap();
    for margin in [0.0, 0.2] {
        let beside = Motion::still(Pose::at([margin, 0.0, 0.0]).unwrap());
        let mut solver = Solver::new().with_settings(Settings {
            tolerance: 0.1,
            margin,
            ..Settings::DEFAULT
        });
        let (a, b) = ((&ball, &path), (&wall, &beside));
        let first = solver.first_contact(a, b, 1.0).unwrap().outcome;
        let any = solver.any_contact(a, b, 1.0).unwrap().outcome;
        let interval = solver.contact_interval(a, b, 1.0).unwrap().outcome;
        assert!(
            matches!(first, Outcome::Contact { time, .. } if time > 0.3 && time <= 0.4),
            "{first:?}"
        );
        assert!(matches!(any, Outcome::Contact { .. }), "{any:?}");
        assert!(
            matches!(interval, Outcome::Interval { last, .. } if last.time >= 0.4),
            "{interval:?}"
        );
    }
}
