//! Checks the free times of all lanes against sampled distances of triangles in f64.

use super::*;
use crate::body::tree::NodeId;
use crate::math::order::{greater, lesser};
use crate::problem::{Problem, WhichBody};
use crate::tests::nearest::{Triangle, nearest_points};
use crate::tests::scene::{Pcg64, RngExt, Scene, SceneKind, rng, scene};
use crate::tuning::MIN_TURNING_PLANE_RADIUS_RATIO;

/// The number of sampled times within a lane's free time, both ends included.
const SAMPLED_TIME_COUNT: usize = 17;

/// Counters that show that a test covers its cases.
#[derive(Debug, Default)]
struct Tally {
    /// The number of lanes with a free time, all of which are checked.
    lanes_with_free_time: usize,
    lanes_without_free_time: usize,
    /// The number of free times that are more than 1.5 times as long as those of fixed planes.
    times_lengthened_by_turning_plane: usize,
    /// The number of lanes without a free time because their pieces are within the gap to keep already.
    lanes_within_gap: usize,
    /// The number of samples at which one axis separates all triangles.
    samples_proven_by_axis: usize,
    samples_proven_by_pieces: usize,
    /// The number of lanes with a free time, by the body whose node is split.
    lanes_by_split_body: [usize; 2],
    lanes_of_boxes: usize,
    lanes_of_triangles: usize,
    lanes_against_triangle: usize,
}

#[test]
fn free_times_hold_for_any_bodies_and_motions() {
    let tally = audit_random_scenes(SceneKind::RandomMotion, 1, 75_000);
    assert_shares_are_substantial(&tally);
}

#[test]
fn free_times_hold_for_sliding_bodies() {
    let tally = audit_random_scenes(SceneKind::Sliding, 2, 30_000);
    assert_shares_are_substantial(&tally);
}

#[test]
fn free_times_hold_near_the_rim_of_a_turning_body() {
    let tally = audit_random_scenes(SceneKind::NearRim, 3, 45_000);
    assert_shares_are_substantial(&tally);
    // Such scenes need planes that turn with the larger body.
    assert!(
        20 * tally.times_lengthened_by_turning_plane > tally.lanes_with_free_time,
        "{tally:?}"
    );
}

#[test]
fn overlapping_pairs_get_no_free_time_though_they_recede() {
    let tally = audit_random_scenes(SceneKind::Receding, 4, 20_000);
    assert!(
        4 * tally.lanes_without_free_time > tally.lanes_with_free_time,
        "{tally:?}"
    );
    assert!(tally.lanes_within_gap > 200, "{tally:?}");
}

fn assert_shares_are_substantial(tally: &Tally) {
    assert!(
        20 * tally.lanes_without_free_time > tally.lanes_with_free_time,
        "{tally:?}"
    );
    assert!(
        8 * tally.lanes_with_free_time > tally.lanes_without_free_time,
        "{tally:?}"
    );
    assert!(
        tally
            .lanes_by_split_body
            .iter()
            .all(|&n| 4 * n > tally.lanes_with_free_time),
        "{tally:?}"
    );
    assert!(
        10 * tally.lanes_of_boxes > tally.lanes_with_free_time,
        "{tally:?}"
    );
    assert!(
        10 * tally.lanes_of_triangles > tally.lanes_with_free_time,
        "{tally:?}"
    );
    assert!(
        20 * tally.lanes_against_triangle > tally.lanes_with_free_time,
        "{tally:?}"
    );
}

/// Checks expansions of random scenes until `lanes` pairs of a child and another node have been proven free for some
/// time.
fn audit_random_scenes(kind: SceneKind, seed: u64, lanes: usize) -> Tally {
    let mut rng = rng(seed);
    let mut tally = Tally::default();
    for number in 0.. {
        if tally.lanes_with_free_time >= lanes {
            break;
        }
        let scene = scene(&mut rng, kind, 200).with_occasional_accelerations(&mut rng);
        let audit = SceneAudit {
            problem: &scene.problem(),
            scene: &scene,
            name: (kind, seed, number),
        };
        for _ in 0..8 {
            audit.descend(&mut rng, &mut tally);
        }
    }
    tally
}

struct SceneAudit<'a> {
    problem: &'a Problem<'a>,
    scene: &'a Scene,
    name: (SceneKind, u64, usize),
}

/// A lane of an expansion: the child, the other node, and the interval of its free time.
#[derive(Debug)]
struct BoundedPair {
    split: WhichBody,
    child: NodeId,
    other_node: NodeId,
    start_clock: f64,
    end_clock: f64,
}

impl SceneAudit<'_> {
    /// Descends from the pair of roots to a pair of pieces by random splits, and checks each split at a random clock.
    fn descend(&self, rng: &mut Pcg64, tally: &mut Tally) {
        let mut ids = [0, 0];
        let (a, b) = (self.problem.a.body.tree(), self.problem.b.body.tree());
        for _ in 0..24 {
            let open = [a.piece(ids[0]).is_none(), b.piece(ids[1]).is_none()];
            let split = match open {
                [false, false] => return,
                [true, false] => WhichBody::A,
                [false, true] => WhichBody::B,
                _ if rng.random_bool(0.5) => WhichBody::A,
                _ => WhichBody::B,
            };
            let (node, other) = match split {
                WhichBody::A => (ids[0], ids[1]),
                WhichBody::B => (ids[1], ids[0]),
            };
            let s = self.clock(rng);
            let common = NodeContext::new(self.problem);
            let all = Split::with_all_children(split, node, other);
            let siblings = expand(&common, &all, s);
            assert_eq!(
                siblings.free_times,
                bound_children_of_kind::<AnyMotion>(&common, &all, s).free_times,
                "{:?}: the kernel of {:?}",
                self.name,
                common.motion
            );
            self.check_expansion(&siblings, split, node, other, s, tally);
            let count = self.child_count_and_kind(split, node).0;
            let lane = self.choose_child(rng, &siblings, count);
            ids[split as usize] = siblings.first_child + lane;
        }
    }

    /// Returns a clock at which the bodies are near each other, or a random one.
    fn clock(&self, rng: &mut Pcg64) -> f64 {
        let near = self.scene.clock + rng.random_range(-0.2..0.2) * self.scene.passage_duration;
        match rng.random_range(0..8) {
            0 => 0.0,
            1 | 2 => rng.random_range(0.0..1.0),
            3 => self.scene.clock,
            _ => near.clamp(0.0, 0.999),
        }
    }

    /// Chooses the child with which the descent continues, mostly the one with the least free time.
    fn choose_child(&self, rng: &mut Pcg64, siblings: &Siblings, count: u32) -> u32 {
        let free = |k: &u32| siblings.free_times.time_of_lane(*k as usize);
        let least = (0..count).min_by(|i, j| free(i).total_cmp(&free(j)));
        if rng.random_bool(0.8) {
            least.unwrap_or(0)
        } else {
            rng.random_range(0..count)
        }
    }

    /// Returns the number of a node's children, and whether these are triangles.
    fn child_count_and_kind(&self, split: WhichBody, node: NodeId) -> (u32, bool) {
        let tree = split.body_in_problem(self.problem).body.tree();
        match tree.get(node) {
            NodeOrTriangle::Node(node) => match node.children {
                NodeChildren::Boxes(group) => (tree.box_group(group).header.count, false),
                NodeChildren::Triangles(group) => (tree.triangle_group_header(group).count, true),
                NodeChildren::Piece(_) => (0, false),
            },
            NodeOrTriangle::Triangle(_) => (0, false),
        }
    }

    fn check_expansion(
        &self,
        siblings: &Siblings,
        split: WhichBody,
        node: NodeId,
        other: NodeId,
        s: f64,
        tally: &mut Tally,
    ) {
        let still = expand_with_fixed_planes(self.problem, split, node, other, s);
        let (count, triangles) = self.child_count_and_kind(split, node);
        for lane in 0..count {
            let free = siblings.free_times.time_of_lane(lane as usize);
            assert!(free >= 0.0, "{:?}: {free}", self.name);
            let pair = BoundedPair {
                split,
                child: siblings.first_child + lane,
                other_node: other,
                start_clock: s,
                end_clock: lesser(1.0, s + f64::from(free)),
            };
            if free > 0.0 {
                self.verify_lane(&pair, tally);
                tally.lanes_with_free_time += 1;
                tally.lanes_by_split_body[split as usize] += 1;
                tally.times_lengthened_by_turning_plane +=
                    usize::from(free > 1.5 * still.free_times.time_of_lane(lane as usize));
                let other_tree = split.other().body_in_problem(self.problem).body.tree();
                tally.lanes_against_triangle += usize::from(other_tree.piece(other).is_some());
                if triangles {
                    tally.lanes_of_triangles += 1;
                } else {
                    tally.lanes_of_boxes += 1;
                }
            } else {
                tally.lanes_without_free_time += 1;
                tally.lanes_within_gap += usize::from(self.overlap(&pair));
            }
        }
    }

    /// Returns whether some pieces of a lane are within the gap to keep; `false` for a lane of more than 64 pairs of
    /// pieces.
    fn overlap(&self, lane: &BoundedPair) -> bool {
        let (near, far) = self.triangles_at(lane, lane.start_clock);
        near.len() * far.len() <= 64
            && self.least_unseparated_distance(&near, &far, 0.0) <= self.problem.kept_gap()
    }

    /// Checks at every sampled time that all triangles below the child stay apart from those below the other node. They
    /// have to be farther apart than the gap of all clocks.
    fn verify_lane(&self, lane: &BoundedPair, tally: &mut Tally) {
        // The error of the reference is within the rounding that the bounds allow for.
        let kept = self.problem.kept_gap() - self.problem.rounding;
        let mut prover = AxisSearch::default();
        for k in 0..SAMPLED_TIME_COUNT {
            let share = k as f64 / (SAMPLED_TIME_COUNT - 1) as f64;
            let s = lane.start_clock + share * (lane.end_clock - lane.start_clock);
            let (near, far) = self.triangles_at(lane, s);
            if prover.separates(&near, &far, kept) {
                tally.samples_proven_by_axis += 1;
            } else {
                let least = self.least_unseparated_distance(&near, &far, kept);
                assert!(
                    least > kept,
                    "{:?}: {least:e} apart at {s}, {kept:e} promised: {lane:?}",
                    self.name,
                );
                tally.samples_proven_by_pieces += 1;
            }
        }
    }

    fn least_unseparated_distance(&self, near: &[Triangle], far: &[Triangle], enough: f64) -> f64 {
        let mut least = f64::INFINITY;
        for a in near {
            for b in far {
                let mut prover = AxisSearch::default();
                if !(enough > 0.0 && prover.separates(&[*a], &[*b], enough)) {
                    least = lesser(least, nearest_points(a, b).distance);
                }
            }
        }
        least
    }

    /// Returns the triangles below both nodes, at the poses at a clock.
    fn triangles_at(&self, lane: &BoundedPair, s: f64) -> (Vec<Triangle>, Vec<Triangle>) {
        let placed = |which: WhichBody, id: NodeId| {
            let side = which.body_in_problem(self.problem);
            let frame = side.path.frame(s);
            let mut out = Vec::new();
            visit_pieces_below(side, id, &mut |piece| {
                out.push(
                    side.body
                        .pieces()
                        .triangle(piece as usize)
                        .map(|p| frame.transform_point(p)),
                );
            });
            out
        };
        (
            placed(lane.split, lane.child),
            placed(lane.split.other(), lane.other_node),
        )
    }
}

/// Calls `visit` with all pieces below a node.
fn visit_pieces_below(side: &BodyWithPath<'_>, id: NodeId, visit: &mut impl FnMut(u32)) {
    let tree = side.body.tree();
    let members = match tree.get(id) {
        NodeOrTriangle::Triangle(piece) => return visit(piece),
        NodeOrTriangle::Node(node) => match node.children {
            NodeChildren::Piece(piece) => return visit(piece),
            NodeChildren::Boxes(group) => tree.box_group(group).header,
            NodeChildren::Triangles(group) => *tree.triangle_group_header(group),
        },
    };
    for k in 0..members.count {
        visit_pieces_below(side, members.first_child + k, visit);
    }
}

/// A search for an axis that separates two sets of triangles, which starts with the axis found last.
#[derive(Default)]
struct AxisSearch {
    axis: Option<DVec3>,
}

impl AxisSearch {
    fn separates(&mut self, a: &[Triangle], b: &[Triangle], kept: f64) -> bool {
        let mut axis = self.axis.unwrap_or_else(|| b[0][0] - a[0][0]);
        // The nearest point found so far of the difference of the hulls.
        let mut nearest: Option<DVec3> = None;
        for _ in 0..24 {
            let Some(n) = axis.try_normalize() else {
                return false;
            };
            let support = lowest_point(b, n) - lowest_point(a, -n);
            if n.dot(support) > kept {
                self.axis = Some(n);
                return true;
            }
            let from = nearest.unwrap_or(support);
            let step = support - from;
            let share = (-from.dot(step) / step.length_squared()).clamp(0.0, 1.0);
            let next = if share > 0.0 {
                from + share * step
            } else {
                from
            };
            nearest = Some(next);
            axis = next;
        }
        false
    }
}

fn lowest_point(triangles: &[Triangle], n: DVec3) -> DVec3 {
    let points = triangles.iter().flatten().copied();
    points
        .map(|p| (n.dot(p), p))
        .fold((f64::INFINITY, DVec3::ZERO), |least, at| {
            if at.0 < least.0 { at } else { least }
        })
        .1
}

/// Like [`expand`], with fixed planes only.
fn expand_with_fixed_planes(
    problem: &Problem<'_>,
    split: WhichBody,
    node: NodeId,
    other: NodeId,
    s: f64,
) -> EightPairFreeTimes {
    let tree = split.body_in_problem(problem).body.tree();
    let NodeOrTriangle::Node(below) = tree.get(node) else {
        panic!("a node to split");
    };
    let common = NodeContext::new(problem);
    let split_all = Split::with_all_children(split, node, other);
    vectorize!(problem.simd_level, level => {
        let motion = RelativeMotion::<_, AnyMotion>::new(level, &common, &split_all, s);
        match below.children {
            NodeChildren::Boxes(group) => {
                let group = tree.box_group(group);
                bound_with_fixed_planes(&motion, group, &group.header)
            }
            NodeChildren::Triangles(group) => {
                let pieces = split.body_in_problem(problem).body.pieces();
                let group = &tree.triangle_group(level, group, pieces);
                bound_with_fixed_planes(&motion, group, &group.header)
            }
            NodeChildren::Piece(_) => panic!("a node to split"),
        }
    })
}

/// Like `RelativeMotion::bound`, with fixed planes only. A radius that is neither much larger nor much smaller than the
/// other node's excludes planes that turn.
#[inline(always)]
fn bound_with_fixed_planes<L: Simd, C: Children>(
    motion: &RelativeMotion<'_, L, AnyMotion>,
    group: &C,
    members: &GroupHeader,
) -> EightPairFreeTimes {
    let far = motion.other_body;
    let radius = match far.body.tree().get(motion.split.other_node) {
        NodeOrTriangle::Node(node) => node.radius,
        NodeOrTriangle::Triangle(piece) => {
            let [a, b, c] = far.body.pieces().triangle(piece as usize);
            let mean = (a + b + c) / 3.0;
            [a, b, c]
                .map(|p| round_up_to_f32(p.distance(mean)))
                .into_iter()
                .fold(0.0, greater)
        }
    };
    let much = 0.99 * MIN_TURNING_PLANE_RADIUS_RATIO;
    let members = GroupHeader {
        max_distance_from_origin: members
            .max_distance_from_origin
            .clamp(radius / much, radius * much),
        ..*members
    };
    motion.bound_group(group, &members)
}
