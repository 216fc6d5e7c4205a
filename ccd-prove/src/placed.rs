//! Where links are in the middle of a stretch of time, in floating point.

use crate::scene::{AxisKind, Joint, Link};
use ccd_core::glam::{DMat3, DQuat, DVec3};

/// How a link moves on its parent, as the checker takes it: its centre along a line, and the link about it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Moving {
    pub(crate) parent: usize,
    pub(crate) centre: DVec3,
    pub(crate) arm: DVec3,
    pub(crate) travel: DVec3,
    rotation: DMat3,
    pub(crate) turn: DVec3,
}

/// A link in the middle of a stretch of time, and how it moves on its parent in half of it; all along the axes of the world.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Placed {
    pub(crate) parent: usize,
    pub(crate) centre: DVec3,
    pub(crate) rotation: DMat3,
    pub(crate) arm: DVec3,
    pub(crate) travel: DVec3,
    pub(crate) turn: DVec3,
}

/// Returns the world and all links.
pub(crate) fn moving(links: &[Link]) -> Vec<Moving> {
    let mut all = vec![Moving {
        parent: 0,
        centre: DVec3::ZERO,
        arm: DVec3::ZERO,
        travel: DVec3::ZERO,
        rotation: DMat3::IDENTITY,
        turn: DVec3::ZERO,
    }];
    for link in links {
        let mut moving = of_joint(&link.joint);
        moving.parent = link.parent;
        moving.arm -= all[link.parent].centre;
        all.push(moving);
    }
    all
}

fn of_joint(joint: &Joint) -> Moving {
    match joint {
        Joint::Free(motion) => Moving {
            parent: 0,
            centre: motion.centre(),
            arm: motion.start().transform_point(motion.centre()),
            travel: motion.velocity(),
            rotation: DMat3::from_quat(motion.start().rotation()),
            turn: motion.spin(),
        },
        Joint::Axis {
            kind,
            pose,
            axis,
            start,
            rate,
        } => {
            let rotation = DMat3::from_quat(pose.rotation());
            let axis = rotation * *axis;
            let [turns, slides] = [AxisKind::Turns, AxisKind::Slides]
                .map(|of| if *kind == of { axis } else { DVec3::ZERO });
            Moving {
                parent: 0,
                centre: DVec3::ZERO,
                arm: pose.translation() + slides * *start,
                travel: slides * *rate,
                rotation: turned(turns * *start) * rotation,
                turn: turns * *rate,
            }
        }
    }
}

fn turned(turn: DVec3) -> DMat3 {
    DMat3::from_quat(DQuat::from_scaled_axis(turn))
}

/// Returns the world and all links in the middle of a stretch of time.
pub(crate) fn placed(links: &[Moving], middle: f64, half: f64) -> Vec<Placed> {
    let mut all: Vec<Placed> = Vec::with_capacity(links.len());
    for link in links {
        let (centre, rotation) = all
            .get(link.parent)
            .map_or((DVec3::ZERO, DMat3::IDENTITY), |on| {
                (on.centre, on.rotation)
            });
        let arm = rotation * (link.arm + link.travel * middle);
        let [travel, turn] = [link.travel, link.turn].map(|v| rotation * (v * half));
        all.push(Placed {
            parent: link.parent,
            centre: centre + arm,
            rotation: rotation * turned(link.turn * middle) * link.rotation,
            arm,
            travel,
            turn,
        });
    }
    all
}
