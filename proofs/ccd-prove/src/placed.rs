//! Where links are in the middle of a stretch of time, in floating point.

use crate::error::NotProven;
use crate::scene::Link;
use crate::screw::Screw;
use ccd_core::glam::{DMat3, DQuat, DVec3};

/// How a link moves on its parent, as the checker takes it: its centre along a line, and the link about it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Moving {
    pub(crate) parent: usize,
    pub(crate) screw: Screw,
    pub(crate) arm: DVec3,
    pub(crate) travel: DVec3,
    rotation: DMat3,
    turn: DVec3,
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

/// Returns the world and all links, in a unit of time of which the exponent is given.
///
/// # Errors
/// [`NotProven::TooSmall`].
pub(crate) fn moving(links: &[Link], time_unit: i32) -> Result<Vec<Moving>, NotProven> {
    let mut all = vec![on_parent(0, Screw::REST)];
    for link in links {
        let number = all.len();
        let screw =
            Screw::of(&link.joint, time_unit).ok_or(NotProven::TooSmall { link: number })?;
        let mut moving = on_parent(link.parent, screw);
        moving.arm -= all[link.parent].screw.centre;
        all.push(moving);
    }
    Ok(all)
}

fn on_parent(parent: usize, screw: Screw) -> Moving {
    let [[slid, turned_before], [travel, turn]] = screw.moves();
    Moving {
        parent,
        screw,
        arm: screw.pose.transform_point(screw.centre) + slid,
        travel,
        rotation: turned(turned_before) * DMat3::from_quat(screw.pose.rotation()),
        turn,
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
