//! Reads the bodies of an MJCF with their joints and geoms.

use super::attributes::Attributes;
use super::classes::Classes;
use super::document::{Element, MAX_ELEMENTS};
use super::orientation::{euler_rotation, read_pose};
use super::settings::Settings;
use crate::robot_file::mjcf_error::MjcfError;
use rigid_ccd::Pose;
use rigid_ccd::glam::DVec3;

/// The index of the world, the body that does not move.
pub(super) const WORLD: usize = 0;

/// A body of the model.
pub(super) struct MjcfBody {
    /// The indices of the body and of its parent. The world has no parent.
    pub(super) number: usize,
    pub(super) parent: Option<usize>,
    pub(super) name: String,
    /// The pose in the parent's frame, with all joints at their reference positions.
    pub(super) pose: Pose,
    pub(super) joints: Vec<MjcfJoint>,
    pub(super) geoms: Vec<MjcfGeom>,
}

/// A joint of a body.
pub(super) struct MjcfJoint {
    /// The name, or by default the body's name and the joint's index.
    pub(super) name: String,
    pub(super) kind: MjcfJointKind,
    /// The anchor and the unit axis, in the body's frame.
    pub(super) anchor: DVec3,
    pub(super) axis: DVec3,
    /// The limits of the position; `None` for an unlimited joint.
    pub(super) limits: Option<[f64; 2]>,
    /// The position of the joint at which the body has the pose in the file.
    pub(super) reference: f64,
    /// Whether MuJoCo moves the body's frame to its center of mass.
    is_aligned: bool,
}

/// How a joint moves its body.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum MjcfJointKind {
    Hinge,
    Slide,
    Ball,
    Free,
}

/// A geom of a body, with its pose in the body's frame.
pub(super) struct MjcfGeom {
    pub(super) attributes: Attributes,
    pub(super) pose: Pose,
    /// The pose of the surrounding `frame` element in the body's frame. The points of `fromto` are in this frame.
    pub(super) frame: Pose,
    pub(super) contype: i32,
    pub(super) conaffinity: i32,
}

impl MjcfGeom {
    pub(super) fn name(&self) -> Option<&str> {
        self.attributes.name("name")
    }
}

/// Reads the bodies of a model. The world comes first, and parents come before children.
pub(super) fn read_bodies(
    root: &Element,
    settings: &Settings,
    classes: &Classes,
) -> Result<Vec<MjcfBody>, MjcfError> {
    let mut reader = Reader {
        settings,
        classes,
        added_count: 0,
        bodies: vec![MjcfBody {
            number: WORLD,
            parent: None,
            name: "world".to_owned(),
            pose: Pose::IDENTITY,
            joints: Vec::new(),
            geoms: Vec::new(),
        }],
    };
    for world in root
        .children
        .iter()
        .filter(|section| section.name == "worldbody")
    {
        reader.add_children(world, &Place::in_body(WORLD))?;
    }
    Ok(reader.bodies)
}

struct Reader<'r> {
    settings: &'r Settings,
    classes: &'r Classes,
    bodies: Vec<MjcfBody>,
    /// The number of elements that were added, replicated ones included.
    added_count: usize,
}

/// The context of the elements that are added.
#[derive(Clone, Copy)]
struct Place<'r> {
    /// The index of the body to which the elements are added.
    body: usize,
    /// The pose of the elements' frame in the body's frame.
    frame: Pose,
    /// The default class.
    class: Option<&'r str>,
    /// The suffix of all names.
    suffix: &'r str,
}

impl Place<'_> {
    fn in_body(body: usize) -> Self {
        Place {
            body,
            frame: Pose::IDENTITY,
            class: None,
            suffix: "",
        }
    }
}

impl Reader<'_> {
    /// Adds the children of an element to a body.
    fn add_children(&mut self, element: &Element, place: &Place<'_>) -> Result<(), MjcfError> {
        for child in &element.children {
            self.added_count += 1;
            if self.added_count > MAX_ELEMENTS {
                return Err(MjcfError::TooManyElements);
            }
            let mut attributes = self.classes.merged(child, place.class)?;
            attributes.add_to_name(place.suffix);
            if let Some(class) = attributes.get("childclass") {
                self.classes.check(class)?;
            }
            let inner = Place {
                class: attributes.get("childclass").or(place.class),
                ..*place
            };
            match child.name.as_str() {
                "body" => self.add_body(child, &attributes, &inner)?,
                "frame" => {
                    let frame = place.frame.compose(&read_pose(&attributes, self.settings)?);
                    self.add_children(child, &Place { frame, ..inner })?;
                }
                "replicate" => self.replicate(child, &attributes, &inner)?,
                "geom" => {
                    let geom = self.geom(attributes, place.frame)?;
                    self.bodies[place.body].geoms.push(geom);
                }
                "joint" | "freejoint" => {
                    let joint = self.joint(&attributes, place.body, place.frame)?;
                    self.bodies[place.body].joints.push(joint);
                }
                // `schema::check` accepts no other elements with shapes or joints.
                _ => {}
            }
        }
        Ok(())
    }

    /// Adds the children of a `replicate` element several times. Each copy is displaced from the previous copy, and its
    /// names get the index of the copy as a suffix.
    fn replicate(
        &mut self,
        element: &Element,
        attributes: &Attributes,
        place: &Place<'_>,
    ) -> Result<(), MjcfError> {
        let count = attributes.integer_or("count", 0)?;
        if count < 1 {
            return Err(attributes.invalid("count"));
        }
        let offset = attributes
            .array("offset")?
            .map_or(DVec3::ZERO, DVec3::from_array);
        let angles: [f64; 3] = attributes.array("euler")?.unwrap_or_default();
        let copy_rotation =
            |times: f64| euler_rotation(angles.map(|angle| times * angle), self.settings);
        let digits = (count - 1).to_string().len();
        let mut position = DVec3::ZERO;
        for k in 0..count {
            let rotation = copy_rotation(k as f64);
            let copy_pose =
                Pose::new(position, rotation).map_err(|_| attributes.invalid("offset"))?;
            position += rotation * offset;
            let separator = attributes.get("sep").unwrap_or("");
            let suffix = format!("{separator}{k:0digits$}{}", place.suffix);
            let inner = Place {
                frame: place.frame.compose(&copy_pose),
                suffix: &suffix,
                ..*place
            };
            self.add_children(element, &inner)?;
        }
        Ok(())
    }

    fn add_body(
        &mut self,
        element: &Element,
        attributes: &Attributes,
        place: &Place<'_>,
    ) -> Result<(), MjcfError> {
        let number = self.bodies.len();
        let name = attributes
            .name("name")
            .map_or_else(|| format!("body{number}"), str::to_owned);
        let pose = place.frame.compose(&read_pose(attributes, self.settings)?);
        let mut joints = Vec::new();
        // In MuJoCo, the user of the simulation moves a `mocap` body freely.
        if attributes.truth_or("mocap", false)? {
            joints.push(MjcfJoint {
                name: format!("{name}/mocap"),
                kind: MjcfJointKind::Free,
                anchor: DVec3::ZERO,
                axis: DVec3::Z,
                limits: None,
                reference: 0.0,
                is_aligned: false,
            });
        }
        self.bodies.push(MjcfBody {
            number,
            parent: Some(place.body),
            name,
            pose,
            joints,
            geoms: Vec::new(),
        });
        let inner = Place {
            body: number,
            frame: Pose::IDENTITY,
            ..*place
        };
        self.add_children(element, &inner)?;
        let has_children = self.bodies.len() > number + 1;
        let body = &self.bodies[number];
        if !has_children && body.joints.iter().any(|joint| joint.is_aligned) {
            let body = body.name.clone();
            return Err(MjcfError::AlignedBody { body });
        }
        Ok(())
    }

    fn geom(&self, attributes: Attributes, frame: Pose) -> Result<MjcfGeom, MjcfError> {
        Ok(MjcfGeom {
            pose: frame.compose(&read_pose(&attributes, self.settings)?),
            frame,
            contype: attributes.integer_or("contype", 1)?,
            conaffinity: attributes.integer_or("conaffinity", 1)?,
            attributes,
        })
    }

    fn joint(
        &self,
        attributes: &Attributes,
        number: usize,
        frame: Pose,
    ) -> Result<MjcfJoint, MjcfError> {
        let body = &self.bodies[number];
        let kind = match attributes.get("type") {
            _ if attributes.element == "freejoint" => MjcfJointKind::Free,
            None | Some("hinge") => MjcfJointKind::Hinge,
            Some("slide") => MjcfJointKind::Slide,
            Some("ball") => MjcfJointKind::Ball,
            Some("free") => MjcfJointKind::Free,
            Some(_) => return Err(attributes.invalid("type")),
        };
        // The world has no joints. A free joint is only allowed on a child of the world, as its only joint.
        let is_free = kind == MjcfJointKind::Free
            || body
                .joints
                .iter()
                .any(|joint| joint.kind == MjcfJointKind::Free);
        if number == WORLD || is_free && (body.parent != Some(WORLD) || !body.joints.is_empty()) {
            return Err(attributes.invalid("type"));
        }
        let anchor = attributes
            .array("pos")?
            .map_or(DVec3::ZERO, DVec3::from_array);
        let axis = attributes
            .array("axis")?
            .map_or(DVec3::Z, DVec3::from_array);
        let axis = attributes.direction("axis", axis)?;
        let default_align = self.settings.aligns_free_bodies;
        let is_aligned = match attributes.get("align") {
            None | Some("auto") => default_align,
            Some(_) => attributes.truth_or("align", default_align)?,
        };
        let scale = |position: f64| match kind {
            MjcfJointKind::Hinge => self.settings.radians(position),
            _ => position,
        };
        let [reference] = attributes.array("ref")?.unwrap_or([0.0]);
        Ok(MjcfJoint {
            name: attributes.name("name").map_or_else(
                || format!("{}/joint{}", body.name, body.joints.len()),
                str::to_owned,
            ),
            kind,
            anchor: frame.transform_point(anchor),
            axis: frame.rotation() * axis,
            limits: match kind {
                // A free joint has no limits. The limits of a ball joint are ignored.
                MjcfJointKind::Free | MjcfJointKind::Ball => None,
                MjcfJointKind::Hinge | MjcfJointKind::Slide => {
                    self.limits(attributes)?.map(|limits| limits.map(scale))
                }
            },
            reference: scale(reference),
            is_aligned: kind == MjcfJointKind::Free && is_aligned,
        })
    }

    fn limits(&self, attributes: &Attributes) -> Result<Option<[f64; 2]>, MjcfError> {
        let range: Option<[f64; 2]> = attributes.array("range")?;
        let valid_range = range.filter(|[low, high]| low < high && self.settings.has_limits);
        match attributes.get("limited") {
            // An empty range gives no limits.
            None | Some("auto") => Ok(valid_range.filter(|_| self.settings.limits_follow_ranges)),
            Some(_) if attributes.truth_or("limited", false)? => valid_range
                .map(Some)
                .ok_or_else(|| attributes.invalid("range")),
            Some(_) => Ok(None),
        }
    }
}
