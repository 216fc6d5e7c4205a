//! Remarks on robots and cells: probable mistakes, and what is not checked.

use crate::skip_reason::LeftOutPairs;
use ccd_decomp::Remarks;
use rigid_ccd::Remark;
use rigid_ccd::text::RoundedToFourDigits;
use std::fmt;

/// A remark on a robot or a cell. Remarks do not affect answers.
///
/// A [warning](CellRemark::is_warning) reports a probable mistake, or that most of a robot is not checked. A note
/// reports what is not checked. [`LinkPairs::remarks`](crate::LinkPairs::remarks) lists the remarks on a robot,
/// [`Cell::remarks`](crate::Cell::remarks) those on a cell.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum CellRemark {
    /// More than half of the moving links have no bodies.
    MostLinksWithoutBodies {
        /// The moving links without bodies.
        links: Vec<String>,
        /// The number of moving links.
        moving_count: usize,
    },
    /// More than half of the moving links are checked against no other link, because a file or the caller skips their
    /// pairs.
    MostLinksUnchecked {
        /// The moving links that are checked against no other link.
        links: Vec<String>,
        /// The number of moving links with bodies.
        moving_count: usize,
    },
    /// The robot's file has a single link, without shapes.
    EmptyRobot {
        /// The name of the link.
        link: String,
    },
    /// Elements of the robot's file are ignored. Other programs may use them.
    LeftOut {
        /// The elements, each with the element that contains it.
        elements: Vec<String>,
    },
    /// An SRDF names links that the robot does not have. Their pairs are ignored.
    UnknownLinks {
        /// The names of the links.
        links: Vec<String>,
    },
    /// The SRDF names another robot.
    OtherRobotName {
        /// The name of the robot.
        robot: String,
        /// The name in the SRDF.
        of_srdf: String,
    },
    /// The size of an item suggests another unit of length: a link far larger than the robot's reach, or another item
    /// far larger or smaller than the robot.
    UnlikelySize {
        /// The name of the link, the attached body or the obstacle.
        item: String,
        /// The longest bounding-box side of its largest body.
        size: f64,
        /// The size of the robot, see [`Robot::size`](crate::Robot::size); for a link, the extent of the robot's joint
        /// origins.
        robot_size: f64,
    },
    /// A number or the tolerance is probably in another unit.
    Input {
        /// The name of the element with the number.
        item: String,
        /// The remark.
        remark: Remark,
    },
    /// Links have no bodies. This is a note.
    LinksWithoutBodies {
        /// The links.
        links: Vec<String>,
    },
    /// Pairs of links are not checked. This is a note.
    PairsLeftOut(LeftOutPairs),
    /// Static links and attached bodies are not checked against obstacles. This is a note.
    StaticItemsUnchecked {
        /// The names of the links and the attached bodies.
        items: Vec<String>,
    },
    /// Pairs with an obstacle or an attached body are allowed to touch. This is a note.
    ContactsAllowed {
        /// The pairs.
        pairs: Vec<[String; 2]>,
    },
    /// Meshes of an MJCF are not convex and are used as they are. MuJoCo would use their convex hulls. This is a note.
    ExactMeshes {
        /// The files or names of the meshes.
        meshes: Vec<String>,
    },
    /// The reader of a mesh ignored or changed something. This is a note.
    MeshContent {
        /// The file of the mesh.
        mesh: String,
        /// The list of what was ignored or changed.
        content: Remarks,
    },
}

impl CellRemark {
    /// Creates a remark on a named element.
    pub fn on(item: impl Into<String>, remark: Remark) -> Self {
        let item = item.into();
        CellRemark::Input { item, remark }
    }

    /// Returns whether the remark is a warning: a probable mistake, or that most of a robot is not checked.
    pub fn is_warning(&self) -> bool {
        !matches!(
            self,
            CellRemark::LinksWithoutBodies { .. }
                | CellRemark::PairsLeftOut(_)
                | CellRemark::StaticItemsUnchecked { .. }
                | CellRemark::ContactsAllowed { .. }
                | CellRemark::ExactMeshes { .. }
                | CellRemark::MeshContent { .. }
        )
    }

    pub(crate) fn left_out(element: String) -> Self {
        let elements = vec![element];
        CellRemark::LeftOut { elements }
    }

    /// Adds the remark to a list. All ignored elements are collected in one remark.
    pub(crate) fn add_to(self, remarks: &mut Vec<CellRemark>) {
        if let CellRemark::LeftOut { elements } = &self {
            for other in &mut *remarks {
                if let CellRemark::LeftOut { elements: all } = other {
                    all.extend(elements.iter().cloned());
                    return;
                }
            }
        }
        remarks.push(self);
    }

    /// Sorts warnings before notes.
    pub(crate) fn warnings_first(mut remarks: Vec<CellRemark>) -> Vec<CellRemark> {
        remarks.sort_by_key(|remark| !remark.is_warning());
        remarks
    }

    /// Returns the remark with `prefixed` applied to all names of links, joints and items.
    pub(crate) fn with_robot_name(&self, prefixed: impl Fn(&str) -> String) -> Self {
        let mut remark = self.clone();
        let names: Vec<&mut String> = match &mut remark {
            CellRemark::MostLinksWithoutBodies { links, .. }
            | CellRemark::MostLinksUnchecked { links, .. }
            | CellRemark::LinksWithoutBodies { links }
            | CellRemark::UnknownLinks { links }
            | CellRemark::StaticItemsUnchecked { items: links } => links.iter_mut().collect(),
            CellRemark::LeftOut { elements } => elements.iter_mut().collect(),
            CellRemark::EmptyRobot { link: name }
            | CellRemark::UnlikelySize { item: name, .. }
            | CellRemark::Input { item: name, .. } => vec![name],
            CellRemark::PairsLeftOut(LeftOutPairs { pairs, .. })
            | CellRemark::ContactsAllowed { pairs } => pairs.iter_mut().flatten().collect(),
            CellRemark::OtherRobotName { .. }
            | CellRemark::ExactMeshes { .. }
            | CellRemark::MeshContent { .. } => Vec::new(),
        };
        for name in names {
            *name = prefixed(name);
        }
        remark
    }
}

impl fmt::Display for CellRemark {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            CellRemark::MostLinksWithoutBodies {
                links,
                moving_count,
            } => write!(
                f,
                "most of the robot is not checked: {} of {moving_count} moving links have no bodies: {}; the shapes for drawing \
                 may have them",
                links.len(),
                links.join(", ")
            ),
            CellRemark::MostLinksUnchecked {
                links,
                moving_count,
            } => write!(
                f,
                "most of the robot is not checked against itself: {} of {moving_count} moving links are checked against no other \
                 link: {}",
                links.len(),
                links.join(", ")
            ),
            CellRemark::EmptyRobot { link } => write!(
                f,
                "the robot's file has one link without shapes, {link}, and no joints; does it contain only macros, or only shapes for \
                 drawing?"
            ),
            CellRemark::LeftOut { elements } => write!(
                f,
                "elements of the robot's file are ignored, although other programs may use them: {}",
                elements.join(", ")
            ),
            CellRemark::UnknownLinks { links } => write!(
                f,
                "the SRDF names links that the robot does not have; their pairs are left out: {}",
                links.join(", ")
            ),
            CellRemark::OtherRobotName { robot, of_srdf } => write!(
                f,
                "the SRDF names another robot; does it belong to this one? It is of `{of_srdf}`, and the robot is `{robot}`"
            ),
            CellRemark::UnlikelySize {
                item,
                size,
                robot_size,
            } => {
                let [size, robot_size] = [size, robot_size].map(|&size| RoundedToFourDigits(size));
                write!(
                    f,
                    "the size of {item} is unlikely next to the robot's; is it in the robot's unit of length? {item} is {size} long, \
                     and the robot {robot_size}"
                )
            }
            CellRemark::Input { item, remark } => write!(f, "{item}: {remark}"),
            CellRemark::LinksWithoutBodies { links } => write!(
                f,
                "{} without bodies, compared with nothing: {}",
                counted(links.len(), "link"),
                links.join(", ")
            ),
            CellRemark::PairsLeftOut(LeftOutPairs { reason, pairs }) => write!(
                f,
                "{} of links not checked ({reason}): {}",
                counted(pairs.len(), "pair"),
                listed(pairs)
            ),
            CellRemark::StaticItemsUnchecked { items } => write!(
                f,
                "not compared with obstacles, since no joint moves it: {}",
                items.join(", ")
            ),
            CellRemark::ContactsAllowed { pairs } => write!(
                f,
                "{} allowed: {}",
                counted(pairs.len(), "contact"),
                listed(pairs)
            ),
            CellRemark::ExactMeshes { meshes } => write!(
                f,
                "bodies may enter hollows of these meshes, but MuJoCo uses their convex hulls: {}",
                meshes.join(", ")
            ),
            CellRemark::MeshContent { mesh, content } => write!(f, "mesh {mesh}: {content}"),
        }
    }
}

fn listed(pairs: &[[String; 2]]) -> String {
    let texts: Vec<String> = pairs.iter().map(|[a, b]| format!("{a} and {b}")).collect();
    texts.join(", ")
}

/// Formats a count with its noun.
pub(crate) fn counted(count: usize, thing: &str) -> String {
    match count {
        1 => format!("1 {thing}"),
        _ => format!("{count} {thing}s"),
    }
}
