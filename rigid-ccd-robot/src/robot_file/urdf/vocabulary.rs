//! The known elements and attributes of URDF, including extensions by other programs.

/// The attributes and children that an element may have, each a list of names separated by spaces.
pub(super) struct Vocabulary {
    name: &'static str,
    /// The known attributes: those that are read, and those that are unrelated to shapes, joints and pairs.
    pub(super) attributes: &'static str,
    /// The children that are read.
    children: &'static str,
    /// The children that are unrelated to shapes, joints and pairs.
    pub(super) harmless: &'static str,
    /// The children that other programs may use for shapes, joints or pairs. They are ignored with a remark.
    pub(super) left_out: &'static str,
}

/// Returns whether a list of names separated by spaces contains a name.
pub(super) fn contains(names: &str, name: &str) -> bool {
    names.split(' ').any(|listed| listed == name)
}

/// Returns the vocabulary of an element; `None` if it is unknown in its parent. The parent of the root is the empty
/// string.
pub(super) fn vocabulary_of(parent: &str, element: &str) -> Option<&'static Vocabulary> {
    let find = |name: &str| VOCABULARY.iter().find(|entry| entry.name == name);
    let is_child = parent.is_empty() && element == "robot"
        || find(parent).is_some_and(|parent| contains(parent.children, element));
    find(element).filter(|_| is_child)
}

/// An element without children.
const fn leaf(name: &'static str, attributes: &'static str) -> Vocabulary {
    Vocabulary {
        name,
        attributes,
        children: "",
        harmless: "",
        left_out: "",
    }
}

/// The vocabulary of each element, from `urdfdom` 6 and from files of other programs.
const VOCABULARY: &[Vocabulary] = &[
    Vocabulary {
        children: "link joint",
        harmless: "gazebo material mujoco ros2_control sensor transmission",
        left_out: "loop_joint",
        ..leaf("robot", "name version")
    },
    Vocabulary {
        children: "collision visual",
        harmless: "audio_source contact gravity inertial kinematic surface",
        left_out: "collision_checking origin self_collision_checking self_filter",
        ..leaf("link", "name type")
    },
    Vocabulary {
        children: "origin geometry",
        harmless: "contact_coefficients material surface verbose",
        ..leaf("collision", "name")
    },
    Vocabulary {
        children: "origin geometry",
        harmless: "material",
        ..leaf("visual", "name")
    },
    Vocabulary {
        children: "box capsule cylinder mesh sphere",
        ..leaf("geometry", "name")
    },
    leaf("box", "size"),
    leaf("capsule", "radius length"),
    leaf("cylinder", "radius length"),
    leaf("mesh", "filename scale"),
    leaf("sphere", "radius"),
    leaf("origin", "xyz rpy quat_xyzw"),
    Vocabulary {
        children: "origin parent child axis limit mimic",
        harmless: "calibration dynamics safety_controller",
        ..leaf("joint", "name type dont_collapse")
    },
    leaf("parent", "link"),
    leaf("child", "link"),
    leaf("axis", "xyz"),
    leaf(
        "limit",
        "lower upper effort velocity acceleration deceleration jerk command_effort current gear_velocity",
    ),
    leaf("mimic", "joint multiplier offset"),
];
