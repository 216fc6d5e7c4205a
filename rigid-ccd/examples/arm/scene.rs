//! Reads an arm from a URDF file, and places it among obstacles.

use rand::RngExt;
use rand_pcg::Pcg64;
use rigid_ccd::glam::{DQuat, DVec3, EulerRot};
use rigid_ccd::trajectory::{Chain, Joint};
use rigid_ccd::{Body, Error, InputError, Motion, Pose, Solver, load};
use std::path::Path;
use urdf_rs::{Geometry, JointType, Robot};

/// An arm and its obstacles.
pub(crate) struct Scene {
    pub(crate) chain: Chain,
    /// The bodies of the arm's links, each in its link's frame.
    pub(crate) links: Vec<Body>,
    /// For each link, the earlier links that it is tested against: those more than 0.01 apart from it in the home
    /// position, without its neighbour.
    pub(crate) tested_links: Vec<Vec<usize>>,
    pub(crate) obstacles: Vec<(Body, Motion)>,
}

impl Scene {
    /// Reads an arm, and adds random obstacles.
    pub(crate) fn load(urdf: &Path, obstacles: usize, random: &mut Pcg64) -> anyhow::Result<Self> {
        let robot = urdf_rs::read_file(urdf)?;
        let chain = Chain::new(
            Pose::IDENTITY,
            robot.joints.iter().map(joint).collect::<Result<_, _>>()?,
        );
        let links: Vec<Body> = (0..robot.links.len())
            .map(|k| body(&robot, k, urdf))
            .collect::<anyhow::Result<_>>()?;
        let mut scene = Scene {
            tested_links: vec![Vec::new(); links.len()],
            chain,
            links,
            obstacles: Vec::new(),
        };
        scene.fill_tested_links()?;
        while scene.obstacles.len() < obstacles {
            let size = [(); 3].map(|()| random.random_range(0.03..0.12));
            let at = [(); 3].map(|()| random.random_range(-1.6..1.6));
            let turned = DQuat::from_euler(
                EulerRot::XYZ,
                random.random_range(0.0..3.0),
                random.random_range(0.0..3.0),
                0.0,
            );
            // No obstacle stands in the arm's foot.
            if DVec3::from_array(at).length() > 0.5 {
                let stands = Motion::still(Pose::new(at, turned)?);
                scene.obstacles.push((Body::cuboid(size)?, stands));
            }
        }
        Ok(scene)
    }

    pub(crate) fn home_position(&self) -> Vec<f64> {
        vec![0.0; self.chain.joints().len()]
    }

    /// Fills `tested_links` with the pairs of links that are more than 0.01 apart in the home position. Neighbouring
    /// links always touch, so they are left out.
    fn fill_tested_links(&mut self) -> Result<(), Error> {
        let (home, mut solver) = (self.home_position(), Solver::new());
        for high in 0..self.links.len() {
            for low in 0..high.saturating_sub(1) {
                let pose = |link| self.chain.pose(link, &home);
                let [a, b] = [
                    (&self.links[high], pose(high)?),
                    (&self.links[low], pose(low)?),
                ];
                if solver.distance(a, b)?.outcome.lower() > 0.01 {
                    self.tested_links[high].push(low);
                }
            }
        }
        Ok(())
    }
}

fn joint(joint: &urdf_rs::Joint) -> Result<Joint, InputError> {
    let [roll, pitch, yaw] = joint.origin.rpy.0;
    // URDF rotates about fixed axes: first x, then y, then z.
    let turned = DQuat::from_euler(EulerRot::ZYX, yaw, pitch, roll);
    let origin = Pose::new(joint.origin.xyz.0, turned)?;
    let limits = joint.limit.lower..=joint.limit.upper;
    Ok(match joint.joint_type {
        JointType::Revolute => Joint::revolute(origin, joint.axis.xyz.0)?.with_limits(limits),
        JointType::Continuous => Joint::revolute(origin, joint.axis.xyz.0)?,
        JointType::Prismatic => Joint::prismatic(origin, joint.axis.xyz.0)?.with_limits(limits),
        _ => Joint::fixed(origin),
    })
}

fn body(robot: &Robot, link: usize, urdf: &Path) -> anyhow::Result<Body> {
    let collision = robot.links[link].collision.first();
    match collision.map(|collision| &collision.geometry) {
        Some(Geometry::Mesh { filename, .. }) => Ok(load(urdf.with_file_name(filename))?),
        other => anyhow::bail!("link {link}: {other:?} is no mesh"),
    }
}
