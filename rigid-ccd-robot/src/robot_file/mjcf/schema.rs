//! The supported elements and attributes of MJCF, from the schema of MuJoCo 4.0 (`mj_printSchema`).

use super::document::Element;
use crate::robot_file::mjcf_error::MjcfError;

/// The elements that another element may contain, with the names of their attributes.
type Known = &'static [(&'static str, Attributes)];

enum Attributes {
    /// The attributes in these space-separated lists.
    Of(&'static [&'static str]),
    /// Any attributes: the element is unrelated to shapes, joints and pairs, or rejected elsewhere.
    Any,
}

/// Rejects elements and attributes that MJCF does not have. Elements that are unrelated to shapes, joints and pairs
/// are skipped.
pub(super) fn check(root: &Element) -> Result<(), MjcfError> {
    check_attributes(root, &Attributes::Of(&["model"]))?;
    check_children(root)
}

fn check_children(element: &Element) -> Result<(), MjcfError> {
    let Some(known) = allowed_children(&element.name) else {
        return Ok(());
    };
    for child in &element.children {
        let Some((_, attributes)) = known.iter().find(|(name, _)| *name == child.name) else {
            return Err(child.unknown_in(&element.name));
        };
        check_attributes(child, attributes)?;
        if let Attributes::Of(_) = attributes {
            check_children(child)?;
        }
    }
    Ok(())
}

fn check_attributes(element: &Element, known: &Attributes) -> Result<(), MjcfError> {
    let Attributes::Of(lists) = known else {
        return Ok(());
    };
    let is_known = |name: &&str| {
        let mut all = lists.iter().flat_map(|list| list.split_whitespace());
        all.any(|own| own == *name)
    };
    match element.attributes.names().find(|name| !is_known(name)) {
        None => Ok(()),
        Some(name) => Err(element.attributes.unknown(name)),
    }
}

/// Returns the elements that an element may contain; `None` if this is not checked here.
fn allowed_children(parent: &str) -> Option<Known> {
    match parent {
        "mujoco" => Some(SECTIONS),
        "compiler" => Some(&[("lengthrange", Attributes::Any)]),
        "option" => Some(&[("flag", Attributes::Of(&[FLAG]))]),
        "default" => Some(DEFAULTS),
        "asset" => Some(ASSETS),
        "worldbody" | "body" | "frame" | "replicate" => Some(BODY),
        "geom" | "mesh" => Some(&[("plugin", Attributes::Any)]),
        "contact" => Some(CONTACTS),
        "equality" => Some(EQUALITIES),
        _ => Some(&[]),
    }
}

const SECTIONS: Known = &[
    ("compiler", Attributes::Of(&[COMPILER])),
    ("option", Attributes::Of(&[OPTION])),
    ("default", Attributes::Of(&["class"])),
    ("asset", Attributes::Of(&[])),
    ("worldbody", Attributes::Of(&[])),
    ("contact", Attributes::Of(&[])),
    ("equality", Attributes::Of(&[])),
    ("deformable", Attributes::Any),
    ("actuator", Attributes::Any),
    ("custom", Attributes::Any),
    ("extension", Attributes::Any),
    ("keyframe", Attributes::Any),
    ("sensor", Attributes::Any),
    ("size", Attributes::Any),
    ("statistic", Attributes::Any),
    ("tendon", Attributes::Any),
    ("visual", Attributes::Any),
];

const DEFAULTS: Known = &[
    ("default", Attributes::Of(&["class"])),
    ("mesh", Attributes::Of(&[MESH])),
    ("joint", Attributes::Of(&[JOINT])),
    ("geom", Attributes::Of(&[GEOM, ORIENTATION])),
    ("pair", Attributes::Of(&[PAIR])),
    ("equality", Attributes::Of(&[EQUALITY])),
    ("adhesion", Attributes::Any),
    ("camera", Attributes::Any),
    ("cylinder", Attributes::Any),
    ("damper", Attributes::Any),
    ("dcmotor", Attributes::Any),
    ("general", Attributes::Any),
    ("intvelocity", Attributes::Any),
    ("light", Attributes::Any),
    ("material", Attributes::Any),
    ("motor", Attributes::Any),
    ("muscle", Attributes::Any),
    ("orientation", Attributes::Any),
    ("pid", Attributes::Any),
    ("plugin", Attributes::Any),
    ("position", Attributes::Any),
    ("site", Attributes::Any),
    ("tendon", Attributes::Any),
    ("texture", Attributes::Any),
    ("velocity", Attributes::Any),
];

const ASSETS: Known = &[
    (
        "mesh",
        Attributes::Of(&[
            MESH,
            "builtin class content_type face file material name normal params refpos refquat smoothnormal texcoord vertex",
        ]),
    ),
    (
        "hfield",
        Attributes::Of(&["content_type elevation file name ncol nrow size"]),
    ),
    ("material", Attributes::Any),
    ("model", Attributes::Any),
    ("skin", Attributes::Any),
    ("texture", Attributes::Any),
];

const BODY: Known = &[
    (
        "body",
        Attributes::Of(&[
            "childclass fuse gravcomp mocap name pos simple sleep user",
            ORIENTATION,
        ]),
    ),
    (
        "frame",
        Attributes::Of(&["childclass name pos", ORIENTATION]),
    ),
    (
        "replicate",
        Attributes::Of(&["childclass count euler offset sep"]),
    ),
    ("joint", Attributes::Of(&["class name", JOINT])),
    ("freejoint", Attributes::Of(&["align group name"])),
    ("geom", Attributes::Of(&["class name", GEOM, ORIENTATION])),
    ("attach", Attributes::Any),
    ("camera", Attributes::Any),
    ("composite", Attributes::Any),
    ("flexcomp", Attributes::Any),
    ("inertial", Attributes::Any),
    ("light", Attributes::Any),
    ("plugin", Attributes::Any),
    ("site", Attributes::Any),
];

const CONTACTS: Known = &[
    ("pair", Attributes::Of(&["class geom1 geom2 name", PAIR])),
    ("exclude", Attributes::Of(&["body1 body2 name"])),
];

const EQUALITIES: Known = &[
    (
        "connect",
        Attributes::Of(&["anchor body1 body2 class name site1 site2", EQUALITY]),
    ),
    (
        "weld",
        Attributes::Of(&[
            "anchor body1 body2 class name relpose site1 site2 torquescale",
            EQUALITY,
        ]),
    ),
    (
        "joint",
        Attributes::Of(&["class joint1 joint2 name polycoef", EQUALITY]),
    ),
    (
        "tendon",
        Attributes::Of(&["class name polycoef tendon1 tendon2", EQUALITY]),
    ),
    ("flex", Attributes::Any),
    ("flexstrain", Attributes::Any),
    ("flexvert", Attributes::Any),
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
