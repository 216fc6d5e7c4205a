//! The supported elements and attributes of MJCF, from the schema of MuJoCo 4.0 (`mj_printSchema`).

use super::document::Element;
use crate::robot_file::mjcf_error::MjcfError;

/// Elements whose attributes and children are checked: each with lists of its attributes, separated by spaces.
type Checked = &'static [(&'static str, &'static [&'static str])];

/// Rejects elements and attributes that MJCF does not have, and elements that are not supported. Elements that are
/// unrelated to shapes, joints and pairs are not checked.
pub(super) fn check(root: &Element) -> Result<(), MjcfError> {
    check_attributes(root, &["model"])?;
    check_children(root)
}

fn check_children(element: &Element) -> Result<(), MjcfError> {
    let (checked, unchecked) = allowed_children(&element.name);
    for child in &element.children {
        if let Some((_, attributes)) = checked.iter().find(|(name, _)| *name == child.name) {
            check_attributes(child, attributes)?;
            check_children(child)?;
        } else if !unchecked.split(' ').any(|name| name == child.name) {
            return Err(child.unknown_in(&element.name));
        }
    }
    Ok(())
}

fn check_attributes(element: &Element, lists: &[&str]) -> Result<(), MjcfError> {
    let is_known = |name: &&str| {
        let mut known = lists.iter().flat_map(|list| list.split_whitespace());
        known.any(|known| known == *name)
    };
    match element.attributes.names().find(|name| !is_known(name)) {
        None => Ok(()),
        Some(name) => Err(element.attributes.unknown(name)),
    }
}

/// Returns the elements that an element may contain: those that are checked, and a list of those that are not, because
/// they are unrelated to shapes, joints and pairs.
fn allowed_children(parent: &str) -> (Checked, &'static str) {
    match parent {
        "mujoco" => (
            SECTIONS,
            "actuator custom extension keyframe sensor size statistic tendon visual",
        ),
        "compiler" => (&[], "lengthrange"),
        "option" => (&[("flag", &[FLAG])], ""),
        "default" => (
            DEFAULTS,
            "adhesion camera cylinder damper dcmotor general intvelocity light material motor muscle orientation pid \
             plugin position site tendon texture velocity",
        ),
        "asset" => (ASSETS, "material model skin texture"),
        "worldbody" | "body" | "frame" | "replicate" => (BODY, "camera inertial light plugin site"),
        "geom" | "mesh" => (&[], "plugin"),
        "contact" => (CONTACTS, ""),
        "equality" => (EQUALITIES, "flex flexstrain flexvert"),
        _ => (&[], ""),
    }
}

const SECTIONS: Checked = &[
    ("compiler", &[COMPILER]),
    ("option", &[OPTION]),
    ("default", &["class"]),
    ("asset", &[]),
    ("worldbody", &[]),
    ("contact", &[]),
    ("equality", &[]),
];

const DEFAULTS: Checked = &[
    ("default", &["class"]),
    ("mesh", &[MESH]),
    ("joint", &[JOINT]),
    ("geom", &[GEOM, ORIENTATION]),
    ("pair", &[PAIR]),
    ("equality", &[EQUALITY]),
];

const ASSETS: Checked = &[
    (
        "mesh",
        &[
            MESH,
            "builtin class content_type face file material name normal params refpos refquat smoothnormal texcoord vertex",
        ],
    ),
    (
        "hfield",
        &["content_type elevation file name ncol nrow size"],
    ),
];

const BODY: Checked = &[
    (
        "body",
        &[
            "childclass fuse gravcomp mocap name pos simple sleep user",
            ORIENTATION,
        ],
    ),
    ("frame", &["childclass name pos", ORIENTATION]),
    ("replicate", &["childclass count euler offset sep"]),
    ("joint", &["class name", JOINT]),
    ("freejoint", &["align group name"]),
    ("geom", &["class name", GEOM, ORIENTATION]),
];

const CONTACTS: Checked = &[
    ("pair", &["class geom1 geom2 name", PAIR]),
    ("exclude", &["body1 body2 name"]),
];

const EQUALITIES: Checked = &[
    (
        "connect",
        &["anchor body1 body2 class name site1 site2", EQUALITY],
    ),
    (
        "weld",
        &[
            "anchor body1 body2 class name relpose site1 site2 torquescale",
            EQUALITY,
        ],
    ),
    ("joint", &["class joint1 joint2 name polycoef", EQUALITY]),
    ("tendon", &["class name polycoef tendon1 tendon2", EQUALITY]),
];

const COMPILER: &str = "alignfree angle assetdir autolimits balanceinertia boundinertia boundmass conflict coordinate \
    discardvisual eulerseq fitaabb fusestatic inertiafromgeom inertiagrouprange meshdir passthrough savecanonical savecompiled \
    saveinertial settotalmass strippath texturedir usethread";

const OPTION: &str = "actuatorgroupdisable ccd_iterations ccd_tolerance cone density gravity impratio integrator iterations \
    jacobian ls_iterations ls_tolerance magnetic noslip_iterations noslip_tolerance o_friction o_margin o_solimp o_solref \
    sdf_initpoints sdf_iterations sleep_tolerance solver timestep tolerance viscosity wind";

const FLAG: &str = "actuation autoreset clampctrl constraint contact damper diagexact energy equality eulerdamp filterparent \
    frictionloss fwdinv gravity invdiscrete ipc island limit midphase multiccd nativeccd override refsafe sensor sleep \
    speculative spring warmstart";

const ORIENTATION: &str = "axisangle euler quat xyaxes zaxis";

const MESH: &str = "inertia maxhullvert scale";

const JOINT: &str = "actuatorfrclimited actuatorfrcrange actuatorgravcomp armature axis damping frictionloss group limited \
    margin pos range ref solimpfriction solimplimit solreffriction solreflimit springdamper springref springyield stiffness \
    type user";

const GEOM: &str = "adhesion castshadow conaffinity condim contype density fitscale fluidcoef fluidshape friction fromto gap \
    group hfield margin mass material mesh pos priority rgba shellinertia size solimp solmix solref surfacevel type user";

const PAIR: &str = "adhesion condim friction gap margin solimp solref solreffriction";

const EQUALITY: &str = "active solimp solref";
